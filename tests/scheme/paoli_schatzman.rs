//! Paoli & Schatzman's scheme where its bounds contradict one another, and walls at one place.

use crate::common;
use crate::random_structures::{Draws, at, chain};
use signorini::qp::Backend;
use signorini::{Method, Options, Path, Row, Scene, Scheme, Stepper, Wall, run};

/// Two masses between stops and a stop on their distance, each with a restitution of its own.
fn dependent(draws: &mut Draws) -> Scene {
    let mut scene = chain(2, 100.0, 1e-3).with_duration(1.0);
    let distance = Row::new(vec![(1, 1.0), (0, -1.0)]);
    for (name, row) in [("left", Row::dof(0)), ("right", Row::dof(1)), ("between", distance)] {
        let e = if draws.chance(0.5) { draws.unit() } else { 0.0 };
        let gap = 10.0_f64.powf(draws.between(-6.0, -3.0));
        scene = scene.with_wall(at(Wall::upper(&format!("{name}-upper"), gap).with_restitution(e), row.clone()));
        let e = if draws.chance(0.5) { 1.0 } else { draws.unit() };
        scene = scene.with_wall(at(Wall::lower(&format!("{name}-lower"), -gap).with_restitution(e), row));
    }
    let v = [draws.between(-1.0, 1.0), draws.between(-1.0, 1.0)];
    scene.with_initial(&[0.0; 2], &v)
}

#[test]
fn unequal_restitutions_on_rows_that_depend_on_one_another_are_no_reason_to_stop() {
    let (mut shared, mut steps) = (0, 0);
    for seed in 0..300 {
        let scene = dependent(&mut Draws::new(seed));
        // A step in which a body crosses the gap: deep behind one wall, the bounds of the others
        // contradict.
        let h = 1e-3;
        let mut stepper = Stepper::new(&scene, &Scheme::PaoliSchatzman, h).expect("a sound scene");
        for _ in 0..300 {
            let step = stepper.step().unwrap_or_else(|error| panic!("seed {seed}: {error}"));
            shared += u32::from(matches!(step.path, Path::OneRestitution));
            steps += 1;
        }
        let run = run(&scene.with_duration(0.3), &Scheme::PaoliSchatzman, &Options::with_step(h)).expect("a run");
        let judged = run.residuals;
        assert!(judged.complementarity < 1e-9 && judged.force_balance < 1e-9, "seed {seed}: {judged:?}");
    }
    println!("{shared} of {steps} steps");
    assert!(shared > 10, "{shared} of {steps} steps: a test of nothing");
}

#[test]
fn walls_at_one_place_share_their_force_alike_in_every_solver() {
    let scene = Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("first", 5e-3).with_restitution(0.5))
        .with_wall(Wall::upper("second", 5e-3).with_restitution(0.5))
        .with_wall(Wall::lower("floor", -5e-3).with_restitution(0.5))
        .with_load(signorini::Load::harmonic(3.0, 5.0, 0.0))
        .with_duration(1.0);
    for scheme in [common::MOREAU_JEAN, Scheme::PaoliSchatzman, Scheme::ImplicitEuler] {
        for backend in [Backend::Clamp, Backend::Condensed, Backend::Clarabel] {
            let (method, options) = (Method { scheme, backend }, Options::with_step(1e-3));
            let run = run(&scene, &method, &options).expect("a run");
            let [first, second] = ["first", "second"].map(|wall| run.trajectory.impulse(wall).expect("a wall"));
            assert!(first < 0.0, "{scheme}, {backend:?}: nothing was met");
            // Clarabel's answers are polished to rounding, but which of two equal walls it leaves
            // how much is its tolerance's.
            let tolerance = if backend == Backend::Clarabel { 1e-6 } else { 1e-12 };
            assert!(
                (first - second).abs() <= tolerance * first.abs(),
                "{scheme}, {backend:?}: {first} and {second} N s"
            );
        }
    }
}
