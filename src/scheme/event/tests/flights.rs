//! Flights against closed forms, and what they cost: one that is plain to see takes one evaluation
//! for each leap, and the careful search is for the others.

use super::*;
use std::f64::consts::PI;

/// Without a spring, so that no bound on the motion is known beforehand: under a sine of 1 rad/s it
/// moves by `a` sin(t + `phase`) m.
fn swaying(a: f64, phase: f64) -> Scene {
    // The rounding of the frequency is some 1e-16.
    let load = Load::harmonic(-2.0 * a, 0.5 / PI, phase);
    free().with_load(load).with_load(Load::constant(1e-30)).with_initial(&[a * phase.sin()], &[a * phase.cos()])
}

/// The search over `span`, which ends there.
fn clear(scene: &Scene, span: f64) -> Event {
    let mut event = Event::new(scene, 1.0).unwrap();
    event.begin_arc(span, 0.0);
    let hit = event.search(span).unwrap();
    let expected = event.arc.state(span);
    assert!((hit.tau - span).abs() < 1e-15 && hit.wall.is_none(), "{hit:?}");
    // The same closed form.
    assert_eq!((hit.state[0], hit.state[1]), expected);
    event
}

#[test]
fn a_flight_far_from_walls_takes_a_leap_for_two_radians() {
    for (span, leaps) in [(1.9, 1), (2.1, 2), (9.9, 5), (10.1, 6), (19.9, 10)] {
        let scene = swaying(0.1, 0.7).with_wall(Wall::lower("lower", -1.0)).with_wall(Wall::upper("upper", 1.0));
        let event = clear(&scene, span);
        assert_eq!(event.counters().evaluations, leaps, "{span}");
    }
}

#[test]
fn the_last_leap_is_looked_at_over_its_own_length() {
    // From 0.8 sin(−0.34) m over the peak at 0.8 m, and on by 0.8 rad. Over two radians the cubic
    // to that end, which moves away at 0.62 m/s, would leave the wall at 1 m in doubt.
    let scene = swaying(0.8, -0.3412).with_wall(Wall::upper("upper", 1.0));
    assert_eq!(clear(&scene, 2.8).counters().evaluations, 2);
}

#[test]
fn a_flight_to_and_fro_takes_an_evaluation_for_each_impact() {
    for (force, e) in [(0.0, 1.0), (0.0, 0.5), (-1e-3, 1.0)] {
        let scene = free()
            .with_wall(Wall::lower("lower", -1.0).with_restitution(e))
            .with_wall(Wall::upper("upper", 0.5).with_restitution(e))
            .with_load(Load::constant(force))
            .with_initial(&[0.0], &[3.0]);
        let mut event = Event::new(&scene, 20.0).unwrap();
        for number in 1..=4 {
            event.advance(0.0).unwrap();
            let wall: usize = number % 2;
            assert_eq!(event.q()[0], [-1.0, 0.5][wall]);
            // Twice the energy per mass.
            let (arrives, energy) = (event.velocity_left(), 9.0 * f64::powi(e, 2 * (number as i32 - 1)));
            let expected = energy + event.q()[0] * force;
            // A few roundings at each impact.
            assert!((arrives * arrives - expected).abs() < 1e-13, "{number}: {arrives}");
            assert_eq!(event.v()[0], -e * arrives);
        }
        let EventCounters { events, impacts, evaluations } = event.counters();
        assert_eq!((events, impacts), (4, 4));
        assert_eq!(evaluations, 4, "{force} {e}");
    }
}

#[test]
fn impacts_of_an_oscillator_between_walls_take_two_evaluations_each() {
    // Between walls at ±0.5 m: from one to the other within twice the angle whose sine is 0.5/a.
    for a in (0..40).map(|i| 0.5 * 1.05_f64.powi(1 + i)) {
        let scene = Scene::oscillator(1.0, 0.0, 1.0)
            .with_wall(Wall::lower("lower", -0.5))
            .with_wall(Wall::upper("upper", 0.5))
            .with_initial(&[0.0], &[a])
            .with_duration(1e3);
        let mut event = Event::new(&scene, 1e3).unwrap();
        for number in 0..20 {
            event.advance(0.0).unwrap();
            let expected = (1.0 + 2.0 * f64::from(number)) * f64::asin(0.5 / a);
            // Twenty roundings of the speed, and of an angle near π/2 more.
            assert!((event.end() - expected).abs() < 1e-13, "{a}: {} {expected}", event.end());
        }
        let evaluations = event.counters().evaluations;
        assert!(evaluations <= 40, "{a}: {evaluations}");
    }
}

#[test]
fn a_flight_that_comes_near_a_wall_is_seen_in_shorter_leaps() {
    // 0.95 sin t m under a wall at 1 m, from −1 rad to 2 rad: two radians leave that in doubt.
    let scene = swaying(0.95, -1.0).with_wall(Wall::upper("upper", 1.0));
    let near = clear(&scene, 3.0).counters().evaluations;
    assert!(near <= 6, "{near}");
    // Peaks just before the wall and just behind it.
    for (a, met) in [(1.0 - 1e-9, false), (1.0 + 1e-9, true)] {
        let scene = swaying(a, 0.0).with_wall(Wall::upper("upper", 1.0));
        let mut event = Event::new(&scene, 20.0).unwrap();
        event.advance(0.0).unwrap();
        let expected = if met { (1.0 / a).asin() } else { 20.0 };
        // At the graze the place is resolved to 1e-15 m, at a slope of 4e-5 m/s.
        assert!((event.end() - expected).abs() < 1e-10, "{a}: {}", event.end());
    }
}
