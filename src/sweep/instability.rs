//! What a reader of the table must know: of the case, and of rows whose motion is unstable, each of
//! which says so itself, and the table is told of them once.

use super::Plan;
use super::measure::Measure;
use crate::case::{BEYOND_LIMIT, Case};
use crate::output::realisations;
use crate::run::notes::{NEGATIVE_DAMPING, unstable};
use crate::scene::Scene;

impl Plan {
    /// What a reader of the results must know of the case as it stands, and random forces that take
    /// time and memory, in words. Whether its flow is stable, each row says for itself.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let flow = self.base.unstable_in_flow();
        let own = self.base.notes().into_iter().filter(|note| flow.as_ref() != Some(note));
        own.chain(self.base.large_random_forces()).chain(self.upper_figures()).collect()
    }

    /// That the work rates among the measures are upper figures, since a support of the case as it
    /// stands has no friction.
    fn upper_figures(&self) -> Option<String> {
        let worn = |measure: &Measure| *measure == Measure::WorkRate || measure.needs_law();
        realisations::without_friction(&self.base.scene).filter(|_| self.sweep.measures.iter().any(worn))
    }
}

/// What the row of `case`, run as `scene`, says of its motion: that the flow or its damping makes
/// it unstable.
pub(super) fn of_row(case: &Case, scene: &Scene) -> Vec<String> {
    case.unstable_in_flow().into_iter().chain(unstable(scene)).collect()
}

/// True of a row whose flow is beyond the fluid-elastic limit, by what its `error` says: its work
/// rates mean nothing.
pub(super) fn is_meaningless(error: &str) -> bool {
    error.contains(BEYOND_LIMIT)
}

/// Rows of a table that say the same of their motion.
#[derive(Debug, Clone, Default, PartialEq)]
struct Rows {
    count: u64,
    /// The numbers of the first and the last of them.
    ends: [String; 2],
}

/// The rows of a table whose motion is unstable: by the flow, and by their damping.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Unstable([Rows; 2]);

/// The words by which a row is known, and what they mean.
const KINDS: [(&str, &str); 2] = [
    (
        BEYOND_LIMIT,
        "beyond the fluid-elastic limit: work rates there mean nothing, since the force of this instability is not in \
         the motion",
    ),
    (NEGATIVE_DAMPING, "unstable by negative damping: without contact their motion grows, and walls alone limit it"),
];

impl Unstable {
    /// Counts the row `number` by what its `error` says.
    pub fn count(&mut self, number: &str, error: &str) {
        for (rows, _) in self.0.iter_mut().zip(KINDS).filter(|(_, (words, _))| error.contains(words)) {
            rows.ends[usize::from(rows.count > 0)] = number.to_owned();
            rows.count += 1;
        }
    }

    /// What a reader must know of them, in a table of so many rows.
    pub fn sentences(&self, all: u64) -> impl Iterator<Item = String> {
        self.0.iter().zip(KINDS).filter(|(rows, _)| rows.count > 0).map(move |(rows, (_, meaning))| {
            let Rows { count, ends: [first, last] } = rows;
            let (are, which) =
                if *count == 1 { ("is", format!("row {first}")) } else { ("are", format!("rows {first} to {last}")) };
            let within = if *count == 1 || *count == all { "" } else { "among " };
            format!("{count} of {all} rows {are} {meaning} ({within}{which}; the column error says more)")
        })
    }
}
