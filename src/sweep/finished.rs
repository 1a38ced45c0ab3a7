//! The result of a finished sweep.

use super::finish::Tables;
use super::status::Status;
use super::table::TABLE;
use crate::error::Error;
use crate::run::Cautioned;
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
