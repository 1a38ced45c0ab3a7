//! The forces on the body at one instant, the sizes below which they are rounding, and when a
//! motion has faded.

use super::*;
use crate::scene::{Load, Scene, Table, Wall};
use std::f64::consts::TAU;

const EPS: f64 = f64::EPSILON;

/// A damped body under a constant, two sines and a table with a slope of 3 N/s.
fn loaded(walls: &[Wall]) -> Event {
    let mut scene = Scene::oscillator(4.0, 3.0, 50.0)
        .with_load(Load::constant(2.0))
        .with_load(Load::harmonic(5.0, 0.75, 0.3))
        .with_load(Load::harmonic(-7.0, 0.25, 1.1))
        .with_load(Load::table(Table::new(vec![0.0, 100.0], vec![10.0, 310.0]).unwrap()))
        .with_initial(&[0.5], &[0.25])
        .with_duration(100.0);
    for wall in walls {
        scene = scene.with_wall(wall.clone());
    }
    Event::new(&scene, 1.0).unwrap()
}

/// Load (N), rate (N/s) and curvature (N/s²) of `loaded` at `t`.
fn load(t: f64) -> [f64; 3] {
    let (a, b) = (0.75 * TAU, 0.25 * TAU);
    [
        2.0 + 5.0 * (a * t + 0.3).sin() - 7.0 * (b * t + 1.1).sin() + 10.0 + 3.0 * t,
        5.0 * a * (a * t + 0.3).cos() - 7.0 * b * (b * t + 1.1).cos() + 3.0,
        -5.0 * a * a * (a * t + 0.3).sin() + 7.0 * b * b * (b * t + 1.1).sin(),
    ]
}

#[test]
fn the_acceleration_is_that_of_all_forces_at_the_present_and_its_rate_that_of_the_load() {
    let mut event = loaded(&[]);
    for (time, late, q, v, extra) in [(3.25, 0.0, 0.5, 0.25, 0.0), (7.5, 0.125, -2.0, 3.0, 11.0)] {
        // A delay so large that it shows.
        (event.time, event.late, event.q) = (time, late, q);
        let [f, rate, _] = load(time + late);
        let [a, jerk] = event.acceleration(v, extra);
        let expected = [(f + extra - 3.0 * v - 50.0 * q) / 4.0, rate / 4.0];
        // Rounding of some ten terms of up to 150 N.
        assert!((a - expected[0]).abs() < 1e-13 && (jerk - expected[1]).abs() < 1e-13, "{a} {jerk}: {expected:?}");
    }
}

#[test]
fn elastic_walls_push_the_body_behind_their_faces_and_never_pull_it() {
    let soft = |wall: Wall| wall.with_elasticity(100.0, 20.0);
    let walls = [
        Wall::lower("hard", 0.25),
        soft(Wall::lower("in-front", 0.0)),
        soft(Wall::lower("below", 0.75)),
        soft(Wall::upper("above", 0.375)),
        soft(Wall::upper("far", 1.0)),
    ];
    let (mut with, mut without) = (loaded(&walls), loaded(&[]));
    for event in [&mut with, &mut without] {
        (event.time, event.q) = (2.0, 0.5);
    }
    // 0.25 m behind the lower face and 0.125 m behind the upper one: k_a s + c_a ṡ each.
    for (v, push) in [(0.0, 25.0 - 12.5), (0.5, 15.0 - 22.5), (3.0, -72.5), (-3.0, 85.0)] {
        let change = with.acceleration(v, 0.0)[0] - without.acceleration(v, 0.0)[0];
        assert!((change - push / 4.0).abs() < 1e-13, "{v}: {change}");
    }
}

#[test]
fn the_curvature_of_the_load_is_that_of_the_sines_unless_they_cancel_to_rounding() {
    let mut event = loaded(&[]);
    for time in [0.0, 3.25, 7.5] {
        event.time = time;
        let expected = load(time)[2] / 4.0;
        assert!((event.curvature() - expected).abs() < 1e-12, "{} {expected}", event.curvature());
    }
    // Two sines that differ in a share of their amplitudes, for light and heavy bodies.
    for (share, counts) in [(2.0 * EPS, false), (-2.0 * EPS, false), (100.0 * EPS, true), (-100.0 * EPS, true)] {
        for mass in [1.0 / 1024.0, 1.0, 1024.0] {
            let scene = Scene::oscillator(mass, 0.0, 0.0)
                .with_load(Load::harmonic(1.0, 3.0, 1.25))
                .with_load(Load::harmonic(-1.0 - share, 3.0, 1.25))
                .with_duration(1.0);
            let found = Event::new(&scene, 1.0).unwrap().curvature();
            let expected = if counts { share * (3.0 * TAU).powi(2) * 1.25_f64.sin() / mass } else { 0.0 };
            // Rounding of the two terms, in shares of their difference.
            assert!((found - expected).abs() <= 0.06 * expected.abs(), "{share:e} {mass}: {found:e} {expected:e}");
        }
    }
}

#[test]
fn the_sizes_of_the_force_and_of_its_rate_are_those_of_all_their_terms() {
    let mut event = loaded(&[]);
    for _ in 0..7 {
        event.advance(0.0).unwrap();
    }
    event.begin_arc(1.0, 0.0);
    let [_, _, force, rate] = event.sizes;
    assert!(event.time == 7.0 && force > 40.0 && rate > 20.0, "{force} {rate}");
    // The instant is known to an ulp of 7 s, in which the force changes by its rate, and the rate
    // of the faster sine by its own. Of (f − cv − kq)/m and of its derivative.
    let size = (force + rate * 7.0) / 4.0;
    let expected = [size, (rate + rate * 0.75 * TAU * 7.0) / 4.0 + 3.0 / 4.0 * size];
    for (found, expected) in event.force_size.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
    }
}

/// A body of `mass` (kg) that stands at a lower wall at 11 m, held there by a spring of 1/4 N/m
/// against a load that presses with `press` (N).
fn standing(mass: f64, press: f64) -> Event {
    let scene = Scene::oscillator(mass, 0.0, 0.25)
        .with_wall(Wall::lower("floor", 11.0).with_restitution(0.0))
        .with_load(Load::constant(2.75 - press))
        .with_initial(&[11.0], &[0.0])
        .with_duration(10.0);
    let mut event = Event::new(&scene, 1.0).unwrap();
    event.support = Some(0);
    event.begin_arc(1.0, 0.0);
    event
}

#[test]
fn a_contact_is_open_only_where_the_wall_pushes_by_more_than_rounding() {
    // Two forces of 2.75 N: their noise is 4 ulps of 5.5, 5e-15 N, whatever the mass.
    for mass in [1.0 / 1024.0, 1.0, 1024.0] {
        for (press, open) in [(0.0, false), (9e-16, false), (1e-13, true), (1.0, true)] {
            let mut event = standing(mass, press);
            assert_eq!(event.barriers[0].open.is_some(), open, "{mass} {press:e}");
            event.gather_impulses();
            // Over a second; 2.75 N less the pressure has lost up to 4e-16 N.
            let expected = if open { press } else { 0.0 };
            let (impulse, least) = (event.shown.impulse[0], if open { 1e-15 } else { 0.0 });
            assert!((impulse - expected).abs() <= least, "{mass} {press:e}: {impulse:e}");
        }
    }
}

#[test]
fn a_motion_has_faded_where_both_displacement_and_speed_have() {
    let mut event = loaded(&[]);
    let share = EPS * EPS;
    event.largest = [8.0, 32.0];
    for (q, v, faded) in [
        (8.0, 32.0, true),
        (-8.0, -32.0, true),
        (0.0, 0.0, true),
        (8.1, 0.0, false),
        (0.0, 32.1, false),
        (-8.1, 32.1, false),
    ] {
        assert_eq!(event.has_faded([q * share, v * share]), faded, "{q} {v}");
    }
    // It is put to rest at the origin, unless a wall carries it.
    for (v, at, support) in [(32.0, 0.0, None), (33.0, 33.0, None), (32.0, 32.0, Some(0))] {
        (event.q, event.v, event.support) = (8.0 * share, v * share, support);
        event.fade();
        assert_eq!((event.q == 0.0, event.v), (at == 0.0, at * share), "{v} {support:?}");
    }
    // What counts is the largest of all.
    (event.q, event.v) = (-9.0, 1.0);
    event.fade();
    assert_eq!(event.largest, [9.0, 32.0]);
    (event.q, event.v) = (1.0, -33.0);
    event.fade();
    assert_eq!((event.largest, event.q, event.v), ([9.0, 33.0], 1.0, -33.0));
}
