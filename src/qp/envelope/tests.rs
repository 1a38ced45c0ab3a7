//! Factors compared with full matrices and their LU decomposition.

use super::*;
use crate::qp::tests::trial::{Dense, Draws, block, part, solution};
use nalgebra::{DMatrix, DVector};

/// Rows of which each sees as many unknowns as `reach` more than one, shifted by one from row to
/// row: W is a band. Springs of at least 0.1 keep its condition below some 1e3, so that 1e-12 is
/// far above the rounding of a dozen rows.
fn band(draws: &mut Draws, m: usize, reach: usize) -> Dense {
    let seen = |i: usize, j: usize| (i..=i + reach).contains(&j);
    let g = DMatrix::from_fn(m, m + reach, |i, j| if seen(i, j) { draws.between(-1.0, 1.0) } else { 0.0 });
    // A unit of force in which W is far from 1.
    let mass = 10_f64.powf(draws.between(-9.0, 9.0));
    Dense { mass, g, compliance: (0..m).map(|_| draws.between(0.1, 1.0) / mass).collect() }
}

/// The largest entry of `found` − `expected` beside the largest of `expected`.
fn miss(found: &[f64], expected: &DVector<f64>) -> f64 {
    let most = |v: &DVector<f64>| v.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    most(&(DVector::from_column_slice(found) - expected)) / most(expected).max(f64::MIN_POSITIVE)
}

/// Takes a row into the factor, after the pivot and the combination have been compared.
fn take(envelope: &mut Envelope, dense: &Dense, row: usize) {
    let (system, w) = (dense.at_rest(), dense.w());
    let rows = envelope.rows().to_vec();
    let line = envelope.eliminate(&system, row);
    let column = part(&w, &rows, row);
    let expected = solution(&block(&w, &rows), &column);
    let mut c = vec![9.0; 3];
    envelope.combine(line, &mut c);
    assert_eq!(c.len(), rows.len());
    assert!(miss(&c, &expected) < 1e-12, "row {row} after {rows:?}: {c:?}, {expected}");
    // What is left of Wₖₖ, and NᵀD N with N = eₖ − Σ cⱼ eⱼ.
    let left = w[(row, row)] - column.dot(&expected);
    assert!((line.pivot - left).abs() < 1e-12 * w[(row, row)], "row {row} after {rows:?}");
    let size = w[(row, row)] + rows.iter().zip(&expected).map(|(&j, c)| c * c * w[(j, j)]).sum::<f64>();
    assert!((envelope.size(&system, row, &c) - size).abs() < 1e-12 * size, "row {row} after {rows:?}");
    envelope.admit(row, line);
}

#[test]
fn rows_that_come_and_go_are_solved_for_as_by_a_full_matrix() {
    let mut draws = Draws::new(1, 0);
    for trial in 0..60 {
        let (m, reach) = (2 + trial % 11, trial % 4);
        let dense = band(&mut draws, m, reach);
        let (system, w) = (dense.at_rest(), dense.w());
        let mut envelope = Envelope::new(&system);
        for _ in 0..3 {
            let rows = envelope.rows().to_vec();
            // Some of the first rows stay; of those behind them, some come.
            let kept = (draws.between(0.0, 1.0) * (rows.len() as f64 + 1.0)) as usize;
            envelope.keep(kept);
            assert_eq!(envelope.rows(), &rows[..kept]);
            let next = envelope.rows().last().map_or(0, |last| last + 1);
            for row in next..m {
                if draws.chance(0.7) {
                    take(&mut envelope, &dense, row);
                }
            }
            let rows = envelope.rows().to_vec();
            let asked = draws.vector(rows.len());
            let mut r = asked.as_slice().to_vec();
            envelope.solve(&mut r);
            let expected = solution(&block(&w, &rows), &asked);
            assert!(miss(&r, &expected) < 1e-12, "{rows:?} of {m}: {r:?}, {expected}");
            assert!(envelope.is_ordered());
        }
    }
}

#[test]
fn largest_pivots_first_leave_over_the_rows_that_depend_on_others() {
    let mut draws = Draws::new(2, 0);
    let mut left_over = 0;
    for trial in 0..60 {
        let (n, m) = (1 + trial % 5, 1 + trial % 9);
        let mass = 10_f64.powf(draws.between(-9.0, 9.0));
        // Small whole numbers, so that rows depend on others exactly or not at all.
        let g = DMatrix::from_fn(m, n, |_, _| draws.whole(-2, 2));
        let g = DMatrix::from_fn(m, n, |i, j| if j == 0 && g.row(i).amax() == 0.0 { 1.0 } else { g[(i, j)] });
        let rank = g.rank(1e-9);
        let dense = Dense { mass, g, compliance: vec![0.0; m] };
        let (system, w) = (dense.at_rest(), dense.w());
        let mut envelope = Envelope::new(&system);
        let rows: Vec<usize> = (0..m).collect();
        let mut depend = vec![];
        envelope.refactor(&system, &rows, &mut vec![], |row, c| depend.push((row, c.to_vec())));
        let basis = envelope.rows().to_vec();
        assert_eq!((basis.len(), depend.len()), (rank, m - rank), "{basis:?} of {}", dense.g);
        assert!(!envelope.is_ordered() && basis.iter().all(|row| depend.iter().all(|other| other.0 != *row)));
        let full = block(&w, &basis);
        for (row, c) in &depend {
            let expected = solution(&full, &part(&w, &basis, *row));
            // Small whole numbers make a condition of some 1e4, at most 1e6.
            assert!(miss(c, &expected) < 1e-9, "row {row} of {basis:?}: {c:?}, {expected}");
        }
        let asked = draws.vector(rank);
        let mut r = asked.as_slice().to_vec();
        envelope.solve(&mut r);
        assert!(miss(&r, &solution(&full, &asked)) < 1e-9, "{basis:?} of {}", dense.g);
        left_over += depend.len();
        // An unordered factor takes a further row as an ordered one does,
        let line = envelope.eliminate(&system, 0);
        let mut c = vec![];
        envelope.combine(line, &mut c);
        let again = solution(&full, &part(&w, &basis, 0));
        assert!(miss(&c, &again) < 1e-9, "row 0 of {basis:?}: {c:?}, {again}");
        envelope.drop_line();
        // and forgets its order with its rows.
        envelope.keep(0);
        assert!(envelope.is_ordered() && envelope.rows().is_empty());
        take(&mut envelope, &dense, m - 1);
    }
    assert!(left_over > 100, "{left_over}");
}
