//! Stretches of a run that the exact scheme leaves to moreau-jean.

use serde::{Deserialize, Serialize};

/// A stretch with more impacts than the exact scheme follows one by one, which moreau-jean
/// computed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Handover {
    /// Start, s.
    pub from: f64,
    /// End, s.
    pub to: f64,
    /// Largest step, s.
    pub step: f64,
}
