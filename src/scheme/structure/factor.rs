//! Factors of the matrices of a step.

use crate::error::{Error, Result};
use crate::linear::{Factor, Symmetric};

/// The factor of a matrix of a step.
pub(super) fn factor(a: &Symmetric) -> Result<Factor> {
    Factor::new(a).map_err(|fault| Error::invalid("system: matrices", fault, "a positive definite mass"))
}
