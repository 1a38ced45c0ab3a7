//! The options of a run besides the scene and the method: its times, and whether it is judged and
//! recorded.

use crate::error::Result;
use crate::finite::first_not_finite;
use crate::residual::{Finding, Judge, Residuals};
use crate::scene::{Scene, State};
use crate::scheme::Stepper;
use crate::statistics::{Forces, Statistics, WearTally};
use crate::step::{Contact, QuietSteps, Step};
use crate::time::{TimeGrid, TimeOptions};
use crate::trajectory::{Recorder, Trajectory};
use std::fmt::Debug;

/// The options of a run besides the scene and the method.
///
/// A run is judged and recorded by default. A study that needs only one of the two, or only the
/// state at the end, leaves the other out and saves its time. The result then has no such field
/// full of zeros: it is absent from the type of the [`Run`](crate::Run):
///
/// ```
/// use signorini::{Load, Options, Scene, Scheme, Wall, run};
///
/// let scene = Scene::oscillator(1.0, 0.2, 100.0)
///     .with_wall(Wall::upper("upper", 5e-3))
///     .with_load(Load::harmonic(3.0, 5.0, 0.0));
/// let options = Options::with_step(1e-4);
///
/// let full = run(&scene, &Scheme::Event, &options)?;
/// let judged = run(&scene, &Scheme::Event, &options.unrecorded())?; // residuals, no trajectory
/// // The state at the end, and counters.
/// let bare = run(&scene, &Scheme::Event, &options.unjudged().unrecorded())?;
/// assert_eq!(judged.residuals, full.residuals);
/// assert_eq!(bare.state, full.state);
/// # Ok::<(), signorini::Error>(())
/// ```
///
/// `bare.residuals` would not compile to a number:
///
/// ```compile_fail
/// # use signorini::{Options, Scene, Scheme, run};
/// let options = Options::with_step(1e-4).unjudged();
/// let bare = run(&Scene::oscillator(1.0, 0.0, 1.0), &Scheme::Event, &options).unwrap();
/// println!("{}", bare.residuals.complementarity);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<J: Judging = Judged, R: Recording = Recorded> {
    /// Step, rows and the window of the statistics. The exact scheme ignores the step.
    pub time: TimeOptions,
    /// Whether the run is judged.
    pub judge: J,
    /// Whether it is recorded.
    pub record: R,
}

impl Options {
    /// Steps of `step` seconds, all of them recorded, statistics from the start.
    #[must_use]
    pub fn with_step(step: f64) -> Self {
        Self::new(TimeOptions::with_step(step))
    }

    /// A judged and recorded run.
    #[must_use]
    pub fn new(time: TimeOptions) -> Self {
        Self { time, judge: Judged, record: Recorded }
    }
}

impl<J: Judging, R: Recording> Options<J, R> {
    /// These options with a row every `sample` seconds instead of every step.
    #[must_use]
    pub fn with_sample(mut self, sample: f64) -> Self {
        self.time.sample = Some(sample);
        self
    }

    /// These options without the judge: [`Run::residuals`](crate::Run::residuals) is then `()`.
    #[must_use]
    pub fn unjudged(self) -> Options<Unjudged, R> {
        let Self { time, record, .. } = self;
        Options { time, judge: Unjudged, record }
    }

    /// These options without rows, contacts and statistics:
    /// [`Run::trajectory`](crate::Run::trajectory) and [`Run::statistics`](crate::Run::statistics)
    /// are then `()`. (For contacts and statistics with two rows only, give the duration to
    /// [`Options::with_sample`].)
    #[must_use]
    pub fn unrecorded(self) -> Options<J, Unrecorded> {
        let Self { time, judge, .. } = self;
        Options { time, judge, record: Unrecorded }
    }

    /// The steps and rows of a run over `scene`.
    pub(super) fn grid(&self, scene: &Scene, exact: bool) -> Result<TimeGrid> {
        let mut time = self.time;
        if R::ROWLESS && time.sample.is_none() {
            // The maximum number of rows does not apply to a run without rows. A given spacing
            // stays: steps end on its rows.
            time.sample = Some(scene.duration);
        }
        if exact { TimeGrid::exact(scene.duration, &time) } else { TimeGrid::stepping(scene.duration, &time) }
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Judged {}
    impl Sealed for super::Unjudged {}
    impl Sealed for super::Recorded {}
    impl Sealed for super::Unrecorded {}
}

/// Whether a run is judged: [`Judged`] or [`Unjudged`], no others.
pub trait Judging: sealed::Sealed + Debug + Copy {
    /// The result of the judge: [`Residuals`], or nothing.
    type Verdict: Debug + Clone;
    /// The list of [`Finding`]s, or nothing.
    type Findings: Debug + Clone;
    #[doc(hidden)]
    type Judge;
    #[doc(hidden)]
    fn begin(stepper: &Stepper, step: f64, start: &State) -> Self::Judge;
    #[doc(hidden)]
    fn observe(judge: &mut Self::Judge, step: &Step<'_>);
    /// Whether processing many steps at once is faster; `None` if it does not look at steps.
    #[doc(hidden)]
    fn batches_quiet_steps(judge: &Self::Judge) -> Option<bool>;
    #[doc(hidden)]
    fn observe_quiet(judge: &mut Self::Judge, quiet: &QuietSteps);
    #[doc(hidden)]
    fn verdict(judge: Self::Judge, recorded: Option<&Trajectory>) -> (Self::Verdict, Self::Findings);
    #[doc(hidden)]
    fn residuals(verdict: &Self::Verdict) -> Option<&Residuals>;
    #[doc(hidden)]
    fn findings(findings: &Self::Findings) -> &[Finding];
    /// Puts a finding about the run as a whole first.
    #[doc(hidden)]
    fn find(findings: &mut Self::Findings, finding: Finding);
    #[doc(hidden)]
    const JUDGED: bool;
}

/// The run is judged step by step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Judged;

/// The run is not judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Unjudged;

impl Judging for Judged {
    type Verdict = Residuals;
    type Findings = Vec<Finding>;
    type Judge = Judge;

    fn begin(stepper: &Stepper, step: f64, start: &State) -> Judge {
        let scene = stepper.checked();
        Judge::over(scene.shared(), scene.wall_masses(), stepper.contract(), step, (&start.q, &start.v))
    }

    fn observe(judge: &mut Judge, step: &Step<'_>) {
        judge.observe(step);
    }

    fn batches_quiet_steps(judge: &Judge) -> Option<bool> {
        Some(judge.batches_quiet_steps())
    }

    fn observe_quiet(judge: &mut Judge, quiet: &QuietSteps) {
        judge.observe_quiet(quiet);
    }

    fn verdict(mut judge: Judge, recorded: Option<&Trajectory>) -> (Residuals, Vec<Finding>) {
        if let Some(trajectory) = recorded {
            let sums: Vec<f64> = trajectory.contact_impulses().iter().map(|column| column.iter().sum()).collect();
            judge.hear(&sums);
            let sum = |column: &Vec<f64>| column.iter().sum();
            let holes: Vec<[f64; 2]> = trajectory.hole_impulses().iter().map(|[y, z]| [sum(y), sum(z)]).collect();
            judge.hear_holes(&holes);
        }
        (judge.residuals(), judge.findings())
    }

    fn residuals(verdict: &Residuals) -> Option<&Residuals> {
        Some(verdict)
    }

    fn findings(findings: &Vec<Finding>) -> &[Finding] {
        findings
    }

    fn find(findings: &mut Vec<Finding>, finding: Finding) {
        findings.insert(0, finding);
    }

    const JUDGED: bool = true;
}

impl Judging for Unjudged {
    type Verdict = ();
    type Findings = ();
    type Judge = ();

    fn begin(_: &Stepper, _: f64, _: &State) {}

    fn observe((): &mut (), _: &Step<'_>) {}

    fn batches_quiet_steps((): &()) -> Option<bool> {
        None
    }

    fn observe_quiet((): &mut (), _: &QuietSteps) {}

    fn verdict((): (), _: Option<&Trajectory>) -> ((), ()) {
        ((), ())
    }

    fn residuals((): &()) -> Option<&Residuals> {
        None
    }

    fn findings((): &()) -> &[Finding] {
        &[]
    }

    fn find((): &mut (), _: Finding) {}

    const JUDGED: bool = false;
}

/// Whether a run is recorded: [`Recorded`] or [`Unrecorded`], no others.
pub trait Recording: sealed::Sealed + Debug + Copy {
    /// The recorded motion: a [`Trajectory`], or nothing.
    type Motion: Debug + Clone;
    /// The statistics of its contacts: [`Statistics`], or nothing.
    type Statistics: Debug + Clone;
    #[doc(hidden)]
    type Recorder;
    #[doc(hidden)]
    const ROWLESS: bool;
    #[doc(hidden)]
    fn begin(stepper: &Stepper, rows: u64, start: &State, time: &TimeOptions) -> Self::Recorder;
    #[doc(hidden)]
    fn observe(recorder: &mut Self::Recorder, step: &Step<'_>);
    #[doc(hidden)]
    fn observe_quiet(recorder: &mut Self::Recorder, quiet: &QuietSteps);
    #[doc(hidden)]
    fn finish(
        recorder: Self::Recorder,
        open: &[Contact],
        scene: (&Scene, &[f64]),
        statistics_from: f64,
    ) -> (Self::Motion, Self::Statistics);
    #[doc(hidden)]
    fn trajectory(motion: &Self::Motion) -> Option<&Trajectory>;
    /// The place of a statistic that is not finite.
    #[doc(hidden)]
    fn not_finite(statistics: &Self::Statistics) -> Option<String>;
}

/// Rows, contacts and their statistics are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Recorded;

/// Only the state at the end is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Unrecorded;

impl Recording for Recorded {
    type Motion = Trajectory;
    type Statistics = Statistics;
    type Recorder = (Recorder, Forces, WearTally);
    const ROWLESS: bool = false;

    fn begin(stepper: &Stepper, rows: u64, start: &State, time: &TimeOptions) -> Self::Recorder {
        let forces = Forces::new(stepper.scene(), time.statistics_from, time.force_averaging);
        let wear = WearTally::new(stepper.scene(), time.statistics_from, time.sectors);
        (Recorder::new(stepper.scene(), rows, &start.q, &start.v), forces, wear)
    }

    fn observe((recorder, forces, wear): &mut Self::Recorder, step: &Step<'_>) {
        recorder.observe(step);
        forces.observe(step);
        wear.observe_beside(step, recorder.slid());
    }

    fn observe_quiet((recorder, _, _): &mut Self::Recorder, quiet: &QuietSteps) {
        // Without an impulse there is nothing to sum up.
        recorder.observe_quiet(quiet);
    }

    fn finish(
        (recorder, forces, wear): Self::Recorder,
        open: &[Contact],
        (scene, masses): (&Scene, &[f64]),
        from: f64,
    ) -> (Trajectory, Statistics) {
        let trajectory = recorder.finish(open);
        let statistics = Statistics::of(scene, masses, trajectory.contacts(), from).with_forces(&forces);
        let statistics = statistics.with_wear(&wear);
        (trajectory, statistics)
    }

    fn trajectory(motion: &Trajectory) -> Option<&Trajectory> {
        Some(motion)
    }

    fn not_finite(statistics: &Statistics) -> Option<String> {
        first_not_finite(statistics).map(|part| format!("statistics.{part}"))
    }
}

impl Recording for Unrecorded {
    type Motion = ();
    type Statistics = ();
    type Recorder = ();
    const ROWLESS: bool = true;

    fn begin(_: &Stepper, _: u64, _: &State, _: &TimeOptions) {}

    fn observe((): &mut (), _: &Step<'_>) {}

    fn observe_quiet((): &mut (), _: &QuietSteps) {}

    fn finish((): (), _: &[Contact], _: (&Scene, &[f64]), _: f64) -> ((), ()) {
        ((), ())
    }

    fn trajectory((): &()) -> Option<&Trajectory> {
        None
    }

    fn not_finite((): &()) -> Option<String> {
        None
    }
}
