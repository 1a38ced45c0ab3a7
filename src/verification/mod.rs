//! The verification manual: scenes with values that others published or that have a closed form,
//! and what this program finds for them on the machine that it runs on.
//!
//! `published.rs` has the values of other programs and benchmarks, `closed_forms.rs` those that
//! follow from a formula, each as an `entry.rs`, of the case files in `scenes/` or of built-in
//! ones; `quantity.rs` reads a value from a run. None of the values was computed by this program.

mod closed_forms;
mod entry;
mod published;
mod quantity;

use crate::error::Error;
use crate::run::Run;
use entry::{Entry, Expected};
use serde::Serialize;

/// One line of the manual, filled in.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Verified {
    /// Name of the case.
    pub case: String,
    /// The keys of the case that were changed, as `key = value`, separated by commas.
    pub changes: String,
    /// The scheme.
    pub method: String,
    /// Where the expected value comes from.
    pub source: String,
    /// What is compared.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// The expected value.
    pub expected: f64,
    /// Largest deviation allowed, in the unit of the value.
    pub tolerance: f64,
    /// Why the tolerance is what it is.
    pub reason: String,
    /// What this program finds; `None` where the run failed, was refuted, or has no such value.
    pub found: Option<f64>,
}

impl Verified {
    /// How far the value found is from the expected one.
    #[must_use]
    pub fn deviation(&self) -> Option<f64> {
        self.found.map(|found| (found - self.expected).abs())
    }

    /// Whether the value is within its tolerance.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.deviation().is_some_and(|deviation| deviation <= self.tolerance)
    }
}

impl Verified {
    /// The line of a value of an entry; `run` is `None` where nothing was run.
    fn of(entry: &Entry, expected: &Expected, run: Option<&Run>) -> Self {
        let changes: Vec<String> = entry.changes.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        Self {
            case: entry.name().to_owned(),
            changes: changes.join(", "),
            method: entry.method.to_owned(),
            source: entry.source.to_owned(),
            quantity: expected.quantity.to_owned(),
            unit: expected.unit.to_owned(),
            expected: expected.value,
            tolerance: expected.tolerance,
            reason: expected.reason.to_owned(),
            found: run.and_then(|run| (expected.found)(run)).filter(|found| found.is_finite()),
        }
    }
}

fn entries() -> impl Iterator<Item = &'static Entry> {
    closed_forms::ENTRIES.iter().chain(published::ENTRIES)
}

/// The lines of the manual before anything is run.
#[cfg(test)]
pub fn expected() -> Vec<Verified> {
    entries().flat_map(|entry| entry.values.iter().map(|value| Verified::of(entry, value, None))).collect()
}

/// Runs every entry, and calls `progress` with the share that is done. Also returns why an entry
/// could not be run, with its name; its lines have no value.
#[must_use]
pub fn verify(progress: &dyn Fn(f64)) -> (Vec<Verified>, Vec<(String, Error)>) {
    let (mut lines, mut failures) = (Vec::new(), Vec::new());
    let count = entries().count() as f64;
    for (index, entry) in entries().enumerate() {
        let outcome = entry.run();
        lines.extend(entry.values.iter().map(|value| Verified::of(entry, value, outcome.as_ref().ok())));
        failures.extend(outcome.err().map(|error| (entry.name().to_owned(), error)));
        progress((index + 1) as f64 / count);
    }
    (lines, failures)
}
