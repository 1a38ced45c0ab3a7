//! Rows that depend on one another, at whole numbers: many touch at once, and share forces.

use super::*;
use crate::qp::tests::trial::{Dense, Draws};
use nalgebra::{DMatrix, DVector};

/// The columns `rows` of Gᵀ.
fn seen(g: &DMatrix<f64>, rows: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(g.ncols(), rows.len(), |j, i| g[(rows[i], j)])
}

#[test]
fn forces_balance_and_are_those_of_least_norm() {
    let mut draws = Draws::new(14, 0);
    let mut judged = 0;
    for trial in 0..400 {
        let (n, m) = (1 + trial % 3, 2 + trial % 9);
        let g = DMatrix::from_fn(m, n, |_, _| draws.whole(-2, 2));
        let g = DMatrix::from_fn(m, n, |i, j| if g.row(i).amax() == 0.0 { 1.0 } else { g[(i, j)] });
        let dense = Dense { mass: 1.0, g, compliance: vec![0.0; m] };
        let mut solver = Solver::new(dense.problem(), Backend::Condensed, 1.0).unwrap();
        let g = &dense.g;
        for step in 0..6 {
            let b = DVector::from_fn(n, |_, _| draws.whole(-8, 8) * 0.5);
            let room = |draws: &mut Draws| if draws.chance(0.3) { INF } else { draws.whole(0, 2) * 0.5 };
            let (lo, hi): (Vec<f64>, Vec<f64>) = (0..m).map(|_| (-room(&mut draws), room(&mut draws))).unzip();
            let found = solver.solve(&Rhs { b: b.as_slice(), lo: &lo, hi: &hi }).unwrap();
            let case = format!("{trial}.{step}: {g} {b} {lo:?} {hi:?} {found:?}");
            let (x, r) = (DVector::from_column_slice(&found.x), DVector::from_column_slice(&found.multiplier));
            // Numbers below 10 of rows at wide angles: rounding is far below 1e-9.
            assert!((&x - &b - g.tr_mul(&r)).amax() < 1e-9, "{case}");
            let y = g * &x;
            let mut touching = vec![];
            for i in 0..m {
                assert!(lo[i] - 1e-9 < y[i] && y[i] < hi[i] + 1e-9, "row {i} of {case}");
                let (low, high) = ((y[i] - lo[i]).abs() < 1e-9, (y[i] - hi[i]).abs() < 1e-9);
                assert!((r[i] <= 0.0 || low) && (r[i] >= 0.0 || high), "row {i} of {case}");
                if low || high {
                    touching.push((i, low, high));
                }
            }
            // Least Σ Wᵢᵢ rᵢ²: there is a w with Wᵢᵢ rᵢ = gᵢ·w on each row that pushes, and on the
            // others that touch a w that would not have them push. It is unique if the rows that
            // push see all that the touching ones do.
            let weighed = |i: usize| g.row(i).norm_squared() * r[i];
            let pushing: Vec<usize> = (0..m).filter(|&i| r[i] != 0.0).collect();
            if pushing.is_empty() {
                continue;
            }
            let columns = seen(g, &pushing);
            let asked = DVector::from_iterator(pushing.len(), pushing.iter().map(|&i| weighed(i)));
            let w = columns.transpose().svd(true, true).solve(&asked, 1e-9).unwrap();
            assert!((columns.tr_mul(&w) - &asked).amax() < 1e-8, "{case}");
            let all: Vec<usize> = touching.iter().map(|row| row.0).collect();
            if seen(g, &all).rank(1e-6) == columns.rank(1e-6) {
                for &(i, low, high) in touching.iter().filter(|row| r[row.0] == 0.0) {
                    let push = (g.row(i) * &w)[0];
                    let pushes = (low && push > 1e-8) || (high && push < -1e-8);
                    assert!(!pushes, "row {i} of {case}");
                    judged += 1;
                }
            }
        }
    }
    assert!(judged > 100, "{judged}");
}
