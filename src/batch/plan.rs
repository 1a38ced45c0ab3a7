//! The duration of a batch, and the threads and instructions that compute it.

use super::lane::Lane;
use super::outcome::{Batch, Outcome};
use super::width::Width;
use super::work::Work;
use crate::error::{Error, Result, Subject};
use crate::parallel::cores;
use std::sync::Mutex;

/// Number of oscillators that a thread takes at a time.
const SHARE: usize = 256;

/// Maximum number of recorded states of a batch: 16 bytes each.
const MOST_STROBES: usize = 1 << 32;

/// The duration of a batch, and the threads and instructions that compute it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plan {
    /// Periods of each oscillator before the window.
    pub settle: u32,
    /// Periods of the window, 1 or more.
    pub keep: u32,
    /// Number of threads; 0 for all cores of the machine. Results do not depend on it.
    pub threads: usize,
    /// The instructions, which decide how many lanes are computed together.
    pub width: Width,
}

impl Plan {
    /// `settle` periods, then a window of `keep`, on all cores and with the widest instructions of
    /// this machine.
    #[must_use]
    pub fn new(settle: u32, keep: u32) -> Self {
        Self { settle, keep, threads: 0, width: Width::Widest }
    }

    /// Computes every oscillator.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an invalid oscillator, a window without a period, instructions that
    /// this machine does not have, more states than its memory holds. The error of an oscillator
    /// that could not be computed is in its place of [`Batch::outcomes`].
    pub fn run(&self, lanes: &[Lane]) -> Result<Batch> {
        self.width.check()?;
        if self.keep == 0 {
            return Err(Error::invalid("keep", 0, "1 period or more"));
        }
        let keep = self.keep as usize;
        let strobes = lanes.len().saturating_mul(keep);
        if strobes > MOST_STROBES {
            return Err(Error::invalid(
                "strobes",
                format!("{strobes:e}"),
                "at most 4e9: fewer periods kept, or oscillators",
            ));
        }
        for (index, lane) in lanes.iter().enumerate() {
            lane.validate().map_err(|error| match error {
                Error::Invalid { subject, value, expected } => {
                    Error::Invalid { subject: subject.within(Subject::nth("oscillator", index)), value, expected }
                }
                other => other,
            })?;
        }
        let mut strobes = room(strobes)?;
        let mut outcomes: Vec<Option<Result<Outcome>>> = vec![None; lanes.len()];
        let shares = lanes.chunks(SHARE).zip(outcomes.chunks_mut(SHARE)).zip(strobes.chunks_mut(SHARE * keep));
        let queue = Mutex::new(shares);
        let work = || loop {
            // A thread that panicked leaves the queue valid, without the oscillators that it took.
            let next = queue.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).next();
            let Some(((lanes, outcomes), strobes)) = next else { return };
            Work { lanes, outcomes, strobes, settle: self.settle, keep: self.keep }.run(self.width);
        };
        let threads = match self.threads {
            0 => cores(),
            some => some,
        };
        std::thread::scope(|scope| {
            for _ in 1..threads.min(lanes.len().div_ceil(SHARE)) {
                scope.spawn(work);
            }
            work();
        });
        let missed = || Err(Error::invalid("oscillator", "not followed", "an outcome"));
        let outcomes = outcomes.into_iter().map(|outcome| outcome.unwrap_or_else(missed)).collect();
        Ok(Batch { keep, strobes, outcomes })
    }
}

/// As many states, not computed yet, where there is memory for them.
fn room(count: usize) -> Result<Vec<[f64; 2]>> {
    let mut states = Vec::new();
    if states.try_reserve_exact(count).is_err() {
        let found = format!("{count:e}, of 16 bytes each");
        return Err(Error::invalid(
            "strobes",
            found,
            "as many as there is memory for: fewer periods kept, or oscillators",
        ));
    }
    states.resize(count, [f64::NAN; 2]);
    Ok(states)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_beyond_all_memory_are_refused() {
        let refused = room(1 << 60).unwrap_err();
        assert!(refused.is_request() && refused.to_string().starts_with("strobes is 1."), "{refused}");
        assert_eq!(room(3).map(|states| states.len()), Ok(3));
    }
}
