//! The rows of a recorded motion are the states of the steps that end there.

use crate::common::{MOREAU_JEAN, schemes_of_whole_steps, source};
use signorini::{Options, Path, Recorder, Scene, Scheme, Step, Stepper, run};

#[test]
fn each_row_is_the_state_after_the_steps_before_it_whatever_their_number() {
    // Durations and spacings that are no binary numbers: the end of a step and the time of a row
    // differ by rounding, either way.
    for scheme in schemes_of_whole_steps().into_iter().filter(|scheme| *scheme != Scheme::Newmark) {
        for per in [1, 2, 3, 7] {
            for (spacing, rows) in [(0.7e-3, 100), (1.1e-3, 64), (1.0 / 3000.0, 90), (1e-3, 93)] {
                let duration = spacing * f64::from(rows);
                let scene = source(0.8, 0.4).with_duration(duration).with_initial(&[0.0], &[0.5]);
                let h = spacing / f64::from(per);
                let run = run(&scene, &scheme, &Options::with_step(h).with_sample(spacing)).expect("a run");
                let (time, q) = (run.trajectory.time(), run.trajectory.displacement());
                let what = format!("{scheme}, {rows} rows of {spacing} s, {per} steps each");
                assert_eq!((time.len(), time[0], time[time.len() - 1]), (rows as usize + 1, 0.0, duration), "{what}");
                let mut stepper = Stepper::new(&scene, &scheme, duration / f64::from(rows * per)).expect("sound");
                let mut pushed = 0.0;
                for (row, &shown) in q.iter().enumerate().skip(1) {
                    let mut impulse = 0.0;
                    for _ in 0..per {
                        impulse += stepper.step().expect("a step").impulse[0];
                    }
                    // The run may have taken a step that differs in its last place.
                    assert!((shown - stepper.state().q[0]).abs() < 1e-9, "{what}, row {row}");
                    let found = run.trajectory.contact_impulses()[0][row];
                    let force = run.trajectory.contact_force("upper").expect("a wall")[row];
                    assert_eq!(run.trajectory.contact_forces()[0][row], force);
                    assert!((force * spacing - found).abs() <= 1e-14 * found.abs(), "{what}: {force} N");
                    assert!((found - impulse).abs() < 1e-7, "{what}, row {row}: {found} N s, not {impulse}");
                    pushed += impulse.abs();
                }
                assert!(pushed > 0.1, "{what}: {pushed} N s, a test of nothing");
            }
        }
    }
}

/// A step that fits no scene of one mass and two walls, whichever of its slices does not.
fn misfits<'a>(good: &Step<'a>, long: &'a [f64]) -> Vec<Step<'a>> {
    let with = |change: fn(&mut Step<'a>, &'a [f64])| {
        let mut step = *good;
        change(&mut step, long);
        step
    };
    vec![
        with(|step, long| step.impulse = long),
        with(|step, long| step.jump = long),
        with(|step, long| step.force = long),
        with(|step, long| step.q = long),
        with(|step, long| step.v = long),
        with(|step, long| step.velocity_before = long),
    ]
}

#[test]
fn a_recorder_passes_over_a_step_of_another_scene() {
    let scene: Scene = source(0.8, 0.4).with_duration(0.1);
    let mut stepper = Stepper::new(&scene, &MOREAU_JEAN, 1e-2).expect("a sound scene");
    let start = stepper.state();
    let record = |steps: &[Step<'_>]| {
        let mut recorder = Recorder::new(&scene, 10, &start.q, &start.v);
        steps.iter().for_each(|step| recorder.observe(step));
        recorder.finish(&[])
    };
    let empty = record(&[]);
    let good = stepper.step().expect("a step");
    assert!(matches!(good.path, Path::Grid));
    assert_eq!(record(&[good]).time().len(), 2);
    for long in [&[1.0, 2.0, 3.0][..], &[]] {
        for step in misfits(&good, long) {
            assert_eq!(record(&[step]), empty, "{step:?}");
        }
    }
}
