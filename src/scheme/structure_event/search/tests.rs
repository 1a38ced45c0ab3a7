//! What the search goes by: the rounding errors of gaps and forces, worked out from state and
//! loads.

use super::super::tests::{hole, masses, near, on, rigid, started, with};
use super::*;
use crate::scene::{Load, Scene, Wall};
use std::f64::consts::TAU;

/// Two damped masses under way; the first is pressed onto a wall that sees it twice as large.
fn pressed() -> StructureEvent {
    let scene =
        masses(&[2.0, 3.0], &[(0, 0, 5.0), (1, 0, -1.0), (1, 1, 4.0)], &[(0, 0, 700.0), (1, 0, -300.0), (1, 1, 900.0)])
            .with_wall(rigid(Wall::lower("held", 0.04), 0.0, &[(0, 2.0)]))
            .with_wall(rigid(Wall::lower("far", -0.5), 0.0, &[(1, 1.0)]))
            .with_load(on(Load::constant(-40.0), 0))
            .with_load(on(Load::harmonic(30.0, 3.0, 0.3), 1))
            .with_initial(&[0.02, 0.01], &[0.0, 0.2]);
    let mut event = started(&scene, 0.5);
    for _ in 0..3 {
        event.advance(None).unwrap();
    }
    event.begin_series(event.limit());
    event.measure();
    event
}

#[test]
fn the_rounding_errors_of_gap_and_force_are_those_of_all_their_terms() {
    let event = pressed();
    let ([q0, q1], [v0, v1]) = ([event.q[0], event.q[1]], [event.v[0], event.v[1]]);
    let (t, unit, omega) = (event.time, event.series.unit(), TAU * 3.0);
    assert!(t > 0.1 && v0.abs() < 1e-25 && v1 != 0.0 && event.hold.rows().len() == 1, "{t} {v0} {v1}");
    // The force on either mass, with the reaction r of the wall on the first; the instant is known
    // to an ulp of the time. Then their rates.
    let r = 40.0 + 700.0 * q0 - 300.0 * q1 - v1;
    let wave = 30.0 * (1.0 + omega * t);
    let first = 40.0 + 700.0 * q0.abs() + 300.0 * q1.abs() + v1.abs() + r.abs();
    let second = wave + 300.0 * q0.abs() + 900.0 * q1.abs() + 4.0 * v1.abs();
    let a1 = (30.0 * (omega * t + 0.3).sin() + 300.0 * q0 - 900.0 * q1 - 4.0 * v1) / 3.0;
    assert!((event.derivatives[2][1] - a1).abs() < 1e-12 * second, "{:?} {a1}", event.derivatives[2]);
    let r_rate = -300.0 * v1 - a1;
    let first_rate = 300.0 * v1.abs() + 5.0 * first / 2.0 + second / 3.0 + r_rate.abs();
    let second_rate = wave * omega + 900.0 * v1.abs() + first / 2.0 + 4.0 * second / 3.0;
    let (moved, sum) = (event.series.span() * unit * v1.abs(), 4.0 * f64::EPSILON);
    let wanted = [
        sum * (q1.abs() + moved + 0.5),
        sum * (v1.abs() * unit + 2.0 * second / 3.0 * unit * unit / 2.0),
        sum * second / 3.0 * unit * unit / 2.0,
        sum * second_rate / 3.0 * unit.powi(3) / 6.0,
    ];
    let found = event.noises(1, -0.5);
    (0..4).for_each(|k| assert!(near(found[k], wanted[k]), "{k}: {:e} for {:e}", found[k], wanted[k]));
    // The row sees the force of its wall doubled.
    let fast = event.series.rate() * unit;
    let [force, rate] = [first, first_rate].map(|size| sum * size / 2.0);
    let wanted = [force, rate * unit, rate * unit * fast, rate * unit * fast * fast];
    let found = event.force_noises(0);
    (0..4).for_each(|k| assert!(near(found[k], wanted[k]), "{k}: {:e} for {:e}", found[k], wanted[k]));
    let travel: f64 = event.series.seen(1)[1..].iter().map(|c| c.abs()).sum();
    assert!(travel > 1e-3 && near(event.travel(1, 1.0), travel), "{travel}");
}

#[test]
fn the_force_of_a_spring_and_a_dashpot_has_the_rounding_errors_of_both() {
    // k_a s + c_a ṡ of s = Σ sₖ xᵏ has the coefficients k_a sₖ + c_a (k + 1) sₖ₊₁/unit.
    let (stiffness, damping, unit) = (300.0, 7.0, 0.125);
    let noises = [3e-16, 5e-16, 11e-16, 13e-16];
    let found = of_sum(noises, 0.75, (stiffness, damping, unit));
    let next = [5e-16, 11e-16, 13e-16, 13e-16];
    let mut all = 0.0;
    for k in [0, 1, 2, 3] {
        let wanted = 300.0 * noises[k] + 56.0 * (k + 1) as f64 * next[k];
        assert!(near(found.of[k], wanted), "{k}: {:e} for {wanted:e}", found.of[k]);
        all += wanted;
    }
    // Four times the sum of these and of the rounding of the terms on the way.
    assert!(near(found.below(), 4.0 * (all + noise(356.0 * 0.75))), "{:e}", found.below());
}

/// A free mass at `q` above a lower wall at 1 m.
fn above(q: f64, v: f64, wall: Wall) -> StructureEvent {
    let mut event = started(&masses(&[1.0], &[], &[]).with_wall(wall).with_initial(&[q], &[v]), 1.0);
    event.begin_series(event.limit());
    event
}

#[test]
fn a_gap_within_the_rounding_of_its_place_is_closed_already() {
    // One unit in the last place above the wall; at this speed it would take a fifth of a second.
    let mut event = above(1.0 + f64::EPSILON, -1e-15, rigid(Wall::lower("floor", 1.0), 0.5, &[(0, 1.0)]));
    assert_eq!(event.search(), Some(Hit { x: 0.0, cause: Cause::Gap(0, 0) }));
    // By the rounding errors of this stretch, and not of the last.
    assert!(event.sizes.known);
    let mut event = above(1.25, -1.0, rigid(Wall::lower("floor", 1.0), 0.5, &[(0, 1.0)]));
    assert_eq!(event.search(), Some(Hit { x: 0.25, cause: Cause::Gap(0, 0) }));
}

#[test]
fn a_wall_that_was_just_left_is_not_found_again_by_the_rounding_of_the_stretch_before() {
    for just in [true, false] {
        // At rest 1e-12 m behind the face, a thousand times the rounding.
        let spring = Wall::lower("spring", 1.0).with_elasticity(100.0, 0.0);
        let mut event = above(1.0 - 1e-12, 0.0, spring);
        event.barriers[0].phase = Phase::Outside;
        event.barriers[0].changed = if just { event.time } else { -1.0 };
        event.begin_series(event.limit());
        let again = Some(Hit { x: 0.0, cause: Cause::Elastic(0) });
        assert_eq!(event.search(), if just { None } else { again }, "{just}");
    }
}

#[test]
fn a_row_between_walls_without_room_stays_there_when_a_push_arrives() {
    // The push comes through seven masses: no derivative of the force at the start shows it.
    let chain = |n: usize| {
        let inner = (1..n).flat_map(|i| [(i, i, 100.0), (i - 1, i - 1, 100.0), (i, i - 1, -100.0)]);
        let entries: Vec<_> = inner.chain([(0, 0, if n == 7 { 100.0 } else { 0.0 })]).collect();
        let mut v = vec![0.0; n];
        v[n - 1] = 1.0;
        masses(&vec![1.0; n], &[], &entries).with_initial(&vec![0.0; n], &v).with_duration(2.0)
    };
    let tight = [Wall::lower("below", 0.0), Wall::upper("above", 0.0)].map(|wall| rigid(wall, 0.3, &[(0, 1.0)]));
    let scene = tight.into_iter().fold(chain(8), Scene::with_wall);
    // Seven masses on a spring to the ground.
    let [held, seven] = [scene, chain(7)].map(|scene| {
        let mut event = started(&scene, 2.0);
        while event.time < 2.0 {
            event.advance(None).unwrap();
            // The push is noticed where it exceeds rounding.
            assert!(scene.walls.is_empty() || event.q[0].abs() < 1e-12, "{:e}", event.q[0]);
        }
        event.q
    });
    assert!(seven[0].abs() > 1e-3);
    for (a, b) in held[1..].iter().zip(&seven) {
        assert!((a - b).abs() < 1e-11, "{held:?} {seven:?}");
    }
}

#[test]
fn springs_stand_beside_a_hole_in_which_a_body_slides() {
    // The longest series there is; the spring with and without a dashpot is at its equilibrium.
    for damping in [0.0, 3.0] {
        let spring = Wall::lower("spring", 0.0).with_elasticity(100.0, damping).at(crate::scene::Row::dof(2));
        let scene = with(masses(&[1.0; 3], &[], &[]), hole(2e-3, 0.5, [0.0; 2]))
            .with_wall(spring)
            .with_load(on(Load::constant(-5.0), 2))
            .with_initial(&[2e-3, 0.0, -0.05], &[0.0, 0.03, 0.0]);
        let mut event = started(&scene, 0.1);
        while event.time < 0.3 {
            event.advance(None).unwrap();
        }
        let (force, off) = (event.shown.force[1], event.q[0].hypot(event.q[1]) - 2e-3);
        assert!((force - 5.0).abs() < 1e-12 && off.abs() < 1e-17, "{force} {off:e}");
    }
}

#[test]
fn the_force_of_a_hole_has_the_rounding_error_of_its_bend_too() {
    let (mass, gap, speed) = (0.8, 1.0 / 512.0, 0.03);
    let scene = with(masses(&[mass; 2], &[], &[]), hole(gap, 0.5, [0.0; 2]))
        .with_initial(&[0.6 * gap, 0.8 * gap], &[-0.8 * speed, 0.6 * speed]);
    let mut event = started(&scene, 0.01);
    event.advance(None).unwrap();
    event.begin_series(event.limit());
    event.measure();
    // The force m v²/γ along the normal, and its turning at v/γ; lengths of vectors are sums of
    // magnitudes.
    let (unit, push, turn) = (event.series.unit(), mass * speed * speed / gap, speed / gap);
    let [across, along] = [(&event.q, gap), (&event.v, speed)].map(|(x, of)| (x[0].abs() + x[1].abs()) / of);
    let wanted = [
        noise(across * push) + noise(along * along * push),
        (noise(along * push * turn) + noise(3.0 * along * across * push * turn)) * unit,
    ];
    let found = event.force_noises(0);
    // The rate of the force is rounding, and adds to these.
    (0..2).for_each(|k| assert!((found[k] / wanted[k] - 1.0).abs() < 1e-9, "{k}: {found:?} for {wanted:?}"));
}
