//! The loop: a stepper, the judge and the recorder, from the start of a scene to its end.

use crate::error::Result;
use crate::qp::Backend;
use crate::residual::{Judge, Residuals};
use crate::scene::Scene;
use crate::scheme::{Counters, Handed, Scheme, Stepper};
use crate::statistics::Statistics;
use crate::time::{TimeGrid, TimeOptions};
use crate::trajectory::{Recorder, Trajectory};
use std::time::Instant;

/// Steps between two reports of progress.
const PROGRESS_STRIDE: u64 = 1 << 14;

/// What a run needs to know beside the scene and the scheme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Step, recording and statistics. The exact scheme has no use for the step.
    pub time: TimeOptions,
    /// Solver of the quadratic programmes.
    pub backend: Backend,
}

impl Options {
    /// Steps of `step` seconds, all of them recorded, statistics from the start, the solver chosen by the scene.
    #[must_use]
    pub fn with_step(step: f64) -> Self {
        Self { time: TimeOptions::with_step(step), backend: Backend::Auto }
    }
}

/// A finished run.
#[derive(Debug, Clone)]
pub struct Run {
    /// The scheme that made it.
    pub scheme: Scheme,
    /// The solver of its quadratic programmes: the one in force, not `auto`.
    pub backend: Backend,
    /// Its steps and rows.
    pub grid: TimeGrid,
    /// The recorded motion.
    pub trajectory: Trajectory,
    /// The judge's verdict.
    pub residuals: Residuals,
    /// Contact statistics over the window asked for.
    pub statistics: Statistics,
    /// What it cost, machine-independent.
    pub counters: Counters,
    /// What it cost, wall-clock seconds, recording and judging included.
    pub seconds: f64,
    /// Stretches that the exact scheme handed to moreau-jean; none for other schemes.
    pub handed: Vec<Handed>,
    /// What a reader must know of this run, in sentences.
    pub notes: Vec<String>,
}

/// Runs `scene` by `scheme` to its end.
///
/// # Errors
/// [`crate::Error::Invalid`] for a request that makes no sense, and what [`Stepper::step`] reports.
pub fn run(scene: &Scene, scheme: &Scheme, options: &Options) -> Result<Run> {
    run_with_progress(scene, scheme, options, &mut |_| {})
}

/// The same, telling `progress` the time reached (s) now and then.
///
/// # Errors
/// As [`run`].
pub fn run_with_progress(
    scene: &Scene,
    scheme: &Scheme,
    options: &Options,
    progress: &mut dyn FnMut(f64),
) -> Result<Run> {
    scene.validate()?;
    let exact = *scheme == Scheme::Event;
    let grid = match exact {
        true => TimeGrid::exact(scene.duration, &options.time)?,
        false => TimeGrid::stepping(scene.duration, &options.time)?,
    };
    let started = Instant::now();
    let mut stepper = Stepper::with_backend(scene, scheme, grid.step, options.backend)?;
    let state = stepper.state();
    let mut judge = Judge::new(stepper.scene(), stepper.contract(), grid.step, &state.q, &state.v);
    let mut recorder = Recorder::new(stepper.scene(), grid.rows, &state.q, &state.v);
    let mut count = 0;
    loop {
        let step = stepper.step()?;
        judge.see(&step);
        recorder.see(&step);
        let time = step.end;
        count += 1;
        if count % PROGRESS_STRIDE == 0 {
            progress(time);
        }
        if if exact { time >= scene.duration } else { count == grid.steps } {
            break;
        }
    }
    let trajectory = recorder.finish(&stepper.open_contacts());
    let mut run = Run {
        scheme: *scheme,
        backend: stepper.backend(),
        grid,
        statistics: Statistics::new(scene, trajectory.contacts(), options.time.statistics_from),
        trajectory,
        residuals: judge.residuals(),
        counters: stepper.counters(),
        seconds: started.elapsed().as_secs_f64(),
        handed: stepper.handed().to_vec(),
        notes: Vec::new(),
    };
    run.notes = crate::notes::notes(scene, &run);
    Ok(run)
}
