//! The parts of the method, by closed forms and full matrices.

use super::*;
use crate::qp::tests::trial::{Dense, Draws};
use nalgebra::{DMatrix, DVector};

#[test]
fn a_line_search_ends_where_the_slope_is_zero() {
    let mut draws = Draws::new(8, 0);
    for trial in 0..500 {
        let n = 1 + trial % 7;
        // Numbers that are often 0 or equal, so that kinks fall together or on the start.
        let a: Vec<f64> = (0..n).map(|_| draws.whole(-3, 3)).collect();
        let mut b: Vec<f64> = (0..n).map(|_| draws.whole(-2, 2)).collect();
        b.push(draws.between(0.1, 1.0));
        let a = [a, vec![draws.between(-1.0, 1.0)]].concat();
        // d/dt of ½ Σ max(0, a + t b)² − c t, which increases with t; it falls at t = 0.
        let slope = |t: f64| a.iter().zip(&b).map(|(a, b)| (a + t * b).max(0.0) * b).sum::<f64>();
        let fall = draws.between(0.01, 5.0);
        let c = slope(0.0) + fall;
        let length = line_search(&a, &b, fall, &mut vec![]);
        // Terms up to 10, times the step: rounding of a dozen of them.
        assert!(length > 0.0 && (slope(length) - c).abs() < 1e-12 * length.max(1.0), "{trial}: {a:?} {b:?} {length}");
    }
    // Where nothing grows any more there is no such place: the search ends at the last kink.
    assert_eq!(line_search(&[1.0, 2.0], &[-1.0, -1.0], 9.0, &mut vec![]), 2.0);
}

#[test]
fn rows_are_factored_by_their_directions() {
    let mut draws = Draws::new(9, 0);
    for trial in 0..40 {
        let (n, m) = (1 + trial % 5, 1 + trial % 9);
        let mass = 10_f64.powf(draws.between(-12.0, 12.0));
        let dense =
            Dense { mass, g: DMatrix::from_fn(m, n, |_, _| draws.between(-1.0, 1.0)), compliance: vec![0.0; m] };
        let (system, w) = (dense.at_rest(), dense.w());
        let (direction, rank) = directions(&system);
        assert_eq!((rank, direction.len()), (n.min(m), rank * m), "trial {trial}");
        let p = DMatrix::from_row_slice(m, rank, &direction);
        let weight = DMatrix::from_diagonal(&DVector::from_column_slice(&system.weight));
        // What is left of each Wᵢᵢ is at most 1e-14 of it.
        let missing = &weight * &p * p.transpose() * &weight - &w;
        assert!(missing.amax() < 1e-12 * w.amax(), "trial {trial}: {missing}");
    }
}

#[test]
fn a_shifted_matrix_is_factored_and_solved_for() {
    let mut draws = Draws::new(10, 0);
    for n in 1..8 {
        let half = DMatrix::from_fn(n, n, |_, _| draws.between(-1.0, 1.0));
        let (h, shift) = (&half * half.transpose(), draws.between(0.5, 1.0));
        // Stored by rows; only the lower half is read.
        let mut lower: Vec<f64> = h.transpose().as_slice().to_vec();
        (0..n).for_each(|i| lower[i * n + i + 1..(i + 1) * n].fill(f64::NAN));
        factor(&mut lower, n, shift);
        let asked = draws.vector(n);
        let mut found = asked.as_slice().to_vec();
        solve(&lower, n, &mut found);
        let missing = (h + DMatrix::identity(n, n) * shift) * DVector::from_column_slice(&found) - asked;
        // Condition below 10.
        assert!(missing.amax() < 1e-13, "{n}: {missing}");
    }
    // What rounding makes negative is kept positive.
    let mut negative = [-3.0];
    factor(&mut negative, 1, 0.25);
    assert_eq!(negative, [0.5]);
}

#[test]
fn rows_touch_within_rounding_and_where_they_push() {
    for unit in [1e-9, 1.0, 1e9] {
        let system = Dense::rigid([[1.0], [1.0], [1.0], [2.0]]).system(&[0.0]);
        let mut crowd = RedundantRows::new(&system);
        crowd.play.push(&system, 0, Side::Lower);
        // Row 0 pushes all of them up by one unit, row 3 by two.
        let lo = [1.0, 1.0 - 0.9e-12, 1.0 - 1.1e-12, -2.0].map(|x| x * unit);
        let hi = [f64::INFINITY, 1.5 * unit, 1.0 * unit, 2.0 * unit];
        crowd.touch(&system, &Rhs { b: &[], lo: &lo, hi: &hi }, unit, &[unit, 0.0, 0.0, 0.0]);
        let (lower, upper) = (Side::Lower, Side::Upper);
        assert_eq!(crowd.touching, [(0, lower), (1, lower), (2, upper), (3, upper)], "{unit}");
        // A row with a force touches, wherever it is.
        let far = [9.0 * unit; 4];
        crowd.touch(&system, &Rhs { b: &[], lo: &far, hi: &far.map(|x| 2.0 * x) }, unit, &[unit, 0.0, 0.0, 0.0]);
        assert_eq!(crowd.touching, [(0, lower)], "{unit}");
    }
}

#[test]
fn a_wrong_guess_of_who_shares_the_force_is_corrected_and_counted() {
    // Three rows at 1 before a body at 2: the active set takes one of them. Without directions
    // nobody is said to share, and pivoting brings all three into play.
    let system = Dense::rigid([[1.0], [1.0], [1.0]]).system(&[2.0]);
    let (mut crowd, mut pivoting) = (RedundantRows::new(&system), Pivoting::new(&system));
    crowd.direction.fill(0.0);
    let rhs = Rhs { b: &[2.0], lo: &[f64::NEG_INFINITY; 3], hi: &[1.0; 3] };
    let mut r = [0.0; 3];
    assert_eq!(crowd.solve(&system, &mut pivoting, &rhs, &[0, 1, 2], 1.0, &mut r), Some(1 + 3));
    assert!(r.iter().all(|r| (r + 1.0 / 3.0).abs() < 1e-15), "{r:?}");
}
