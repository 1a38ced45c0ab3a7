//! Computes the rows on several threads, into memory, or into a folder, where an interrupted sweep
//! can be continued.

use super::block::{Block, JOURNAL};
use super::finish::write_tables;
use super::finished::Finished;
use super::folder::{self, State, Study};
use super::found::RowsFound;
use super::plan::Plan;
use super::row::Row;
use super::run_set::RunSet;
use super::sensitivity::{SENSITIVITY_TABLES, Sensitivity};
use super::shard::Shard;
use super::table::{REALISATIONS, cells_of};
use crate::error::Result;
use crate::order::sort_by_number;
use crate::output::format::Formats;
use crate::output::journal::Journal;
use crate::output::results::Results;
use crate::parallel::cores;
use crate::run::Cautioned;
use crate::study::realisations::PILOTS;
use std::path::Path;
use std::time::{Duration, Instant};

/// Interval between reports of progress.
const BETWEEN_REPORTS: Duration = Duration::from_millis(100);

/// Options for running a sweep into a folder; by default the whole sweep, on all cores.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
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
    /// Number of runs: rows, or realisations of all rows; where the intervals of rows decide, as
    /// many as are known to be needed.
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
        let mut rows: Vec<Row> = Vec::new();
        let add = |runs: &RunSet, rows: &mut Vec<Row>| {
            self.compute((Shard::WHOLE, runs), threads.max(1), &RowsFound::default(), &|row| row, &mut |row| {
                rows.extend(row);
                Ok(())
            })?;
            sort_by_number(rows, |row: &Row| self.run_number(row) as f64);
            Ok(())
        };
        add(&self.first_runs(Shard::WHOLE), &mut rows)?;
        let pilots = |row: u64| Ok(rows.iter().filter(|run| run.number == row).map(|run| self.cells(run)).collect());
        if let Some(counts) = self.counts(self.count(), pilots)? {
            add(&RunSet::further(&counts), &mut rows)?;
        }
        self.number(&mut rows);
        Ok(rows)
    }

    /// Runs the sweep into `folder`: `sweep.csv`, `samples.csv` if instants are requested,
    /// `realisations.csv` if rows have several, `effects.csv` if keys vary one at a time,
    /// `shares.csv` if they are drawn at random, and `request.json`. After an interruption at any
    /// instant, the same call continues, and ends with the same bytes, whatever the number of
    /// threads. Finished tables are read: where one is no longer as it was written, all rows are
    /// computed again. `progress` is called from time to time.
    ///
    /// ```
    /// use signorini::case::CaseFile;
    /// use signorini::sweep::{Axis, Measure, Sweep, SweepOptions};
    ///
    /// let plan = Sweep::new(CaseFile::embedded("rigid-walls-sine")?)
    ///     .vary(Axis::linear("load.1.harmonic.frequency", 4.0, 5.0, 3)?)
    ///     .measure([Measure::Contacts])
    ///     .plan()?;
    /// # let scratch = tempfile::tempdir().expect("a folder");
    /// # let folder = scratch.path().join("frequencies");
    /// # /*
    /// let folder = Path::new("frequencies");
    /// # */
    /// let finished = plan.run_into(&folder, SweepOptions::default(), &|_| ())?;
    /// assert!(finished.folder.join("sweep.csv").exists());
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OtherResults`](crate::Error::OtherResults); [`Error::Io`](crate::Error::Io) for a
    /// folder that another process is writing to, and if writing fails.
    pub fn run_into(&self, folder: &Path, options: SweepOptions, progress: &dyn Fn(Progress)) -> Result<Finished> {
        let (finished, mut results) = self.run_in(folder, options, Formats::default(), progress, &|_| ())?;
        let there = SENSITIVITY_TABLES.iter().any(|(_, file)| finished.folder.join(file).exists());
        if options.shard == Shard::WHOLE
            && !there
            && let Some(found) = Sensitivity::read(&finished.folder, &self.request())?
            && found.write(&mut results)?
        {
            results.finish()?;
        }
        Ok(finished)
    }

    /// As [`Plan::run_into`]; also returns the folder, where files can be added in `formats`.
    /// `on_damage` is called with what the folder holds that is damaged, before its rows are
    /// computed again.
    pub(crate) fn run_in(
        &self,
        folder: &Path,
        options: SweepOptions,
        formats: Formats,
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
        let state = if options.force { State::Empty } else { folder::state(&folder, rows) };
        let mut damaged = None;
        let anew = matches!(state, State::Empty);
        match state {
            State::Finished { tables, records, notes } => {
                folder::record_notes(&mut results, &notes);
                // What an interruption after the last row has left.
                let _ = std::fs::remove_file(folder.join(JOURNAL));
                let runs =
                    records.iter().find(|(name, _)| name == REALISATIONS).map_or(rows, |(_, record)| record.rows);
                results.keep(records);
                let cautioned = Cautioned::default();
                let finished =
                    Finished { folder, rows, runs, found: runs, tables, cautioned, damaged, seconds: 0.0, threads };
                return Ok((finished, results));
            }
            State::Damaged(what) => {
                on_damage(&what);
                damaged = Some(what);
            }
            State::Empty | State::Begun => {}
        }
        let place = |run: u64| options.shard.place(self, run);
        let journal = Journal::open(&folder, JOURNAL, rows * self.runs_of_row(), anew, place)?;
        results.begin(JOURNAL)?;
        let found = journal.done();
        let mut cautioned = Cautioned::default();
        let (mut journal, counts) = self.fill(journal, options.shard, (threads, &mut cautioned), &|done, runs| {
            let new = done - found;
            let rate = if new > 0 { new as f64 / started.elapsed().as_secs_f64() } else { 0.0 };
            progress(Progress { done, runs, rate });
        })?;
        let notes: Vec<String> = self.notes().into_iter().chain(cautioned.sentences()).collect();
        folder::record_notes(&mut results, &notes);
        let count = |row: u64| counts.as_ref().and_then(|counts| counts.get(row as usize)).copied();
        let count = |row: u64| count(row).unwrap_or(self.runs_of_row());
        let tables = write_tables(self, &mut results, &mut journal, (rows, &count))?;
        let runs = (0..rows).map(count).sum();
        results.finish()?;
        let seconds = started.elapsed().as_secs_f64();
        Ok((Finished { folder, rows, runs, found, tables, cautioned, damaged, seconds, threads }, results))
    }

    /// Computes the rows that are not yet in the journal; with it returns how many runs each of
    /// them has, where their intervals decide. `progress` is called with the numbers of runs that
    /// are done and that are known to be needed.
    fn fill(
        &self,
        mut journal: Journal,
        shard: Shard,
        (threads, cautioned): (usize, &mut Cautioned),
        progress: &dyn Fn(u64, u64),
    ) -> Result<(Journal, Option<Vec<u64>>)> {
        let rows = shard.chains(self.chains) * self.chain_rows();
        let first = self.first_runs(shard);
        let runs = first.count() * self.chain_rows();
        self.add_runs(&mut journal, (shard, &first), (threads, cautioned), &|done| progress(done, runs.max(done)))?;
        let counts = self.counts(rows, |row| {
            let pilots = row * self.runs_of_row()..row * self.runs_of_row() + PILOTS;
            let line = |place: u64| Ok(Block::read(&mut journal, place as usize)?.map(|block| cells_of(&block.line)));
            pilots.map(line).filter_map(Result::transpose).collect()
        })?;
        if let Some(counts) = &counts {
            let runs = counts.iter().sum();
            let further = RunSet::further(counts);
            self.add_runs(&mut journal, (shard, &further), (threads, cautioned), &|done| progress(done, runs))?;
        }
        Ok((journal, counts))
    }

    /// Computes those of the runs that are not yet in the journal.
    fn add_runs(
        &self,
        journal: &mut Journal,
        (shard, runs): (Shard, &RunSet),
        (threads, cautioned): (usize, &mut Cautioned),
        progress: &dyn Fn(u64),
    ) -> Result<()> {
        let found = RowsFound::of(self, journal, shard)?;
        let mut reported = Instant::now();
        let outcome = self.compute(
            (shard, runs),
            threads,
            &found,
            &|mut row| (self.run_number(&row), std::mem::take(&mut row.caution), self.block(row)),
            &mut |finished| {
                if let Some((run, caution, block)) = finished {
                    cautioned.add(run, caution);
                    journal.add(run, shard.place(self, run).unwrap_or(usize::MAX), &block.bytes())?;
                }
                if reported.elapsed() > BETWEEN_REPORTS {
                    reported = Instant::now();
                    progress(journal.done());
                }
                Ok(())
            },
        );
        // Rows received before writing failed are kept.
        let flushed = journal.flush();
        outcome.and(flushed)?;
        progress(journal.done());
        Ok(())
    }

    fn block(&self, row: Row) -> Block {
        let (line, samples) = (self.line(&row), self.sample_lines(&row));
        Block { end: row.end.filter(|_| self.sweep.followed().is_some()), line, samples }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Measure, Sweep};
    use super::*;
    use crate::case::CaseFile;

    /// 1 kg before a stop under a random force.
    const STOP: &str = "\
[system.oscillator]
mass = 1.0
damping = 2.0
stiffness = 400.0
[[wall]]
name = \"stop\"
side = \"upper\"
position = 5e-3
restitution = 0.5
[[load]]
random = { rms = 3.0, from = 1.0, to = 20.0, seed = 7 }
[time]
end = 1.0
step = 1e-3
";

    #[test]
    fn pilots_and_others_go_on_from_any_run_to_the_same_lines() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join("stop.toml"), STOP).unwrap();
        let axis = Axis::list("wall.stop.position", &[1e-3.into(), 5e-3.into()]).unwrap();
        let sweep = Sweep::new(CaseFile::read(dir.path().join("stop.toml")).unwrap()).vary(axis);
        let plan = sweep.measure([Measure::ForceMean]).until_interval(0.2, None).unwrap().plan().unwrap();
        let places = plan.count() * plan.runs_of_row();
        let filled = |anew: bool| {
            let place = |run: u64| Shard::WHOLE.place(&plan, run);
            let journal = Journal::open(dir.path(), JOURNAL, places, anew, place).unwrap();
            let found = journal.done();
            let (mut journal, counts) =
                plan.fill(journal, Shard::WHOLE, (2, &mut Cautioned::default()), &|_, _| {}).unwrap();
            let line = |place: u64| Block::read(&mut journal, place as usize).unwrap().map(|block| block.line);
            (found, counts.unwrap(), (0..places).map(line).collect::<Vec<_>>())
        };
        let (_, counts, lines) = filled(true);
        let all: u64 = counts.iter().sum();
        assert!(all > 2 * PILOTS && counts.iter().all(|count| *count >= PILOTS), "{counts:?}");
        let path = dir.path().join(JOURNAL);
        let whole = std::fs::read(&path).unwrap();
        let starts: Vec<usize> = (0..whole.len()).filter(|&at| whole[at..].starts_with(b"@")).collect();
        for kept in [1, PILOTS, 2 * PILOTS - 1, 2 * PILOTS, 2 * PILOTS + 1, all - 1] {
            std::fs::write(&path, &whole[..starts[kept as usize]]).unwrap();
            assert_eq!(filled(false), (kept, counts.clone(), lines.clone()));
        }
    }
}
