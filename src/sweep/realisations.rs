//! Rows with several realisations of their random loads: each realisation is a run of its own with
//! a line of `realisations.csv`, and the row of `sweep.csv` has the means over them.
//!
//! The seeds are the same in every row, those of
//! [`Case::realisation`](crate::case::Case::realisation), so that rows differ by what varies alone.
//! Runs are numbered row by row: run `r N + k − 1` is realisation `k` of row `r`, of `N`, or of `N`
//! at most where the row's own interval decides. A row without realisations is one run.

use super::plan::{MOST_ROWS, Plan};
use super::row::Row;
use super::run_set::RunSet;
use super::shard::Shard;
use super::table::cells_of;
use super::until_interval::UntilInterval;
use crate::case::RANDOM;
use crate::error::{Error, Result};
use crate::study::realisations::{PILOTS, RealisationCount};
use csv::StringRecord;

impl Plan {
    /// How many realisations of the random loads every row has; `None` where a row is one run.
    #[must_use]
    pub fn realisations(&self) -> Option<RealisationCount> {
        self.sweep.realisations
    }

    /// Number of runs: rows, or realisations of all rows; where intervals decide, of their pilots,
    /// the fewest that there may be.
    #[must_use]
    pub fn runs(&self) -> u64 {
        self.count().saturating_mul(self.first_runs_of_row())
    }

    /// Number of runs of a row, the most where its interval decides.
    pub(super) fn runs_of_row(&self) -> u64 {
        self.sweep.realisations.map_or(1, RealisationCount::most)
    }

    /// Number of runs of a row that are made before its interval is looked at.
    fn first_runs_of_row(&self) -> u64 {
        match self.sweep.realisations {
            Some(RealisationCount::Within { .. }) => PILOTS,
            _ => self.runs_of_row(),
        }
    }

    /// The runs of `shard` that are made before intervals are looked at: all, or the pilots.
    pub(super) fn first_runs(&self, shard: Shard) -> RunSet {
        RunSet::First { of_chain: self.first_runs_of_row(), chains: shard.chains(self.chains) }
    }

    /// The numbers of realisations of rows whose intervals decide, each from the lines of its
    /// pilots; `pilots` has those of a row. `None` where intervals do not decide.
    ///
    /// # Errors
    /// Those of `pilots`.
    pub(super) fn counts(
        &self,
        rows: u64,
        mut pilots: impl FnMut(u64) -> Result<Vec<StringRecord>>,
    ) -> Result<Option<Vec<u64>>> {
        let Some(until) = &self.until else { return Ok(None) };
        (0..rows).map(|row| Ok(until.count(&pilots(row)?))).collect::<Result<Vec<u64>>>().map(Some)
    }

    /// The cells of the line of `row`.
    pub(super) fn cells(&self, row: &Row) -> StringRecord {
        cells_of(&self.line(row))
    }

    /// The number of the run of `row`.
    pub(super) fn run_number(&self, row: &Row) -> u64 {
        row.number * self.runs_of_row() + row.realisation.map_or(0, |number| number - 1)
    }

    /// An error for realisations that the case does not have, or that what varies contradicts.
    pub(super) fn check_seeds(&self) -> Result<()> {
        let Some(wanted) = self.sweep.realisations else { return Ok(()) };
        if let (Some(until), RealisationCount::Within { share, .. }) = (&self.until, wanted) {
            self.check_interval(until, share)?;
        }
        let count = wanted.most();
        let refuse = |expected: &str| Err(Error::invalid("number of realisations (--seeds)", count, expected));
        if count < 2 {
            return refuse("2 or more realisations: the interval of a mean follows from their scatter");
        }
        if !self.base.is_random() {
            return refuse(RANDOM);
        }
        let mut targets = self.sweep.axes.iter().flat_map(|axis| &axis.targets).map(|(target, _)| target);
        if let Some(key) = targets.find(|target| target.is_seed()) {
            let expected = "no seeds beside it: they set the same";
            return Err(Error::invalid("[[vary]] key", key, expected));
        }
        if self.count().saturating_mul(count) > MOST_ROWS {
            let expected = format!("at most {} runs in all", MOST_ROWS);
            return refuse(&expected);
        }
        self.base.realisation(count).map(drop)
    }

    /// An error for rows whose intervals cannot decide how many realisations they have.
    fn check_interval(&self, until: &UntilInterval, share: f64) -> Result<()> {
        let refuse = |expected: &str| {
            Err(Error::invalid("interval of the realisations (--until-interval)", format_args!("{share:?}"), expected))
        };
        if self.sweep.followed().is_some() {
            return refuse("nothing followed beside it: a row would start from realisations that the last one lacks");
        }
        if !self.base.is_random() {
            return refuse(RANDOM);
        }
        if !until.judges() {
            let names = UntilInterval::names();
            return refuse(&format!("a measure beside it whose interval decides: {names}"));
        }
        Ok(())
    }
}
