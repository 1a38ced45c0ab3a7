//! The error of a matrix that has no factor.

use std::fmt;

/// A matrix that should be positive definite is not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct NotDefinite {
    /// The row in which its elimination found no positive pivot.
    pub row: usize,
}

impl fmt::Display for NotDefinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the matrix is not positive definite: no positive pivot in row {}", self.row)
    }
}

impl std::error::Error for NotDefinite {}
