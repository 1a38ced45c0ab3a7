//! The loop: a stepper, the judge and the recorder, from the start of a scene to its end.

use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::residual::{Judge, Residuals};
use crate::scene::Scene;
use crate::scheme::{Counters, Scheme, Stepper};
use crate::statistics::Statistics;
use crate::trajectory::{Recorder, Trajectory};
use std::time::Instant;

/// More steps than this are refused: a week of computing.
pub const MOST_STEPS: f64 = 1e10;

/// More recorded rows than this are refused: half a gigabyte of CSV.
pub const MOST_ROWS: f64 = 1e7;

/// Rows of the exact scheme, which has no step of its own, where no spacing is given.
const EVENT_ROWS: u64 = 1000;

/// Steps between two reports of progress.
const PROGRESS_STRIDE: u64 = 1 << 14;

/// Equal steps that end exactly at the end, and equal rows that fall on steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeGrid {
    /// The end, s.
    pub end: f64,
    /// The step used, s: the one asked for or a little shorter.
    pub step: f64,
    /// Number of steps.
    pub steps: u64,
    /// Number of recorded intervals; the rows are one more.
    pub rows: u64,
    /// True if the step had to be shortened.
    pub shortened: bool,
}

impl TimeGrid {
    /// A grid over [0, `end`] with rows at most `sample` apart (every step if none) and steps at most `step` long, in seconds.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a step that is not positive or exceeds the end, a sample shorter than the step, more than [`MOST_STEPS`]
    /// steps or [`MOST_ROWS`] rows.
    pub fn new(end: f64, step: f64, sample: Option<f64>) -> Result<Self> {
        let positive = |key: &str, x: f64| {
            if x.is_finite() && x > 0.0 { Ok(()) } else { Err(Error::invalid(key, x, "a finite number above 0")) }
        };
        positive("time.end", end)?;
        positive("time.step", step)?;
        if step > end {
            return Err(Error::invalid("time.step", step, format!("at most time.end, {end}")));
        }
        if end / step > MOST_STEPS {
            return Err(Error::invalid(
                "time.step",
                step,
                format!("at least {:e}: {MOST_STEPS:e} steps", end / MOST_STEPS),
            ));
        }
        let rows = match sample {
            None => intervals(end, step),
            Some(sample) => {
                positive("time.sample", sample)?;
                if sample < step * (1.0 - 1e-9) {
                    return Err(Error::invalid("time.sample", sample, format!("at least time.step, {step}")));
                }
                intervals(end, sample)
            }
        };
        if rows as f64 > MOST_ROWS {
            let key = if sample.is_some() { "time.sample" } else { "time.step without time.sample" };
            let least = format!("rows at least {:e} s apart: {MOST_ROWS:e} rows", end / MOST_ROWS);
            return Err(Error::invalid(key, sample.unwrap_or(step), least));
        }
        let steps = rows * intervals(end / rows as f64, step);
        let used = end / steps as f64;
        Ok(Self { end, step: used, steps, rows, shortened: used < step * (1.0 - 1e-9) })
    }
}

/// The least number of equal intervals of at most `step` that fill `span`, forgiving the rounding of their ratio.
fn intervals(span: f64, step: f64) -> u64 {
    let ratio = span / step;
    // In range: the caller has bounded the ratio by MOST_STEPS.
    (ratio * (1.0 - 1e-12)).ceil().max(1.0) as u64
}

/// What a run needs to know beside the scene and the scheme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Step, s; shortened where it does not divide the rows' spacing. The exact scheme has no use for it.
    pub step: f64,
    /// Spacing of the recorded rows, s; every step if none (the exact scheme: a thousandth of the duration).
    pub sample: Option<f64>,
    /// Start of the window for statistics, s.
    pub statistics_from: f64,
    /// Solver of the quadratic programmes.
    pub backend: Backend,
}

impl Options {
    /// Steps of `step` seconds, all of them recorded, statistics from the start, the solver chosen by the scene.
    #[must_use]
    pub fn with_step(step: f64) -> Self {
        Self { step, sample: None, statistics_from: 0.0, backend: Backend::Auto }
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
    /// What a reader must know of this run, in sentences.
    pub notes: Vec<String>,
}

/// Runs `scene` by `scheme` to its end.
///
/// # Errors
/// [`Error::Invalid`] for a request that makes no sense, and what [`Stepper::step`] reports.
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
    let from = options.statistics_from;
    if !(from >= 0.0 && from < scene.duration) {
        return Err(Error::invalid(
            "time.statistics_from",
            from,
            format!("0 or more and below time.end, {}", scene.duration),
        ));
    }
    let grid = grid(scene, scheme, options)?;
    let exact = *scheme == Scheme::Event;
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
        statistics: Statistics::new(scene, trajectory.contacts(), from),
        trajectory,
        residuals: judge.residuals(),
        counters: stepper.counters(),
        seconds: started.elapsed().as_secs_f64(),
        notes: Vec::new(),
    };
    run.notes = crate::notes::notes(scene, &run);
    Ok(run)
}

fn grid(scene: &Scene, scheme: &Scheme, options: &Options) -> Result<TimeGrid> {
    if *scheme != Scheme::Event {
        return TimeGrid::new(scene.duration, options.step, options.sample);
    }
    let end = scene.duration;
    let sample = options.sample.unwrap_or(end / EVENT_ROWS as f64).min(end);
    let rows = TimeGrid::new(end, sample, None)?.rows;
    Ok(TimeGrid { end, step: end, steps: 1, rows, shortened: false })
}
