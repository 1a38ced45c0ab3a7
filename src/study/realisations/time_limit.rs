//! How many realisations fit into a time.

use crate::error::{Error, Result};
use std::time::Instant;

/// The time that a study may take, by the clock. What a given number of realisations gives does not
/// depend on it; their number does, and so on the machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeLimit {
    began: Instant,
    seconds: f64,
    runs_each: f64,
}

impl TimeLimit {
    /// So many seconds from now on.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `most_time` for a number that is not above 0.
    pub fn from_now(seconds: f64) -> Result<Self> {
        if !(seconds.is_finite() && seconds > 0.0) {
            return Err(Error::invalid("most_time", format_args!("{seconds:?} s"), "a time above 0"));
        }
        Ok(Self { began: Instant::now(), seconds, runs_each: 1.0 })
    }

    /// The same where every realisation costs so many runs in all.
    pub(super) fn with_runs_each(self, runs_each: f64) -> Self {
        Self { runs_each, ..self }
    }

    /// The time, s.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// The most realisations that fit into what is left of the time after so many `pilots`, where a
    /// run takes `run_s` seconds, as many at once as there are cores, and `others` runs have to be
    /// made besides.
    pub(super) fn affordable(&self, pilots: u64, run_s: f64, others: f64) -> u64 {
        fitting(pilots, self.seconds - self.began.elapsed().as_secs_f64(), run_s, others, self.runs_each)
    }
}

/// The most realisations of `runs_each` runs each, of which the `pilots` have had their first,
/// that fit into `left` seconds beside `others` runs; never fewer than the pilots.
fn fitting(pilots: u64, left: f64, run_s: f64, others: f64, runs_each: f64) -> u64 {
    let runs = left / run_s - others + pilots as f64;
    // Rounding shall not lose a realisation; infinite where runs take no time.
    ((runs / runs_each * (1.0 + f64::EPSILON)).floor().max(0.0) as u64).max(pilots)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_of_the_time_is_spent_on_whole_realisations_after_the_checks() {
        // 60 s left at 2 s a run are 30 runs; 12 of them with half the step leave 18, beside the 6
        // that have been made.
        assert_eq!(fitting(6, 60.0, 2.0, 12.0, 1.0), 24);
        assert_eq!(fitting(6, 61.9, 2.0, 12.0, 1.0), 24);
        assert_eq!(fitting(6, 62.0, 2.0, 12.0, 1.0), 25);
        // Of histories of seven windows each: 7 N - 6 runs are 30 at most.
        assert_eq!(fitting(6, 72.0, 2.0, 0.0, 7.0), 6);
        assert_eq!(fitting(6, 2.0 * (7.0 * 9.0 - 6.0), 2.0, 0.0, 7.0), 9);
        // The pilots have been made, however late it is; and runs without a duration always fit.
        assert_eq!((fitting(6, -5.0, 2.0, 12.0, 1.0), fitting(6, 1.0, 2.0, 12.0, 1.0)), (6, 6));
        assert_eq!(fitting(6, 1.0, 0.0, 12.0, 1.0), u64::MAX);
    }

    #[test]
    fn a_time_that_is_none_is_refused_by_name() {
        for seconds in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = TimeLimit::from_now(seconds).unwrap_err();
            assert!(error.is_request() && error.to_string().starts_with("most_time is "), "{error}");
        }
        assert_eq!(TimeLimit::from_now(90.0).unwrap().seconds(), 90.0);
    }
}
