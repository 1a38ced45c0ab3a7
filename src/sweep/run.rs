//! Computes the rows on several threads, into memory, or into a folder, where an interrupted sweep
//! can be continued.

use super::block::{Block, JOURNAL};
use super::effects::{effects, write_effects};
use super::finish::write_tables;
use super::finished::Finished;
use super::folder::{self, State, Study};
use super::found::RowsFound;
use super::plan::Plan;
use super::row::Row;
use super::shard::Shard;
use super::table::EFFECTS;
use crate::error::Result;
use crate::output::format::Format;
use crate::output::journal::Journal;
use crate::output::results::Results;
use crate::parallel::cores;
use std::path::Path;
use std::time::{Duration, Instant};

/// Interval between reports of progress.
const BETWEEN_REPORTS: Duration = Duration::from_millis(100);

/// Options for running a sweep into a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SweepOptions {
    /// Number of threads; all cores if `None`.
    pub threads: Option<usize>,
    /// The part of the sweep.
    pub shard: Shard,
    /// True to start from the beginning, whatever the folder contains.
    pub force: bool,
}

/// Progress of a sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// Runs done, including those of earlier processes.
    pub done: u64,
    /// Number of runs: rows, or realisations of all rows.
    pub runs: u64,
    /// Runs of this process per second; 0 before the first.
    pub rate: f64,
}

impl Plan {
    /// All rows, in their order, computed on `threads` threads and kept in memory, of rows with
    /// several realisations each of these; [`Plan::run_into`] writes them to disk, and the means.
    ///
    /// # Errors
    /// Errors of single rows are not returned: they are in [`Row::status`] and [`Row::error`].
    pub fn rows(&self, threads: usize) -> Result<Vec<Row>> {
        let mut rows = Vec::new();
        self.compute(Shard::WHOLE, threads.max(1), &RowsFound::default(), &|row| row, &mut |row| {
            rows.extend(row);
            Ok(())
        })?;
        rows.sort_by_key(|row: &Row| self.run_number(row));
        self.number(&mut rows);
        Ok(rows)
    }

    /// Runs the sweep into `folder`: `sweep.csv`, `samples.csv` if instants are requested,
    /// `realisations.csv` if rows have several, `effects.csv` if keys vary one at a time, and
    /// `request.json`. After an interruption at any instant, the same call continues, and ends with
    /// the same bytes, whatever the number of threads. Finished tables are read: where one is no
    /// longer as it was written, all rows are computed again. `progress` is called from time to
    /// time.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io) for a folder with results of another request, one that
    /// another process is writing to, and if writing fails.
    pub fn run_into(&self, folder: &Path, options: SweepOptions, progress: &dyn Fn(Progress)) -> Result<Finished> {
        let (finished, mut results) = self.run_in(folder, options, Vec::new(), progress, &|_| ())?;
        let effects = effects(&finished.folder, &self.request())?;
        if !effects.is_empty() && options.shard == Shard::WHOLE && !finished.folder.join(EFFECTS).exists() {
            write_effects(&mut results, &effects)?;
            results.finish()?;
        }
        Ok(finished)
    }

    /// As [`Plan::run_into`]; also returns the folder, in whose place files can be added, pictures
    /// in each of `formats`. `on_damage` is called with what the folder holds that is damaged,
    /// before its rows are computed again.
    pub(crate) fn run_in(
        &self,
        folder: &Path,
        options: SweepOptions,
        formats: Vec<Format>,
        progress: &dyn Fn(Progress),
        on_damage: &dyn Fn(&str),
    ) -> Result<(Finished, Results)> {
        let started = Instant::now();
        let folder = options.shard.folder(folder);
        let request = folder::of_shard(self.request(), options.shard);
        let mut results = Results::open(&folder, request, options.force, formats)?;
        folder::record_request(&mut results, &Study::of(self)?, options.shard);
        let threads = options.threads.unwrap_or_else(cores).max(1);
        let rows = options.shard.chains(self.chains) * self.chain_rows();
        let runs = rows * self.runs_of_row();
        let state = if options.force { State::Empty } else { folder::state(&folder, rows) };
        let mut damaged = None;
        let anew = matches!(state, State::Empty);
        match state {
            State::Finished { tables, records } => {
                // What an interruption after the last row has left.
                let _ = std::fs::remove_file(folder.join(JOURNAL));
                results.keep(records);
                let finished = Finished { folder, rows, runs, found: runs, tables, damaged, seconds: 0.0, threads };
                return Ok((finished, results));
            }
            State::Damaged(what) => {
                on_damage(&what);
                damaged = Some(what);
            }
            State::Empty | State::Begun => {}
        }
        let place = |run: u64| options.shard.place(self, run);
        let journal = Journal::open(&folder, JOURNAL, runs, anew, place)?;
        results.begin(JOURNAL)?;
        let found = journal.done();
        let mut journal = self.fill(journal, options.shard, threads, &|done| {
            let new = done - found;
            let rate = if new > 0 { new as f64 / started.elapsed().as_secs_f64() } else { 0.0 };
            progress(Progress { done, runs, rate });
        })?;
        let tables = write_tables(self, &mut results, &mut journal, rows)?;
        results.finish()?;
        let seconds = started.elapsed().as_secs_f64();
        Ok((Finished { folder, rows, runs, found, tables, damaged, seconds, threads }, results))
    }

    /// Computes the rows that are not yet in the journal.
    fn fill(&self, mut journal: Journal, shard: Shard, threads: usize, progress: &dyn Fn(u64)) -> Result<Journal> {
        let found = RowsFound::of(self, &mut journal, shard)?;
        let mut reported = Instant::now();
        let outcome =
            self.compute(shard, threads, &found, &|row| (self.run_number(&row), self.block(row)), &mut |finished| {
                if let Some((run, block)) = finished {
                    journal.add(run, shard.place(self, run).unwrap_or(usize::MAX), &block.bytes())?;
                }
                if reported.elapsed() > BETWEEN_REPORTS {
                    reported = Instant::now();
                    progress(journal.done());
                }
                Ok(())
            });
        // Rows received before writing failed are kept.
        let flushed = journal.flush();
        outcome.and(flushed)?;
        progress(journal.done());
        Ok(journal)
    }

    fn block(&self, row: Row) -> Block {
        let (line, samples) = (self.line(&row), self.sample_lines(&row));
        Block { end: row.end.filter(|_| self.sweep.followed().is_some()), line, samples }
    }
}
