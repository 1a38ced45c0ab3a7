//! Computes the rows on several threads, into memory, or into a folder, where an interrupted sweep
//! can be continued.

use super::batched::TOGETHER;
use super::finish::{Tables, write_tables};
use super::folder::{self, State, Study};
use super::journal::{Block, JOURNAL, Journal};
use super::plan::{Plan, Point};
use super::request::Kernel;
use super::row::{Row, Status};
use super::shard::Shard;
use super::table::TABLE;
use crate::error::{Error, Result};
use crate::interrupt::Carried;
use crate::output::format::Format;
use crate::output::results::Results;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Capacity of the channel to the journal, in rows per thread.
const WAITING: usize = 64;

/// Interval between reports of progress.
const TELL: Duration = Duration::from_millis(100);

/// Options for running a sweep into a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Manner {
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
    /// Rows done, including those of earlier processes.
    pub done: u64,
    /// Number of rows.
    pub rows: u64,
    /// Rows of this process per second; 0 before the first.
    pub rate: f64,
}

/// The result of a finished sweep.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Finished {
    /// Folder of its tables.
    pub folder: PathBuf,
    /// Number of rows.
    pub rows: u64,
    /// Number of rows that earlier processes had computed.
    pub found: u64,
    /// Number of rows by status.
    pub tables: Tables,
    /// Which table of earlier results was emptied, shortened, changed or removed, so that the rows
    /// were computed again.
    pub damaged: Option<String>,
    /// Wall-clock time of this process, s.
    pub seconds: f64,
    /// Number of threads of this process.
    pub threads: usize,
}

impl Plan {
    /// All rows, in their order, computed on `threads` threads and kept in memory;
    /// [`Plan::run_into`] writes them to disk.
    ///
    /// # Errors
    /// Errors of single rows are not returned: they are in [`Row::status`] and [`Row::error`].
    pub fn rows(&self, threads: usize) -> Result<Vec<Row>> {
        let all = Mutex::new(Vec::new());
        self.compute(Shard::WHOLE, threads.max(1), &AtomicBool::new(false), &Found::default(), &|rows| {
            all.lock().unwrap_or_else(PoisonError::into_inner).push(rows);
            true
        })?;
        let mut rows = all.into_inner().unwrap_or_else(PoisonError::into_inner);
        rows.sort_by_key(|row: &Row| row.number);
        self.number(&mut rows);
        Ok(rows)
    }

    /// Runs the sweep into `folder`: `sweep.csv`, `samples.csv` if instants are requested, and
    /// `request.json`. After an interruption at any instant, the same call continues, and ends with
    /// the same bytes, whatever the number of threads. Finished tables are read: where one is no
    /// longer as it was written, all rows are computed again. `progress` is called from time to
    /// time.
    ///
    /// # Errors
    /// [`Error::Io`] for a folder with results of another request, one that another process is
    /// writing to, and if writing fails.
    pub fn run_into(&self, folder: &Path, manner: Manner, progress: &dyn Fn(Progress)) -> Result<Finished> {
        self.run_in(folder, manner, Vec::new(), progress, &|_| ()).map(|(finished, _)| finished)
    }

    /// As [`Plan::run_into`]; also returns the folder, in whose place files can be added, pictures
    /// in each of `formats`. `told` is called with what the folder holds that is damaged, before
    /// its rows are computed again.
    pub(crate) fn run_in(
        &self,
        folder: &Path,
        manner: Manner,
        formats: Vec<Format>,
        progress: &dyn Fn(Progress),
        told: &dyn Fn(&str),
    ) -> Result<(Finished, Results)> {
        let started = Instant::now();
        let folder = manner.shard.folder(folder);
        let request = folder::of_shard(self.request(), manner.shard);
        let mut results = Results::open(&folder, request, manner.force, formats)?;
        folder::tell(&mut results, &Study::of(self)?, manner.shard);
        let all = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = manner.threads.unwrap_or(all).max(1);
        let rows = manner.shard.chains(self.chains) * self.chain_rows();
        let state = if manner.force { State::Empty } else { folder::state(&folder, rows) };
        let mut damaged = None;
        let anew = matches!(state, State::Empty);
        match state {
            State::Finished { tables, records } => {
                // What an interruption after the last row has left.
                let _ = std::fs::remove_file(folder.join(JOURNAL));
                results.keep(records);
                let finished = Finished { folder, rows, found: rows, tables, damaged, seconds: 0.0, threads };
                return Ok((finished, results));
            }
            State::Damaged(what) => {
                told(&what);
                damaged = Some(what);
            }
            State::Empty | State::Begun => {}
        }
        let place = |row: u64| manner.shard.place(self, row);
        let journal = Journal::open(&folder, rows, anew, place)?;
        results.begin(JOURNAL)?;
        let found = journal.done();
        let mut journal = self.fill(journal, manner.shard, threads, &|done| {
            let new = done - found;
            let rate = if new > 0 { new as f64 / started.elapsed().as_secs_f64() } else { 0.0 };
            progress(Progress { done, rows, rate });
        })?;
        let tables = write_tables(self, &mut results, &mut journal, rows)?;
        results.finish()?;
        let seconds = started.elapsed().as_secs_f64();
        Ok((Finished { folder, rows, found, tables, damaged, seconds, threads }, results))
    }

    /// Computes the rows that are not yet in the journal.
    fn fill(&self, mut journal: Journal, shard: Shard, threads: usize, tell: &dyn Fn(u64)) -> Result<Journal> {
        let found = Found::of(self, &mut journal, shard)?;
        let stop = AtomicBool::new(false);
        let (sender, receiver) = sync_channel::<(u64, Block)>(WAITING * threads);
        let outcome = std::thread::scope(|scope| {
            let (found, stop) = (&found, &stop);
            let interrupt = Carried::here();
            let workers = scope.spawn(move || {
                let sender: SyncSender<(u64, Block)> = sender;
                let take = |row: Row| sender.send((row.number, self.block(row))).is_ok();
                interrupt.over(|| self.compute(shard, threads, stop, found, &take))
            });
            let mut told = Instant::now();
            let mut written = Ok(());
            loop {
                match receiver.recv_timeout(TELL) {
                    Ok((row, block)) => {
                        let place = shard.place(self, row).unwrap_or(usize::MAX);
                        written = journal.add(row, place, &block);
                        if written.is_err() {
                            stop.store(true, Ordering::Relaxed);
                            break;
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => break,
                }
                if told.elapsed() > TELL {
                    told = Instant::now();
                    tell(journal.done());
                }
            }
            // Dropping the receiver ends the workers that wait to send.
            drop(receiver);
            let computed = workers.join().unwrap_or_else(|_| Err(lost()));
            written.and(computed)
        });
        // Rows received before writing failed are kept.
        let flushed = journal.flush();
        outcome.and(flushed)?;
        tell(journal.done());
        Ok(journal)
    }

    /// Computes the chains of `shard` on `threads` threads, each from the row after those `found`,
    /// and passes every row to `take`, those of a chain in their order; ends early if that returns
    /// false, or if `stop` is set. Chains begin in their order, so the rows of a journal are nearly
    /// sorted.
    fn compute(
        &self,
        shard: Shard,
        threads: usize,
        stop: &AtomicBool,
        found: &Found,
        take: &(dyn Fn(Row) -> bool + Sync),
    ) -> Result<()> {
        let chains = shard.chains(self.chains);
        let next = AtomicU64::new(0);
        let interrupt = Carried::here();
        let together = if self.sweep.kernel == Kernel::Batch { TOGETHER } else { 1 };
        let work = || -> Result<()> {
            loop {
                let own = next.fetch_add(together, Ordering::Relaxed);
                if own >= chains {
                    return Ok(());
                }
                if self.sweep.kernel == Kernel::Batch {
                    let open = (own..chains.min(own + together)).filter(|own| found.chain(*own).0 == 0);
                    let points: Vec<Point> = open.map(|own| self.point(shard.chain(own), 0)).collect();
                    if stop.load(Ordering::Relaxed) {
                        return Ok(());
                    }
                    let rows = self.batched(&points);
                    interrupt.check()?;
                    if !rows.into_iter().all(take) {
                        return Ok(());
                    }
                    continue;
                }
                let (done, mut state) = found.chain(own);
                for along in done..self.chain_rows() {
                    if stop.load(Ordering::Relaxed) {
                        return Ok(());
                    }
                    let row = self.row(&self.point(shard.chain(own), along), state.as_ref());
                    interrupt.check()?;
                    // A row that failed leaves no state: the next one starts from the case's
                    // initial state.
                    state = row.end.clone().filter(|_| self.sweep.followed().is_some());
                    if !take(row) {
                        return Ok(());
                    }
                }
            }
        };
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..threads).map(|_| scope.spawn(|| interrupt.over(work))).collect();
            workers.into_iter().try_for_each(|worker| worker.join().unwrap_or_else(|_| Err(lost())))
        })
    }

    fn block(&self, row: Row) -> Block {
        let (line, samples) = (self.line(&row), self.sample_lines(&row));
        Block { end: row.end.filter(|_| self.sweep.followed().is_some()), line, samples }
    }

    /// Estimates time and size of the whole sweep from its first rows; nothing is written.
    #[must_use]
    pub fn estimate(&self, patience: Duration) -> Estimate {
        let started = Instant::now();
        let (mut rows, mut bytes, mut failed) = (0, 0, 0);
        let batched = self.sweep.kernel == Kernel::Batch;
        if batched {
            let points: Vec<Point> = (0..self.chains.min(TOGETHER)).map(|chain| self.point(chain, 0)).collect();
            for row in self.batched(&points) {
                rows += 1;
                failed += u64::from(!row.status.is_good());
                bytes += (self.line(&row).len() + self.sample_lines(&row).len()) as u64;
            }
        }
        'rows: for chain in 0..if batched { 0 } else { self.chains } {
            let mut state = None;
            for along in 0..self.chain_rows() {
                let row = self.row(&self.point(chain, along), state.as_ref());
                rows += 1;
                failed += u64::from(!row.status.is_good());
                bytes += (self.line(&row).len() + self.sample_lines(&row).len()) as u64;
                state = row.end.filter(|_| self.sweep.followed().is_some());
                if started.elapsed() > patience {
                    break 'rows;
                }
            }
        }
        let all = self.count() as f64 / f64::from(rows as u32).max(1.0);
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        // A chain runs on one thread.
        let abreast = (threads as f64).min(self.chains as f64);
        Estimate {
            tried: rows,
            failed,
            seconds: started.elapsed().as_secs_f64() * all / abreast,
            threads,
            bytes: bytes as f64 * all,
        }
    }
}

/// The rows that earlier processes have computed.
#[derive(Debug, Default)]
struct Found {
    /// Number of rows done of each chain; empty if none is done.
    done: Vec<u32>,
    /// The states from which interrupted chains continue.
    states: BTreeMap<u64, crate::scene::State>,
}

impl Found {
    fn of(plan: &Plan, journal: &mut Journal, shard: Shard) -> Result<Self> {
        let mut found = Self::default();
        if journal.done() == 0 {
            return Ok(found);
        }
        let length = plan.chain_rows();
        for own in 0..shard.chains(plan.chains) {
            let place = |along: u64| (own * length + along) as usize;
            let done = (0..length).find(|&along| !journal.has(place(along))).unwrap_or(length);
            if plan.sweep.followed().is_some() && done > 0 && done < length {
                let last = journal.read(place(done - 1))?.and_then(|block| block.end);
                found.states.extend(last.map(|state| (own, state)));
            }
            found.done.push(done as u32);
        }
        Ok(found)
    }

    /// Number of rows done of chain number `own`, and the state from which the next one starts.
    fn chain(&self, own: u64) -> (u64, Option<crate::scene::State>) {
        let done = self.done.get(own as usize).copied().unwrap_or(0);
        (u64::from(done), self.states.get(&own).cloned())
    }
}

/// Estimate of the time and size of a sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Estimate {
    /// Number of rows that were computed for the estimate.
    pub tried: u64,
    /// Number of these that failed.
    pub failed: u64,
    /// Time of the whole sweep, s of wall-clock time on that number of threads.
    pub seconds: f64,
    /// The cores of this machine.
    pub threads: usize,
    /// Size of its tables, bytes; while it runs, the journal takes the same again.
    pub bytes: f64,
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

/// The error for a thread that panicked, which is a defect of this program.
fn lost() -> Error {
    Error::io("a thread of the sweep", "it has panicked, which is a defect of this program".to_owned(), false)
}
