//! Windows: runs with the gaps of a time of a history.

use super::support::WearingSupport;
use crate::residual::Finding;
use crate::run::Caution;
use crate::statistics::WearStatistics;
use crate::study::realisations::Realisation;
use crate::wear::{Opening, WearWork};
use serde::{Deserialize, Serialize};

/// What a window tells.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct WearWindow {
    /// Its number, from 1.
    pub number: u64,
    /// What wear had made of each support that wears.
    pub openings: Vec<Opening>,
    /// The work rates of each support that wears, W.
    pub rates: Vec<WearWork>,
    /// The half widths of the 95 % intervals of the work rates of all of each support, W: of the
    /// batches of this one run.
    #[serde(default)]
    pub half_widths_95_w: Vec<Option<f64>>,
    /// What the judge refutes in its run.
    pub findings: Vec<Finding>,
    /// What limits the use of its results.
    #[serde(default)]
    pub caution: Caution,
}

impl WearWindow {
    /// What `member` tells of `supports`, which are as they were at the start.
    #[must_use]
    pub fn of(member: &Realisation, supports: &[WearingSupport]) -> Self {
        let opening = |support: &WearingSupport| support.opening(&WearWork::none(0, support.gaps.len()));
        Self::after(member, supports, supports.iter().map(opening).collect())
    }

    /// What `member` tells of `supports`, of which wear had made `openings`.
    pub(super) fn after(member: &Realisation, supports: &[WearingSupport], openings: Vec<Opening>) -> Self {
        let found = |support: &WearingSupport| member.wear.iter().find(|wear| wear.support == support.name);
        let rate = |support| found(support).map_or_else(WearWork::default, WearStatistics::rates);
        let half_width = |support| found(support).and_then(|wear| wear.work_rate_half_width_95_w);
        Self {
            number: member.number,
            openings,
            rates: supports.iter().map(rate).collect(),
            half_widths_95_w: supports.iter().map(half_width).collect(),
            findings: member.findings.clone(),
            caution: member.caution.clone(),
        }
    }

    /// The work rates if that of each support were larger by its half width; NaN of a support
    /// without one.
    pub(super) fn largest_rates(&self) -> Vec<WearWork> {
        let larger = |(support, rate): (usize, &WearWork)| {
            let half_width = self.half_widths_95_w.get(support).copied().flatten();
            rate.scaled(half_width.map_or(f64::NAN, |half_width| 1.0 + half_width / rate.total))
        };
        self.rates.iter().enumerate().map(larger).collect()
    }
}
