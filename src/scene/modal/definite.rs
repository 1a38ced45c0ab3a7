//! Checks that the mass matrix is positive definite, as modes require, and finds the row that
//! violates this.

use crate::error::{Error, Result};
use crate::linear::{Factor, Symmetric};
use crate::scene::structure::matrix_of;

/// The factor of `mass`; an error unless it is positive definite.
pub(super) fn definite(mass: &Symmetric) -> Result<Factor> {
    match Factor::new(mass) {
        Ok(factor) => Ok(factor),
        Err(fault) => {
            let key = matrix_of("mass").row(fault.row);
            let value = mass.get(fault.row, fault.row);
            Err(Error::invalid(key, format_args!("{value:?} on the diagonal"), "a positive definite matrix"))
        }
    }
}
