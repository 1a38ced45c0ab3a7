//! Which closed rows are held and with which force, against the balance of forces written out.

use super::super::tests::{closed, hole, masses, near, on, rigid, started, with};
use super::*;
use crate::scene::{Load, Scene, Wall};

/// A mass of 2 kg on a floor that sees it three times as large, under a force (N).
fn loaded(force: f64) -> Scene {
    masses(&[2.0], &[], &[])
        .with_wall(rigid(Wall::lower("floor", 0.0), 0.5, &[(0, 3.0)]))
        .with_load(on(Load::constant(force), 0))
}

#[test]
fn the_speed_that_rounding_leaves_after_a_stop_is_none() {
    // Forces of 8 N on 2 kg over a series of 1 s: speeds of 1e-14 m/s are rounding.
    let quiet = noise(3.0 * 8.0 / 2.0);
    let stopped = [1.0, 0.0];
    for (push, e, speed, held) in [
        (stopped, 0.0, 100.0, true),
        ([0.0; 2], 0.0, 100.0, false),
        (stopped, 0.5, 100.0, false),
        (stopped, 0.0, 3000.0, false),
        ([0.0; 2], 0.0, 0.5, true),
    ] {
        let mut event = started(&loaded(-8.0), 1.0);
        event.sizes.instant = vec![8.0];
        event.v = vec![speed * quiet / 3.0];
        let mut closed_row = closed(0, 1.0);
        (closed_row.push, closed_row.restitution) = (push, e);
        event.closed_rows = vec![closed_row];
        event.settle(None).unwrap();
        let what = format!("{push:?} {e} {speed}: {:?}", event.closed_rows);
        assert!(event.places[0].held == if held { 1.0 } else { 0.0 }, "{what}");
        assert!(if held { event.v[0].abs() < 1e-25 } else { near(event.v[0], speed * quiet / 3.0) }, "{what}");
    }
}

#[test]
fn a_row_is_held_with_the_force_that_presses_it() {
    // Through the row a force of 6 N is 2 N; unheld it moves the mass at 3 m/s².
    for (force, both, reaction, size, fate) in [
        (-6.0, false, 2.0, 12.0, Fate::Held(0)),
        (6.0, false, 0.0, 6.0, Fate::Gone(0)),
        (-6.0, true, 2.0, 12.0, Fate::Held(0)),
        (6.0, true, -2.0, 12.0, Fate::Held(0)),
    ] {
        let scene = loaded(force).with_wall(rigid(Wall::upper("above", 0.0), 0.5, &[(0, 3.0)]));
        let mut event = started(&scene, 1.0);
        let mut closed_row = closed(0, 1.0);
        closed_row.both = both;
        event.closed_rows = vec![closed_row];
        event.settle(None).unwrap();
        let (closed_row, what) = (event.closed_rows[0], format!("{force} {both}: {:?}", event.closed_rows));
        assert!(closed_row.fate == fate && (closed_row.force[0] - reaction).abs() < 1e-14, "{what}");
        let acceleration = if fate == Fate::Held(0) { 0.0 } else { force / 2.0 };
        assert!((event.derivatives[2][0] - acceleration).abs() < 1e-15, "{what}");
        // The terms of the acceleration: the force, and three times that of the wall.
        assert!(near(event.rhs_size[0], size), "{what}: {:?}", event.rhs_size);
        let held = if reaction < 0.0 { -1.0 } else { 1.0 };
        assert!(event.places[0].held == if fate == Fate::Held(0) { held } else { 0.0 }, "{what}");
    }
}

#[test]
fn the_forces_of_several_walls_are_terms_of_the_acceleration() {
    let scene = masses(&[2.0, 5.0], &[], &[])
        .with_wall(rigid(Wall::lower("a", 0.0), 0.5, &[(0, 3.0)]))
        .with_wall(rigid(Wall::upper("b", 0.0), 0.5, &[(1, 1.0)]))
        .with_load(on(Load::constant(-6.0), 0))
        .with_load(on(Load::constant(10.0), 1));
    let mut event = started(&scene, 1.0);
    event.closed_rows = vec![closed(0, 1.0), closed(1, -1.0)];
    event.settle(None).unwrap();
    assert!(
        near(event.closed_rows[0].force[0], 2.0) && near(event.closed_rows[1].force[0], -10.0),
        "{:?}",
        event.closed_rows
    );
    assert!(near(event.rhs_size[0], 12.0) && near(event.rhs_size[1], 20.0), "{:?}", event.rhs_size);
    assert!(event.derivatives[2].iter().all(|a| a.abs() < 1e-14), "{:?}", event.derivatives[2]);
}

#[test]
fn a_force_that_has_just_vanished_may_be_more_than_rounding() {
    let mut event = started(&masses(&[2.0], &[], &[]).with_wall(rigid(Wall::lower("a", 0.0), 0.5, &[(0, 1.0)])), 1.0);
    // Terms of 1000 m/s²: a share of 1e-9 of them is 1e-6 m/s².
    event.rhs_size = vec![2000.0];
    let judge = |level, push, away, released| event.judged(closed(0, 1.0), level, push, away, released).fate;
    assert_eq!(judge(0, 5e-7, 0.0, None), Fate::Held(0));
    assert_eq!(judge(0, 5e-7, 0.0, Some(0)), Fate::Open);
    assert_eq!(judge(0, 5e-7, 0.0, Some(1)), Fate::Held(0));
    assert_eq!(judge(0, 2e-6, 0.0, Some(0)), Fate::Held(0));
    assert_eq!(judge(1, 5e-7, 0.0, Some(0)), Fate::Held(1));
    assert_eq!(judge(0, 0.0, 5e-7, Some(0)), Fate::Open);
    assert_eq!(judge(0, 0.0, 5e-7, None), Fate::Gone(0));
    assert_eq!(judge(0, 0.0, 2e-6, Some(0)), Fate::Gone(0));
    // Between walls on both sides, a row that nothing presses is not in contact.
    event.rhs_size = vec![0.0];
    let mut closed_row = closed(0, 1.0);
    closed_row.both = true;
    assert_eq!(event.judged(closed_row, 0, 0.0, 0.0, None).fate, Fate::Open);
}

#[test]
fn of_rows_that_depend_on_each_other_the_one_that_pulled_carries_nothing() {
    let scene = masses(&[2.0], &[], &[]).with_wall(rigid(Wall::lower("a", 0.0), 0.5, &[(0, 1.0)])).with_wall(rigid(
        Wall::lower("b", 0.0),
        0.5,
        &[(0, 2.0)],
    ));
    for pulled in [0, 1] {
        let mut event = started(&scene, 1.0);
        event.closed_rows = [0, 1].map(|row| ClosedRow { fate: Fate::Held(1), ..closed(row, 1.0) }).to_vec();
        event.hold_seats(Some(pulled));
        assert_eq!(event.hold.rows().iter().map(|held| held.row).collect::<Vec<_>>(), [1 - pulled]);
        assert!(event.places[1 - pulled].held == 1.0 && event.places[pulled].held == 0.0);
        let carriers: Vec<usize> = event.carriers.iter().map(|carrier| carrier.0).collect();
        assert_eq!(carriers, [1 - pulled]);
    }
}

#[test]
fn a_row_that_no_derivative_decides_is_stopped_and_left_free() {
    for both in [false, true] {
        let wall = |wall: Wall| rigid(wall, 0.5, &[(0, 1.0)]);
        let scene =
            masses(&[2.0], &[], &[]).with_wall(wall(Wall::lower("a", 0.0))).with_wall(wall(Wall::upper("b", 0.0)));
        let mut event = started(&scene, 1.0);
        event.v = vec![1e-17];
        event.closed_rows = vec![ClosedRow { both, ..closed(0, -1.0) }];
        event.hold_seats(None);
        assert!(event.v[0].abs() < 1e-30 && event.hold.rows().is_empty(), "{:?}", event.v);
        // Its displacement, its speed, and three derivatives of that are 0.
        let unknown = Some(LeadingZeros::Unknown(5));
        assert_eq!(event.places[0].gap_zeros, [if both { unknown } else { None }, unknown]);
    }
}

#[test]
fn a_body_that_runs_along_a_hole_without_a_force_is_not_held_and_does_not_leave() {
    // On a spring, in uniform motion on the circle of the hole; another mass rests on a floor.
    let (gap, omega) = (1.0 / 512.0, 20.0);
    let spring = omega * omega;
    let scene = with(masses(&[1.0; 3], &[], &[(0, 0, spring), (1, 1, spring)]), hole(gap, 0.5, [0.0; 2]))
        .with_wall(rigid(Wall::lower("floor", 0.0), 0.5, &[(2, 1.0)]))
        .with_load(on(Load::constant(-5.0), 2))
        .with_initial(&[gap, 0.0, 0.0], &[0.0, gap * omega, 0.0]);
    for faster in [0.0, 1e-6, -1e-6] {
        let mut event = started(&scene, 1.0);
        event.v[1] *= 1.0 + faster;
        event.closed_rows = vec![closed(0, 1.0), closed(1, -1.0)];
        event.settle(None).unwrap();
        let [floor, hole] = [event.closed_rows[0].fate, event.closed_rows[1].fate];
        let wanted = match faster {
            0.0 => Fate::Open,
            f if f > 0.0 => Fate::Held(0),
            _ => Fate::Gone(0),
        };
        assert!(floor == Fate::Held(0) && hole == wanted, "{faster}: {floor:?} {hole:?}");
    }
}
