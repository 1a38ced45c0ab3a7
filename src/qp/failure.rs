//! Why a programme was not solved.

use std::fmt;

/// Why a programme was refused or not solved. Rows are numbered from 0; only the caller knows what
/// they stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Failure {
    /// A is not symmetric positive definite.
    NotPositiveDefinite,
    /// The bounds of a row cannot be met together with those of another.
    Infeasible {
        /// The row that could not be met; its lower bound where two opposite bounds cross.
        row: usize,
        /// The row whose bound it conflicts with: the same row where its own lower bound lies above
        /// its upper bound.
        against: usize,
    },
    /// A number is NaN, or infinite or negative where only finite or non-negative ones are allowed.
    NotFinite {
        /// Which array.
        what: &'static str,
        /// Which entry of it (of a matrix: column by column).
        index: usize,
    },
    /// The solver gave up.
    NotSolved {
        /// What the solver reported.
        status: &'static str,
    },
    /// Sizes of arrays do not fit together.
    Shape {
        /// Which size.
        what: &'static str,
        /// What it should be.
        expected: usize,
        /// What it is.
        found: usize,
    },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPositiveDefinite => write!(f, "the step's matrix is not symmetric positive definite"),
            Self::Infeasible { row, against } if row == against => {
                write!(f, "the bounds of row {row} cross: the lower one lies above the upper one")
            }
            Self::Infeasible { row, against } => {
                write!(f, "the bounds of rows {row} and {against} cannot be met together")
            }
            Self::NotFinite { what, index } => write!(f, "{what}[{index}] is not a usable number"),
            Self::NotSolved { status } => write!(f, "the solver stopped without a solution: {status}"),
            Self::Shape { what, expected, found } => write!(f, "number of {what}: {found}; expected {expected}"),
        }
    }
}

impl std::error::Error for Failure {}

#[cfg(test)]
mod tests;
