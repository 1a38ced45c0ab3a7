//! The impulses in the table carry the momentum of the run, in every scheme: judged from what is recorded.

mod common;
mod random_structures;

use common::{MOREAU_JEAN, schemes, source};
use random_structures::{at, chain, on};
use signorini::residual::momentum;
use signorini::{Load, Options, Probe, Row, Scene, Scheme, Wall, run};

/// 35 N press 1 kg on a stop at 1 mm against 1e4 N/m: it rests under 25 N for ten seconds.
fn pressed() -> Scene {
    Scene::oscillator(1.0, 20.0, 1e4)
        .with_wall(Wall::upper("stop", 1e-3).with_restitution(0.3))
        .with_load(Load::constant(35.0))
        .with_duration(10.0)
}

/// Three masses between stops, one of them pressed on its own, with blows in the middle of steps.
fn masses() -> Scene {
    let mut scene = chain(3, 150.0, 4e-3).with_duration(2.0);
    for i in 0..3 {
        scene = scene.with_wall(at(Wall::upper(&format!("u{i}"), 3e-3).with_restitution(0.5), Row::dof(i)));
        scene = scene.with_wall(at(Wall::lower(&format!("l{i}"), -4e-3).with_restitution(0.5), Row::dof(i)));
    }
    scene.probes = (0..3).map(|i| Probe { name: format!("mass-{i}"), at: Row::dof(i) }).collect();
    scene
        .with_load(on(Load::harmonic(3.0, 3.0, 0.0), 0))
        .with_load(on(Load::constant(2.0), 2))
        .with_load(on(Load::impulse(0.02, 0.51237), 1))
}

#[test]
fn the_recorded_impulses_close_the_momentum_balance_of_any_run() {
    for (name, scene) in [("pressed", pressed()), ("source", source(0.8, 0.8).with_duration(5.0)), ("masses", masses())]
    {
        for scheme in schemes().into_iter().chain([Scheme::GeneralizedAlpha { rho: 0.0 }, Scheme::Event]) {
            // Newmark gains energy without end.
            if scheme == Scheme::Newmark && name != "pressed" {
                continue;
            }
            for h in [2e-3, 2e-4] {
                let mut options = Options::with_step(h);
                options.time.sample = Some(h);
                let run = run(&scene, &scheme, &options).expect("a run");
                let seen = momentum(&scene, &run.trajectory).expect("a probe on every mass");
                // The rules' weights differ from the trapezoid's at the ends of the run, by one step at each; and each contact may shift
                // the place, whose velocity the damper feels, by a step: c h v of an impact of m v.
                let impacts = run.trajectory.contacts().len() as f64;
                let damper = if name == "pressed" { 20.0 * 1e-3 } else { 1.2 * 1e-2 };
                let allowed = 2.0 * seen.step_ns.min(h * 40.0) + impacts * damper * h * 10.0 + 1e-11;
                println!("{name} {scheme} h = {h}: {seen:?}, {impacts} contacts, allowed {allowed:e}");
                assert!(seen.residual_ns <= allowed, "{name}, {scheme}, h = {h}: {seen:?}, not {allowed:e}");
                assert!(allowed < 0.05 * seen.exchanged_ns, "{name}, {scheme}: a test of nothing, {seen:?}");
            }
        }
    }
}

#[test]
fn an_impulse_column_that_is_short_of_what_the_wall_gave_is_seen() {
    // Half of the wall's impulses are another wall's, which stands where nothing is met.
    let scene = pressed();
    let run = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-3)).expect("a run");
    let moved = Scene { walls: vec![at(Wall::upper("stop", 1e-3), Row::new(vec![(0, 0.5)]))], ..scene.clone() };
    let seen = momentum(&moved, &run.trajectory).expect("a probe");
    // Half of 25 N over ten seconds.
    assert!((seen.residual_ns - 125.0).abs() < 2.0, "{seen:?}");
    assert!(momentum(&scene, &run.trajectory).expect("a probe").residual_ns < 0.1);
}
