//! The result of a finished sweep.

use super::finish::Tables;
use super::status::Status;
use super::table::TABLE;
use crate::error::Error;
use std::path::PathBuf;

/// The result of a finished sweep.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Finished {
    /// Folder of its tables.
    pub folder: PathBuf,
    /// Number of rows.
    pub rows: u64,
    /// Number of runs: rows, or realisations of all rows.
    pub runs: u64,
    /// Number of runs that earlier processes had computed.
    pub found: u64,
    /// Number of rows by status.
    pub tables: Tables,
    /// The runs of this process with notes that limit their use.
    pub cautioned: Cautioned,
    /// Which table of earlier results was emptied, shortened, changed or removed, so that the rows
    /// were computed again.
    pub damaged: Option<String>,
    /// Wall-clock time of this process, s.
    pub seconds: f64,
    /// Number of threads of this process.
    pub threads: usize,
}

/// Runs that have notes that limit the use of their results.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Cautioned {
    /// Number of runs that were looked at.
    pub runs: u64,
    /// Number of those with such notes.
    pub with_notes: u64,
    /// The number of the first of these, and its first note.
    pub first: Option<(u64, String)>,
}

impl Cautioned {
    /// Counts run number `run` and its `caution`, in whatever order runs end.
    pub(super) fn add(&mut self, run: u64, caution: Option<String>) {
        self.runs += 1;
        let Some(caution) = caution else { return };
        self.with_notes += 1;
        if self.first.as_ref().is_none_or(|(first, _)| run < *first) {
            self.first = Some((run, caution));
        }
    }

    /// The same in a sentence; `None` where no run has a note.
    #[must_use]
    pub fn sentence(&self) -> Option<String> {
        let (_, first) = self.first.as_ref()?;
        let Self { runs, with_notes, .. } = self;
        Some(format!("{with_notes} of {runs} runs have notes that limit the use of their results; the first: {first}"))
    }
}

impl Finished {
    /// The error of a sweep in which every row failed, or under `strict` any row.
    #[must_use]
    pub fn failure(&self, strict: bool) -> Option<Error> {
        let bad = self.tables.bad();
        if bad == 0 || (!strict && bad < self.rows) {
            return None;
        }
        let worst = self.tables.first_error.clone().unwrap_or_default();
        let refuted = self.tables.counts.iter().any(|(status, _)| status == Status::Refuted.name());
        let runs = vec![format!("{bad} of {} rows failed: {worst}", self.rows)];
        Some(if refuted { Error::Refuted { runs } } else { Error::io(TABLE.to_owned(), runs.concat(), false) })
    }
}
