//! A stepper set to a state at a time continues as the original would.

use crate::common::{MOREAU_JEAN, source};
use signorini::{Chain, Integrator, Load, PenaltyLaw, Row, Scene, Scheme, State, Stepper, Wall};

const H: f64 = 1e-3;

fn penalty(integrator: Integrator) -> Scheme {
    Scheme::Penalty { law: PenaltyLaw::Linear { stiffness: 1e6, damping: 0.0 }, integrator }
}

fn chain() -> Scene {
    let chain = Chain { masses: vec![1.0; 3], springs: vec![200.0; 2], grounds: [200.0, 0.0] };
    Scene::structure(chain.structure().expect("a chain"))
        .with_load(Load { at: Row::dof(0), ..Load::harmonic(3.0, 2.0, 0.3) })
        .with_initial(&[0.0; 3], &[0.0, 0.1, 0.2])
}

fn walled_chain() -> Scene {
    chain().with_wall(Wall::upper("stop", 5e-3).with_restitution(0.5).at(Row::dof(2)))
}

/// `count` steps: time, state and impulses after each.
fn go(stepper: &mut Stepper, count: usize) -> Vec<(f64, State, Vec<f64>)> {
    let mut seen = Vec::new();
    for _ in 0..count {
        let step = stepper.step().expect("a step");
        seen.push((step.end, State { q: step.q.to_vec(), v: step.v.to_vec() }, step.impulse.to_vec()));
    }
    seen
}

#[test]
fn one_step_rules_repeat_their_steps_to_the_last_bit() {
    let mut schemes = vec![MOREAU_JEAN, Scheme::MoreauJean { theta: 1.0 }, Scheme::ImplicitEuler];
    schemes.extend([Integrator::Trapezoidal, Integrator::ImplicitEuler, Integrator::DiscreteGradient].map(penalty));
    for (what, scene) in [("oscillator", source(0.8, 0.8)), ("chain", walled_chain())] {
        for scheme in &schemes {
            let mut stepper = Stepper::new(&scene, scheme, H).expect("a scene");
            go(&mut stepper, 150);
            let (time, state) = (stepper.time(), stepper.state());
            let first = go(&mut stepper, 400);
            assert!(first.iter().any(|(.., p)| p.iter().any(|&p| p != 0.0)), "{what}, {scheme}: no wall met");
            stepper.set_state(time, &state).expect("a state of its own");
            assert_eq!((stepper.time(), stepper.state()), (time, state.clone()), "{what}, {scheme}");
            assert_eq!(go(&mut stepper, 400), first, "{what}, {scheme}");
            // Work goes on being counted.
            assert_eq!(stepper.counters().steps, 950);
            // And another stepper continues from it.
            let mut other = Stepper::new(&scene, scheme, H).expect("a scene");
            other.set_state(time, &state).expect("a state of its own");
            assert_eq!(go(&mut other, 400), first, "{what}, {scheme}");
        }
    }
}

/// A scheme that divides steps goes on within one: set to its own state after every part, it makes
/// the parts that it makes by itself.
#[test]
fn a_divided_step_is_gone_on_with_from_any_of_its_parts() {
    for (what, scene) in [("oscillator", source(0.5, 0.8)), ("chain", walled_chain())] {
        let mut stepper = Stepper::new(&scene, &Scheme::Located, H).expect("a scene");
        let by_itself = go(&mut stepper, 600);
        let within = |time: f64| (time / H - (time / H).round()).abs() > 1e-3;
        assert!(by_itself.iter().filter(|(time, ..)| within(*time)).count() > 2, "{what}: no step was divided");
        let mut other = Stepper::new(&scene, &Scheme::Located, H).expect("a scene");
        for (number, expected) in by_itself.iter().enumerate() {
            let (time, state) = (other.time(), other.state());
            other.set_state(time, &state).expect("a state of its own");
            assert_eq!((other.time(), other.state()), (time, state), "{what}");
            let found = go(&mut other, 1).remove(0);
            // A part after an impact is found from the path of the whole step, or from its own.
            let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-11);
            assert!((found.0 - expected.0).abs() < 1e-11, "{what}, {number}: {} s, not {}", found.0, expected.0);
            assert!(
                close(&found.1.q, &expected.1.q) && close(&found.1.v, &expected.1.v) && close(&found.2, &expected.2),
                "{what}, {number}: {found:?}, not {expected:?}"
            );
        }
    }
}

#[test]
fn the_exact_scheme_goes_on_from_any_time() {
    for (what, scene) in [("oscillator", source(0.5, 0.5)), ("chain", walled_chain())] {
        let mut stepper = Stepper::new(&scene, &Scheme::Event, 0.05).expect("a scene");
        while stepper.time() < 0.33 {
            stepper.step().expect("a step");
        }
        let (time, state) = (stepper.time(), stepper.state());
        while stepper.time() < 0.6 {
            stepper.step().expect("a step");
        }
        let end = stepper.state();
        let mut other = Stepper::new(&scene, &Scheme::Event, 0.05).expect("a scene");
        other.set_state(time, &state).expect("a state of its own");
        while other.time() < stepper.time() {
            other.step().expect("a step");
        }
        assert_eq!(other.time(), stepper.time(), "{what}: steps end at the same multiples of the stride");
        for (a, b) in other.state().q.iter().zip(&end.q) {
            // Rounding, through a few impacts with e = ½.
            assert!((a - b).abs() < 1e-13, "{what}: {a} {b}");
        }
    }
}

/// The largest error of `scheme` at 0.6 s, m, against the exact motion, with the state set to
/// itself at 0.3 s.
fn error(scene: &Scene, scheme: &Scheme, h: f64) -> f64 {
    let mut exact = Stepper::new(scene, &Scheme::Event, 0.6).expect("a scene");
    while exact.time() < 0.6 {
        exact.step().expect("a step");
    }
    let steps = (0.3 / h).round() as usize;
    let mut stepper = Stepper::new(scene, scheme, h).expect("a scene");
    go(&mut stepper, steps);
    let (time, state) = (stepper.time(), stepper.state());
    stepper.set_state(time, &state).expect("a state of its own");
    go(&mut stepper, steps);
    stepper.state().q.iter().zip(&exact.state().q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn rules_with_a_memory_begin_anew_and_keep_their_order() {
    let oscillator = Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::harmonic(3.0, 5.0, 0.4));
    let schemes = [
        Scheme::PaoliSchatzman,
        Scheme::GeneralizedAlpha { rho: 0.8 },
        Scheme::Newmark,
        MOREAU_JEAN,
        penalty(Integrator::CentralDifference),
    ];
    for (what, scene) in [("oscillator", &oscillator), ("chain", &chain())] {
        for scheme in &schemes {
            let (coarse, fine) = (error(scene, scheme, 2e-3), error(scene, scheme, 1e-3));
            // All of them are of order 2 without impacts; a start of order 1 would give 2.
            assert!((3.3..4.7).contains(&(coarse / fine)), "{what}, {scheme}: {coarse:e} {fine:e}");
        }
    }
}

#[test]
fn a_blow_just_before_is_not_given_twice() {
    // A free body of 1 kg struck with 0.1 N s at 0.2498 s: within half a step before the restart.
    for scheme in [MOREAU_JEAN, Scheme::PaoliSchatzman, penalty(Integrator::CentralDifference)] {
        for structure in [false, true] {
            let mut scene = Scene::oscillator(1.0, 0.0, 0.0).with_load(Load::impulse(0.1, 0.2498));
            if structure {
                let free = Chain { masses: vec![1.0], springs: vec![], grounds: [0.0, 0.0] };
                scene.system = Scene::structure(free.structure().expect("a mass")).system;
            }
            let mut stepper = Stepper::new(&scene, &scheme, H).expect("a scene");
            go(&mut stepper, 250);
            let (time, state) = (stepper.time(), stepper.state());
            assert_eq!(state.v, [0.1], "{scheme}");
            stepper.set_state(time, &state).expect("a state of its own");
            go(&mut stepper, 50);
            assert!((stepper.state().v[0] - 0.1).abs() < 1e-15, "{scheme}: {:?}", stepper.state());
        }
    }
}

#[test]
fn the_exact_scheme_gives_the_blows_after_a_restart_and_not_those_at_it() {
    // 2 kg at 0.3 m/s, with blows of 1 N s at 0 and at 0.5 s: 0.8 m/s, then 1.3 m/s.
    for structure in [false, true] {
        let mut scene = Scene::oscillator(2.0, 0.0, 0.0)
            .with_wall(Wall::upper("far", 90.0))
            .with_load(Load::impulse(1.0, 0.0))
            .with_load(Load::impulse(1.0, 0.5))
            .with_initial(&[0.0], &[0.3]);
        if structure {
            let free = Chain { masses: vec![2.0], springs: vec![], grounds: [0.0, 0.0] };
            scene.system = Scene::structure(free.structure().expect("a mass")).system;
        }
        let mut stepper = Stepper::new(&scene, &Scheme::Event, 0.25).expect("a scene");
        let mut reach = |from: Option<(f64, f64)>| {
            if let Some((time, v)) = from {
                stepper.set_state(time, &State { q: vec![0.0], v: vec![v] }).expect("a state");
            }
            while stepper.time() < 1.0 {
                stepper.step().expect("a step");
            }
            stepper.state().q[0]
        };
        for (from, expected) in [
            (None, 0.5 * 0.8 + 0.5 * 1.3),
            // Before the second blow, at it with the velocity after it, and after it.
            (Some((0.25, 0.8)), 0.25 * 0.8 + 0.5 * 1.3),
            (Some((0.5, 1.3)), 0.5 * 1.3),
            (Some((0.75, 1.3)), 0.25 * 1.3),
        ] {
            let found = reach(from);
            assert!((found - expected).abs() < 1e-14, "structure: {structure}, from {from:?}: {found}, not {expected}");
        }
    }
}

#[test]
fn states_that_make_no_sense_are_refused_and_change_nothing() {
    let mut stepper = Stepper::new(&source(0.8, 0.8), &MOREAU_JEAN, H).expect("a scene");
    go(&mut stepper, 10);
    let before = (stepper.time(), stepper.state());
    let state = |q: &[f64], v: &[f64]| State { q: q.to_vec(), v: v.to_vec() };
    for (time, given, key) in [
        (0.0015, state(&[0.0], &[0.0]), "time"),
        (-1.0, state(&[0.0], &[0.0]), "time"),
        (f64::NAN, state(&[0.0], &[0.0]), "time"),
        (f64::INFINITY, state(&[0.0], &[0.0]), "time"),
        (1.0, state(&[0.0, 1.0], &[0.0]), "state: displacement"),
        (1.0, state(&[0.0], &[]), "state: velocity"),
        (1.0, state(&[0.0], &[f64::NAN]), "state: velocity"),
    ] {
        let refused = stepper.set_state(time, &given).expect_err("no such state").to_string();
        assert!(refused.starts_with(key) || refused.contains(key), "{refused}");
        assert_eq!((stepper.time(), stepper.state()), before);
    }
    let mut exact = Stepper::new(&source(0.8, 0.8), &Scheme::Event, 0.1).expect("a scene");
    let refused = exact.set_state(0.5, &state(&[6e-3], &[0.0])).expect_err("behind a wall").to_string();
    assert!(refused.contains("upper"), "{refused}");
}

#[test]
fn a_contact_that_has_not_ended_is_dropped() {
    // Pressed onto a wall for three steps, and set to the same state: of that contact nothing is
    // told any more, and the one that the next steps tell began with the first of them.
    let scene = Scene::oscillator(1.0, 0.0, 100.0)
        .with_wall(Wall::upper("stop", 0.0).with_restitution(0.0))
        .with_load(Load::constant(3.0));
    for scheme in [MOREAU_JEAN, Scheme::ImplicitEuler, Scheme::PaoliSchatzman] {
        let mut stepper = Stepper::new(&scene, &scheme, H).expect("a scene");
        go(&mut stepper, 3);
        assert_eq!(stepper.open_contacts().len(), 1, "{scheme}");
        let (time, state) = (stepper.time(), stepper.state());
        stepper.set_state(time, &state).expect("a state");
        assert_eq!(stepper.open_contacts(), [], "{scheme}");
        go(&mut stepper, 2);
        let open = stepper.open_contacts();
        assert!(open.len() == 1 && open[0].start >= time - 1e-12, "{scheme}: {open:?}");
    }
}
