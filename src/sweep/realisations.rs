//! Rows with several realisations of their random loads: each realisation is a run of its own with
//! a line of `realisations.csv`, and the row of `sweep.csv` has the means over them.
//!
//! The seeds are the same in every row, those of
//! [`Case::realisation`](crate::case::Case::realisation), so that rows differ by what varies alone.
//! Runs are numbered row by row: run `r N + k − 1` is realisation `k` of row `r`, of `N`. A row
//! without realisations is one run.

use super::plan::{MOST_ROWS, Plan};
use super::row::Row;
use crate::error::{Error, Result};

/// The end of a key that sets the seed of a random load.
const SEED_KEY: &str = ".random.seed";

impl Plan {
    /// Number of realisations of the random loads of every row; `None` where a row is one run.
    #[must_use]
    pub fn realisations(&self) -> Option<u64> {
        self.sweep.realisations
    }

    /// Number of runs: rows, or realisations of all rows.
    #[must_use]
    pub fn runs(&self) -> u64 {
        self.count().saturating_mul(self.runs_of_row())
    }

    /// Number of runs of a row.
    pub(super) fn runs_of_row(&self) -> u64 {
        self.sweep.realisations.unwrap_or(1)
    }

    /// The number of the run of `row`.
    pub(super) fn run_number(&self, row: &Row) -> u64 {
        row.number * self.runs_of_row() + row.realisation.map_or(0, |number| number - 1)
    }

    /// An error for realisations that the case does not have, or that what varies contradicts.
    pub(super) fn check_seeds(&self) -> Result<()> {
        let Some(count) = self.sweep.realisations else { return Ok(()) };
        let refuse = |expected: &str| Err(Error::invalid("[run] seeds (--seeds)", count, expected));
        if count < 2 {
            return refuse("2 or more realisations: the interval of a mean follows from their scatter");
        }
        if !self.base.is_random() {
            return refuse("a case with a random load: without one all runs are the same");
        }
        let keys = self.sweep.axes.iter().flat_map(|axis| &axis.targets).map(|(target, _)| target.to_string());
        if let Some(key) = keys.into_iter().find(|key| key.ends_with(SEED_KEY)) {
            let expected = "no seeds beside it: they set the same";
            return Err(Error::invalid("[[vary]] key", key, expected));
        }
        if self.runs() > MOST_ROWS {
            let expected = format!("at most {} runs in all", MOST_ROWS);
            return refuse(&expected);
        }
        self.base.realisation(count).map(drop)
    }
}
