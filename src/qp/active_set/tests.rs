//! Programmes by their optimality conditions and by hand.

use super::*;
use crate::qp::tests::trial::{Dense, Draws, block, part, solution};
use nalgebra::{DMatrix, DVector};

const INF: f64 = f64::INFINITY;

/// r and the number of pivots, from the rows `start` in play.
fn solved(
    system: &Delassus,
    start: &[(usize, Side)],
    (lo, hi): (&[f64], &[f64]),
    limit: u64,
) -> (Result<u64, Failure>, Vec<f64>) {
    let mut play = ActiveSet::new(system.count());
    start.iter().for_each(|&(row, side)| play.push(system, row, side));
    let mut r = vec![f64::NAN; system.count()];
    (play.solve(system, &Rhs { b: &[], lo, hi }, 1.0, limit, &mut r), r)
}

#[test]
fn random_programmes_meet_their_optimality_conditions_from_any_start() {
    let mut draws = Draws::new(5, 0);
    let (mut held, mut free) = (0, 0);
    for trial in 0..300 {
        let (n, m) = (1 + trial % 5, 1 + trial % 8);
        // As often rows that depend on one another as not.
        let g = if draws.chance(0.5) {
            DMatrix::from_fn(m, n, |_, _| draws.whole(-2, 2))
        } else {
            DMatrix::from_fn(m, n, |_, _| draws.between(-1.0, 1.0))
        };
        let compliance = (0..m).map(|_| if draws.chance(0.3) { draws.between(0.1, 1.0) } else { 0.0 }).collect();
        let dense = Dense { mass: 1.0, g, compliance };
        // Bounds around what a point sees can be met together.
        let (seen, w) = (&dense.g * draws.vector(n), dense.w());
        let room = |draws: &mut Draws| if draws.chance(0.3) { INF } else { draws.between(0.0, 0.5) };
        let lo: Vec<f64> = seen.iter().map(|y| y - room(&mut draws)).collect();
        let hi: Vec<f64> = seen.iter().map(|y| y + room(&mut draws)).collect();
        let system = dense.system((3.0 * draws.vector(n)).as_slice());
        let side = |draws: &mut Draws| if draws.chance(0.5) { Side::Lower } else { Side::Upper };
        let start: Vec<_> = (0..m).filter(|_| draws.chance(0.5)).collect();
        let start: Vec<_> = start.into_iter().rev().map(|row| (row, side(&mut draws))).collect();
        let (pivots, r) = solved(&system, &start, (&lo, &hi), 1000);
        assert!(pivots.is_ok(), "trial {trial}: {pivots:?}");
        let y = DVector::from_column_slice(&system.y) + &w * DVector::from_column_slice(&r);
        for row in 0..m {
            // Rounding of motions below 10 under forces that angles of some degrees make larger.
            let (y, r, lo, hi) = (y[row], r[row], lo[row], hi[row]);
            assert!(lo - 1e-9 < y && y < hi + 1e-9, "trial {trial}, row {row}: {y} in [{lo}, {hi}]");
            assert!(r <= 0.0 || (y - lo).abs() < 1e-9, "trial {trial}, row {row}: {r} at {y} over {lo}");
            assert!(r >= 0.0 || (y - hi).abs() < 1e-9, "trial {trial}, row {row}: {r} at {y} under {hi}");
            *(if r == 0.0 { &mut free } else { &mut held }) += 1;
        }
    }
    assert!(held > 300 && free > 300, "{held} {free}");
}

#[test]
fn rows_that_change_are_counted_and_limited() {
    // Four rows of different weight apart from one another, of which two are beyond their bounds.
    let dense = Dense::rigid([[2.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 3.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);
    let system = dense.system(&[1.0, -2.0, 0.0, 1.0]);
    let bounds: (&[f64], &[f64]) = (&[-1.0; 4], &[1.0; 4]);
    let (upper, lower) = (Side::Upper, Side::Lower);
    let expected = vec![-0.25, 1.0, 0.0, 0.0];
    assert_eq!(solved(&system, &[], bounds, 2), (Ok(2), expected.clone()));
    let failure = Failure::NotSolved { status: "the active set did not settle" };
    assert_eq!(solved(&system, &[], bounds, 1).0, Err(failure));
    // From the right rows nothing has to change: a row that touches without a force may stay, and
    // one counts once.
    let right = [(1, lower), (0, upper), (1, lower), (3, upper), (0, upper)];
    assert_eq!(solved(&system, &right, bounds, 0), (Ok(0), expected.clone()));
    // A row that would pull is dropped; a bound that has become infinite holds nothing, and drops
    // its row without a pivot.
    assert_eq!(solved(&system, &[(1, lower), (2, lower), (0, upper)], bounds, 0), (Ok(1), expected.clone()));
    let open: (&[f64], &[f64]) = (&[-1.0, -1.0, -INF, -1.0], &[1.0, 1.0, 1.0, INF]);
    assert_eq!(solved(&system, &[(1, lower), (2, lower), (3, upper), (0, upper)], open, 0), (Ok(0), expected));
}

#[test]
fn rows_are_told_from_dependent_ones_in_all_units() {
    for unit in [1e-15, 1.0, 1e15] {
        let mut dense = Dense::rigid([[1.0, 0.2], [3.0, 0.6], [0.7, 1.0], [0.3, 0.9]]);
        dense.mass = 1.0 / unit;
        let system = dense.at_rest();
        let mut play = ActiveSet::new(4);
        for row in [0, 1, 0, 2, 3, 2] {
            play.push(&system, row, Side::Lower);
        }
        assert_eq!(play.rows().collect::<Vec<_>>(), [(0, Side::Lower), (2, Side::Lower)], "{unit}");
    }
}

#[test]
fn a_row_that_two_nearly_parallel_ones_span_depends_on_them_however_it_is_rounded() {
    for turn in 0..40 {
        // y₂ = (y₁ − y₀)/angle: with 0 and 1 in play, the rounding error of row 2's pivot is 1e-16
        // of 1e9.
        let (turn, angle) = (0.15 * f64::from(turn), 3e-5);
        let along = |phi: f64| [(turn + phi).cos(), (turn + phi).sin()];
        let across = [0, 1].map(|i| (along(angle)[i] - along(0.0)[i]) / angle);
        let dense = Dense::rigid([along(0.0), along(angle), across]);
        let mut play = ActiveSet::new(3);
        (0..3).for_each(|row| play.push(&dense.at_rest(), row, Side::Lower));
        assert_eq!(play.rows().count(), 2, "{turn}");
        // y₀ ≥ 0 ≥ y₁ leave y₂ ≤ 0, and not ≥ 1.
        let start = [(0, Side::Lower), (1, Side::Upper), (2, Side::Lower)];
        let (found, r) = solved(&dense.at_rest(), &start, (&[0.0, -INF, 1.0], &[INF, 0.0, INF]), 100);
        assert!(matches!(found, Err(Failure::Infeasible { .. })), "{turn}: {found:?}, {r:?}");
    }
}

#[test]
fn a_violation_within_rounding_of_the_largest_motion_is_none() {
    // Row 0, of weight 10, is brought back by 1e6, which is 1e5 for row 1 at a right angle to it.
    // That stands 1e-11 below its bound: more than 1e-12 of the lengths, but less than four ulps of
    // 1e5, 9e-11.
    let system = Dense::rigid([[10.0, 0.0], [0.0, 1.0]]).system(&[-1e5, -1e-11]);
    let bounds: (&[f64], &[f64]) = (&[0.0; 2], &[INF; 2]);
    assert_eq!(solved(&system, &[], bounds, 9), (Ok(1), vec![1e4, 0.0]));
    // It counts beside a motion of 1, which has four ulps of 9e-16.
    let system = Dense::rigid([[10.0, 0.0], [0.0, 1.0]]).system(&[-1.0, -1e-11]);
    assert_eq!(solved(&system, &[], bounds, 9).0, Ok(2));
}

#[test]
fn rounding_is_passed_on_by_the_combination() {
    let mut draws = Draws::new(6, 0);
    for trial in 0..20 {
        let m = 2 + trial % 5;
        let dense = Dense::yielding(&mut draws, m);
        let (system, w) = (dense.at_rest(), dense.w());
        let rows: Vec<usize> = (0..m - 1).rev().collect();
        let mut play = ActiveSet::new(m);
        rows.iter().for_each(|&row| play.push(&system, row, Side::Lower));
        let c = solution(&block(&w, &rows), &part(&w, &rows, m - 1));
        let weight = |row: usize| w[(row, row)].sqrt();
        // Four ulps of the motion of each row, in units of its own.
        let reach = draws.between(1.0, 9.0);
        let all = weight(m - 1) + rows.iter().zip(&c).map(|(&j, c)| c.abs() * weight(j)).sum::<f64>();
        let found = play.rounding(&system, m - 1, reach);
        assert!((found / (4.0 * f64::EPSILON * reach * all) - 1.0).abs() < 1e-9, "trial {trial}: {found}");
    }
}

/// What comes of pushing the second of two equal rows down to its upper bound while the first
/// stands on its lower one.
fn squeezed(lower: f64, upper: f64) -> Failure {
    let system = Dense::rigid([[1.0], [1.0]]).at_rest();
    let mut play = ActiveSet::new(2);
    play.push(&system, 0, Side::Lower);
    let rhs = Rhs { b: &[], lo: &[lower, -INF], hi: &[INF, upper] };
    play.enter(&system, &rhs, (1, Side::Upper), 9, &mut [0.0; 2]).expect_err("nothing gives way")
}

#[test]
fn bounds_that_cross_are_told_from_rounding() {
    let nearly = Failure::NotSolved { status: "rows too nearly dependent" };
    for unit in [1e-12, 1.0, 1e12] {
        assert_eq!(squeezed(unit, 0.0), Failure::Infeasible { row: 0, against: 1 }, "{unit}");
        assert_eq!(squeezed(unit, -unit), Failure::Infeasible { row: 0, against: 1 }, "{unit}");
        // Within 16 ulps of both bounds they do not cross.
        assert_eq!(squeezed(unit * (1.0 + f64::EPSILON), unit), nearly, "{unit}");
        assert_eq!(squeezed(-unit, 0.0), nearly, "{unit}");
    }
    assert_eq!(squeezed(0.0, 0.0), nearly);
}

#[test]
fn the_row_that_resists_most_is_named() {
    // Row 2 sees 0.2 of row 0's motion and all of row 1's: as displacements of the body, 2 and 1.
    let system = Dense::rigid([[10.0, 0.0], [0.0, 1.0], [2.0, 1.0]]).at_rest();
    let (found, _) = solved(&system, &[], (&[10.0, 1.0, -INF], &[INF, INF, 2.0]), 99);
    // The lower bound comes first.
    assert_eq!(found, Err(Failure::Infeasible { row: 0, against: 2 }));
}
