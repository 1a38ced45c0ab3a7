//! Programmes with many more rows than unknowns, in sequence: a beam between more supports than it
//! has modes.

use crate::beam;
use crate::qp_support::{Dense, Judge};
use nalgebra::{DMatrix, DVector};
use signorini::qp::{Backend, Rhs, Solver};

/// Modes, supports, and how hard the beam is shaken, m/s²: from one that rests on all of its
/// supports to one that leaves most of them.
const BEAMS: [(usize, usize, f64); 9] = [
    (12, 300, 1.0),
    (12, 300, 10.0),
    (20, 60, 1.0),
    (20, 60, 10.0),
    (20, 100, 1.0),
    (20, 100, 10.0),
    (60, 199, 1.0),
    (60, 199, 100.0),
    (60, 100, 10.0),
];

/// The scale of bounds, a speed in m/s: the gap over the step.
const SCALE: f64 = beam::GAP / beam::STEP;

/// Programmes of each sequence, and how many of them Clarabel solves too, which takes up to 0.1 s
/// each.
const COUNT: usize = 60;
const ASKED: usize = 8;

#[test]
fn more_supports_than_modes_are_solved_without_clarabel_and_as_by_it() {
    for (modes, supports, shake) in BEAMS {
        let (beam, steps) = beam::programmes(modes, supports, shake, COUNT);
        let dense = Dense {
            g: DMatrix::from_fn(supports, modes, |i, j| beam.g[i][j]),
            a: DMatrix::from_diagonal(&DVector::from_column_slice(&beam.a)),
            compliance: DVector::zeros(supports),
        };
        let judge = Judge::new(&dense);
        let new = |backend| Solver::new(beam.problem(), backend, SCALE).unwrap();
        let (mut solver, mut clarabel) = (new(Backend::Condensed), new(Backend::Clarabel));
        let (mut reached, mut play, mut apart) = (0, 0, [0.0_f64; 2]);
        for (at, (b, lo, hi)) in steps.iter().enumerate() {
            let rhs = Rhs { b, lo, hi };
            let found = solver.solve(&rhs).unwrap().clone();
            let residual = judge.judge(&rhs, SCALE, &found);
            let what = format!("{modes} modes, {supports} supports, {shake} m/s², step {at}: {residual:?}");
            // Those of `qp_condensed.rs`: the sign test's 1e-12, looser by powers of ten where rows
            // are so nearly dependent that rounding decides who carries.
            assert!(residual.stationarity.max(residual.complementarity) <= 1e-12, "{what}");
            assert!(residual.feasibility <= 1e-10, "{what}");
            reached += lo.iter().zip(hi).filter(|(lo, hi)| lo.is_finite() || hi.is_finite()).count();
            play += found.multiplier.iter().filter(|r| **r != 0.0).count();
            if at % (COUNT / ASKED) == 0 {
                let other = clarabel.solve(&rhs).unwrap();
                let most = |values: &[f64]| values.iter().fold(0.0, |most, v: &f64| f64::max(most, v.abs()));
                let difference =
                    |a: &[f64], b: &[f64]| most(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>());
                apart[0] = apart[0].max(difference(&found.x, &other.x) / SCALE.max(most(&other.x)));
                // Σ Wᵢᵢ rᵢ², of which ours is to be the least.
                let sum = |r: &[f64]| r.iter().enumerate().map(|(i, r)| judge.w[(i, i)] * r * r).sum::<f64>();
                apart[1] = apart[1].max(sum(&found.multiplier) / sum(&other.multiplier) - 1.0);
            }
        }
        let counters = solver.counters();
        println!(
            "{modes} modes, {supports} supports, {shake} m/s²: {} reached, {} carry; apart {apart:?}; {counters:?}",
            reached / COUNT,
            play / COUNT
        );
        // x is unique: rounding of one solve with A. The forces are not: no others have a smaller
        // sum, but where rows are so nearly dependent that rounding decides which of them touch.
        assert!(apart[0] <= 1e-12 && apart[1] <= 1e-6, "{modes} modes, {supports} supports, {shake} m/s²: {apart:?}");
        // Exchanging all wrong rows at once left most of these to Clarabel, after hundreds of
        // passes.
        assert_eq!(counters.fallbacks, 0, "{modes} modes, {supports} supports, {shake} m/s²: {counters:?}");
    }
}
