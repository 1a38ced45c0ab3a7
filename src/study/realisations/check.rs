//! Some realisations of a study again, with something refined.

use super::realisation::Realisation;
use serde::Serialize;
use std::fmt;

/// Most realisations that are run again.
pub const MOST_CHECKED: u64 = 6;

/// How many realisations of a study are run again with half the step: [`MOST_CHECKED`] for a
/// `verdict` on its means, else none.
#[must_use]
pub fn checked(verdict: bool) -> u64 {
    if verdict { MOST_CHECKED } else { 0 }
}

/// What is refined in a check.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Refined {
    /// The step.
    HalfStep {
        /// The halved step, s.
        step_s: f64,
        /// The order of the scheme.
        order: u32,
    },
    /// The modes.
    MoreModes {
        /// Number of modes of the study, and of the check.
        modes: [usize; 2],
    },
}

impl Refined {
    /// How many times the change is the error: of half the step 2ᵖ/(2ᵖ − 1), since all further
    /// halvings change 2⁻ᵖ times as much each.
    pub(super) fn factor(self) -> f64 {
        match self {
            Self::HalfStep { order, .. } => {
                let ratio = 2.0_f64.powi(order as i32);
                ratio / (ratio - 1.0)
            }
            Self::MoreModes { .. } => 1.0,
        }
    }

    pub(super) fn is_step(self) -> bool {
        matches!(self, Self::HalfStep { .. })
    }
}

impl fmt::Display for Refined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::HalfStep { .. } => f.write_str("half the step"),
            Self::MoreModes { modes: [_, more] } => write!(f, "{more} modes"),
        }
    }
}

/// The first realisations of a study again, with something refined.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Check {
    /// What is refined.
    pub refined: Refined,
    /// How many realisations were run again.
    pub count: usize,
    /// Numbers of those that the judge refutes: then nothing follows from the check.
    pub refuted: Vec<u64>,
    /// Those realisations.
    #[serde(skip)]
    pub members: Vec<Realisation>,
}

impl Check {
    /// The check by `members`, realisations of the study under the same numbers.
    #[must_use]
    pub fn new(refined: Refined, members: Vec<Realisation>) -> Self {
        let refuted = members.iter().filter(|member| !member.findings.is_empty()).map(|member| member.number);
        Self { refined, count: members.len(), refuted: refuted.collect(), members }
    }
}
