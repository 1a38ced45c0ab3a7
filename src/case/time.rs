//! The times of a run that are not the scene's.

use crate::error::{Error, Result};

/// Most steps that a run may take.
pub const MOST_STEPS: f64 = 1e10;
/// Most rows that a trajectory may have.
pub const MOST_SAMPLES: f64 = 1e7;

/// The `[time]` table without `end`, which is the duration of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeOptions {
    /// Step asked of the stepping schemes, s: above 0, below the end. A run shortens it to divide its duration.
    pub step: f64,
    /// Spacing of the recorded trajectory, s; none records every step. A spacing below the step does too.
    pub sample: Option<f64>,
    /// Start of the window for statistics, s: 0 or more, below the end.
    pub statistics_from: f64,
}

impl TimeOptions {
    /// Checks the times against one another and against the duration (s) of the run.
    ///
    /// # Errors
    /// [`Error::Invalid`] naming `time.step`, `time.sample` or `time.statistics_from`.
    pub fn validate(&self, duration: f64) -> Result<()> {
        let Self { step, sample, statistics_from } = *self;
        let refuse = |key: &str, value: f64, expected: String| {
            Err(Error::invalid(format!("time.{key}"), format_args!("{value:?}"), expected))
        };
        if !(step.is_finite() && step > 0.0) {
            return refuse("step", step, "a finite number above 0".to_owned());
        }
        if step >= duration {
            return refuse("step", step, format!("less than time.end, {duration:?}"));
        }
        if duration / step > MOST_STEPS {
            let least = duration / MOST_STEPS;
            return refuse("step", step, format!("{least:e} or more: at most 1e10 steps up to time.end"));
        }
        match sample {
            None if duration / step > MOST_SAMPLES => {
                let expected = "time.sample beside it: without one every step is recorded, and 1e7 rows are the most";
                return refuse("step", step, expected.to_owned());
            }
            Some(sample) if !(sample.is_finite() && sample > 0.0) => {
                return refuse("sample", sample, "a finite number above 0".to_owned());
            }
            Some(sample) if sample > duration => {
                return refuse("sample", sample, format!("at most time.end, {duration:?}"));
            }
            Some(sample) if duration / sample > MOST_SAMPLES => {
                let least = duration / MOST_SAMPLES;
                return refuse("sample", sample, format!("{least:e} or more: at most 1e7 rows up to time.end"));
            }
            _ => {}
        }
        if !(statistics_from >= 0.0 && statistics_from < duration) {
            return refuse("statistics_from", statistics_from, format!("0 or more, less than time.end, {duration:?}"));
        }
        Ok(())
    }
}
