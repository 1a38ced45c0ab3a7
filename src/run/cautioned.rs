//! How many of several runs have notes that limit the use of their results.

use serde::{Deserialize, Serialize};

/// The share of runs that have settled and are said not to have.
const UNSETTLED_BY_CHANCE: f64 = 0.05;

/// Standard deviations above its mean that a count of runs reaches by chance in one study of
/// twenty.
const BY_CHANCE: f64 = 1.645;

/// What limits the use of the results of one run.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Caution {
    /// The first of its notes that do ([`Run::cautions`](crate::Run::cautions)).
    pub note: Option<String>,
    /// That its window begins before the motion has settled
    /// ([`Run::unsettled`](crate::Run::unsettled)).
    pub unsettled: Option<String>,
}

/// Runs with a note, and the number and the note of the first of them.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct NotedRuns {
    /// Number of runs.
    pub count: u64,
    /// The number of the first of them, and its note.
    pub first: Option<(u64, String)>,
}

/// Runs that have notes that limit the use of their results.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Cautioned {
    /// Number of runs that were looked at.
    pub runs: u64,
    /// Those with notes on their step, scheme, energy or walls.
    pub noted: NotedRuns,
    /// Those whose window begins before the motion has settled, of which one in twenty is found by
    /// chance.
    pub unsettled: NotedRuns,
}

impl NotedRuns {
    /// Counts run number `run` if it has a `note`, in whatever order runs end.
    fn add(&mut self, run: u64, note: Option<String>) {
        let Some(note) = note else { return };
        self.count += 1;
        if self.first.as_ref().is_none_or(|(first, _)| run < *first) {
            self.first = Some((run, note));
        }
    }

    /// That so many of `runs` runs are `what`, with the note of the first; `None` where none is.
    fn sentence(&self, runs: u64, what: &str) -> Option<String> {
        let (_, first) = self.first.as_ref()?;
        Some(format!("{} of {runs} runs {what}; the first: {first}", self.count))
    }
}

impl Cautioned {
    /// Counts run number `run` and its `caution`, in whatever order runs end.
    pub fn add(&mut self, run: u64, caution: Caution) {
        self.runs += 1;
        self.noted.add(run, caution.note);
        self.unsettled.add(run, caution.unsettled);
    }

    /// The same in sentences; none of runs that have not settled where so many are found by chance
    /// among runs that have: no more than the mean of the binomial distribution, and what one study
    /// in twenty exceeds.
    pub fn sentences(&self) -> impl Iterator<Item = String> {
        let mean = UNSETTLED_BY_CHANCE * self.runs as f64;
        let by_chance = mean + BY_CHANCE * (mean * (1.0 - UNSETTLED_BY_CHANCE)).sqrt() + 0.5;
        let beyond_chance = self.unsettled.count as f64 > by_chance;
        let noted = self.noted.sentence(self.runs, "have notes that limit the use of their results");
        let unsettled = self.unsettled.sentence(self.runs, "have not settled where their statistics begin");
        noted.into_iter().chain(unsettled.filter(|_| beyond_chance))
    }
}

#[cfg(test)]
mod tests {
    use super::{Caution, Cautioned};

    #[test]
    fn runs_that_have_not_settled_are_told_beyond_what_chance_finds() {
        // Most runs of which so many are told by chance in less than one study in twenty: the
        // binomial distribution P(X ≥ k) at p = 0.05, with 0.05 for one of one run.
        for (runs, told) in [(1, 1), (6, 2), (24, 4), (1000, 62)] {
            let of = |unsettled: u64| {
                let mut found = Cautioned::default();
                for run in (1..=runs).rev() {
                    let unsettled = (run <= unsettled).then(|| format!("still settling, run {run}"));
                    found.add(run, Caution { note: None, unsettled });
                }
                found.sentences().collect::<Vec<_>>()
            };
            assert_eq!(of(told - 1), [""; 0], "{runs}");
            let text = format!("{told} of {runs} runs have not settled where their statistics begin; the first: ");
            assert_eq!(of(told), [text + "still settling, run 1"], "{runs}");
        }
    }
}
