//! Several degrees of freedom: an oscillator written as matrices gives the same motion, a symmetric
//! pair stays symmetric, and the numbering does not matter.

use crate::common::{self, CONSTRAINED, INTEGRATORS, MOREAU_JEAN, schemes, spring};
use crate::random_structures::{self, at, chain, on};
use signorini::linear::{Factor, Symmetric};
use signorini::qp::Backend;
use signorini::{Error, Integrator, Load, Method, Row, Scene, Scheme, State, Stepper, System, Wall};

fn source(upper: f64, lower: f64) -> Scene {
    common::source(upper, lower).with_load(Load::impulse(0.05, 0.3))
}

/// Scenes of one degree of freedom with everything in it: restitutions, elastic and damped walls,
/// blows (one at the start), a start at rest on a wall.
fn scenes() -> Vec<(&'static str, Scene)> {
    let mut leaning = Scene::oscillator(2.0, 0.3, 50.0)
        .with_wall(Wall::upper("upper", 0.01).with_restitution(0.6))
        .with_wall(Wall::lower("lower", -0.01).with_elasticity(3e3, 2.0))
        .with_load(Load::constant(4.0))
        .with_load(Load::impulse(-0.2, 0.4003));
    leaning = leaning.with_initial(&[0.01], &[0.0]);
    vec![
        ("equal", source(0.8, 0.8)),
        ("plastic", source(0.0, 0.0)),
        ("unequal", source(0.4, 0.9)),
        ("struck at the start", source(0.5, 0.5).with_load(Load::impulse(0.1, 0.0))),
        ("elastic", common::elastic(0.0, 0.5).with_load(Load::impulse(-0.05, 0.71))),
        ("damped", common::elastic(3.0, 0.5)),
        ("all elastic", common::all_elastic(1.0)),
        ("from rest on a wall", leaning),
        ("ball", common::ball(0.05, 0.5)),
    ]
}

fn as_matrices(mut scene: Scene) -> Scene {
    scene.system = System::Structure(scene.system.structure());
    scene
}

/// Largest difference of displacement over half the gap of the source scene, and of the impulses
/// over the largest.
fn difference(a: &Scene, b: &Scene, scheme: &Scheme, steps: u32, extra: impl Fn(u32) -> f64) -> (f64, f64) {
    let mut pair = [a, b].map(|scene| Stepper::new(scene, scheme, 1e-3).expect("a sound scene"));
    let (mut far, mut impulse, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for i in 0..steps {
        let force = [extra(i)];
        let [a, b] = pair.each_mut().map(|stepper| stepper.step_with(&force).expect("a step"));
        far = far.max((a.q[0] - b.q[0]).abs());
        for (p, q) in a.impulse.iter().zip(b.impulse) {
            impulse = impulse.max((p - q).abs());
            largest = largest.max(p.abs());
        }
    }
    (far / common::GAP, if largest > 0.0 { impulse / largest } else { 0.0 })
}

#[test]
fn one_degree_of_freedom_as_matrices_is_the_oscillator() {
    for (name, scene) in scenes() {
        let matrices = as_matrices(scene.clone());
        let mut list = schemes();
        if scene.walls.iter().any(|w| w.law.is_rigid()) {
            list.extend(INTEGRATORS.map(|i| spring(1e4, i)));
            if scene.walls.iter().all(|w| w.law.is_rigid()) && scene.walls.len() == 2 {
                list.extend(INTEGRATORS.map(|i| common::penalty(1e-9, i)));
                // h²k_w/m = 100.
                list.extend(
                    [Integrator::DiscreteGradient, Integrator::ImplicitEuler].map(|i| common::penalty(1e-12, i)),
                );
            }
        }
        for scheme in list {
            // A spring of 1e6 N/m is not resolved by a step of 1 ms: the explicit rule overflows.
            if scheme == spring(1e6, Integrator::CentralDifference) {
                continue;
            }
            // Some roundings of the gap, in another order, grown by the few impacts of 0.6 s; much
            // more where a scheme adds to the energy at each: there over a fifth of that time.
            let wild = scheme == Scheme::Newmark || scheme == spring(1e6, Integrator::Trapezoidal);
            let (steps, bound) = if wild { (120, 1e-8) } else { (600, 1e-10) };
            for push in [0.0, 0.7] {
                let extra = |i: u32| push * f64::from(i % 5);
                let (far, impulse) = difference(&scene, &matrices, &scheme, steps, extra);
                assert!(far < bound && impulse < 10.0 * bound, "{name}, {scheme}, {push}: {far:e} {impulse:e}");
            }
        }
    }
}

/// Two masses between mirrored walls, joined by a spring and each held by one, pushed apart and
/// together.
fn pair(e: f64, elastic: bool) -> Scene {
    let mut scene = chain(2, 150.0, 1e-3);
    for (i, sign) in [(0, 1.0), (1, -1.0)] {
        let (far, near) = (4e-3 * sign, -6e-3 * sign);
        let wall = |name: &str, g: f64| {
            let name = format!("{name}{i}");
            at(if g > 0.0 { Wall::upper(&name, g) } else { Wall::lower(&name, g) }, Row::dof(i))
        };
        scene = scene.with_wall(wall("far", far).with_restitution(e));
        let near = wall("near", near);
        scene = scene.with_wall(if elastic { near.with_elasticity(2e3, 1.0) } else { near.with_restitution(0.5 * e) });
        scene = scene.with_load(on(Load::harmonic(4.0 * sign, 4.0, 0.3), i));
        scene = scene.with_load(on(Load::impulse(0.1 * sign, 0.1503), i));
    }
    // And a wall on their distance, which both feel alike.
    let apart = at(Wall::upper("apart", 7e-3).with_restitution(e), Row::new(vec![(0, 1.0), (1, -1.0)]));
    scene.with_wall(apart)
}

#[test]
fn a_symmetric_pair_stays_symmetric() {
    for (e, elastic) in [(0.0, false), (0.8, false), (0.6, true)] {
        let scene = pair(e, elastic);
        for scheme in schemes().into_iter().filter(|s| *s != Scheme::Newmark) {
            let mut stepper = Stepper::new(&scene, &scheme, 2e-4).expect("a sound scene");
            let mut touched = false;
            for i in 0..2000 {
                let step = stepper.step_with(&[0.5, -0.5]).expect("a step");
                touched |= step.impulse.iter().any(|&p| p != 0.0);
                // Rounding of the gap, a tenth of it for each of some contacts.
                assert!((step.q[0] + step.q[1]).abs() < 1e-10 * 5e-3, "{scheme}, e {e}, step {i}: {:?}", step.q);
            }
            assert!(touched, "{scheme}: no wall was met");
        }
    }
}

/// The same chain of 40 masses between walls, with its masses numbered by `number`.
fn numbered(number: impl Fn(usize) -> usize) -> Scene {
    const N: usize = 40;
    let plain = chain(N, 1e4, 1e-5);
    let System::Structure(matrices) = plain.system else { unreachable!("a chain has matrices") };
    let renumber = |m: &Symmetric| Symmetric::from_entries(N, m.entries().map(|(i, j, x)| (number(i), number(j), x)));
    let mut scene =
        random_structures::scene(renumber(&matrices.mass), renumber(&matrices.damping), renumber(&matrices.stiffness));
    let mut v = vec![0.0; N];
    for i in 0..N {
        v[number(i)] = 0.1 * (1.7 * i as f64).sin();
        let e = if i % 2 == 0 { 0.3 } else { 0.7 };
        scene = scene.with_wall(at(Wall::upper(&format!("u{i}"), 1e-3).with_restitution(e), Row::dof(number(i))));
        let lower = at(Wall::lower(&format!("l{i}"), -1e-3), Row::dof(number(i)));
        scene = scene.with_wall(if i % 5 == 0 { lower.with_elasticity(1e5, 10.0) } else { lower.with_restitution(e) });
    }
    let tie = Row::new(vec![(number(3), 1.0), (number(4), -1.0)]);
    scene = scene.with_wall(at(Wall::lower("tie", -2e-4).with_restitution(0.3), tie));
    scene.with_initial(&[0.0; N], &v).with_load(on(Load::harmonic(50.0, 5.0, 0.0), number(0)))
}

#[test]
fn the_numbering_of_the_masses_is_no_physics() {
    let shuffled = |i: usize| 17 * i % 40;
    let (a, b) = (numbered(|i| i), numbered(shuffled));
    let describe = |scene: &Scene| Factor::new(&scene.system.structure().stiffness).expect("definite").describe();
    assert_eq!(describe(&a), "tridiagonal");
    assert!(describe(&b).contains("sparse"), "{}", describe(&b));
    for scheme in schemes().into_iter().filter(|s| *s != Scheme::Newmark) {
        let mut pair = [&a, &b].map(|scene| Stepper::new(scene, &scheme, 1e-4).expect("a sound scene"));
        let mut contacts = 0;
        for i in 0..300 {
            let [x, y] = pair.each_mut().map(|stepper| stepper.step().expect("a step"));
            contacts += x.impulse.iter().filter(|&&p| p != 0.0).count();
            for (dof, q) in x.q.iter().enumerate() {
                // Rounding errors of the gap, amplified by the impacts of 30 ms.
                assert!((q - y.q[shuffled(dof)]).abs() < 1e-9 * 1e-3, "{scheme}, step {i}, mass {dof}");
            }
            for (p, r) in x.impulse.iter().zip(y.impulse) {
                assert!((p - r).abs() < 1e-9, "{scheme}, step {i}: {p} {r}");
            }
        }
        assert!(contacts > 20, "{scheme}: {contacts}");
    }
}

#[test]
fn a_hundred_thousand_masses_step_as_a_few_thousand_do_while_nothing_has_come_from_the_far_end() {
    let scene = |n: usize| {
        let stops = chain(n, 1e4, 1e-5)
            .with_wall(Wall::upper("first", 1e-5).with_restitution(0.5))
            .with_wall(at(Wall::upper("third", 1e-6).with_restitution(0.0), Row::dof(2)))
            .with_wall(at(Wall::upper("second", 2e-6).with_elasticity(1e4, 1.0), Row::dof(1)));
        stops.with_load(Load::constant(50.0))
    };
    let (long, short) = (scene(100_000), scene(2_000));
    let soft = |integrator| spring(1e5, integrator);
    for scheme in CONSTRAINED.into_iter().chain(INTEGRATORS.map(soft)) {
        let mut pair = [&long, &short].map(|scene| Stepper::new(scene, &scheme, 1e-3).expect("a sound scene"));
        let mut pushed = false;
        for _ in 0..6 {
            let [x, y] = pair.each_mut().map(|stepper| stepper.step().expect("a step"));
            pushed |= x.impulse[0] != 0.0;
            // The stiffness between two masses is a hundredth of their inertia over the step: an
            // influence falls by 1e2 from mass to mass.
            for (a, b) in x.q.iter().zip(y.q).take(500) {
                assert!((a - b).abs() <= 1e-15, "{scheme}: {a} {b}");
            }
            assert_eq!(x.impulse, y.impulse, "{scheme}");
        }
        assert!(pushed, "{scheme}");
    }
}

#[test]
fn what_does_not_fit_is_refused_and_the_stepper_goes_on() {
    let scene = pair(0.5, true);
    for scheme in schemes() {
        let mut stepper = Stepper::new(&scene, &scheme, 1e-3).expect("a sound scene");
        for wrong in [&[][..], &[1.0], &[1.0, 2.0, 3.0], &[f64::NAN, 0.0], &[0.0, f64::INFINITY]] {
            let refused = stepper.step_with(wrong).map(|_| ());
            assert!(refused.as_ref().is_err_and(Error::is_request), "{scheme}, {wrong:?}: {refused:?}");
        }
        assert_eq!(stepper.time(), 0.0);
        stepper.step_with(&[1.0, 2.0]).expect("a step");
        let clamp = Stepper::new(&scene, &Method { scheme, backend: Backend::Clamp }, 1e-3);
        let asks = scheme.has_qp();
        assert!(
            !asks || clamp.is_err_and(|e| e.is_request() && e.to_string().contains("there are 2 unknowns")),
            "{scheme}"
        );
        for step in [0.0, -1.0, f64::NAN] {
            assert!(Stepper::new(&scene, &scheme, step).is_err_and(|e| e.is_request()), "{scheme}");
        }
    }
    let wrong_start = Scene { initial: State { q: vec![0.0], v: vec![0.0; 2] }, ..scene.clone() };
    assert!(Stepper::new(&wrong_start, &MOREAU_JEAN, 1e-3).is_err_and(|e| e.is_request()));
    let beyond = scene.with_wall(at(Wall::upper("beyond", 1.0), Row::dof(2)));
    assert!(Stepper::new(&beyond, &MOREAU_JEAN, 1e-3).is_err_and(|e| e.to_string().contains("beyond")));
}
