//! Impacts, rests and releases at one instant.

mod tails;

use super::*;
use crate::scene::{Load, Scene, Table, Wall};

/// A body of 2 kg without a spring at 0 between `walls`, with velocity `v` (m/s) under `loads`, at
/// the start of an arc of 1 s.
fn body(walls: &[Wall], v: f64, loads: &[Load]) -> Event {
    let mut scene = Scene::oscillator(2.0, 0.0, 0.0).with_initial(&[0.0], &[v]).with_duration(4.0);
    for wall in walls {
        scene = scene.with_wall(wall.clone());
    }
    for load in loads {
        scene = scene.with_load(load.clone());
    }
    let mut event = Event::new(&scene, 1.0).unwrap();
    event.begin_arc(1.0, 0.0);
    event
}

/// A rigid wall at 0 on the side from which `away` (±1) leads away.
fn stop(name: &str, away: f64) -> Wall {
    if away > 0.0 { Wall::lower(name, 0.0) } else { Wall::upper(name, 0.0) }
}

/// 0 at t = 0, and growing by `rate` (N/s).
fn ramp(rate: f64) -> Load {
    Load::table(Table::new(vec![0.0, 4.0], vec![0.0, 4.0 * rate]).unwrap())
}

#[test]
fn of_walls_at_one_place_the_first_of_the_largest_restitution_takes_the_impulse() {
    let walls = [("a", 0.25), ("b", 0.5), ("c", 0.5), ("d", 0.0)].map(|(name, e)| stop(name, 1.0).with_restitution(e));
    let mut event = body(&walls, -3.0, &[]);
    event.advance(0.0).unwrap();
    // Newton's law: from 3 m/s to 1.5 m/s, of 2 kg.
    assert_eq!((event.end(), event.v(), event.step().jump), (0.0, &[1.5][..], &[0.0, 9.0, 0.0, 0.0][..]));
    assert_eq!((event.counters().events, event.counters().impacts), (1, 1));
}

#[test]
fn a_velocity_that_is_rounding_counts_as_0_where_the_body_is_pressed_onto_the_wall() {
    for away in [1.0, -1.0] {
        // The force, its rate, and whether that presses.
        for (force, rate, pressed) in
            [(-away, 0.0, true), (away, 0.0, false), (0.0, -away, true), (-away, away, true), (away, -away, false)]
        {
            let mut event = body(&[stop("wall", away)], away * 1e-18, &[Load::constant(force), ramp(rate)]);
            event.resolve_rigid(Some(0), 0.0, None);
            let expected = if pressed { (0.0, Some(0)) } else { (away * 1e-18, None) };
            assert_eq!((event.v, event.support), expected, "{away} {force} {rate}");
            // Neither is one of velocity 0 that lifts off.
            assert!(event.released < 0.0);
        }
    }
}

#[test]
fn a_body_whose_force_has_vanished_is_let_go_whatever_rounding_says_of_its_load() {
    for away in [1.0, -1.0] {
        // Alone, and with a wall that is closed on the other side.
        for (others, next) in [(vec![], None), (vec![stop("other", -away)], Some(1))] {
            let walls = [vec![stop("wall", away)], others].concat();
            let mut event = body(&walls, 0.0, &[]);
            event.support = Some(0);
            event.barriers[0].open(0, 0.0, 0.0);
            event.barriers[0].open.as_mut().unwrap().impulse = away;
            event.time = 2.0;
            event.resolve_rigid(Some(0), 0.0, Some(0));
            assert_eq!((event.support, event.v), (next, 0.0));
            assert_eq!(event.released, if next.is_none() { 2.0 } else { f64::NEG_INFINITY });
            let [contact] = event.shown.closed[..] else { panic!("{:?}", event.shown.closed) };
            assert_eq!((contact.end, contact.departure_speed), (Some(2.0), Some(0.0)));
        }
    }
}

#[test]
fn a_body_is_carried_by_the_side_to_which_it_is_pressed() {
    let walls = [stop("a", 1.0), stop("b", 1.0), stop("c", -1.0), stop("d", -1.0)];
    let (lower, upper) = ([Some(0), None], [None, Some(2)]);
    let both = [Some(0), Some(2)];
    for (force, closed, carrier, next) in [
        // On its own side the carrier stays the same; on the other it is the first wall that
        // closes.
        (-1.0, both, 1, Some(1)),
        (1.0, both, 1, Some(2)),
        (-1.0, both, 3, Some(0)),
        (1.0, both, 3, Some(3)),
        (0.0, both, 1, Some(1)),
        (0.0, both, 3, Some(3)),
        (-1.0, lower, 1, Some(1)),
        (1.0, lower, 1, None),
        (0.0, lower, 1, Some(1)),
        (-1.0, upper, 3, None),
        (1.0, upper, 3, Some(3)),
    ] {
        for load in [Load::constant(force), ramp(force)] {
            assert_eq!(body(&walls, 0.0, &[load]).pressed(closed, carrier, 0.0), next, "{force} {closed:?} {carrier}");
        }
        // ±(1 − cos 2πt): force and rate vanish.
        let loads = [Load::constant(force), Load::harmonic(-force, 1.0, std::f64::consts::FRAC_PI_2)];
        let found = body(&walls, 0.0, &loads).pressed(closed, carrier, 0.0);
        // Between two walls the curvature need not decide: the body stays, and so does its
        // carrier.
        let expected = if closed == both { Some(carrier) } else { next };
        assert_eq!(found, expected, "{force} {closed:?} {carrier}");
    }
}
