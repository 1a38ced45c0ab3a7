//! The loop: a stepper, the judge and the recorder, from the start of a scene to its end.
//!
//! # Files
//!
//! One run: the loop stepper → judge (`judging.rs`) and recorder (`recording.rs`), side by side
//! (`observers.rs`), each of which `options.rs` can switch off; `finished.rs` is what a run leaves;
//! `divergence.rs` states when a run has diverged, which ends it; `notes.rs` and `notes/` add
//! the notes that a reader must know, and `cautioned.rs` counts the runs of several with notes
//! that limit their use.

mod cautioned;
mod divergence;
mod finished;
mod judging;
pub(crate) mod notes;
mod observers;
mod options;
mod recording;

pub use cautioned::{Caution, Cautioned, NotedRuns};
pub(crate) use divergence::Divergence;
pub use finished::Run;
pub use judging::{Judged, Judging, Unjudged};
pub use notes::foreseen;
pub use options::Options;
pub use recording::{Recorded, Recording, Unrecorded};

use crate::error::Result;
use crate::residual::Finding;
use crate::scene::{Checked, Scene};
use crate::scheme::{Method, Stepper};
use observers::Observers;
use std::time::Instant;

/// Runs `scene` by `method`, a [`Scheme`](crate::Scheme) or a [`Method`], to its end.
///
/// ```
/// use signorini::{Load, Options, Scene, Scheme, Wall, run};
///
/// let scene = Scene::oscillator(1.0, 0.2, 100.0)
///     .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
///     .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
///     .with_load(Load::harmonic(3.0, 5.0, 0.0));
///
/// let stepped = run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(1e-5))?.unrefuted()?;
/// let exact = run(&scene, &Scheme::Event, &Options::with_step(1e-5))?.unrefuted()?;
/// // What the upper wall gave in a second, N s.
/// let (a, b) = (stepped.trajectory.impulse("upper")?, exact.trajectory.impulse("upper")?);
/// assert!((a / b - 1.0).abs() < 1e-3);
/// // Both were judged, step by step, by code that knows no scheme.
/// assert!(stepped.residuals.complementarity < 1e-12 && exact.residuals.energy.residual < 1e-12);
/// for note in &stepped.notes {
///     println!("{note}"); // what a reader of the results must know
/// }
/// # Ok::<(), signorini::Error>(())
/// ```
///
/// A run that diverges ends there: one that is more than 1e6 times faster than the energy of its
/// start and the work of its loads allow, or whose state is no longer finite. It keeps its rows and
/// gets the finding [`Refuted::Diverged`](crate::Refuted::Diverged): that too is `Ok`, unless
/// [`Run::unrefuted`] is asked for. [`Run::cautions`] are no findings, and to be looked at as well.
///
/// # Errors
/// [`crate::Error::Invalid`] for an invalid request, and what [`Stepper::step`] reports, apart from
/// a state that is not finite; [`crate::Error::Diverged`] for a run that diverges and is not
/// judged.
pub fn run<J: Judging, R: Recording>(
    scene: &Scene,
    method: &(impl Copy + Into<Method>),
    options: &Options<J, R>,
) -> Result<Run<J, R>> {
    run_with_progress(scene, method, options, &mut |_| {})
}

/// As [`run`], and calls `progress` with the time reached (s) now and then.
///
/// # Errors
/// As [`run`].
pub fn run_with_progress<J: Judging, R: Recording>(
    scene: &Scene,
    method: &(impl Copy + Into<Method>),
    options: &Options<J, R>,
    progress: &mut dyn FnMut(f64),
) -> Result<Run<J, R>> {
    let scene = &Checked::new(scene)?;
    let method: Method = (*method).into();
    let exact = method.scheme.is_exact();
    let grid = options.grid(scene, exact)?;
    let started = Instant::now();
    let mut stepper = Stepper::by(scene, method, grid.step)?;
    let start = stepper.state();
    let judge = J::begin(&stepper, grid.step, &start);
    let recorder = R::begin(&stepper, grid.rows, &start, &options.time);
    let mut observers = Observers::<J, R>::new(judge, recorder, &stepper);
    let mut divergence = Divergence::new(&stepper, grid.step, &start);
    let diverged = observers.follow_to_end(&mut stepper, &grid, &mut divergence, progress)?;
    let Observers { judge, recorder, .. } = observers;
    let from = options.time.statistics_from;
    // The statistics of a run that diverged refer to the time up to there.
    let until = diverged.as_ref().map_or(scene.duration, |diverged| diverged.time);
    // A penalty has springs in place of rigid walls.
    let seen = Scene { duration: until, ..stepper.scene().clone() };
    let (trajectory, statistics) = R::finish(recorder, &stepper.open_contacts(), &seen, scene.wall_masses(), from);
    // The rows of a run that diverged end before it does, and do not hold all of its impulses.
    let recorded = R::trajectory(&trajectory).filter(|_| diverged.is_none());
    let (residuals, mut findings) = J::verdict(judge, recorded, scene);
    if let Some(part) = R::not_finite(&statistics).filter(|_| diverged.is_none()) {
        J::find(&mut findings, Finding::not_finite(&part, scene.duration));
    }
    if let Some(diverged) = diverged {
        if !J::JUDGED {
            return Err(diverged.error(stepper.counters().steps));
        }
        J::find(&mut findings, diverged.finding());
    }
    let mut run = Run {
        scheme: method.scheme,
        backend: stepper.backend(),
        grid,
        state: stepper.state(),
        statistics,
        trajectory,
        residuals,
        findings,
        counters: stepper.counters(),
        seconds: started.elapsed().as_secs_f64(),
        handed: stepper.handed().to_vec(),
        notes: Vec::new(),
        cautions: Vec::new(),
        unsettled: None,
    };
    let asked = options.time.force_averaging;
    run.cautions = notes::cautions(scene, &run, [asked, stepper.force_averaging(asked)]);
    run.unsettled = R::statistics(&run.statistics).and_then(|statistics| notes::unsettled(scene, statistics));
    let limits = run.cautions.iter().chain(&run.unsettled).cloned();
    run.notes = notes::remarks(scene, &run).into_iter().chain(limits).collect();
    Ok(run)
}

#[cfg(test)]
mod tests {
    use super::{Options, run};
    use crate::linear::Symmetric;
    use crate::residual::{Judge, Refuted};
    use crate::scene::{Load, PlaneRows, Row, Scene, Structure, Wall};
    use crate::scheme::{Scheme, Stepper};
    use crate::statistics::WearTally;
    use crate::step::QuietSteps;
    use crate::time::TimeOptions;

    #[test]
    fn the_wear_of_a_run_is_what_its_tally_finds_by_itself() {
        let same = |x: f64| Symmetric::diagonal(&[x; 2]);
        let structure = Structure { mass: same(1.0), damping: same(0.2), stiffness: same(100.0) };
        let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
        let wall = Wall::round("hole", at.clone(), 5e-3).with_restitution(0.5).with_friction(0.2);
        let pulled = |dof, frequency| Load { at: Row::dof(dof), ..Load::harmonic(3.0, frequency, 0.0) };
        let scene = Scene::structure(structure)
            .with_support("hole", at, [0.0, 0.0], vec![wall])
            .with_load(pulled(0, 5.0))
            .with_load(pulled(1, 3.7))
            .with_duration(2.0);
        // The window begins within a step, and rows are far apart.
        let (step, from) = (1e-3, 0.3004);
        let times = TimeOptions { sample: Some(0.1), statistics_from: from, ..TimeOptions::with_step(step) };
        for scheme in [Scheme::MoreauJean { theta: 0.5 }, Scheme::Located] {
            let made = run(&scene, &scheme, &Options::new(times)).expect("a run");
            let mut stepper = Stepper::new(&scene, &scheme, step).expect("a scene");
            let mut alone = WearTally::new(&scene, from, times.sectors);
            while stepper.time() < 2.0 - 0.5 * step {
                alone.observe(&stepper.step().expect("a step"));
            }
            assert!(made.statistics.wear[0].work_rate_w > 0.0);
            assert_eq!(made.statistics.wear, alone.statistics(), "{scheme}");
        }
    }

    /// The first findings of 300 steps without contact, seen together and one by one, with number
    /// `wrong` changed by `lie`: of end, displacement, velocity and the velocities in the balance.
    fn accused(wrong: usize, lie: impl Fn(&mut [f64; 5])) -> [Option<(Refuted, f64)>; 2] {
        let scene = Scene::oscillator(1.0, 0.2, 100.0)
            .with_wall(Wall::upper("far", 1.0))
            .with_load(Load::harmonic(3.0, 5.0, 0.0))
            .with_initial(&[1e-3], &[0.1]);
        let h = 1e-3;
        let mut stepper = Stepper::new(&scene, &Scheme::MoreauJean { theta: 0.5 }, h).expect("a scene");
        let judge = || Judge::new(&scene, stepper.contract(), h, &[1e-3], &[0.1]);
        let (mut together, mut alone, mut quiet) = (judge(), judge(), QuietSteps::new(1));
        for k in 0..300 {
            let step = stepper.step().expect("a step");
            let mut told = [step.end, step.q[0], step.v[0], step.velocity_before[0], step.velocity_after[0]];
            if k == wrong {
                lie(&mut told);
            }
            let [end, q, v, before, after] = told;
            assert!(quiet.begin(step.index, step.start) > 0);
            quiet.add(end, (&[q], &[v]), (&[before], &[after]));
            if quiet.is_full() || k == 299 {
                together.observe_quiet(&quiet);
                (0..quiet.len()).for_each(|k| alone.observe(&quiet.step(k)));
                quiet.clear();
            }
        }
        assert!(together.batches_quiet_steps());
        [together, alone].map(|judge| judge.findings().first().map(|found| (found.refuted, found.time_s)))
    }

    #[test]
    fn a_wrong_step_among_many_is_accused_with_its_time() {
        assert_eq!(accused(301, |_| {}), [None, None]);
        for wrong in [1, 77, 128, 200, 299] {
            let time = (wrong + 1) as f64 * 1e-3;
            // A velocity that no force explains, and a displacement that no velocity does.
            let [together, alone] = accused(wrong, |told| told[4] += 1e-3);
            assert_eq!((together, alone.map(|found| found.1)), (alone, Some(time)));
            let [together, alone] = accused(wrong, |told| told[1] += 1e-6);
            assert_eq!(together, alone);
            assert!(alone.is_some_and(|found| (found.1 - time).abs() < 1.5e-3), "{alone:?} near {time}");
            // A displacement behind the wall, which did not push.
            let [together, alone] = accused(wrong, |told| told[1] = 2.0);
            assert_eq!(together, alone);
            assert!(alone.is_some());
        }
    }
}
