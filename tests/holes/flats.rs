//! Friction between flats: no scene is refuted, and wedged bodies.

use crate::draws::cases;
use crate::rubbing::{MOREAU_JEAN, body, isotropic, load, with_flats};
use signorini::{Load, Options, Row, Scene, Stepper, heading, run};

/// Some roundings of a speed or an impulse of 0.1 m/s or N s.
const ROUNDING: f64 = 1e-16;

/// A body of 1 kg on springs among `sides` flats, driven in this direction (degrees).
fn driven(sides: usize, direction: f64, friction: f64) -> Scene {
    let flats: Vec<(f64, f64)> = (0..sides).map(|k| (360.0 * k as f64 / sides as f64, 1e-3)).collect();
    let [y, z] = heading(direction);
    with_flats(isotropic(1.0, 0.2, 100.0), "flats", body(), &flats, 0.5, friction)
        .with_load(load(Load::harmonic(20.0, 3.0, 0.0), Row::new(vec![(0, y), (1, z)])))
}

#[test]
fn no_scene_with_friction_on_flats_is_refuted() {
    // All 180 with SIGNORINI_CASES=180; 119 of them were refuted where sweeps alone solved them,
    // among them number 61.
    let (share, mut counted) = (cases(30_usize).clamp(1, 180), [0; 2]);
    for number in 0..180 {
        if number * 7 % 180 >= share && number != 61 {
            continue;
        }
        let (sides, way, friction) = ([3, 4, 6, 8][number % 4], number / 4 % 15, [0.1, 0.3, 0.8][number / 60]);
        let scene = driven(sides, 20.0 + 24.0 * way as f64, friction).with_duration(2.0);
        let run = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-3).unrecorded()).unwrap();
        assert_eq!(run.findings, [], "{sides} flats, way {way}, μ = {friction}");
        assert_eq!(run.counters.qp_unsettled, 0, "{sides} flats, way {way}, μ = {friction}");
        assert!(run.counters.qp_solves > 300, "{:?}", run.counters);
        counted = [counted[0] + run.counters.wedged_steps, counted[1] + run.counters.qp_solves];
    }
    // Bodies are wedged at few of their impacts.
    assert!(counted[0] * 100 < counted[1], "{counted:?}");
}

#[test]
fn a_wedged_body_gives_up_its_rebound_is_counted_and_noted() {
    // Symmetrically into a corner of a right angle: with μ = 2 no impulses give the rebound.
    let into = |friction: f64| {
        let flats = [(0.0, 1e-3), (90.0, 1e-3)];
        with_flats(isotropic(1.0, 0.0, 0.0), "corner", body(), &flats, 0.5, friction)
            .with_initial(&[0.0, 0.0], &[0.1, 0.1])
            .with_duration(0.02)
    };
    let noted = |friction: f64| {
        let run = run(&into(friction), &MOREAU_JEAN, &Options::with_step(1e-3)).unwrap();
        assert_eq!((run.findings, run.counters.qp_unsettled), (vec![], 0), "μ = {friction}");
        (run.counters.wedged_steps, run.state.v, run.notes.iter().any(|note| note.contains("wedged")))
    };
    let (count, v, said) = noted(2.0);
    assert!(count > 0 && said && v.iter().all(|v| v.abs() < ROUNDING), "{count} {said} {v:?}");
    let (count, v, said) = noted(0.3);
    assert!(count == 0 && !said && v[0] < -0.04 && v[1] < -0.04, "{count} {v:?}");
    // The step names both flats, and its impulse is that of a body that stops: −m v.
    let mut stepper = Stepper::new(&into(2.0), &MOREAU_JEAN, 1e-3).unwrap();
    loop {
        let step = stepper.step().unwrap();
        if step.impulse.iter().any(|p| *p != 0.0) {
            let mut wedged = step.wedged.to_vec();
            wedged.sort_unstable();
            let push = [step.impulse[0] - step.friction[1], step.impulse[1] + step.friction[0]];
            assert!(wedged == [0, 1] && push.iter().all(|p| (p + 0.1).abs() < ROUNDING), "{step:?}");
            break;
        }
    }
}
