//! A run that is far faster than the energy of its start and the work of its loads allow ends
//! there; motions that grow or travel far by the laws of mechanics do not.

use signorini::linear::Symmetric;
use signorini::{Error, Integrator, Load, Options, PenaltyLaw, Refuted, Scene, Scheme, Structure, Table, Wall, run};

const MOREAU_JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// 1 kg on 100 N/m between walls 5 mm away, under 3 N at 5 Hz.
fn driven(end: f64) -> Scene {
    Scene::oscillator(1.0, 0.0, 100.0)
        .with_wall(Wall::upper("upper", 5e-3))
        .with_wall(Wall::lower("lower", -5e-3))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
        .with_duration(end)
}

/// Springs of 1e7 N/m in place of the walls, whose stability limit is 2/√(1e7 + 100) s.
const EXPLICIT: Scheme = Scheme::Penalty {
    law: PenaltyLaw::Linear { stiffness: 1e7, damping: 0.0 },
    integrator: Integrator::CentralDifference,
};

#[test]
fn a_run_beyond_its_stability_limit_ends_where_it_diverged_and_keeps_its_rows() {
    let mut seen = Vec::new();
    for end in [0.5, 0.7, 2.0, 10.0] {
        let run = run(&driven(end), &EXPLICIT, &Options::with_step(1e-2)).expect("a run with its rows");
        let first = run.findings.first().expect("a finding");
        assert_eq!(first.refuted, Refuted::Diverged, "{first}");
        assert!(first.residual > 1e6 && first.tolerance == 1e6, "{first}");
        // The stability limit is 6.32e-4 s.
        assert!(first.to_string().contains("6.3e-4 s") && first.to_string().contains("1.0e-2 s"), "{first}");
        let (time, q) = (run.trajectory.time(), run.trajectory.displacement());
        assert!((time[time.len() - 1] - first.time_s).abs() < 1e-9 && first.time_s < end, "{first}");
        assert!(q.iter().all(|q| q.is_finite()) && q.len() == time.len());
        assert!(run.notes.iter().any(|note| note.contains("do not trust this run")), "{:?}", run.notes);
        // Rates and shares refer to the time that was run.
        assert_eq!(run.statistics.to_s, first.time_s);
        assert!(matches!(run.refuted(), Some(Error::Refuted { .. })));
        seen.push(first.time_s);
    }
    // It diverges in some ten steps, however long it was to run.
    assert!(seen.iter().all(|time| *time < 0.2), "{seen:?}");
    // Below its limit it does not.
    let stable = run(&driven(2.0), &EXPLICIT, &Options::with_step(3e-4)).expect("a run");
    assert_eq!(stable.findings, []);
}

#[test]
fn the_steps_before_an_overflow_are_counted() {
    // Two loads that are finite by themselves; their sum is not after 1.9 s, in the eighth step.
    let ramp = Table::new(vec![0.0, 4.0], vec![0.0, 1.7e308]).expect("a table");
    let scene = Scene::oscillator(1e10, 0.0, 1.0)
        .with_load(Load::constant(1e308))
        .with_load(Load::table(ramp))
        .with_duration(4.0);
    for options in [Options::with_step(0.25), Options::with_step(0.25).with_sample(1.0)] {
        let run = run(&scene, &MOREAU_JEAN, &options).expect("a run with its rows");
        assert_eq!(run.counters.steps, 7);
        let Err(Error::Diverged { time, step, .. }) = run.unrefuted() else { panic!("it has diverged") };
        assert_eq!((time, step), (2.0, 7));
    }
    let failed = run(&scene, &MOREAU_JEAN, &Options::with_step(0.25).unjudged()).expect_err("diverged");
    assert!(matches!(failed, Error::Diverged { step: 7, .. }), "{failed}");
}

#[test]
fn a_run_without_a_judge_that_diverges_is_an_error() {
    let failed = run(&driven(2.0), &EXPLICIT, &Options::with_step(1e-2).unjudged()).expect_err("diverged");
    assert!(matches!(failed, Error::Diverged { ratio, .. } if ratio > 1e6), "{failed}");
    assert!(!failed.is_request() && failed.to_string().contains("6.3e-4 s"), "{failed}");
}

#[test]
fn a_state_that_overflows_in_one_step_is_diverged_too() {
    // h²k/m = 1e300: the first step inside the wall overflows or passes any scale at once.
    let law = PenaltyLaw::Linear { stiffness: 1e304, damping: 0.0 };
    let scheme = Scheme::Penalty { law, integrator: Integrator::CentralDifference };
    let run = run(&driven(1.0), &scheme, &Options::with_step(1e-2)).expect("the rows up to there");
    assert_eq!(run.findings.first().map(|found| found.refuted), Some(Refuted::Diverged));
    assert!(run.trajectory.displacement().iter().all(|q| q.is_finite()));
}

#[test]
fn motions_that_travel_far_or_grow_by_the_laws_of_mechanics_have_not_diverged() {
    let free = || Scene::oscillator(1.0, 0.0, 0.0).with_wall(Wall::lower("floor", -1e-6));
    let negative = |c: f64| {
        let diagonal = |x: [f64; 2]| Symmetric::diagonal(&x);
        let structure =
            Structure { mass: diagonal([1.0; 2]), damping: diagonal([c, 0.0]), stiffness: diagonal([100.0, 300.0]) };
        Scene::structure(structure).with_initial(&[1e-3, 0.0], &[0.0; 2])
    };
    let spike = Table::new(vec![0.0, 1.0, 1.1, 1.2], vec![0.0, 0.0, 1e8, 0.0]).expect("a table");
    for (what, scene) in [
        // 1e12 m/s after 1e4 s, past a gap of 1 μm.
        ("a free body under a constant force", free().with_load(Load::constant(1e8)).with_duration(1e4)),
        ("a blow", free().with_load(Load::impulse(1e9, 0.5))),
        ("a spike of a table", free().with_load(Load::table(spike)).with_duration(100.0)),
        ("a function", free().with_load(Load::function(|t| 1e9 * (1.0 + t))).with_duration(100.0)),
        ("a fast start", free().with_initial(&[0.0], &[1e9])),
        ("a strained spring", Scene::oscillator(1e-9, 0.0, 1e9).with_initial(&[1.0], &[0.0]).with_duration(1e-7)),
        // e^(0.5 · 60) = 1e13 times the start.
        ("a mode that a flow drives", negative(-1.0).with_duration(60.0)),
        (
            "a resonance without damping",
            Scene::oscillator(1.0, 0.0, 4.0)
                .with_wall(Wall::upper("far", 1e9))
                .with_load(Load::harmonic(1e3, 1.0 / std::f64::consts::PI, 0.0))
                .with_duration(1e3),
        ),
    ] {
        let run = run(&scene, &MOREAU_JEAN, &Options::with_step(scene.duration * 1e-3)).expect(what);
        assert!(run.findings.iter().all(|found| found.refuted != Refuted::Diverged), "{what}: {:?}", run.findings);
        assert_eq!(run.trajectory.time().last(), Some(&scene.duration), "{what}");
    }
}
