//! The programme with its unknowns eliminated on a narrow band: against the optimality conditions
//! and against Clarabel, on matrices whose answer to a force reaches many rows.

use crate::qp_support::{Case, Dense, Judge, Random};
use nalgebra::{DMatrix, DVector};
use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Backend, Problem, Rhs, Solver};

/// A = small I + a weighted graph Laplacian of half bandwidth `width`: an M-matrix, or with signs
/// drawn at random (and dominance kept) any positive definite one.
fn matrix(random: &mut Random, n: usize, width: usize, signed: bool) -> DMatrix<f64> {
    let mut a = DMatrix::zeros(n, n);
    for i in 0..n {
        a[(i, i)] += random.decade(-3.0, -1.0);
        for j in i.saturating_sub(width)..i {
            let k = random.between(0.1, 1.0);
            let sign = if signed && random.chance(0.5) { 1.0 } else { -1.0 };
            (a[(i, j)], a[(j, i)]) = (sign * k, sign * k);
            a[(i, i)] += k;
            a[(j, j)] += k;
        }
    }
    a
}

#[test]
fn programmes_on_a_band_meet_the_optimality_conditions_and_agree_with_clarabel() {
    let mut random = Random(17);
    let (mut eliminated, mut solves, mut fallbacks) = (0, 0, 0);
    for trial in 0..200 {
        let (n, width) = (60 + random.below(40), 1 + random.below(3));
        let (stiffness, size) = (random.decade(-6.0, 9.0), random.decade(-9.0, 3.0));
        let columns: Vec<usize> = (0..n).filter(|_| random.chance(0.9)).collect();
        let m = columns.len();
        let mut g = DMatrix::zeros(m, n);
        for (row, &column) in columns.iter().enumerate() {
            g[(row, column)] = if random.chance(0.3) { random.between(-2.0, -0.5) } else { 1.0 };
        }
        let soft = if trial % 2 == 0 { 0.3 } else { 0.0 };
        let compliance =
            |random: &mut Random| if random.chance(soft) { random.decade(-2.0, 2.0) / stiffness } else { 0.0 };
        let problem = Dense {
            a: matrix(&mut random, n, width, trial % 3 == 0) * stiffness,
            g,
            compliance: DVector::from_fn(m, |_, _| compliance(&mut random)),
        };
        let judge = Judge::new(&problem);
        let new = |backend| Solver::new(problem.problem(), backend, size).expect("sound");
        let (mut condensed, mut clarabel) = (new(Backend::Condensed), new(Backend::Clarabel));
        let mut push: Vec<f64> = (0..n).map(|_| random.between(-0.3, 1.0)).collect();
        for step in 0..20 {
            push.iter_mut().for_each(|p| *p += random.between(-0.1, 0.1));
            let b: Vec<f64> = push.iter().map(|p| p * size * stiffness).collect();
            let bound = |random: &mut Random, sign: f64| match random.unit() {
                u if u < 0.1 => sign * f64::INFINITY,
                u if u < 0.3 => 0.0,
                _ => sign * random.decade(-3.0, 0.0) * size,
            };
            let lo = (0..m).map(|_| bound(&mut random, -1.0)).collect();
            let hi = (0..m).map(|_| bound(&mut random, 1.0)).collect();
            let case = Case { problem: problem.clone(), b, lo, hi, scale: size };
            let found = condensed.solve(&case.rhs()).unwrap_or_else(|e| panic!("{trial}.{step}: {e}"));
            let residual = judge.judge(&case.rhs(), size, found);
            // The tolerance of the sign test; the condition of A is 1e5 at most, of which the
            // judge's own inverse leaves 1e-11 in what it takes for free motion.
            assert!(residual.worst() <= 1e-11, "{trial}.{step}: {residual:?}");
            let reference = clarabel.solve(&case.rhs()).unwrap_or_else(|e| panic!("{trial}.{step}: {e}"));
            let most = |x: &[f64]| x.iter().fold(size, |most, v| f64::max(most, v.abs()));
            let apart = found.x.iter().zip(&reference.x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // Two exact methods on one set of rows: rounding times the condition.
            assert!(apart <= 1e-9 * most(&reference.x), "{trial}.{step}: {apart:e}");
        }
        eliminated += condensed.counters().eliminated;
        solves += condensed.counters().solves;
        fallbacks += condensed.counters().fallbacks;
    }
    println!("{eliminated} of {solves} eliminated, {fallbacks} fallbacks");
    assert!(eliminated > solves / 2, "{eliminated} of {solves}");
}

#[test]
fn few_rows_in_play_are_left_to_the_condensed_matrix() {
    // One row of two hundred pushes: W costs less than a pass over the band.
    let n = 200;
    let chain = (0..n).map(|i| (i, i, 51.0)).chain((1..n).map(|i| (i, i - 1, -25.0)));
    let unit: Vec<[(usize, f64); 1]> = (0..n).map(|i| [(i, 1.0)]).collect();
    let g = Rows::new(n, unit.iter().map(|row| row.as_slice()));
    let problem = Problem { a: Symmetric::from_entries(n, chain), g, compliance: vec![0.0; n] };
    let mut solver = Solver::new(problem, Backend::Condensed, 1.0).expect("sound");
    let solve = |solver: &mut Solver, held: usize| {
        let hi: Vec<f64> = (0..n).map(|i| if i < held { 0.0 } else { f64::INFINITY }).collect();
        solver.solve(&Rhs { b: &vec![1.0; n], lo: &vec![f64::NEG_INFINITY; n], hi: &hi }).expect("feasible");
        solver.counters().eliminated
    };
    assert_eq!((solve(&mut solver, 1), solve(&mut solver, 1)), (0, 0));
    // The first of all rows finds them, the next starts from them.
    solve(&mut solver, n);
    assert!(solve(&mut solver, n) > 0);
}
