//! Stepping past the duration of a scene: every scheme continues as if the duration had been
//! longer.

use crate::common::MOREAU_JEAN;
use signorini::{Chain, Integrator, Load, Options, PenaltyLaw, Row, Scene, Scheme, State, Stepper, Table, Wall, run};

/// Loads of every kind, with a blow and a row of a table beyond the first second.
fn loads(at: &Row) -> Vec<Load> {
    let table = Table::new(vec![0.0, 0.7, 1.6], vec![0.0, 1.0, -1.0]).expect("a table");
    let kinds = [Load::constant(0.1), Load::harmonic(3.0, 5.0, 0.3), Load::impulse(0.02, 1.3), Load::table(table)];
    kinds.into_iter().map(|load| Load { at: at.clone(), ..load }).collect()
}

fn oscillator() -> Scene {
    let mut scene = Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.5))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.5));
    scene.loads = loads(&Row::dof(0));
    scene
}

fn structure() -> Scene {
    let chain = Chain { masses: vec![1.0; 3], springs: vec![200.0; 2], grounds: [200.0, 0.0] };
    let mut structure = chain.structure().expect("a chain");
    structure.damping = signorini::linear::Symmetric::sum(&[(2e-3, &structure.stiffness)]);
    let mut scene =
        Scene::structure(structure).with_wall(Wall::upper("stop", 5e-3).with_restitution(0.5).at(Row::dof(2)));
    scene.loads = loads(&Row::dof(0));
    scene
}

fn schemes() -> Vec<Scheme> {
    let law = PenaltyLaw::Linear { stiffness: 1e6, damping: 0.0 };
    let penalty = |integrator| Scheme::Penalty { law, integrator };
    vec![
        Scheme::Event,
        MOREAU_JEAN,
        Scheme::Located,
        Scheme::PaoliSchatzman,
        Scheme::GeneralizedAlpha { rho: 0.8 },
        Scheme::ImplicitEuler,
        Scheme::Newmark,
        penalty(Integrator::DiscreteGradient),
        penalty(Integrator::Trapezoidal),
        penalty(Integrator::ImplicitEuler),
        penalty(Integrator::CentralDifference),
    ]
}

/// The state at 2 s, by the loop of the stepper's own example.
fn at_two_seconds(scene: &Scene, scheme: &Scheme, step: f64) -> State {
    let mut stepper = Stepper::new(scene, scheme, step).expect("a scene");
    let mut steps = 0;
    while stepper.time() < 2.0 - 1e-9 {
        stepper.step().expect("a step");
        steps += 1;
        assert!(steps < 100_000, "{scheme}: stuck at {} s", stepper.time());
    }
    assert!((stepper.time() - 2.0).abs() < 1e-9, "{scheme}: {}", stepper.time());
    stepper.state()
}

#[test]
fn every_scheme_goes_on_as_if_the_duration_had_been_longer() {
    for (what, scene) in [("oscillator", oscillator()), ("structure", structure())] {
        for scheme in schemes() {
            let short = at_two_seconds(&scene, &scheme, 1e-3);
            let long = at_two_seconds(&scene.clone().with_duration(2.0), &scheme, 1e-3);
            let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // A scheme on a grid does not use the duration. The exact scheme ends a step at it: a
            // rounding error of 1e-17 m, which a dozen impacts with e = ½ amplify by at most 1e5.
            let allowed = if scheme == Scheme::Event { 1e-12 } else { 0.0 };
            let (q, v) = (apart(&short.q, &long.q), apart(&short.v, &long.v));
            assert!(q <= allowed && v <= 100.0 * allowed, "{what}, {scheme}: {q:e} m, {v:e} m/s");
        }
    }
}

#[test]
fn steps_of_the_exact_scheme_that_do_not_divide_the_duration_end_there_too() {
    for scene in [oscillator(), structure()] {
        let mut stepper = Stepper::new(&scene, &Scheme::Event, 0.3).expect("a scene");
        let mut ends = Vec::new();
        while stepper.time() < 1.3 {
            ends.push(stepper.step().expect("a step").end);
        }
        for mark in [0.3, 0.6, 0.9, 1.0, 1.2] {
            assert!(ends.iter().any(|end| (end - mark).abs() < 1e-12), "{mark}: {ends:?}");
        }
        // And a run ends exactly at the end.
        let run = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).expect("a run");
        assert_eq!(run.trajectory.time().last(), Some(&1.0));
        let at_end = ends.iter().position(|&end| end == 1.0);
        assert!(at_end.is_some(), "{ends:?}");
    }
}
