//! Coulomb's law on the impulses of a step.

use super::*;
use crate::residual::friction::FrictionImpulse;
use crate::residual::supports::Supports;
use crate::scene::{Face, FrictionCoefficients, Side, Wall};
use crate::step::{Friction, Law, PromisedForce, Reached, Rigid};

/// The body of 4 kg in a hole of 0.5 m, or beside a flat, with friction ½.
fn scene(flat: bool) -> Scene {
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let mut wall = Wall { law: RIGID, ..Wall::round("support", at.clone(), 0.5) }.with_friction(0.5);
    if flat {
        let face = Face::Flat { side: Side::Upper, position: 0.5, at: Row::dof(0), direction: Some(0.0) };
        wall = Wall { face, ..Wall::upper("flat", 0.5).with_friction(0.5) };
    }
    body([4.0; 2], 0.0).with_support("support", at, [0.0; 2], vec![wall])
}

fn start(scene: &Scene) -> Judge {
    judge(scene, (Balance::Theta(0.5), Promise::springs(Law::Ends(0.5))), 0.25, &[0.5, 0.0])
}

#[test]
fn missing_and_surplus_friction_is_measured_whatever_else_is_zero() {
    let scene = scene(false);
    // Normal force and friction, N, sliding speed, m/s, and the residual at scales of 1.
    for (push, rub, speed, residual) in [
        (0.0, 0.0, 2.0, 0.0),
        // None in sliding, where 1.5 N should act; less than the speed.
        (3.0, 0.0, 2.0, 1.5),
        (3.0, 0.0, -2.0, 1.5),
        (3.0, 0.0, 0.25, 0.25),
        (3.0, 0.0, 0.0, 0.0),
        // Without anything that pushes.
        (0.0, 0.75, 0.0, 0.75),
        (0.0, -0.75, 0.0, 0.75),
        // Coulomb's, at rest less, and beyond the cone.
        (3.0, -1.5, 2.0, 0.0),
        (3.0, 1.5, -2.0, 0.0),
        (3.0, 1.0, 0.0, 0.0),
        (3.0, 1.75, 0.0, 0.25),
        (3.0, -1.75, 0.0, 0.25),
    ] {
        let judge = start(&scene);
        let mut supports = Supports::new(&scene, &[4.0], (&[0.5, 0.0], &[0.0; 2])).unwrap();
        let made = Made { after: vec![0.0, speed], ..Made::rest(&scene, 0.25) };
        let impulse = [0.25 * push, 0.25 * rub];
        let rub = FrictionImpulse { place: 0, friction: 0.5.into(), impulse, tangent: [0.0, 1.0] };
        judge.check_friction(&made.step(), &scene.supports[0].at, &rub, &mut supports);
        let rubs = supports.rubs;
        let found = rubs.worst(1.0, 1.0);
        assert_eq!(found, residual, "{push} N, {} N, {speed} m/s", rub.impulse[1] / 0.25);
        // What exceeds rounding, some 1e-11 here, is the same.
        let beyond = rubs.worst_excess(1.0, 1.0).value.max(rubs.pull.excess.value);
        assert!((beyond - residual).abs() < 1e-10, "{push}, {rub:?}, {speed}: {beyond}");
    }
}

#[test]
fn what_exceeds_kinetic_friction_needs_a_contact_that_slides_neither_before_nor_after() {
    let mut scene = scene(false);
    let friction = FrictionCoefficients { sticking: 0.75, sliding: 0.5 };
    scene.walls[0].friction = friction;
    let judge = start(&scene);
    // A push of 3 N with friction (N) and speed (m/s), one step after the other from rest on the
    // wall: what the last of them misses, at scales of 1.
    for (steps, residual) in [
        (&[(3.0, -2.25, 0.0)][..], 0.0),
        (&[(3.0, 2.5, 0.0)], 0.25),
        (&[(3.0, -1.5, 2.0)], 0.0),
        // Beyond the kinetic one while it slides, by less than the speed or more; too little of it.
        (&[(3.0, -2.25, 2.0)], 0.75),
        (&[(3.0, -2.25, 0.125)], 0.125),
        (&[(3.0, -1.0, 2.0)], 0.5),
        // The step after a slide, and the one after that.
        (&[(3.0, -1.5, 2.0), (3.0, -2.25, 0.0)], 0.75),
        (&[(3.0, -1.5, 0.125), (3.0, -2.25, 0.0)], 0.125),
        // It may hold a body that would turn, not push one that has turned.
        (&[(3.0, -1.5, 2.0), (3.0, 2.25, 0.0)], 0.0),
        (&[(3.0, -1.5, 2.0), (3.0, 2.5, 0.0)], 0.25),
        (&[(3.0, -1.5, 2.0), (3.0, 2.25, -2.0)], 0.75),
        (&[(3.0, -1.5, 2.0), (3.0, 1.5, 0.0), (3.0, 2.25, 0.0)], 0.0),
        // After a step without a push.
        (&[(0.0, 0.0, 0.0), (3.0, 2.25, 0.0)], 0.75),
        (&[(0.0, 0.0, 0.0), (3.0, 1.5, 0.0), (3.0, 2.25, 0.0)], 0.0),
    ] {
        let mut supports = Supports::new(&scene, &[4.0], (&[0.5, 0.0], &[0.0; 2])).unwrap();
        for &(push, rub, speed) in steps {
            let made = Made { after: vec![0.0, speed], ..Made::rest(&scene, 0.25) };
            let impulse = [0.25 * push, 0.25 * rub];
            let rub = FrictionImpulse { place: 0, friction, impulse, tangent: [0.0, 1.0] };
            supports.rubs = Default::default();
            judge.check_friction(&made.step(), &scene.supports[0].at, &rub, &mut supports);
        }
        let found = supports.rubs.worst(1.0, 1.0);
        // A speed counts less its rounding.
        assert!((found - residual).abs() < 1e-9, "{steps:?}: {found}");
    }
}

#[test]
fn friction_at_an_instant_is_kinetic_and_what_changes_the_velocity_may_end_a_stop() {
    let mut scene = scene(false);
    let friction = FrictionCoefficients { sticking: 0.75, sliding: 0.5 };
    scene.walls[0].friction = friction;
    let judge = start(&scene);
    let at_end = |[p, f]: [f64; 2], speed: f64| {
        let mut supports = Supports::new(&scene, &[4.0], (&[0.5, 0.0], &[0.0; 2])).unwrap();
        let made = Made { after: vec![0.0, speed], ..Made::rest(&scene, 0.25) };
        let rub = FrictionImpulse { place: 0, friction, impulse: [0.25 * p, 0.25 * f], tangent: [0.0, 1.0] };
        judge.check_friction_at_end(&made.step(), &scene.supports[0].at, &rub, &mut supports);
        (supports.rubs.worst(1.0, 1.0), supports.slid[0])
    };
    // It stood before.
    assert_eq!((at_end([3.0, 2.25], 0.0).0, at_end([3.0, 1.5], 0.0)), (0.75, (0.0, 0.0)));
    assert!(at_end([0.0; 2], 2.0).1 > 1.9 && at_end([0.0; 2], 0.0).1 == 0.0);
}

#[test]
fn a_run_begins_with_the_walls_on_which_the_body_stands() {
    let scene = scene(false);
    let slid = |q: [f64; 2], v: [f64; 2]| Supports::new(&scene, &[4.0], (&q, &v)).unwrap().slid[0];
    assert_eq!((slid([0.5, 0.0], [0.0; 2]), slid([0.3, 0.4], [3.0, 4.0])), (0.0, 0.0));
    for (q, v) in [([0.4, 0.0], [0.0; 2]), ([0.5, 0.0], [0.0, 1e-9]), ([0.3, 0.4], [4.0, -3.0])] {
        assert_eq!(slid(q, v), f64::INFINITY, "{q:?} {v:?}");
    }
}

#[test]
fn a_sliding_speed_counts_less_the_rounding_of_all_speeds() {
    let scene = scene(false);
    let mut judge = start(&scene);
    judge.blows.struck.copy_from_slice(&[100.0, 0.0]);
    let made = Made { before: vec![50.0, -20.0], after: vec![-30.0, 1e-9], ..Made::rest(&scene, 0.25) };
    let mut supports = Supports::new(&scene, &[4.0], (&[0.5, 0.0], &[0.0; 2])).unwrap();
    let rub = FrictionImpulse { place: 0, friction: 0.5.into(), impulse: [1.0, 0.0], tangent: [0.0, 1.0] };
    judge.check_friction(&made.step(), &scene.supports[0].at, &rub, &mut supports);
    let rubs = supports.rubs;
    // Of 70, 30 and 100 m/s, and the solver's tolerance of the gap over a step. At this scale of
    // forces the speed is the smaller one.
    let found = rubs.worst_excess(1.0, 1e-30).value;
    assert_less(found, 1e-9, judge.noise.velocity(200.0, 0.25));
}

#[test]
fn the_friction_of_flats_is_a_force_of_the_run() {
    let scene = scene(true);
    let mut judge = start(&scene);
    let made = Made { impulse: vec![-1.0], friction: vec![-3.0], ..Made::rest(&scene, 0.25) };
    let mut supports = judge.supports.take().unwrap();
    judge.rub_flats(&made.step(), &mut supports);
    let rubs = supports.rubs;
    // 12 N beside a push of 4 N, which is noted elsewhere: 10 N beyond the cone.
    assert_eq!((judge.walls.force_scale, rubs.worst(1.0, 1.0)), (12.0, 10.0));
}

#[test]
fn a_wall_of_a_wedged_body_or_of_one_that_comes_to_rest_owes_no_rebound() {
    let mut scene = scene(true);
    scene.walls[0].law = WallLaw::Rigid { restitution: 0.5 };
    let rigid = Rigid { force: PromisedForce::Mean, displacement: None, velocity: Some(Reached::Ahead(0.5)) };
    let promise = Promise { rigid, ..Promise::springs(Law::Ends(0.5)) };
    // It arrives at 2 m/s and stops: 1 m/s of rebound is owed, if it is not given up.
    let owed = |friction: Option<Friction>, wedged: &[usize], resting: &[usize], pushed: f64| {
        let promise = Promise { friction, ..promise };
        let mut judge = judge(&scene, (Balance::Theta(0.5), promise), 0.25, &[0.5, 0.0]);
        judge.supports.as_mut().expect("friction").pushed[0] = pushed;
        let (wedged, resting) = (wedged.to_vec(), resting.to_vec());
        let (q, before) = (vec![0.5, 0.0], vec![2.0, 0.0]);
        let made = Made { q, before, impulse: vec![-8.0], wedged, resting, ..Made::rest(&scene, 0.25) };
        judge.walls_on_grid(&made.step(), false);
        judge.walls.rebounds.worst(1.0, 1.0)
    };
    let law = Some(Friction::EndVelocity);
    assert_eq!(owed(law, &[], &[], -100.0), 1.0);
    assert_eq!((owed(law, &[0], &[], 0.0), owed(law, &[1], &[], 0.0)), (0.0, 1.0));
    // Rest where 2 e m a = 8 N s is at most ½ of the push before.
    assert_eq!([-17.0, -15.0, 0.0].map(|pushed| owed(law, &[], &[0], pushed)), [0.0, 1.0, 1.0]);
    // A scheme that does not promise friction gives up nothing.
    assert_eq!(owed(None, &[0], &[0], -100.0), 1.0);
}
