//! The times of a run other than the scene's duration: step, recording, statistics, and the grid
//! that follows from them.

use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};

/// Maximum number of steps of a run: minutes for a scheme of one degree of freedom, and far from
/// the end of a `u64`.
pub const MOST_STEPS: f64 = 1e10;
/// Maximum number of rows of a trajectory: half a gigabyte of CSV.
pub const MOST_ROWS: f64 = 1e7;

/// Step, recording and statistics of a run: a case's `[time]` table without `end`, which is the
/// duration of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TimeOptions {
    /// Step requested of the stepping schemes, s: above 0, below the end. A run shortens it so that
    /// it divides the duration.
    pub step: f64,
    /// Spacing of the recorded trajectory, s; `None`, or a spacing below the step, records every
    /// step.
    pub sample: Option<f64>,
    /// Start of the window for statistics, s: 0 or more, below the end.
    pub statistics_from: f64,
    /// Length of the intervals over which the force of a rigid wall is averaged before its root
    /// mean square over time is taken, s: above 0; by default
    /// [`FORCE_AVERAGING`](Self::FORCE_AVERAGING). The interval used may be shorter, so that each
    /// tenth of the window holds a whole number of them, or longer where the window would hold more
    /// than 1e6.
    pub force_averaging: f64,
    /// Number of equal sectors into which the circle around each support is divided, from 1 to
    /// 3600; by default [`SECTORS`](Self::SECTORS).
    #[serde(default = "TimeOptions::sectors")]
    pub sectors: usize,
}

impl TimeOptions {
    /// A millisecond: short compared with the period of a structure, long compared with an impact.
    pub const FORCE_AVERAGING: f64 = 1e-3;

    /// Of 30 degrees each.
    pub const SECTORS: usize = 12;

    /// Maximum number of sectors: of a tenth of a degree each.
    pub const MOST_SECTORS: usize = 3600;

    fn sectors() -> usize {
        Self::SECTORS
    }

    /// Steps of `step` seconds, all of them recorded, and statistics from the start. The exact
    /// scheme, which has no such step, records 1000 intervals, unless `sample` says otherwise.
    #[must_use]
    pub fn with_step(step: f64) -> Self {
        Self {
            step,
            sample: None,
            statistics_from: 0.0,
            force_averaging: Self::FORCE_AVERAGING,
            sectors: Self::SECTORS,
        }
    }

    /// Checks the times against one another and against the duration (s) of the run.
    ///
    /// # Errors
    /// [`Error::Invalid`] naming `step`, `sample`, `statistics_from`, `force_averaging` or
    /// `sectors`.
    pub fn validate(&self, duration: f64) -> Result<()> {
        let Self { step, sample, statistics_from, force_averaging, sectors } = *self;
        let refuse = |key: &'static str, value: f64, expected: String| {
            Err(Error::invalid(key, format_args!("{value:?}"), expected))
        };
        if !(step.is_finite() && step > 0.0) {
            return refuse("step", step, "a finite number above 0".to_owned());
        }
        if step >= duration {
            return refuse("step", step, format!("less than the duration, {duration:?}"));
        }
        if duration / step > MOST_STEPS {
            let least = duration / MOST_STEPS;
            return refuse("step", step, format!("{least:e} or more: at most 1e10 steps up to the end"));
        }
        match sample {
            None if duration / step > MOST_ROWS => {
                let expected = "sample beside it: without one every step is recorded, and 1e7 rows are the most";
                return refuse("step", step, expected.to_owned());
            }
            Some(sample) if !(sample.is_finite() && sample > 0.0) => {
                return refuse("sample", sample, "a finite number above 0".to_owned());
            }
            Some(sample) if sample > duration => {
                return refuse("sample", sample, format!("at most the duration, {duration:?}"));
            }
            Some(sample) if duration / sample > MOST_ROWS => {
                let least = duration / MOST_ROWS;
                return refuse("sample", sample, format!("{least:e} or more: at most 1e7 rows up to the end"));
            }
            _ => {}
        }
        if !(statistics_from >= 0.0 && statistics_from < duration) {
            return refuse(
                "statistics_from",
                statistics_from,
                format!("0 or more, less than the duration, {duration:?}"),
            );
        }
        if !(force_averaging.is_finite() && force_averaging > 0.0) {
            return refuse("force_averaging", force_averaging, "a finite number above 0".to_owned());
        }
        if !(1..=Self::MOST_SECTORS).contains(&sectors) {
            return Err(Error::invalid("sectors", sectors, format!("from 1 to {}", Self::MOST_SECTORS)));
        }
        Ok(())
    }
}

/// Equal steps that end exactly at the end of the run, and equally spaced rows that coincide with
/// steps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TimeGrid {
    /// The end, s.
    pub end: f64,
    /// The step used, s: the requested one or a little shorter.
    pub step: f64,
    /// Number of steps.
    pub steps: u64,
    /// Number of recorded intervals; the rows are one more.
    pub rows: u64,
    /// True if the step had to be shortened.
    pub shortened: bool,
    /// True if the spacing of the rows had to be shortened so that the last row is at the end.
    pub rows_shortened: bool,
}

/// Number of recorded intervals of the exact scheme, which has no step of its own, if no spacing is
/// given.
const EVENT_ROWS: f64 = 1000.0;

impl TimeGrid {
    /// The time between two rows, s.
    pub(crate) fn row_spacing(&self) -> f64 {
        self.end / self.rows as f64
    }

    /// The grid of a stepping scheme over [0, `duration`] seconds.
    ///
    /// # Errors
    /// As [`TimeOptions::validate`].
    pub fn stepping(duration: f64, options: &TimeOptions) -> Result<Self> {
        options.validate(duration)?;
        let step = options.step;
        let spacing = options.sample.map_or(step, |sample| sample.max(step));
        let rows = intervals(duration, spacing);
        let steps = rows * intervals(duration / rows as f64, step);
        let used = duration / steps as f64;
        Ok(Self {
            end: duration,
            step: used,
            steps,
            rows,
            shortened: used < step * (1.0 - 1e-9),
            rows_shortened: options.sample.is_some() && shorter(duration, rows, spacing),
        })
    }

    /// The rows of the exact scheme, which steps from event to event: a thousand unless a spacing
    /// is given.
    ///
    /// # Errors
    /// As [`TimeOptions::validate`].
    pub fn exact(duration: f64, options: &TimeOptions) -> Result<Self> {
        let sample = options.sample.unwrap_or(duration / EVENT_ROWS);
        TimeOptions { step: 0.5 * duration, sample: Some(sample), ..*options }.validate(duration)?;
        let rows = intervals(duration, sample);
        let rows_shortened = shorter(duration, rows, sample);
        Ok(Self { end: duration, step: duration, steps: 1, rows, shortened: false, rows_shortened })
    }
}

/// True if `rows` intervals of the duration are shorter than the spacing asked for, by more than
/// rounding.
fn shorter(duration: f64, rows: u64, spacing: f64) -> bool {
    duration / (rows as f64) < spacing * (1.0 - 1e-9)
}

/// The least number of equal intervals of at most `step` that fill `span`, up to the rounding of
/// their ratio.
fn intervals(span: f64, step: f64) -> u64 {
    // In range: the options bound the ratio by MOST_STEPS.
    (span / step * (1.0 - 1e-12)).ceil().max(1.0) as u64
}
