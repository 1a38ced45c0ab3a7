//! The growth of a small change of the start, as data: when, how much, and how it was found.

use crate::scheme::Method;
use std::fmt;

/// How a growth was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// By saltation matrices along the exact motion: an exact value.
    Saltation,
    /// By exact runs from perturbed starts: a lower bound.
    ExactRuns,
    /// By runs of a stepping method from perturbed starts: a lower bound.
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
    /// Largest singular value of the derivative at these times, or the growth seen, in units of the
    /// gap scale and the largest speed, for one degree of freedom that of a free vibration as wide
    /// as the gap if it is larger; at least 1. NaN where perturbed runs have separated
    /// completely.
    pub factor: Vec<f64>,
    /// How the growth was found.
    pub source: Source,
}
