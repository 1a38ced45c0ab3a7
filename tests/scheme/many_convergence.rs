//! Chains of three masses: every scheme at its order, against the modes where nothing is touched,
//! against a much finer run of another scheme where it is.

use crate::common::{CONSTRAINED, INTEGRATORS, MOREAU_JEAN, slope, spring};
use crate::random_structures::{at, chain, on};
use signorini::{Integrator, Load, Options, Row, Scene, Scheme, Stepper, TimeOptions, Wall, run};
use std::f64::consts::{FRAC_PI_4, SQRT_2};

const K: f64 = 150.0;
const BETA: f64 = 4e-3;
const Q0: [f64; 3] = [3e-3, -1e-3, 2e-3];
const V0: [f64; 3] = [0.02, 0.05, -0.04];

/// The chain's free motion by its modes φⱼ(i) = sin(ijπ/4)/√2, ωⱼ² = 4k sin²(jπ/8), ζⱼ = ½βωⱼ.
fn modal(t: f64) -> [f64; 3] {
    let mut q = [0.0; 3];
    for j in 1..4_u8 {
        let j = f64::from(j);
        let shape = [1.0, 2.0, 3.0].map(|i| (i * j * FRAC_PI_4).sin() / SQRT_2);
        let part = |x: [f64; 3]| x.iter().zip(shape).map(|(x, s)| x * s).sum::<f64>();
        let omega = 2.0 * K.sqrt() * (0.5 * j * FRAC_PI_4).sin();
        let (decay, (a, b)) = (0.5 * BETA * omega * omega, (part(Q0), part(V0)));
        let damped = (omega * omega - decay * decay).sqrt();
        let y = (-decay * t).exp() * (a * (damped * t).cos() + (b + decay * a) / damped * (damped * t).sin());
        for (q, s) in q.iter_mut().zip(shape) {
            *q += y * s;
        }
    }
    q
}

/// Displacements of all masses every 10 ms up to `end`, by `per` steps each.
fn rows(scene: &Scene, scheme: &Scheme, per: u64, end: f64) -> Vec<Vec<f64>> {
    let mut stepper = Stepper::new(scene, scheme, 1e-2 / per as f64).expect("a sound scene");
    let row = |_| {
        for _ in 0..per {
            stepper.step().expect("a step");
        }
        stepper.state().q
    };
    (0..(end / 1e-2).round() as u64).map(row).collect()
}

/// Largest difference, over 5 mm.
fn far(a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().flatten().zip(b.iter().flatten()).fold(0.0, |worst, (x, y)| f64::max(worst, (x - y).abs())) / 5e-3
}

#[test]
fn free_motion_converges_to_the_modes_at_the_order_of_every_scheme() {
    let scene = chain(3, K, BETA).with_initial(&Q0, &V0).with_wall(Wall::upper("far", 1.0));
    let exact: Vec<Vec<f64>> = (1..=100).map(|i| modal(f64::from(i) * 1e-2).to_vec()).collect();
    let mut list: Vec<(Scheme, f64)> = CONSTRAINED.map(|s| (s, 2.0)).to_vec();
    list.extend(INTEGRATORS.map(|i| (spring(1e4, i), 2.0)));
    for (scheme, order) in &mut list {
        // A damper at the mean velocity, but the stiffness at t: of order two as well. Implicit
        // rules are of order one.
        let implicit = matches!(scheme, Scheme::Penalty { integrator: Integrator::ImplicitEuler, .. });
        if implicit
            || *scheme == Scheme::ImplicitEuler
            || matches!(scheme, Scheme::MoreauJean { theta } if *theta > 0.5)
        {
            *order = 1.0;
        }
    }
    for (scheme, order) in list {
        let errors = [16_u64, 32, 64].map(|per| (1.0 / per as f64, far(&rows(&scene, &scheme, per, 1.0), &exact)));
        println!("{scheme}: {errors:?}");
        assert!((slope(&errors) - order).abs() < 0.1, "{scheme}: {errors:?}");
        assert!(errors[2].1 < 0.05, "{scheme}: {errors:?}");
    }
}

#[test]
fn plastic_impacts_of_a_chain_converge_to_one_motion() {
    let mut scene = chain(3, K, BETA);
    for i in 0..3 {
        let (upper, lower) = (Wall::upper(&format!("u{i}"), 3e-3), Wall::lower(&format!("l{i}"), -4e-3));
        scene = scene.with_wall(at(upper.with_restitution(0.0), Row::dof(i)));
        scene = scene.with_wall(at(lower.with_restitution(0.0), Row::dof(i)));
    }
    let near = at(Wall::lower("near", -2e-3).with_restitution(0.0), Row::new(vec![(0, 1.0), (2, -1.0)]));
    let scene =
        scene.with_wall(near).with_load(on(Load::harmonic(3.0, 3.0, 0.0), 0)).with_load(on(Load::constant(0.2), 2));
    let end = 0.5;
    let reference = rows(&scene, &Scheme::PaoliSchatzman, 10_000, end);
    let other = rows(&scene, &MOREAU_JEAN, 10_000, end);
    // The two finest runs, by rules that share nothing but the matrices.
    let agree = far(&reference, &other);
    println!("reference: {agree:e}");
    assert!(agree < 1e-3, "{agree:e}");
    for scheme in CONSTRAINED.into_iter().filter(|s| *s != Scheme::Newmark) {
        let errors = [20_u64, 80, 320].map(|per| (1.0 / per as f64, far(&rows(&scene, &scheme, per, end), &reference)));
        let order = slope(&errors);
        println!("{scheme}: {order} {errors:?}");
        // One at least; impact times fall where they fall in a step, so that the slope of three
        // runs scatters.
        assert!(order > 0.75 && errors[2].1 < 1e-2, "{scheme}: {order} {errors:?}");
    }
}

#[test]
fn the_discrete_gradient_keeps_the_energy_of_a_chain_behind_stiff_walls_for_ever() {
    let mut scene = chain(5, 1e4, 0.0).with_initial(&[0.0; 5], &[0.1, -0.2, 0.15, 0.05, -0.1]);
    for i in 0..5 {
        scene = scene.with_wall(at(Wall::upper(&format!("u{i}"), 1e-4), Row::dof(i)));
        scene = scene.with_wall(at(Wall::lower(&format!("l{i}"), -1e-4), Row::dof(i)));
    }
    // h²k_w/m = 100: a step that does not resolve the walls.
    let run = run(
        &scene.with_duration(200.0),
        &spring(1e8, Integrator::DiscreteGradient),
        &Options {
            time: TimeOptions { sample: Some(1.0), ..TimeOptions::with_step(1e-3) },
            ..Options::with_step(1e-3)
        },
    )
    .expect("a run");
    let energy = run.residuals.energy;
    println!("{energy:?} {} contacts", run.trajectory.contacts().len());
    assert!(run.trajectory.contacts().len() > 10_000);
    // Rounding of 2e5 steps: each some units of the energy, at random.
    assert!((energy.final_j / energy.initial_j - 1.0).abs() < 1e-11, "{energy:?}");
}
