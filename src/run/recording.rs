//! Whether a run is recorded.

use crate::finite::first_not_finite;
use crate::scene::{Scene, State};
use crate::scheme::Stepper;
use crate::statistics::{Forces, Statistics, WearTally};
use crate::step::{Contact, QuietSteps, Step};
use crate::time::TimeOptions;
use crate::trajectory::{Recorder, Trajectory};
use std::fmt::Debug;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Recorded {}
    impl Sealed for super::Unrecorded {}
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
        scene: &Scene,
        masses: &[f64],
        statistics_from: f64,
    ) -> (Self::Motion, Self::Statistics);
    #[doc(hidden)]
    fn trajectory(motion: &Self::Motion) -> Option<&Trajectory>;
    /// The statistics, if the run was recorded.
    #[doc(hidden)]
    fn statistics(statistics: &Self::Statistics) -> Option<&Statistics>;
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

/// What records a run.
#[derive(Debug)]
pub struct RunRecorder {
    rows: Recorder,
    forces: Forces,
    wear: WearTally,
}

impl Recording for Recorded {
    type Motion = Trajectory;
    type Statistics = Statistics;
    type Recorder = RunRecorder;
    const ROWLESS: bool = false;

    fn begin(stepper: &Stepper, rows: u64, start: &State, time: &TimeOptions) -> RunRecorder {
        let scene = stepper.scene();
        RunRecorder {
            rows: Recorder::new(scene, rows, &start.q, &start.v),
            forces: Forces::new(scene, time.statistics_from, stepper.force_averaging(time.force_averaging)),
            wear: WearTally::new(scene, time.statistics_from, time.sectors),
        }
    }

    fn observe(recorder: &mut RunRecorder, step: &Step<'_>) {
        recorder.rows.observe(step);
        recorder.forces.observe(step);
        recorder.wear.observe_beside(step, recorder.rows.slid());
    }

    fn observe_quiet(recorder: &mut RunRecorder, quiet: &QuietSteps) {
        // Without an impulse there is nothing to sum up.
        recorder.rows.observe_quiet(quiet);
    }

    fn finish(
        recorder: RunRecorder,
        open: &[Contact],
        scene: &Scene,
        masses: &[f64],
        from: f64,
    ) -> (Trajectory, Statistics) {
        let trajectory = recorder.rows.finish(open);
        let contacts = recorder.forces.in_window(trajectory.contacts());
        let statistics = Statistics::of(scene, masses, &contacts, from);
        (trajectory, statistics.with_forces(&recorder.forces).with_wear(&recorder.wear))
    }

    fn trajectory(motion: &Trajectory) -> Option<&Trajectory> {
        Some(motion)
    }

    fn statistics(statistics: &Statistics) -> Option<&Statistics> {
        Some(statistics)
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

    fn finish((): (), _: &[Contact], _: &Scene, _: &[f64], _: f64) -> ((), ()) {
        ((), ())
    }

    fn trajectory((): &()) -> Option<&Trajectory> {
        None
    }

    fn statistics((): &()) -> Option<&Statistics> {
        None
    }

    fn not_finite((): &()) -> Option<String> {
        None
    }
}
