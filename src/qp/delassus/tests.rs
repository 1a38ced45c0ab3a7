//! The condensed matrix, compared with a full one.

use super::*;
use crate::qp::tests::trial::{Dense, Draws, chain};
use nalgebra::{DMatrix, DVector};

#[test]
fn motions_and_forces_are_those_of_the_full_matrices_in_all_units() {
    let mut draws = Draws::new(7, 0);
    for trial in 0..40 {
        let (n, m) = (1 + trial % 9, 1 + trial % 7);
        let (a, g, problem) = chain(&mut draws, n, m);
        let compliance = DVector::from_column_slice(&problem.compliance);
        let w = &g * a.clone().cholesky().expect("definite").inverse() * g.transpose();
        let w = w + DMatrix::from_diagonal(&compliance);
        let mut system = Delassus::new(&problem).expect("definite");
        // Rounding of a dozen sums of a matrix of condition below 10.
        let size = w.amax();
        for i in 0..m {
            let (found, expected) = (system.weight[i], w[(i, i)].sqrt());
            assert!((found - expected).abs() < 1e-13 * expected, "trial {trial}, row {i}: {found} {expected}");
            for j in 0..m {
                let missing = system.entry(i, j) - w[(i, j)];
                assert!(missing.abs() < 1e-13 * size, "trial {trial}, {i}, {j}: {missing} of {size}");
                // Symmetric to the last bit.
                assert_eq!(system.entry(i, j), system.entry(j, i), "trial {trial}, {i}, {j}");
            }
        }
        let b = &a * draws.vector(n);
        let mut x = vec![0.0; n];
        system.release(b.as_slice(), &mut x);
        system.complete(&x);
        let free = &g * DVector::from_column_slice(&x);
        assert!((DVector::from_column_slice(&system.y) - &free).amax() < 1e-13 * free.amax().max(1.0), "trial {trial}");
        // Some forces, and the motion they cause.
        let rows: Vec<usize> = (0..m).filter(|_| draws.chance(0.5)).collect();
        let r = DVector::from_fn(m, |i, _| if rows.contains(&i) { draws.between(-1.0, 1.0) * a.amax() } else { 0.0 });
        system.respond(b.as_slice(), &rows, r.as_slice(), &mut x);
        let missing = &a * DVector::from_column_slice(&x) - &b - g.tr_mul(&r);
        assert!(missing.amax() < 1e-13 * (b.amax() + r.amax()), "trial {trial}: {missing}");
    }
}

#[test]
fn rows_that_touch_their_bounds_are_free() {
    let mut system = Dense::rigid([[1.0, 0.0], [0.0, 2.0]]).at_rest();
    let mut free = |lo: [f64; 2], hi: [f64; 2]| system.is_free(&Rhs { b: &[], lo: &lo, hi: &hi }, &[0, 1], &[0.5, 0.5]);
    assert!(free([0.5, 1.0], [0.5, 1.0]));
    assert!(!free([0.6, 1.0], [0.7, 1.0]) && !free([0.5, 0.1], [0.5, 0.9]));
}

#[test]
fn rows_that_hardly_move_one_another_are_loose_in_all_units() {
    for unit in [1e-15, 1.0, 1e15] {
        for (share, loose) in [(0.09, true), (-0.09, true), (0.11, false), (-0.11, false), (0.0, true)] {
            // W₀₁ is this share of √(W₀₀ W₁₁).
            let rest = f64::sqrt(1.0 - share * share);
            for row in [1.0, 1e-3, 1e3] {
                let mut dense = Dense::rigid([[1.0, 0.0], [row * share, row * rest]]);
                dense.mass = 1.0 / unit;
                assert_eq!(dense.at_rest().loose, loose, "{unit} {share} {row}");
            }
        }
        // Two couplings add up.
        for (share, loose) in [(0.04, true), (0.06, false)] {
            let mut dense = Dense::rigid([[1.0, 0.0, 0.0], [share, 1.0, 0.0], [share, 0.0, 1.0]]);
            dense.mass = 1.0 / unit;
            assert_eq!(dense.at_rest().loose, loose, "{unit} {share}");
        }
    }
}
