//! The growth of a small change of the start, as data: when, how much, and how it was found.

use crate::scheme::Method;
use std::fmt;

/// How a growth was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// By saltation matrices along the exact motion: exactly.
    Saltation,
    /// By exact runs from starts beside the scene's: at least.
    ExactRuns,
    /// By such runs of a stepping method: at least.
    Runs(Method),
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Saltation => f.write_str("by saltation matrices along the exact motion"),
            Self::ExactRuns => f.write_str("at least, by exact runs from perturbed starts"),
            Self::Runs(method) => write!(f, "at least, by perturbing the start of a {method} run"),
        }
    }
}

/// Growth over time.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Growth {
    /// Ends of the exact run's steps, or rows of the perturbed runs, s.
    pub time: Vec<f64>,
    /// Largest singular value of the derivative there, or the growth seen, in units of the gap scale and the largest speed; at least 1 at the start. No
    /// number where perturbed runs have parted altogether.
    pub factor: Vec<f64>,
    /// How it was found.
    pub source: Source,
}
