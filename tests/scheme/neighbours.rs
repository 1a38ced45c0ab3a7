//! Bodies and walls beside one another: each is treated by its own, in closed forms.

use crate::common::{CONSTRAINED, MOREAU_JEAN, schemes, source};
use crate::random_structures::{self, at, on};
use signorini::linear::Symmetric;
use signorini::{Load, Options, Row, Scene, Scheme, Stepper, Wall, run};

/// Two free bodies of 1 kg.
fn two_bodies() -> Scene {
    random_structures::scene(Symmetric::diagonal(&[1.0, 1.0]), Symmetric::zeros(2), Symmetric::zeros(2))
}

#[test]
fn bodies_that_rest_on_walls_of_opposite_sides_are_not_frozen_between_them() {
    // One is pressed up against a stop, the other down onto one: no wall takes turns with another.
    let scene = two_bodies()
        .with_wall(at(Wall::upper("up", 0.0).with_restitution(0.0), Row::dof(0)))
        .with_wall(at(Wall::lower("down", 0.0).with_restitution(0.0), Row::dof(1)))
        .with_load(on(Load::constant(2.0), 0))
        .with_load(on(Load::constant(-3.0), 1))
        .with_duration(0.1);
    let found = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-2)).expect("a run");
    assert_eq!(found.counters.frozen_steps, 0);
    // Both walls push in all ten steps, with the load.
    for (wall, force) in [("up", -2.0), ("down", 3.0)] {
        let impulse = found.trajectory.impulse(wall).expect("a wall");
        // Ten terms.
        assert!((impulse - 0.1 * force).abs() < 1e-14, "{wall}: {impulse} N s");
    }
    assert_eq!(found.counters.qp_solves, 10);
}

#[test]
fn a_body_without_room_to_move_is_not_frozen_between_its_walls() {
    // The load presses the body on either wall in turn, and a smaller step changes nothing.
    let scene = Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("up", 1e-3))
        .with_wall(Wall::lower("down", 1e-3))
        .with_initial(&[1e-3], &[0.0])
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
        .with_duration(1.0);
    let found = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-3)).expect("a run");
    let impulses = ["up", "down"].map(|wall| found.trajectory.impulse(wall).expect("a wall"));
    // Each takes its half of the sine, ∫|F sin ωt − K u| dt.
    assert!(impulses[0] < -0.9 && impulses[1] > 0.9, "{impulses:?}");
    assert_eq!(found.counters.frozen_steps, 0);
}

#[test]
fn walls_share_a_force_if_they_stand_at_one_place_and_only_then() {
    // The body reaches a wall in its first step, of 0.2 s at 1 m/s. Bounds that differ by less than
    // 32 units in the last place, 7e-15 of their size, are one place.
    for (apart, shared) in [(0.0, true), (2e-15, true), (2e-14, false), (1e-12, false), (1e-10, false), (1e-3, false)] {
        let scene = Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::upper("near", 0.1))
            .with_wall(Wall::upper("far", 0.1 * (1.0 + apart)))
            .with_initial(&[0.0], &[1.0]);
        // Stands on the wall after 0.2 s, and so at 0.5 m/s on the average: what it lost over 0.2 s
        // is the force.
        let total = 0.5 / 0.2;
        let mut stepper = Stepper::new(&scene, &Scheme::ImplicitEuler, 0.2).expect("sound");
        let step = stepper.step().expect("a step");
        let expected = if shared { [-0.5 * total, -0.5 * total] } else { [-total, 0.0] };
        for (force, expected) in step.force.iter().zip(expected) {
            // Three operations.
            assert!((force - expected).abs() < 1e-14, "{apart}: {:?}", step.force);
        }
    }
}

#[test]
fn a_body_that_leaves_its_wall_at_the_start_is_not_held_by_it() {
    // At the wall, pressed onto it, but on its way out: no wall pushes, and the first step is that
    // of a free body. (Not so by paoli-schatzman: its bound mirrors the displacement before, and
    // lets a body at the wall leave by e times the velocity it has, no slower.)
    for sign in [1.0, -1.0] {
        let wall = if sign > 0.0 { Wall::upper("stop", 0.25) } else { Wall::lower("stop", -0.25) };
        let free = Scene::oscillator(1.0, 0.0, 0.0)
            .with_load(Load::constant(3.0 * sign))
            .with_initial(&[0.25 * sign], &[-sign]);
        let scene = free.clone().with_wall(wall);
        for scheme in schemes().into_iter().filter(|scheme| *scheme != Scheme::PaoliSchatzman) {
            let h = 1e-3;
            let mut between = Stepper::new(&scene, &scheme, h).expect("sound");
            let step = between.step().expect("a step");
            assert_eq!((step.impulse, step.force), (&[0.0][..], &[0.0][..]), "{scheme}");
            let mut alone = Stepper::new(&free, &scheme, h).expect("sound");
            let far = alone.step().expect("a step");
            // The same sums, but for the order in which a scheme may take them.
            assert!((step.q[0] - far.q[0]).abs() < 1e-15 && (step.v[0] - far.v[0]).abs() < 1e-13, "{scheme}");
        }
    }
}

#[test]
fn a_blow_that_drives_a_resting_body_into_its_wall_breaks_no_promise() {
    // 1 kg rests on a floor under 5 N and is struck onto it and, later, off it: in moreau-jean the
    // floor answers the velocity after the blow by its restitution, e v.
    for e in [0.0, 0.5, 1.0] {
        for blow in [-0.7, 0.4] {
            let scene = Scene::oscillator(1.0, 0.0, 0.0)
                .with_wall(Wall::lower("floor", 0.0).with_restitution(e))
                .with_load(Load::constant(-5.0))
                .with_load(Load::impulse(blow, 0.0055))
                .with_duration(0.012);
            for scheme in CONSTRAINED.into_iter().filter(|scheme| *scheme != Scheme::Newmark) {
                let found = run(&scene, &scheme, &Options::with_step(1e-3)).expect("a run");
                assert_eq!(found.findings, [], "{scheme}, e = {e}, {blow} N s: {:?}", found.residuals);
            }
            let found = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-3)).expect("a run");
            let v = found.trajectory.velocity();
            // In the step of the blow the floor's answer is to the blow alone.
            let struck = if blow < 0.0 { -e * blow } else { blow - 5e-3 };
            assert!((v[6] - struck).abs() < 1e-14, "e = {e}, {blow} N s: {v:?}, expected {struck}");
        }
    }
}

#[test]
fn the_last_numbers_of_a_body_that_runs_away_are_refused() {
    // 1e300 N from the caller, for ever: the velocity passes the largest number.
    for scene in [source(0.8, 0.8), two_bodies()] {
        let n = scene.initial.q.len();
        let scene = scene.with_initial(&vec![0.0; n], &vec![0.0; n]);
        for scheme in [MOREAU_JEAN, Scheme::ImplicitEuler] {
            let mut stepper = Stepper::new(&scene, &scheme, 1.0).expect("sound");
            let pushed = vec![1e308; n];
            let failed = (0..100).find_map(|_| match stepper.step_with(&pushed) {
                Ok(step) => {
                    assert!(step.q.iter().chain(step.v).all(|x| x.is_finite()), "{scheme}: {:?}", step.q);
                    None
                }
                Err(error) => Some(error),
            });
            // Walls may hold it, at 1e308 N; free bodies are gone.
            assert!(failed.is_some() || n == 1, "{scheme}");
        }
    }
}
