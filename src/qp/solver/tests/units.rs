//! Programmes in other units of mass and length. Where these are powers of two (even ones for the
//! mass, of which roots are taken), all numbers keep their digits: a solver whose tolerances have
//! the right dimensions takes the same steps to the same bits.

use super::*;
use crate::qp::tests::trial::{Draws, chain};
use nalgebra::{DMatrix, DVector};

/// A programme and its right-hand sides.
struct Sequence {
    a: DMatrix<f64>,
    g: DMatrix<f64>,
    compliance: Vec<f64>,
    steps: Vec<[Vec<f64>; 3]>,
}

impl Sequence {
    /// Rows at whole numbers or anywhere: some depend on others, many touch.
    fn new(draws: &mut Draws, n: usize, m: usize, whole: bool) -> Self {
        let (a, _, _) = chain(draws, n, 0);
        let a = &a / a.amax();
        let g = DMatrix::from_fn(m, n, |_, _| if whole { draws.whole(-2, 2) } else { draws.between(-1.0, 1.0) });
        // No row sees nothing, and has a weight without a unit.
        let g = DMatrix::from_fn(m, n, |i, j| if g.row(i).amax() == 0.0 { 1.0 } else { g[(i, j)] });
        let soft = draws.chance(0.3);
        let compliance = (0..m).map(|_| if soft { draws.between(0.1, 1.0) } else { 0.0 }).collect();
        let mut b = draws.vector(n) * 3.0;
        let mut step = |draws: &mut Draws| {
            b = 0.5 * &b + draws.vector(n) * 3.0;
            let room = |draws: &mut Draws| if draws.chance(0.2) { INF } else { draws.whole(0, 2) * 0.25 };
            let (lo, hi): (Vec<f64>, Vec<f64>) = (0..m).map(|_| (-room(draws), room(draws))).unzip();
            [b.as_slice().to_vec(), lo, hi]
        };
        let steps = (0..6).map(|_| step(draws)).collect();
        Self { a, g, compliance, steps }
    }

    /// Everything found, and the counters, with masses 4^`mass` and lengths 2^`length` as large;
    /// the results in the units of this programme.
    fn solved(&self, backend: Backend, mass: i32, length: i32) -> Vec<(Option<Solution>, SolverCounters)> {
        let (mass, length) = (4_f64.powi(mass), 2_f64.powi(length));
        let (m, n) = self.g.shape();
        let lower = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let entries = lower.map(|(i, j)| (i, j, self.a[(i, j)] * mass)).filter(|entry| entry.2 != 0.0);
        let row = |i: usize| (0..n).map(|j| (j, self.g[(i, j)])).filter(|entry| entry.1 != 0.0).collect::<Vec<_>>();
        let rows: Vec<_> = (0..m).map(row).collect();
        let problem = Problem {
            a: Symmetric::from_entries(n, entries),
            g: Rows::new(n, rows.iter().map(Vec::as_slice)),
            compliance: self.compliance.iter().map(|c| c / mass).collect(),
        };
        let mut solver = Solver::new(problem, backend, length).unwrap();
        let times = |v: &[f64], unit: f64| v.iter().map(|x| x * unit).collect::<Vec<_>>();
        let step = |[b, lo, hi]: &[Vec<f64>; 3]| {
            let (b, lo, hi) = (times(b, mass * length), times(lo, length), times(hi, length));
            let found = solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).ok().cloned();
            let back = |found: Solution| Solution {
                x: times(&found.x, 1.0 / length),
                multiplier: times(&found.multiplier, 1.0 / (mass * length)),
            };
            (found.map(back), solver.counters())
        };
        self.steps.iter().map(step).collect()
    }
}

#[test]
fn a_programme_is_solved_in_the_same_steps_in_all_units() {
    let mut draws = Draws::new(12, 0);
    let mut total = SolverCounters::default();
    for trial in 0..150 {
        // Few rows, as many as unknowns or more, and far more.
        let (n, m) = [(4, 3), (3, 6), (2, 20), (5, 40)][trial % 4];
        let sequence = Sequence::new(&mut draws, n, m, trial % 3 > 0);
        let backend = if trial % 10 == 9 { Backend::Clarabel } else { Backend::Condensed };
        let plain = sequence.solved(backend, 0, 0);
        for (mass, length) in [(-20, 0), (20, 0), (0, -40), (0, 40), (-20, 40), (20, -40)] {
            let other = sequence.solved(backend, mass, length);
            assert_eq!(other, plain, "trial {trial}, {n} unknowns, {m} rows, mass 4^{mass}, length 2^{length}");
        }
        let (found, counters) = plain.last().unwrap();
        assert!(found.is_some(), "all bounds contain 0");
        total.pivots += counters.pivots;
        total.crowded += counters.crowded;
        total.iterations += counters.iterations;
    }
    assert!(total.pivots > 300 && total.crowded > 50 && total.iterations > 100, "{total:?}");
}

#[test]
fn a_band_is_solved_in_the_same_steps_in_all_units() {
    // Steps of a long chain whose rows all see one unknown.
    let mut draws = Draws::new(13, 0);
    for trial in 0..4 {
        let n = 60;
        let (a, _, _) = chain(&mut draws, n, 0);
        let a = &a / a.amax();
        let compliance = (0..n).map(|_| if trial % 2 == 0 { 0.0 } else { draws.between(0.0, 0.1) }).collect();
        let b = draws.vector(n);
        let step = |draws: &mut Draws| {
            let load = (&b + draws.vector(n)) * 2.0 + DVector::repeat(n, 2.0);
            [load.as_slice().to_vec(), vec![-INF; n], vec![0.0; n]]
        };
        let steps = (0..4).map(|_| step(&mut draws)).collect();
        let sequence = Sequence { a, g: DMatrix::identity(n, n), compliance, steps };
        let plain = sequence.solved(Backend::Condensed, 0, 0);
        assert!(plain[3].1.eliminated > 0, "{:?}", plain[3].1);
        for (mass, length) in [(-20, 0), (20, 0), (0, -40), (0, 40)] {
            assert_eq!(sequence.solved(Backend::Condensed, mass, length), plain, "trial {trial}, {mass}, {length}");
        }
    }
}
