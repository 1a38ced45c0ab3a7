//! Modes need a mass matrix that is positive definite: the check, with the row that fails it.

use crate::error::{Error, Result};
use crate::linear::{Factor, Symmetric};

/// The factor of `mass`; an error unless it is positive definite.
pub(super) fn definite(mass: &Symmetric) -> Result<Factor> {
    match Factor::new(mass) {
        Ok(factor) => Ok(factor),
        Err(fault) => {
            let key = format!("system: mass matrix, row {}", fault.row + 1);
            let value = mass.get(fault.row, fault.row);
            Err(Error::invalid(key, format_args!("{value:?} on the diagonal"), "a positive definite matrix"))
        }
    }
}
