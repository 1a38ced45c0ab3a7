//! Factors of the matrices of a step.

use crate::error::{Error, Result};
use crate::linear::{Factor, NotDefinite, Symmetric};
use crate::scene::SharedStructure;

/// The factor of a matrix of a step.
pub(super) fn factor(a: &Symmetric) -> Result<Factor> {
    Factor::new(a).map_err(refused)
}

/// The factor of M, which the scene has already.
pub(super) fn mass_factor(structure: &SharedStructure) -> Result<Factor> {
    structure.mass_factor().map_err(refused)
}

fn refused(fault: NotDefinite) -> Error {
    Error::invalid(("system", "matrices"), fault, "a positive definite mass")
}
