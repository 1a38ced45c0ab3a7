//! Impacts, against momentum and Newton's law worked out by hand, and where rebounds end.

use super::super::tests::{closed, hole, masses, near, on, rigid, started, with};
use super::*;
use crate::scene::{Load, Scene, Table, Wall};

/// Where two neighbours of a row of masses touch: q₁ − q₀ ≥ 0.
fn between(i: usize, e: f64) -> Wall {
    rigid(Wall::lower(&format!("{i}"), 0.0), e, &[(i, -1.0), (i + 1, 1.0)])
}

/// The velocities after the first instant.
fn struck(scene: &Scene) -> Vec<f64> {
    let mut event = started(scene, 1.0);
    event.advance(None).unwrap();
    assert!(event.time == 0.0);
    event.v.clone()
}

fn assert_near(found: &[f64], wanted: &[f64]) {
    for (a, b) in found.iter().zip(wanted) {
        assert!((a - b).abs() < 1e-13, "{found:?} for {wanted:?}");
    }
}

#[test]
fn an_impact_may_drive_a_body_into_the_next() {
    // The last ball is leaving, slower than the blow that is passed on: equal balls exchange their
    // velocities.
    let row = |v: &[f64]| {
        let scene = masses(&vec![1.0; v.len()], &[], &[]).with_initial(&vec![0.0; v.len()], v);
        (1..v.len()).fold(scene, |scene, i| scene.with_wall(between(i - 1, 1.0)))
    };
    assert_near(&struck(&row(&[1.0, 0.0, 0.1])), &[0.0, 0.1, 1.0]);
    assert_near(&struck(&row(&[1.0, 0.0, 0.1, 0.3])), &[0.0, 0.1, 0.3, 1.0]);
}

#[test]
fn a_body_without_room_is_a_wall_to_others() {
    let tight = [Wall::lower("below", 0.0), Wall::upper("above", 0.0)].map(|wall| rigid(wall, 0.7, &[(0, 1.0)]));
    let scene = tight.into_iter().fold(masses(&[1.0, 1.0], &[], &[]), Scene::with_wall);
    for e in [1.0, 0.5, 0.0] {
        let scene = scene.clone().with_wall(between(0, e));
        // Even where the body comes with a speed towards a wall, which stops it at the same time.
        for (v, away) in [([0.0, -1.0], e), ([-0.5, -1.0], 0.5 * e)] {
            assert_near(&struck(&scene.clone().with_initial(&[0.0, 0.0], &v)), &[0.0, away]);
        }
    }
}

#[test]
fn walls_in_turn_end_at_one_velocity() {
    // 1, 2 and 3 kg that run into each other at e = 0 move on together, with their momentum.
    let scene = (0..2).fold(masses(&[1.0, 2.0, 3.0], &[], &[]), |scene, i| scene.with_wall(between(i, 0.9)));
    let mut event = started(&scene, 1.0);
    event.v = vec![1.0, 0.0, -1.0];
    event.closed_rows = vec![closed(0, 1.0), closed(1, 1.0)];
    event.in_turn().unwrap();
    assert_near(&event.v, &[-1.0 / 3.0; 3]);
    // What is not approached is left alone.
    event.v = vec![-1.0, 0.0, 1.0];
    event.in_turn().unwrap();
    assert_near(&event.v, &[-1.0, 0.0, 1.0]);
}

#[test]
fn a_speed_is_0_within_the_rounding_of_velocities_and_forces() {
    let wall = |dof: usize, weight: f64| rigid(Wall::lower("floor", 0.0), 0.5, &[(dof, weight)]);
    let mut event = started(
        &masses(&[2.0, 50.0], &[], &[]).with_wall(wall(0, 3.0)).with_wall(wall(1, 1.0)).with_duration(0.25),
        1.0,
    );
    event.begin_series(0.25);
    event.v = vec![-0.5, 0.7];
    event.sizes.instant = vec![8.0, 30.0];
    event.closed_rows = vec![closed(0, 1.0)];
    (event.fastest_row, event.fastest_weighed) = (1.5, 0.8);
    assert!(event.series.unit() == 0.25);
    // |g v| + |g f/m| · unit.
    let own = [noise(1.5 + 12.0 * 0.25), noise(0.7 + 0.6 * 0.25)];
    (0..2).for_each(|row| assert!(near(event.quiet(row), own[row]), "{row}: {:e}", event.quiet(row)));
    // Among several, 4e-12 of the fastest, or in the metric of the mass if that is less: W is 9/2
    // and 1/50.
    event.closed_rows = vec![closed(0, 1.0), closed(1, 1.0)];
    let wanted = [4e-12 * 1.5, 4e-12 * 0.8 * 0.02_f64.sqrt()];
    (0..2).for_each(|row| assert!(near(event.quiet(row), wanted[row]), "{row}: {:e}", event.quiet(row)));
}

#[test]
fn a_displacement_is_known_to_the_rounding_of_its_terms_and_of_the_way_so_far() {
    let scene = masses(&[2.0], &[], &[]).with_wall(rigid(Wall::lower("floor", -0.5), 0.5, &[(0, 3.0)]));
    let mut event = started(&scene.with_initial(&[2.0], &[-0.75]), 0.25);
    event.begin_series(0.25);
    event.series.cut(0.125);
    // 6 m, half of the series at 2.25 m/s, and the wall.
    let wanted = noise(6.0 + 0.5 * 2.25 * 0.25 + 0.5);
    assert!(near(event.resolution(0, -0.5), wanted), "{:e}", event.resolution(0, -0.5));
}

/// A body of 2 kg on a floor.
struct Body {
    load: Load,
    floor: f64,
    e: f64,
    /// The time of an impact, s, and the longest step.
    time: f64,
    stride: f64,
    /// How far it has moved before, m.
    travel: f64,
}

/// In steps in which it moves by metres at most, a body that is pressed with 2 kg times `press`.
fn pressed(press: f64, e: f64) -> Body {
    let stride = f64::sqrt(8.0 / press);
    Body { load: Load::constant(-2.0 * press), floor: 0.0, e, time: 0.0, stride, travel: 1.0 }
}

impl Body {
    /// True if the body stays on the floor after an impact that makes it leave with this speed,
    /// m/s.
    fn stays_after(&self, rebound: f64) -> bool {
        // The ceiling makes the gap scale 1 m.
        let scene = masses(&[2.0], &[], &[])
            .with_wall(rigid(Wall::lower("floor", self.floor), self.e, &[(0, 1.0)]))
            .with_wall(rigid(Wall::upper("ceiling", self.floor + 2.0), self.e, &[(0, 1.0)]))
            .with_load(self.load.clone())
            .with_initial(&[self.floor], &[0.0]);
        let mut event = started(&scene, self.stride);
        event.restart(self.time, &[self.floor], &[-rebound / self.e]).unwrap();
        event.places[0].travel = self.travel;
        event.advance(None).unwrap();
        let v = event.v[0];
        assert!(event.time == self.time && (v == 0.0 || near(v, rebound)), "{v:e} for {rebound:e}");
        v == 0.0
    }
}

#[test]
fn a_rebound_lower_than_a_share_of_the_scene_is_the_last() {
    for g in [8.0, 8e6, 0.5] {
        // 1e-12 m high, whatever the acceleration.
        let last = f64::sqrt(2.0 * g * 1e-12);
        for e in [0.2, 0.9] {
            let body = pressed(g, e);
            assert!(body.stays_after(0.98 * last) && !body.stays_after(1.02 * last), "{g} {e}");
        }
    }
    // At e = 1 they never end.
    assert!(!pressed(8.0, 1.0).stays_after(3.9e-6));
}

#[test]
fn rebounds_do_not_end_while_their_force_changes() {
    // Rebounds from 2 µm/s at 8 m/s² go on for 2 · 2e-6/8/(1 − e) s; meanwhile a ramp of the force
    // may change it by a millionth.
    for e in [0.5, 0.75] {
        let remaining = 0.5e-6 / (1.0 - e);
        let stays = |load: Load| Body { load, ..pressed(8.0, e) }.stays_after(2e-6);
        let ramp = |share: f64| {
            let slope = share * 1e-6 * 16.0 / remaining;
            Load::table(Table::new(vec![0.0, 10.0], vec![-16.0, -16.0 - 10.0 * slope]).unwrap())
        };
        assert!(stays(ramp(0.97)) && !stays(ramp(1.03)), "{e}");
        // A sine at its peak changes by half the square of its phase.
        let sine = |share: f64| {
            let omega = (2.0 * share * 1e-6).sqrt() / remaining;
            Load::harmonic(-16.0, omega / std::f64::consts::TAU, 0.5 * std::f64::consts::PI)
        };
        assert!(stays(sine(0.97)) && !stays(sine(1.03)), "{e}");
    }
}

#[test]
fn a_rebound_that_rounding_hides_is_the_last() {
    // In steps of 20 µs the body moves by 1.6e-9 m only. At a place of 1 m the search takes 4 ·
    // 1.8e-15 m for 0, and the rebound is 1e-15 m high.
    let short = || Body { stride: 2e-5, travel: 0.0, ..pressed(8.0, 0.5) };
    assert!(Body { floor: 1.0, ..short() }.stays_after(1.26e-7));
    assert!(!short().stays_after(1.26e-7));
    // What hides it is the rounding error up to its end, not that of the 1 km of a step of 16 s:
    // 4e-6 m/s is a height of 1e-12 m.
    let long = || Body { stride: 16.0, ..pressed(8.0, 0.5) };
    assert!(long().stays_after(3.9e-6) && !long().stays_after(4.1e-6));
    // At 1e9 s eight units in the last place are 1.8 µs, and a flight takes 1.5 µs or 2.25 µs.
    let late = Body { time: 1e9, stride: 1.0 / 1024.0, travel: 0.0, ..pressed(8.0, 0.5) };
    assert!(late.stays_after(6e-6) && !late.stays_after(9e-6));
}

#[test]
fn a_rebound_that_only_another_wall_presses_may_be_the_last() {
    // A force of 800 N on the second coordinate presses on the wall −q₀ + 100 q₁ ≥ 0, whose
    // reaction of 8 N presses the first onto its own.
    let (force, weight) = (800.0, 100.0);
    let press = force * weight / (1.0 + weight * weight);
    let scene = |e: f64| {
        masses(&[1.0, 1.0], &[], &[])
            .with_wall(rigid(Wall::lower("lever", 0.0), e, &[(0, -1.0), (1, weight)]))
            .with_wall(rigid(Wall::lower("floor", 0.0), 0.5, &[(0, 1.0)]))
            // It makes the gap scale 1 m.
            .with_wall(rigid(Wall::upper("ceiling", 2.0), 0.5, &[(0, 1.0)]))
            .with_load(on(Load::constant(-force), 1))
    };
    let last = f64::sqrt(2.0 * press * 1e-12);
    for part in 0..64 {
        // Just above and just below it, with other roundings: the lever, which rests, may leave by
        // one whatever its restitution.
        let apart = 0.02 - 1e-4 * f64::from(part);
        let rebound = last * if part % 2 == 0 { 1.0 + apart } else { 1.0 - apart };
        let wanted = if part % 2 == 0 { rebound } else { 0.0 };
        for e in [0.0, 0.5] {
            let scene = scene(e).with_initial(&[0.0, 0.0], &[-2.0 * rebound, -2.0 * rebound / weight]);
            let mut event = started(&scene, 1.0);
            event.places[1].travel = 1.0;
            event.advance(None).unwrap();
            assert!((event.v[0] - wanted).abs() < 1e-6 * rebound, "{part} {e}: {:e} for {wanted:e}", event.v[0]);
        }
    }
}

#[test]
fn a_rebound_that_only_the_bend_of_a_hole_presses_may_be_the_last() {
    // v²/γ presses a body that slides round; the height counts as a share of the gap.
    let (gap, speed) = (2e-3, 0.034);
    let last = f64::sqrt(2.0 * speed * speed / gap * 1e-12 * gap);
    for share in [0.97, 1.03] {
        let scene = with(masses(&[1.3; 2], &[], &[]), hole(gap, 0.5, [0.0; 2]))
            .with_initial(&[gap, 0.0], &[2.0 * share * last, speed]);
        let mut event = started(&scene, 0.01);
        event.places[0].travel = 1.0;
        event.advance(None).unwrap();
        let wanted = if share < 1.0 { 0.0 } else { -share * last };
        assert!((event.v[0] - wanted).abs() < 1e-6 * last, "{share}: {:e} for {wanted:e}", event.v[0]);
        assert!(event.v[1] == speed);
    }
}
