//! The scalar programme against closed forms.

use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Backend, Failure, Problem, Rhs, ScalarRow, Solver, clamp};

const INF: f64 = f64::INFINITY;

fn rigid(lo: f64, hi: f64) -> ScalarRow {
    ScalarRow { lo, hi, compliance: 0.0 }
}

fn elastic(lo: f64, hi: f64, compliance: f64) -> ScalarRow {
    ScalarRow { lo, hi, compliance }
}

fn solve<const M: usize>(a: f64, b: f64, rows: [ScalarRow; M]) -> (f64, [f64; M]) {
    let mut r = [f64::NAN; M];
    (clamp(a, b, &rows, &mut r).expect("feasible"), r)
}

#[test]
fn a_free_step_carries_no_force() {
    assert_eq!(solve(2.0, 3.0, [rigid(-2.0, 2.0), elastic(-INF, 1.5, 0.1)]), (1.5, [0.0, 0.0]));
    assert_eq!(solve(2.0, 3.0, []), (1.5, []));
}

#[test]
fn a_rigid_wall_holds_with_the_force_that_balances() {
    assert_eq!(solve(2.0, 6.0, [rigid(-1.0, INF), rigid(-INF, 1.0)]), (1.0, [0.0, -4.0]));
    assert_eq!(solve(2.0, -6.0, [rigid(-1.0, INF), rigid(-INF, 1.0)]), (-1.0, [4.0, 0.0]));
}

#[test]
fn walls_at_one_place_share_the_force_equally() {
    assert_eq!(solve(2.0, 6.0, [rigid(-1.0, 2.0), rigid(-INF, 1.0), rigid(0.0, 1.0)]), (1.0, [0.0, -2.0, -2.0]));
    // A wall a tenth of a millimetre behind another of a metre carries nothing.
    assert_eq!(solve(2.0, 6.0, [rigid(-INF, 1.0), rigid(-INF, 1.0001)]), (1.0, [-4.0, 0.0]));
}

#[test]
fn an_elastic_wall_yields_in_proportion() {
    // (a + 1/c) x = b + u/c: x = (6 + 4)/(2 + 4).
    let (x, [r]) = solve(2.0, 6.0, [elastic(-INF, 1.0, 0.25)]);
    let exact = 10.0 / 6.0;
    // Two roundings of numbers below 4.
    assert!((x - exact).abs() <= 4.0 * f64::EPSILON && (r + (exact - 1.0) * 4.0).abs() <= 8.0 * f64::EPSILON);
}

#[test]
fn a_stiff_elastic_wall_tends_to_the_rigid_one() {
    for compliance in [1e-6, 1e-12, 1e-18, 1e-30, 1e-300] {
        let (x, [r]) = solve(2.0, 6.0, [elastic(-INF, 1.0, compliance)]);
        // It yields c |r|; the balance a x = b + r holds to rounding of its terms.
        assert!((x - 1.0 - compliance * 4.0).abs() <= 8.0 * compliance * compliance + 4e-16, "{x}");
        assert!((r + 4.0).abs() <= 16.0 * compliance + 4e-15, "{r}");
    }
}

#[test]
fn elastic_walls_in_layers_take_up_one_after_the_other() {
    // Bounds 1, 2, 3 of stiffness 1 each and a = 1: at x = 2.5 the first two push with 1.5 and 0.5.
    let rows = [1.0, 2.0, 3.0].map(|place| elastic(-INF, place, 1.0));
    assert_eq!(solve(1.0, 4.5, rows), (2.5, [-1.5, -0.5, 0.0]));
    // A lower layer pushes up as well, if the body starts below it.
    let rows = [elastic(0.0, INF, 1.0), elastic(-INF, -1.0, 1.0)];
    assert_eq!(solve(1.0, -2.0, rows).0, -1.0);
}

#[test]
fn a_rigid_stop_behind_an_elastic_layer_takes_the_rest() {
    let rows = [elastic(-INF, 1.0, 0.5), rigid(-INF, 2.0)];
    assert_eq!(solve(1.0, 10.0, rows), (2.0, [-2.0, -6.0]));
    // Soft enough a load and the layer alone suffices.
    let (x, r) = solve(1.0, 2.5, rows);
    assert_eq!((x, r), (1.5, [-1.0, 0.0]));
}

#[test]
fn preload_of_a_layer_pushes_against_the_opposite_stop() {
    // Free motion is at 0, inside the rigid stop, but the elastic wall pushes it through.
    let rows = [rigid(-1.0, 1.0), elastic(5.0, INF, 0.1)];
    let (x, r) = solve(1.0, 0.0, rows);
    assert_eq!((x, r), (1.0, [-39.0, 40.0]));
}

#[test]
fn touching_without_force_is_no_contact() {
    assert_eq!(solve(3.0, 3.0, [rigid(-1.0, 1.0), elastic(-INF, 1.0, 1.0)]), (1.0, [0.0, 0.0]));
    assert_eq!(solve(3.0, 0.0, [rigid(0.0, 0.0)]), (0.0, [0.0]));
}

#[test]
fn bounds_that_cross_by_rounding_are_one_place() {
    let (x, r) = solve(1.0, 7.0, [rigid(0.1 + 0.2, INF), rigid(-INF, 0.3)]);
    assert!((x - 0.3).abs() <= f64::EPSILON && r[0] == 0.0 && r[1] < 0.0);
    let crossing = clamp(1.0, 7.0, &[rigid(0.31, INF), rigid(-INF, 0.3)], &mut [0.0; 2]);
    assert_eq!(crossing, Err(Failure::Infeasible { row: 0, against: 1 }));
}

#[test]
fn what_is_no_number_is_named() {
    let rows = [rigid(-1.0, 1.0)];
    let nan = f64::NAN;
    assert_eq!(clamp(1.0, nan, &rows, &mut [0.0]), Err(Failure::NotFinite { what: "b", index: 0 }));
    assert_eq!(clamp(1.0, INF, &rows, &mut [0.0]), Err(Failure::NotFinite { what: "b", index: 0 }));
    assert_eq!(clamp(nan, 1.0, &rows, &mut [0.0]), Err(Failure::NotFinite { what: "A", index: 0 }));
    assert_eq!(clamp(0.0, 1.0, &rows, &mut [0.0]), Err(Failure::NotPositiveDefinite));
    assert_eq!(clamp(-1.0, 1.0, &rows, &mut [0.0]), Err(Failure::NotPositiveDefinite));
    let bad = |row| clamp(1.0, 0.5, &[rigid(-1.0, 1.0), row], &mut [0.0; 2]);
    assert_eq!(bad(rigid(nan, 1.0)), Err(Failure::NotFinite { what: "lower bound", index: 1 }));
    assert_eq!(bad(rigid(0.0, nan)), Err(Failure::NotFinite { what: "upper bound", index: 1 }));
    assert_eq!(bad(elastic(1.0, 2.0, -1.0)), Err(Failure::NotFinite { what: "compliance", index: 1 }));
    assert_eq!(bad(elastic(2.0, 1.0, 1.0)), Err(Failure::Infeasible { row: 1, against: 1 }));
    let short = clamp(1.0, 0.5, &rows, &mut []);
    assert_eq!(short, Err(Failure::Shape { what: "forces", expected: 1, found: 0 }));
}

#[test]
fn the_stiffest_row_takes_what_the_balance_leaves() {
    // A stop of compliance 1e-18 at 1 and a soft pad that starts at ½: in x = 1 + 3e-18, which no
    // double tells from 1, stands the stop's force.
    let (stop, pad) = (elastic(-INF, 1.0, 1e-18), elastic(-INF, 0.5, 0.5));
    for (rows, which) in [([stop, pad], 0), ([pad, stop], 1)] {
        let (x, r) = solve(2.0, 6.0, rows);
        // a x = b + r₁ + r₂ with −1 of the pad.
        assert!((x - 1.0).abs() <= f64::EPSILON, "{x}");
        assert!(
            (r[which] + 3.0).abs() <= 8.0 * f64::EPSILON && (r[1 - which] + 1.0).abs() <= 8.0 * f64::EPSILON,
            "{r:?}"
        );
    }
    // The mirror, and a third row that is soft and met, behind one that is not.
    let rows = [elastic(-0.5, INF, 0.5), elastic(-9.0, INF, 1e-20), elastic(-1.0, INF, 1e-18), elastic(-0.5, INF, 1.0)];
    let (x, r) = solve(2.0, -6.0, rows);
    assert!((x + 1.0).abs() <= f64::EPSILON, "{x}");
    for (found, expected) in r.iter().zip([1.0, 0.0, 2.5, 0.5]) {
        assert!((found - expected).abs() <= 8.0 * f64::EPSILON, "{r:?}");
    }
}

#[test]
fn rigid_bounds_that_cross_by_more_than_rounding_are_refused() {
    // 1e-12 of the largest of the bounds and the free motion, and no more.
    let crossed = |lo: f64, hi: f64, b: f64| clamp(2.0, b, &[rigid(lo, INF), rigid(-INF, hi)], &mut [0.0; 2]);
    let infeasible = Err(Failure::Infeasible { row: 0, against: 1 });
    for size in [1.0, 1e-9, 1e9] {
        for sign in [1.0, -1.0] {
            let bounds = |share: f64| {
                let (a, b) = (sign * size, sign * size * (1.0 - sign * share));
                (a.max(b), a.min(b))
            };
            for (share, refused) in [(0.5e-12, false), (2e-12, true), (1e-9, true), (1e-3, true)] {
                let (lo, hi) = bounds(share);
                let found = crossed(lo, hi, 0.0);
                assert_eq!(found == infeasible, refused, "{lo} over {hi}: {found:?}");
            }
        }
        // Beside a free motion to ten times as far, ten times as much is rounding.
        let (lo, hi) = (size * (1.0 + 5e-12), size);
        assert_eq!(crossed(lo, hi, 0.0), infeasible);
        assert!(crossed(lo, hi, 20.0 * size).is_ok() && crossed(lo, hi, -20.0 * size).is_ok());
    }
}

#[test]
fn bounds_that_cross_by_rounding_hold_at_their_midpoint() {
    let (lo, hi) = (1.0 + 8.0 * f64::EPSILON, 1.0);
    for (b, force) in [(6.0, -4.0), (-6.0, 8.0)] {
        for (rows, on) in [([rigid(lo, INF), rigid(-INF, hi)], [0, 1]), ([rigid(-INF, hi), rigid(lo, INF)], [1, 0])] {
            let (x, r) = solve(2.0, b, rows);
            assert_eq!(x, 1.0 + 4.0 * f64::EPSILON);
            // The side that bears is the one the body is driven into.
            let [lower, upper] = on.map(|row| r[row]);
            let (bears, idle) = if force > 0.0 { (lower, upper) } else { (upper, lower) };
            assert!((bears - force).abs() <= 32.0 * f64::EPSILON && idle == 0.0, "{r:?}");
        }
    }
    // Around 0, where a share of the place is nothing and only the free motion tells that the
    // bounds cross by rounding.
    let (lo, hi) = (1e-13, -1e-13);
    let rows = [rigid(-INF, 5.0), rigid(-5.0, INF), rigid(-INF, hi), rigid(lo, INF)];
    assert_eq!(solve(2.0, 6.0, rows), (0.0, [0.0, 0.0, -6.0, 0.0]));
    assert_eq!(solve(2.0, -6.0, rows), (0.0, [0.0, 0.0, 0.0, 6.0]));
}

#[test]
fn the_tightest_wall_of_each_side_bears_wherever_it_stands_in_the_list() {
    let rows =
        [rigid(-INF, 3.0), rigid(-3.0, INF), rigid(-INF, 1.0), rigid(-1.0, INF), rigid(-INF, 2.0), rigid(-2.0, INF)];
    assert_eq!(solve(2.0, 6.0, rows), (1.0, [0.0, 0.0, -4.0, 0.0, 0.0, 0.0]));
    assert_eq!(solve(2.0, -6.0, rows), (-1.0, [0.0, 0.0, 0.0, 4.0, 0.0, 0.0]));
    // Behind a pad as well, whose force is its own.
    let rows = [elastic(-0.5, INF, 0.5), rigid(-2.0, INF), rigid(-1.0, INF)];
    assert_eq!(solve(2.0, -6.0, rows), (-1.0, [1.0, 0.0, 3.0]));
}

#[test]
fn a_free_motion_beyond_all_numbers_is_named() {
    // b and a are finite, b/a is not.
    for (a, b) in [(1e-300, 1e300), (1e-300, -1e300)] {
        for rows in [[rigid(-1.0, 1.0)], [rigid(-INF, INF)], [elastic(-1.0, 1.0, 0.1)]] {
            assert_eq!(clamp(a, b, &rows, &mut [0.0]), Err(Failure::NotFinite { what: "b", index: 0 }), "{rows:?}");
        }
    }
}

#[test]
fn a_stop_that_drives_the_body_into_a_pad_carries_the_pad_too() {
    // The free motion violates the stop alone; where the stop puts it, the pad pushes back.
    let (stop, pad) = (rigid(1.0, INF), elastic(-INF, 0.5, 0.125));
    assert_eq!(solve(2.0, 0.0, [stop, pad]), (1.0, [6.0, -4.0]));
    assert_eq!(solve(2.0, 0.0, [pad, stop]), (1.0, [-4.0, 6.0]));
    let (stop, pad) = (rigid(-INF, -1.0), elastic(-0.5, INF, 0.125));
    assert_eq!(solve(2.0, 0.0, [stop, pad]), (-1.0, [-6.0, 4.0]));
}

#[test]
fn a_stop_before_a_pad_keeps_the_body_off_it() {
    // The free motion violates both, the body reaches the stop only.
    assert_eq!(solve(1.0, 10.0, [rigid(-INF, 1.0), elastic(-INF, 2.0, 0.5)]), (1.0, [-9.0, 0.0]));
    assert_eq!(solve(1.0, -10.0, [elastic(-2.0, INF, 0.5), rigid(-1.0, INF)]), (-1.0, [0.0, 9.0]));
}

#[test]
fn a_stop_just_where_a_pad_holds_the_body_carries_nothing() {
    // Exactly nothing, whatever a, b and c: a force of rounding would count as a contact.
    for i in 1..200 {
        let share = |k: i32| f64::from((i * k) % 197) / 197.0;
        let (a, c) = (0.1 + share(31), 0.01 + share(57));
        let pad = elastic(-INF, 0.3, c);
        let (x, [force]) = solve(a, 0.7 + share(83), [pad]);
        assert_eq!(solve(a, 0.7 + share(83), [pad, rigid(-INF, x)]), (x, [force, 0.0]));
    }
}

#[test]
fn walls_at_the_origin_share_as_walls_anywhere_do() {
    // No share of a place at 0 is above 0: equal bounds are one place all the same.
    assert_eq!(solve(2.0, 6.0, [rigid(-INF, 0.0), rigid(-1.0, 0.0)]), (0.0, [-3.0, -3.0]));
    assert_eq!(solve(2.0, -6.0, [rigid(0.0, INF), rigid(0.0, 1.0)]), (0.0, [3.0, 3.0]));
}

#[test]
fn a_wall_that_nothing_can_be_before_and_a_pad_without_stiffness_are_named() {
    let bad = |row| clamp(1.0, 0.5, &[rigid(-1.0, 1.0), row], &mut [0.0; 2]);
    assert_eq!(bad(rigid(INF, INF)), Err(Failure::NotFinite { what: "lower bound", index: 1 }));
    assert_eq!(bad(rigid(-INF, -INF)), Err(Failure::NotFinite { what: "upper bound", index: 1 }));
    assert_eq!(bad(elastic(-INF, 0.0, INF)), Err(Failure::NotFinite { what: "compliance", index: 1 }));
}

#[test]
fn a_row_that_x_does_not_move_is_pushed_by_its_own_spring() {
    // 0·x = 0 lies 0.3 below, above or within the bounds of a row that yields by 0.2 m/N.
    for (lo, hi, force) in [(0.3, INF, 1.5), (-INF, -0.3, -1.5), (-0.3, 0.3, 0.0), (0.0, 0.0, 0.0)] {
        let rows: [&[(usize, f64)]; 2] = [&[(0, 1.0)], &[(0, 0.0)]];
        let problem = Problem { a: Symmetric::diagonal(&[2.0]), g: Rows::new(1, rows), compliance: vec![0.0, 0.2] };
        let mut solver = Solver::new(problem, Backend::Clamp, 1.0).expect("one unknown");
        let found = solver.solve(&Rhs { b: &[6.0], lo: &[-INF, lo], hi: &[1.0, hi] }).expect("feasible");
        // The other row holds x = 1 against 3 with 2·1 − 6 = −4.
        assert_eq!((found.x[0], found.multiplier[0]), (1.0, -4.0));
        assert!((found.multiplier[1] - force).abs() < 1e-15, "{lo} {hi}: {found:?}");
    }
}
