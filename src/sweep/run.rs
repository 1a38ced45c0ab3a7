//! Rows computed on several threads: into memory, or into a folder, from where they can be gone on
//! with.

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
use crate::output::atomic::check_folder;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Rows on their way to the journal, a thread.
const WAITING: usize = 64;

/// How often progress is told.
const TELL: Duration = Duration::from_millis(100);

/// How a sweep is run into a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Manner {
    /// Threads; all cores where there is none.
    pub threads: Option<usize>,
    /// Which part of it.
    pub shard: Shard,
    /// True to begin anew, whatever the folder holds.
    pub force: bool,
}

/// How far a sweep has come.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// Rows that are done, those of earlier processes among them.
    pub done: u64,
    /// Rows in all.
    pub rows: u64,
    /// Rows of this process a second; 0 before the first.
    pub rate: f64,
}

/// What a finished sweep amounts to.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Finished {
    /// Where its tables are.
    pub folder: PathBuf,
    /// Rows, and how many of them were there before this process.
    pub rows: u64,
    /// Rows that an earlier process had computed.
    pub found: u64,
    /// Rows by what became of them.
    pub tables: Tables,
    /// Seconds of this process.
    pub seconds: f64,
    /// Threads of this process.
    pub threads: usize,
}

impl Plan {
    /// All rows, in their order, on so many threads. For what fits into memory; [`Plan::run_into`]
    /// is for the rest.
    ///
    /// # Errors
    /// None of a row: those are in [`Row::status`] and [`Row::error`].
    pub fn rows(&self, threads: usize) -> Result<Vec<Row>> {
        let all = Mutex::new(Vec::new());
        self.compute(Shard::WHOLE, threads.max(1), &AtomicBool::new(false), &Found::default(), &|rows| {
            all.lock().unwrap_or_else(PoisonError::into_inner).push(rows);
            true
        })?;
        let mut rows = all.into_inner().unwrap_or_else(PoisonError::into_inner);
        rows.sort_by_key(|row: &Row| row.number);
        Ok(rows)
    }

    /// Runs the sweep into `folder`: `sweep.csv`, `samples.csv` where instants are asked for, and
    /// `request.json`. Killed at any instant and started again it goes on, and ends with the same
    /// bytes, whatever the number of threads. `progress` is told now and then how far it is.
    ///
    /// # Errors
    /// [`Error::Io`] for a folder of another request, one in which another process is at work, and
    /// a disk that refuses.
    pub fn run_into(&self, folder: &Path, manner: Manner, progress: &dyn Fn(Progress)) -> Result<Finished> {
        let started = Instant::now();
        let folder = manner.shard.folder(folder);
        let request = folder::of_shard(self.request(), manner.shard);
        let state = folder::look(&folder, &request, manner.force)?;
        check_folder(&folder)?;
        let all = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = manner.threads.unwrap_or(all).max(1);
        let rows = manner.shard.chains(self.chains) * self.chain_rows();
        if state == State::Finished {
            let tables = Tables::read(&folder.join(TABLE))?;
            let _ = std::fs::remove_file(folder.join(JOURNAL));
            return Ok(Finished { folder, rows, found: rows, tables, seconds: 0.0, threads });
        }
        let place = |row: u64| manner.shard.place(self, row);
        let journal = Journal::open(&folder, rows, state == State::Empty, place)?;
        let study = Study::of(self)?;
        folder::say(&folder, &request, &study, manner.shard, false)?;
        let found = journal.done();
        let mut journal = self.fill(journal, manner.shard, threads, &|done| {
            let new = done - found;
            let rate = if new > 0 { new as f64 / started.elapsed().as_secs_f64() } else { 0.0 };
            progress(Progress { done, rows, rate });
        })?;
        let tables = write_tables(self, &folder, &mut journal, rows)?;
        folder::say(&folder, &request, &study, manner.shard, true)?;
        journal.remove();
        Ok(Finished { folder, rows, found, tables, seconds: started.elapsed().as_secs_f64(), threads })
    }

    /// Computes what is not in the journal yet.
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
            // Workers that wait for room in the channel see that nobody reads it.
            drop(receiver);
            let computed = workers.join().unwrap_or_else(|_| Err(lost()));
            written.and(computed)
        });
        // What came in before the disk refused is kept, as far as it goes.
        let flushed = journal.flush();
        outcome.and(flushed)?;
        tell(journal.done());
        Ok(journal)
    }

    /// Computes the chains of `shard` on `threads` threads, each from where it was `found`, and
    /// hands every row to `take` in the order of its chain; ends early where that returns false, or
    /// `stop` is set. Chains are begun in their order: rows of a journal are nearly so.
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
                    // A row that failed leaves no state: the next one starts as the case does.
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

    /// What the whole sweep will take, from its first rows: nothing is written.
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

/// What earlier processes have done.
#[derive(Debug, Default)]
struct Found {
    /// Of each chain how many rows; nothing where nothing is done.
    done: Vec<u32>,
    /// The states from which chains go on that were interrupted.
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

    /// How many rows of chain number `own` are done, and where the next one starts.
    fn chain(&self, own: u64) -> (u64, Option<crate::scene::State>) {
        let done = self.done.get(own as usize).copied().unwrap_or(0);
        (u64::from(done), self.states.get(&own).cloned())
    }
}

/// What a sweep will take.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Estimate {
    /// Rows that were tried, and how many of them failed.
    pub tried: u64,
    /// How many of these failed.
    pub failed: u64,
    /// All of it, s of wall-clock time on so many threads.
    pub seconds: f64,
    /// The cores of this machine.
    pub threads: usize,
    /// Its tables, bytes; while it runs the journal takes as much again.
    pub bytes: f64,
}

impl Finished {
    /// The error of a sweep of which nothing came of any row, or of one row under `strict`.
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

/// A thread that ended by a panic, which is a defect of this program.
fn lost() -> Error {
    Error::io("a thread of the sweep", "it has ended by a defect of this program".to_owned(), false)
}
