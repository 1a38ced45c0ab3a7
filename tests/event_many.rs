//! The exact scheme for several degrees of freedom: against that for one, closed forms, and refined runs.

mod common;

use signorini::linear::Symmetric;
use signorini::{Load, Options, Row, Run, Scene, Scheme, Structure, System, TimeOptions, Wall, run};

fn as_matrices(mut scene: Scene) -> Scene {
    let System::Oscillator(o) = scene.system else { return scene };
    let one = |x: f64| Symmetric::diagonal(&[x]);
    let structure = Structure { mass: one(o.mass), damping: one(o.damping), stiffness: one(o.stiffness) };
    scene.system = System::Structure(Box::new(structure));
    scene
}

fn options(scene: &Scene, rows: f64) -> Options {
    let mut options = Options::with_step(0.5 * scene.duration);
    options.time = TimeOptions { sample: Some(scene.duration / rows), ..options.time };
    options
}

fn exact(scene: &Scene, rows: f64) -> Run {
    run(scene, &Scheme::Event, &options(scene, rows)).unwrap()
}

fn assert_judged(run: &Run) {
    let r = &run.residuals;
    assert!(r.energy.residual < 1e-12, "{:?}", r.energy);
    assert!(r.complementarity < 1e-10, "{}", r.complementarity);
    assert!(r.force_balance < 1e-9, "{}", r.force_balance);
    assert!(r.tension_n <= 1e-12 * r.force_scale_n, "{}", r.tension_n);
}

/// One run by each exact scheme, and the largest difference of displacement over half the gap.
fn difference(scene: Scene) -> (f64, Run, Run) {
    let (a, b) = (exact(&scene, 500.0), exact(&as_matrices(scene), 500.0));
    let error = common::error(a.trajectory.displacement(), b.trajectory.displacement());
    (error, a, b)
}

#[test]
fn one_degree_of_freedom_as_matrices_is_the_oscillator() {
    let mut weak = common::elastic(0.0, 1.0);
    weak.duration = 1.0;
    for (name, scene) in [
        ("e = 1", common::source(1.0, 1.0).with_duration(2.0)),
        ("e = 0.8", common::source(0.8, 0.8).with_duration(2.0)),
        ("e = 0", common::source(0.0, 0.0).with_duration(2.0)),
        ("e = 0.5 above, 0 below, a blow", common::source(0.5, 0.0).with_load(Load::impulse(0.05, 0.3)).with_duration(2.0)),
        ("elastic above", weak),
        ("damped elastic above", common::elastic(5.0, 0.5).with_duration(1.0)),
        ("damped elastic on both sides", common::all_elastic(20.0).with_duration(1.0)),
    ] {
        let (error, a, b) = difference(scene);
        println!("{name}: {error:e} {:?}", b.counters);
        // Rounding, and what e = 1 makes of it in 2 s (a factor of 60).
        assert!(error < 1e-11, "{name}: {error:e}");
        assert_eq!(a.trajectory.contacts().len(), b.trajectory.contacts().len(), "{name}");
        for (x, y) in a.trajectory.contacts().iter().zip(b.trajectory.contacts()) {
            assert_eq!(x.wall, y.wall, "{name}");
            assert!((x.start - y.start).abs() < 1e-11, "{name}: {x:?} {y:?}");
            assert!((x.impulse - y.impulse).abs() < 1e-9, "{name}: {x:?} {y:?}");
            let peak = |c: &signorini::Contact| c.peak_force.unwrap_or(0.0);
            assert!((peak(x) - peak(y)).abs() < 1e-7, "{name}: {x:?} {y:?}");
        }
        assert_judged(&b);
    }
}

#[test]
fn a_ball_comes_to_rest_when_its_rebounds_accumulate() {
    let ball = as_matrices(common::ball(1.0, 0.9)).with_duration(10.0);
    let run = exact(&ball, 1000.0);
    // t∞ = √(2h/g)(1+e)/(1−e); the tail that is closed is 1e-12 of the height.
    let rest = run.trajectory.contacts().last().unwrap();
    assert!((rest.start - 8.578_949).abs() < 1e-4, "{rest:?}");
    assert_eq!(rest.end, None);
    let steady = run.trajectory.contact_force("floor").unwrap();
    assert!((steady[990] - 9.81).abs() < 1e-12);
    assert_judged(&run);
}
