//! An estimate of the time and size of a sweep, from its first rows.

use super::found::RowsFound;
use super::plan::Plan;
use super::shard::Shard;
use crate::parallel::cores;
use std::time::{Duration, Instant};

/// Estimate of the time and size of a sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Estimate {
    /// Number of rows, or of their realisations, that were computed for the estimate.
    pub tried: u64,
    /// Number of these that failed.
    pub failed: u64,
    /// Time of the whole sweep, s of wall-clock time on that number of threads; where the intervals
    /// of rows decide how many runs there are, of the first ones.
    pub seconds: f64,
    /// The cores of this machine.
    pub threads: usize,
    /// Size of its tables, bytes; while it runs, the journal takes the same again.
    pub bytes: f64,
}

impl Plan {
    /// Estimates time and size of the whole sweep from its first rows, computed for `patience` or a
    /// little longer; nothing is written.
    #[must_use]
    pub fn estimate(&self, patience: Duration) -> Estimate {
        let started = Instant::now();
        let (mut tried, mut bytes, mut failed) = (0, 0, 0);
        let found = RowsFound::default();
        let runs = self.first_runs(Shard::WHOLE);
        for group in 0..self.groups(Shard::WHOLE, &runs) {
            // Fails only where the function that it gets does.
            let _ = self.group(group, (Shard::WHOLE, &runs), &found, &mut |row| {
                tried += 1;
                failed += u64::from(!row.status.is_good());
                bytes += self.line(&row).len() + self.sample_lines(&row).len();
                Ok(started.elapsed() <= patience)
            });
            if started.elapsed() > patience {
                break;
            }
        }
        let all = self.runs() as f64 / (tried as f64).max(1.0);
        let threads = cores();
        // A chain runs on one thread.
        let abreast = (threads as f64).min(runs.count() as f64);
        let seconds = started.elapsed().as_secs_f64() * all / abreast;
        Estimate { tried, failed, seconds, threads, bytes: bytes as f64 * all }
    }
}
