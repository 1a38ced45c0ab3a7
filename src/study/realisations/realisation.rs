//! The figures of one realisation.

use super::measure::{self, Figure, Measure};
use crate::residual::Finding;
use crate::run::{Caution, Run};
use crate::statistics::{ContactPlace, WearStatistics};

/// The figures of one realisation.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Realisation {
    /// Its number, from 1.
    pub number: u64,
    /// Every measure of every place.
    pub figures: Vec<Figure>,
    /// The wear at each support.
    pub wear: Vec<WearStatistics>,
    /// What the judge refutes in its run.
    pub findings: Vec<Finding>,
    /// What limits the use of its results.
    pub caution: Caution,
    /// Share of its steps in which opposite walls pushed in turn, so that the body stood still
    /// between them.
    pub frozen_share: f64,
}

impl Realisation {
    /// The figures of `run`, which is realisation `number`.
    #[must_use]
    pub fn of(number: u64, run: &Run) -> Self {
        Self {
            number,
            figures: measure::figures(&run.statistics),
            wear: run.statistics.wear.clone(),
            findings: run.findings.clone(),
            caution: run.caution(),
            frozen_share: run.counters.frozen_steps as f64 / run.counters.steps.max(1) as f64,
        }
    }

    /// One that has nothing but these figures.
    #[cfg(any(test, feature = "cli"))]
    pub(crate) fn of_figures(number: u64, figures: Vec<Figure>) -> Self {
        Self { number, figures, wear: Vec::new(), findings: Vec::new(), caution: Caution::default(), frozen_share: 0.0 }
    }

    /// The value of `measure` at `place`.
    #[must_use]
    pub fn value(&self, place: &ContactPlace, measure: Measure) -> Option<f64> {
        self.figure(place, measure).map(|figure| figure.value)
    }

    pub(super) fn figure(&self, place: &ContactPlace, measure: Measure) -> Option<&Figure> {
        self.figures.iter().find(|figure| figure.measure == measure && figure.place == *place)
    }
}
