//! How many of several runs have notes that limit the use of their results.

use serde::Serialize;

/// Runs that have notes that limit the use of their results.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
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
    pub(crate) fn add(&mut self, run: u64, caution: Option<String>) {
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
