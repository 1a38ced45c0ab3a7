//! The table `[statistics]`.

use crate::error::{Error, Result};
use crate::statistics::FEWEST_VALUES;
use crate::time::TimeOptions;

/// Further statistics that a case asks for. The window of all statistics is in `[time]`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct StatisticsOptions {
    /// Contacts are joined into one episode where less than this lies between them, s.
    pub rest: f64,
    /// Whether spectra of displacements and forces are written.
    pub spectra: bool,
}

/// Rows of the exact scheme where no spacing is given.
const EVENT_ROWS: f64 = 1000.0;

impl StatisticsOptions {
    /// Checks the options against the times of a run that ends at `duration` (s).
    ///
    /// # Errors
    /// [`Error::Invalid`] under `statistics` for a rest that is negative or as long as the window,
    /// and for spectra of fewer than 72 rows or averaged forces.
    pub fn validate(&self, duration: f64, time: &TimeOptions) -> Result<()> {
        let window = duration - time.statistics_from;
        let Self { rest, spectra } = *self;
        if !(rest >= 0.0 && rest < window) {
            let expected = format!("0 or more, in s, and less than the window of the statistics, {window:?}");
            return Err(Error::invalid(("statistics", "rest"), format_args!("{rest:?}"), expected));
        }
        if !spectra {
            return Ok(());
        }
        // The exact scheme has rows of its own where none are asked for.
        let row = time.sample.map_or(time.step.max(duration / EVENT_ROWS), |sample| sample.max(time.step));
        let most = window / FEWEST_VALUES as f64;
        for (spacing, of) in [(row, "rows"), (stretch(time.force_averaging, row), "averaged forces")] {
            if spacing > most {
                let value = format!("true, with {of} {spacing:e} s apart in a window of {window:?} s");
                let expected = format!("{FEWEST_VALUES} {of} or more in the window: at most {most:e} s apart");
                return Err(Error::invalid(("statistics", "spectra"), value, expected));
            }
        }
        Ok(())
    }
}

/// The stretch over which forces are averaged for their spectrum: `averaging` (s), as a whole
/// number of rows that are `row` (s) apart.
pub(crate) fn stretch(averaging: f64, row: f64) -> f64 {
    rows_of(averaging, row) as f64 * row
}

/// How many rows that is.
pub(crate) fn rows_of(averaging: f64, row: f64) -> usize {
    (averaging / row).round().clamp(1.0, 1e9) as usize
}
