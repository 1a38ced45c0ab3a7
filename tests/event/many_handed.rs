//! Stretches in which impacts follow one another faster than the exact scheme resolves.

use crate::common;
use signorini::linear::Symmetric;
use signorini::{Load, Options, Scene, Scheme, Structure, TimeOptions, run};

/// A ball with e = 1 that only drag brings to rest: its impacts never end, and no flight is the
/// tail of a geometric series.
fn ball_in_oil(drag: f64) -> Scene {
    let mut scene = common::ball(1e-3, 1.0).with_duration(8.0);
    let one = |x: f64| Symmetric::diagonal(&[x]);
    scene.system = Structure { mass: one(1.0), damping: one(drag), stiffness: one(0.0) }.into();
    scene
}

#[test]
fn impacts_without_end_are_handed_to_moreau_jean_and_the_run_says_so() {
    let scene = ball_in_oil(30.0);
    let mut options = Options::with_step(4.0);
    options.time = TimeOptions { sample: Some(0.01), ..options.time };
    let run = run(&scene, &Scheme::Event, &options).unwrap();
    println!("{:?} {:?} {:?}", run.counters, run.handed, run.notes);
    assert!(run.counters.handed_steps > 0);
    assert_eq!(run.counters.handed_steps % 200, 0);
    assert!(run.notes.iter().any(|note| note.contains("moreau-jean stepped through it")), "{:?}", run.notes);
    let first = run.handed[0];
    // Until then 5000 impacts have not fallen into one stretch, a thousandth of the run.
    assert!(first.from > 0.2 && first.from < 6.0, "{first:?}");
    // Momentum: from the first fall to the end the floor has carried the weight minus the impulse
    // of the drag: m v is 0 at both ends, and that impulse is c times the fall.
    let impulse = run.trajectory.impulse("floor").unwrap();
    let expected = 9.81 * 8.0 - 30.0 * 1e-3;
    // The ball ends within a bounce of a step, g h per step of 4e-5 s.
    assert!((impulse - expected).abs() < 2e-3, "{impulse} {expected}");
    // θ = ½ conserves energy at e = 1; the loss is where the exact motion is put back onto the
    // floor.
    assert!(run.residuals.energy.residual < 1e-9, "{:?}", run.residuals.energy);
    assert!(run.residuals.force_balance < 1e-9, "{}", run.residuals.force_balance);
    let displacement = run.trajectory.displacement();
    assert!(displacement[700..].iter().all(|q| q.abs() < 1e-6), "{:?}", displacement.last());
    assert_eq!(displacement.len(), 801);
}

#[test]
fn a_stretch_handed_over_is_under_the_load_of_its_own_time() {
    // 2 sin(2π·0.9 t + 0.7) N on the ball, through which the floor keeps its sign.
    let scene = ball_in_oil(30.0).with_load(Load::harmonic(2.0, 0.9, 0.7)).with_duration(2.5);
    let mut options = Options::with_step(4.0);
    options.time = TimeOptions { sample: Some(0.01), ..options.time };
    let run = run(&scene, &Scheme::Event, &options).expect("a run");
    assert!(run.counters.handed_steps > 0, "{:?}", run.counters);
    assert_eq!(run.findings, []);
    // The momentum of every step with the load of that step; a phase off by a rounding is not seen.
    assert!(run.residuals.force_balance < 1e-9, "{}", run.residuals.force_balance);
    // The floor gives the weight less the load, whose impulse is its integral, and the drag's.
    let omega = std::f64::consts::TAU * 0.9;
    let given = 2.0 / omega * (0.7_f64.cos() - (omega * 2.5 + 0.7).cos());
    let (impulse, expected) = (run.trajectory.impulse("floor").expect("a wall"), 9.81 * 2.5 - given - 30.0 * 1e-3);
    // The ball ends within a bounce of a step, g h per step of 1.25e-5 s, and 1e-4 m of drag.
    assert!((impulse - expected).abs() < 5e-3, "{impulse} {expected}");
}
