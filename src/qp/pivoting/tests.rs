//! Single passes, by hand.

use super::*;
use crate::qp::tests::trial::Dense;

const INF: f64 = f64::INFINITY;

/// The wrong rows of a pass with `held` on their lower bounds.
fn wrong(system: &Delassus, held: &[usize], lo: &[f64], ulps: f64) -> Vec<(usize, Option<Side>)> {
    let m = system.count();
    let mut pivoting = Pivoting::new(system);
    held.iter().for_each(|&row| pivoting.call(row, Side::Lower));
    pivoting.block.set(system, held);
    let (all, hi): (Vec<usize>, Vec<f64>) = ((0..m).collect(), vec![INF; m]);
    pivoting.find_wrong(system, &Rhs { b: &[], lo, hi: &hi }, &all, (1.0, ROUNDING, ulps), &mut vec![0.0; m]);
    pivoting.wrong
}

#[test]
fn a_violation_within_rounding_of_the_largest_motion_is_none() {
    // Row 0, of weight 10, is brought back by 1e6 times its weight. Row 1, of weight 1/8, is at a
    // right angle to it; four ulps of the motion are 1.1e-10 there, its own lengths 1e-12.
    let dense = Dense::rigid([[10.0, 0.0], [0.0, 0.125]]);
    let system = dense.system(&[-1e6, 0.0]);
    assert!(wrong(&system, &[0], &[0.0, 0.5e-10], 0.0).is_empty());
    assert_eq!(wrong(&system, &[0], &[0.0, 2e-10], 0.0), [(1, Some(Side::Lower))]);
    // Without a force only its own lengths count.
    assert_eq!(wrong(&dense.at_rest(), &[], &[-1.0, 0.5e-10], 0.0), [(1, Some(Side::Lower))]);
}

#[test]
fn nearly_dependent_rows_pass_on_their_rounding_errors_if_asked_to() {
    // Rows 0 and 1, at an angle of 1/64, are brought back by forces of 2²⁰ over their weights 8:
    // y₀ = −(8 + 8) 2²⁰. Row 2 of weight 4 is 32 times their difference, so that four ulps of the
    // motions, 9.3e-10, come 4 + 2 · 32 · 8 times over: 4.8e-7.
    let (wide, narrow) = (f64::from(1 << 21), f64::from(1 << 14));
    let system = Dense::rigid([[8.0, 0.0], [8.0, 0.125], [0.0, 4.0]]).system(&[-wide, -narrow]);
    let lower = vec![(2, Some(Side::Lower))];
    for (below, ulps, expected) in
        [(3e-7, ULPS, &vec![]), (3e-7, 0.0, &lower), (6e-7, ULPS, &lower), (6e-7, 0.0, &lower), (1e2, ULPS, &lower)]
    {
        assert_eq!(&wrong(&system, &[0, 1], &[0.0, 0.0, below], ulps), expected, "{below} {ulps}");
    }
}

#[test]
fn bounds_that_cross_are_told_from_rounding() {
    let system = Dense::rigid([[1.0], [1.0]]).at_rest();
    let mut pivoting = Pivoting::new(&system);
    pivoting.call(0, Side::Lower);
    pivoting.call(1, Side::Upper);
    let crossing = |lower: f64, upper: f64| {
        pivoting.crossing(&Rhs { b: &[], lo: &[lower, -INF], hi: &[INF, upper] }, &[1.0, -1.0])
    };
    for unit in [1e-12, 1.0, 1e12] {
        assert!(crossing(unit, 0.0) && crossing(unit, -unit) && crossing(0.0, -unit), "{unit}");
        assert!(!crossing(-unit, 0.0) && !crossing(unit, unit), "{unit}");
        // Within 16 ulps of both bounds they do not cross.
        assert!(!crossing(unit * (1.0 + f64::EPSILON), unit), "{unit}");
    }
    assert!(!crossing(0.0, 0.0));
}

#[test]
fn a_row_is_left_on_the_side_on_which_it_pushes() {
    // Both bounds coincide, and the row is asked to push on either side.
    let dense = Dense::rigid([[1.0, 0.0], [0.5, 1.0]]);
    let mut pivoting = Pivoting::new(&dense.at_rest());
    // The first programme brings it into play; that it turns round is no change.
    for (x, side, changes) in [(-1.0, Side::Lower, 1), (1.0, Side::Upper, 0), (-1.0, Side::Lower, 0)] {
        let (system, bounds) = (dense.system(&[x, 0.0]), [0.0, -9.0]);
        let rhs = Rhs { b: &[], lo: &bounds, hi: &[0.0, 9.0] };
        let mut r = [0.0; 2];
        assert_eq!(pivoting.solve(&system, &rhs, &[0, 1], 1.0, 5, &mut r), Some(changes));
        assert_eq!(r, [-x, 0.0]);
        assert_eq!(pivoting.called().collect::<Vec<_>>(), [(0, side)]);
    }
}
