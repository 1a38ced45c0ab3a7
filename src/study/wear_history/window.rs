//! Windows: runs with the gaps of a time of a history.

use super::support::WearingSupport;
use crate::residual::Finding;
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
    /// What the judge refutes in its run.
    pub findings: Vec<Finding>,
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
        let rate = |support: &WearingSupport| {
            let found = member.wear.iter().find(|wear| wear.support == support.name);
            found.map_or_else(WearWork::default, WearStatistics::rates)
        };
        let rates = supports.iter().map(rate).collect();
        Self { number: member.number, openings, rates, findings: member.findings.clone() }
    }
}
