//! The kinds of errors.

use super::errors::Errors;
use crate::error::names;

/// One of the errors by which charts and tables compare methods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Largest difference of the displacement, over the gap.
    Displacement,
    /// Difference of the impulse at the worst wall, over the reference's total.
    Impulse,
    /// Largest shift of a contact's beginning, over the duration.
    ContactTime,
}

names!(Quantity, Displacement => "displacement", Impulse => "impulse", ContactTime => "contact time");

impl Quantity {
    /// This error of a run: `None` where there was no contact to compare; for contact times NaN
    /// where a contact is missing or spurious.
    #[must_use]
    pub fn of(self, errors: &Errors) -> Option<f64> {
        match self {
            Self::Displacement => Some(errors.displacement),
            Self::Impulse => errors.worst_impulse(),
            Self::ContactTime if errors.missing + errors.spurious > 0 => Some(f64::NAN),
            Self::ContactTime => errors.contact_time,
        }
    }
}
