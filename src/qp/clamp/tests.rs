//! Cases in which the order of the rows, or a row without effect, matters.

use super::*;
use crate::linear::{Rows, Symmetric};

const INF: f64 = f64::INFINITY;

fn rigid(lo: f64, hi: f64) -> ScalarRow {
    ScalarRow { lo, hi, compliance: 0.0 }
}

#[test]
fn the_first_of_equal_walls_and_the_faulty_row_are_named() {
    let named = |rows: &[ScalarRow]| clamp(1.0, 0.0, rows, &mut vec![0.0; rows.len()]).expect_err("no such place");
    let (floor, roof) = (rigid(1.0, INF), rigid(-INF, 0.9));
    assert_eq!(named(&[floor, floor, roof]), Failure::Infeasible { row: 0, against: 2 });
    assert_eq!(named(&[floor, roof, roof]), Failure::Infeasible { row: 0, against: 1 });
    // A row that may stand at one place only is sound.
    let bad = ScalarRow { compliance: f64::NAN, ..floor };
    assert_eq!(named(&[rigid(0.0, 0.0), bad]), Failure::NotFinite { what: "compliance", index: 1 });
}

#[test]
fn walls_that_cross_by_rounding_bear_beside_a_pad() {
    // A floor two ulps above the roof, at 1, and a pad of 8 N/m that reaches up to 0.5.
    let pad = ScalarRow { lo: -INF, hi: 0.5, compliance: 0.125 };
    let mut r = [0.0; 3];
    let x = clamp(2.0, 0.0, &[rigid(1.0 + 2.0 * f64::EPSILON, INF), rigid(-INF, 1.0), pad], &mut r).expect("one place");
    // 2·1 = r₀ − 4: rounding of a place near 1, times the stiffnesses.
    assert!((x - 1.0).abs() < 1e-15 && (r[0] - 6.0).abs() < 1e-14 && r[1] == 0.0, "{x} {r:?}");
    assert!((r[2] + 4.0).abs() < 1e-14, "{r:?}");
}

#[test]
fn a_floor_just_where_a_pad_holds_the_body_carries_nothing() {
    // 2x = −6 + 8 (0.5 − x): x = −0.2, to which the floor is put. Its rounding is the pad's.
    let pad = ScalarRow { lo: 0.5, hi: INF, compliance: 0.125 };
    let mut r = [0.0; 2];
    let x = clamp(2.0, -6.0, &[pad], &mut r[..1]).expect("held");
    assert!((x + 0.2).abs() < 1e-15 && (r[0] - 5.6).abs() < 1e-14, "{x} {r:?}");
    let alone = r;
    assert_eq!((clamp(2.0, -6.0, &[pad, rigid(x, 9.0)], &mut r), r), (Ok(x), alone));
}

#[test]
fn a_mass_of_nothing_is_refused_at_once() {
    let problem = Problem { a: Symmetric::diagonal(&[0.0]), g: Rows::new(1, []), compliance: vec![] };
    assert!(matches!(Clamp::new(&problem, 1.0), Err(Failure::NotPositiveDefinite)));
}

#[test]
fn a_row_that_sees_nothing_is_met_within_rounding_of_the_scale() {
    let problem = Problem { a: Symmetric::diagonal(&[1.0]), g: Rows::new(1, [&[][..]]), compliance: vec![0.0] };
    for unit in [1e-9, 1.0, 1e9] {
        let mut clamp = Clamp::new(&problem, unit).expect("sound");
        let mut solution = Solution { x: vec![0.0], multiplier: vec![1.0] };
        let mut solve = |lo: f64, hi: f64| -> Result<f64, Failure> {
            clamp.solve(&Rhs { b: &[3.0], lo: &[lo * unit], hi: &[hi * unit] }, &mut solution)?;
            Ok(solution.multiplier[0])
        };
        for (lo, hi) in [(-1.0, 0.0), (0.0, 1.0), (0.0, 0.0), (0.9e-12, 1.0), (-1.0, -0.9e-12)] {
            assert_eq!(solve(lo, hi), Ok(0.0), "{unit}: {lo} {hi}");
        }
        for (lo, hi) in [(1.1e-12, 1.0), (-1.0, -1.1e-12)] {
            assert_eq!(solve(lo, hi), Err(Failure::Infeasible { row: 0, against: 0 }), "{unit}: {lo} {hi}");
        }
    }
}
