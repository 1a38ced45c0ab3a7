//! Independent and dependent rows, with full matrices.

use super::*;
use crate::qp::tests::trial::{Dense, Draws, block, part, solution};
use nalgebra::{DMatrix, DVector};

/// Units of W: no power of ten is special.
const UNITS: [f64; 5] = [1e-15, 1e-9, 1.0, 1e9, 1e15];

fn all(system: &Delassus) -> Block {
    let mut block = Block::new(system);
    let rows: Vec<usize> = (0..system.count()).collect();
    block.set(system, &rows);
    block
}

#[test]
fn dependent_rows_are_told_from_nearly_dependent_ones_in_all_units() {
    for unit in UNITS {
        let sees = |rows: &[[f64; 3]]| {
            let g = DMatrix::from_fn(rows.len(), 3, |i, j| rows[i][j]);
            let dense = Dense { mass: 1.0 / unit, g, compliance: vec![0.0; rows.len()] };
            let block = all(&dense.at_rest());
            let found = (block.rank(), block.factor.rows().len(), block.relations.rows().to_vec());
            assert_eq!((found.0, rows.len() - found.0), (found.1, found.2.len()), "{unit}: {found:?}");
            (block.singular(), block.factor.is_ordered(), found.2)
        };
        // Three directions, two of them at an angle of 1e-3 or 1e-5: all independent.
        for angle in [1e-3, 1e-5] {
            assert_eq!(sees(&[[1.0, 0.0, 0.0], [1.0, angle, 0.0], [0.0, 0.3, 0.7]]), (false, true, vec![]), "{unit}");
        }
        // An angle of 1e-7 is none; neither is that to a plane through two rows.
        assert_eq!(sees(&[[1.0, 0.0, 0.0], [3.0, 3e-7, 0.0]]), (true, true, vec![1]), "{unit}");
        let plane = [[0.3, 0.0, 0.1], [0.1, 0.7, 0.0], [0.5, 1.4, 0.1], [0.0, 0.0, 1.0]];
        assert_eq!(sees(&plane), (true, true, vec![2]), "{unit}");
        // c = 30 for the third row, a size of 1800 times its own: another order.
        let fan = [[1.0, 0.0, 0.0], [1.0, 1.0 / 30.0, 0.0], [0.0, 1.0, 0.0]];
        let (singular, ordered, depend) = sees(&fan);
        assert!(singular && !ordered && (depend == [0] || depend == [1]), "{unit}: {depend:?}");
        // c = 15, a size of 450: the increasing order will do.
        assert_eq!(sees(&[fan[0], [1.0, 1.0 / 15.0, 0.0], fan[2]]), (true, true, vec![2]), "{unit}");
    }
    // A row that sees nothing depends on nothing else.
    let idle = Dense::rigid([[1.0, 0.0], [0.0, 0.0], [0.0, 2.0]]);
    assert_eq!(Block::new(&idle.at_rest()).rank(), 2);
    assert_eq!(Block::new(&Dense::rigid([[0.0]]).at_rest()).rank(), 0);
    assert_eq!(Block::new(&Dense::rigid::<0, 1>([]).at_rest()).rank(), 0);
}

#[test]
fn rows_come_and_go_after_a_change_of_order() {
    let dense = Dense::rigid([[1.0, 0.0, 0.0], [1.0, 1e-2, 0.0], [0.0, 1.0, 0.0], [0.2, 0.1, 1.0]]);
    let (system, w) = (dense.at_rest(), dense.w());
    let mut play = Block::new(&system);
    let motion = dense.g.clone() * DVector::from_column_slice(&[0.3, -0.2, 0.5]);
    for rows in [vec![0, 1, 2], vec![0, 1, 2, 3], vec![0, 1, 3], vec![1, 2], vec![0, 1, 2], vec![0, 1, 2], vec![]] {
        play.set(&system, &rows);
        assert_eq!(play.rows(), rows);
        assert_eq!(play.factor.is_ordered(), !rows.starts_with(&[0, 1, 2]), "{rows:?}");
        let mut r = [0.0; 4];
        // The slack is far above the rounding of motions below 1 of rows at an angle of 1e-2.
        play.forces(&system, |row| motion[row], |_| 1e-9, 0.0, &mut r);
        let moved = &w * DVector::from_column_slice(&r);
        assert!(rows.iter().all(|&row| (moved[row] - motion[row]).abs() < 1e-10), "{rows:?}: {moved} {motion}");
    }
}

/// Null vectors of W on `rows`, in columns.
fn null(w: &DMatrix<f64>) -> DMatrix<f64> {
    let values = w.clone().symmetric_eigen();
    let most = values.eigenvalues.amax();
    let kept: Vec<usize> = (0..w.nrows()).filter(|&i| values.eigenvalues[i].abs() < 1e-9 * most).collect();
    DMatrix::from_fn(w.nrows(), kept.len(), |i, k| values.eigenvectors[(i, kept[k])])
}

#[test]
fn forces_are_the_limit_of_vanishing_springs() {
    // r = e/δ + r₀ solves (W + δD) r = q for δ → 0: W e = 0, NᵀD e = Nᵀq, W r₀ = q − D e and
    // NᵀD r₀ = 0 for every N with W N = 0.
    let mut draws = Draws::new(3, 0);
    let (mut escaped, mut shared, mut unique) = (0, 0, 0);
    for trial in 0..200 {
        let (n, m) = (1 + trial % 4, 2 + trial % 7);
        // Small whole numbers make rows that depend on one another exactly or by wide angles.
        let g = DMatrix::from_fn(m, n, |_, _| draws.whole(-2, 2));
        let g = DMatrix::from_fn(m, n, |i, j| if j == 0 && g.row(i).amax() == 0.0 { 1.0 } else { g[(i, j)] });
        let mass = 10_f64.powf(draws.between(-9.0, 9.0));
        let dense = Dense { mass, g, compliance: vec![0.0; m] };
        let (system, w) = (dense.at_rest(), dense.w());
        let rows: Vec<usize> = (0..m).filter(|_| draws.chance(0.8)).collect();
        if rows.is_empty() {
            continue;
        }
        let (length, meets) = (10_f64.powf(draws.between(-6.0, 3.0)), draws.chance(0.5));
        let asked = length * if meets { &dense.g * draws.vector(n) } else { draws.vector(m) };
        let mut play = Block::new(&system);
        play.set(&system, &rows);
        let mut r = vec![f64::NAN; m];
        play.forces(&system, |row| asked[row], |_| 1e-8 * length, 0.0, &mut r);
        assert!((0..m).all(|row| r[row].is_nan() != rows.contains(&row)), "others stay as they are");
        let of = |r: &[f64]| DVector::from_iterator(rows.len(), rows.iter().map(|&row| r[row]));
        let none = vec![0.0; m];
        let (r, e) = (of(&r), of(play.escape().unwrap_or(&none)));
        let (w, q) = (block(&w, &rows), DVector::from_iterator(rows.len(), rows.iter().map(|&row| asked[row])));
        let d = DMatrix::from_diagonal(&w.diagonal());
        let free = null(&w);
        // Small whole numbers make a condition of some 1e4, at most 1e6.
        let most = w.amax();
        let close = |a: DVector<f64>, size: f64| a.is_empty() || a.amax() <= 1e-7 * size;
        assert!(close(&w * &e, most * e.amax()), "trial {trial}: {e}");
        assert!(close(free.tr_mul(&(&d * &e - &q)), q.amax()), "trial {trial}: {e}");
        assert!(close(&w * &r + &d * &e - &q, q.amax()), "trial {trial}: {r}");
        assert!(close(free.tr_mul(&(&d * &r)), most * r.amax()), "trial {trial}: {r}");
        let grows = free.ncols() > 0 && !close(free.tr_mul(&q), q.amax());
        assert_eq!(play.escape().is_some(), grows, "trial {trial}");
        escaped += usize::from(grows);
        shared += usize::from(!grows && free.ncols() > 0);
        unique += usize::from(free.ncols() == 0);
    }
    assert!(escaped > 30 && shared > 30 && unique > 30, "{escaped} {shared} {unique}");
}

#[test]
fn an_escape_is_measured_by_the_motion_that_it_causes() {
    // A row that sees 1e5 times what the other sees needs 1e-5 of its force: with N = (−1e-5, 1),
    // NᵀD N = 2 and Nᵀq = ±1, e = ±N/2.
    for (rows, asked, escape) in
        [([[1e5], [1.0]], [0.0, 1.0], [-5e-6, 0.5]), ([[1.0], [1e5]], [1.0, 0.0], [0.5, -5e-6])]
    {
        let system = Dense::rigid(rows).at_rest();
        let mut play = all(&system);
        play.forces(&system, |row| asked[row], |_| 1e-12, 0.0, &mut [0.0; 2]);
        let found = play.escape().expect("no common place");
        assert!((0..2).all(|i| (found[i] / escape[i] - 1.0).abs() < 1e-9), "{found:?}");
    }
}

#[test]
fn rounding_is_passed_on_by_the_combination() {
    let mut draws = Draws::new(4, 0);
    for trial in 0..20 {
        let m = 2 + trial % 5;
        let dense = Dense::yielding(&mut draws, m);
        let (system, w) = (dense.at_rest(), dense.w());
        let mut play = Block::new(&system);
        let rows: Vec<usize> = (0..m - 1).collect();
        play.set(&system, &rows);
        let c = solution(&block(&w, &rows), &part(&w, &rows, m - 1));
        let weight = |row: usize| w[(row, row)].sqrt();
        // Four ulps of the motion of each row, in units of its own.
        let reach = draws.between(1.0, 9.0);
        let all = weight(m - 1) + rows.iter().map(|&j| c[j].abs() * weight(j)).sum::<f64>();
        let expected = 4.0 * f64::EPSILON * reach * all;
        let found = play.rounding(&system, m - 1, reach);
        assert!((found / expected - 1.0).abs() < 1e-9, "trial {trial}: {found}, {expected}");
    }
}

#[test]
fn a_touching_row_yields_with_the_rows_it_depends_on() {
    for unit in UNITS {
        let mut dense = Dense::rigid([[1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 0.0], [1.0, 0.01], [0.0, 3.0]]);
        dense.mass = 1.0 / unit;
        let system = dense.at_rest();
        let mut play = Block::new(&system);
        play.set(&system, &[0, 1]);
        let slack = 1e-12;
        let mut yielding = |row: usize, gap: f64, r: [f64; 2]| play.yielding(&system, row, gap, |_| slack, &r);
        // The rows in play yield by D r: by −r₀ W₀₀ and −r₁ W₁₁, and row 2 by the sum of both.
        let near = |found: Option<f64>, expected: f64| found.is_some_and(|x| (x / expected - 1.0).abs() < 1e-12);
        assert!(near(yielding(2, 0.0, [3.0, 4.0]), -7.0 * unit), "{unit}");
        assert!(near(yielding(3, 0.0, [3.0, 4.0]), -6.0 * unit), "{unit}");
        assert!(near(yielding(5, 0.0, [3.0, -4.0]), 12.0 * unit), "{unit}");
        // Whatever the gap, if it is within half of what rounding allows, here of one slack; with
        // row 4 = row 0 + 0.01 row 1 as well, of which a hundredth of a slack remains.
        assert!(near(yielding(2, 0.49e-12, [3.0, 4.0]), -7.0 * unit), "{unit}");
        assert_eq!(yielding(2, 0.51e-12, [3.0, 4.0]), None, "{unit}");
        assert!(near(yielding(4, 0.49e-14, [3.0, 4.0]), -3.04 * unit), "{unit}");
        assert_eq!(yielding(4, 0.51e-14, [3.0, 4.0]), None, "{unit}");
        // Opposite forces that move a row by nothing, and no force at all.
        assert_eq!(yielding(2, 0.0, [3.0, -3.0]), None, "{unit}");
        assert_eq!(yielding(2, 0.0, [0.0, 0.0]), None, "{unit}");
        // A row at an angle to those in play does not yield with them, be it large or small.
        let mut alone = Block::new(&system);
        alone.set(&system, &[0]);
        for row in [1, 2, 4] {
            alone.forces(&system, |_| unit, |_| slack, 0.0, &mut [0.0; 6]);
            assert_eq!(alone.yielding(&system, row, 0.0, |_| slack, &[3.0, 4.0]), None, "{unit}, row {row}");
        }
    }
}
