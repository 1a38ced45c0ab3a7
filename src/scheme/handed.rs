//! What the exact scheme did not follow itself.

use serde::{Deserialize, Serialize};

/// A stretch that the exact scheme handed to moreau-jean: more impacts crowd there than it follows
/// one by one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Handed {
    /// From when, s.
    pub from: f64,
    /// Until when, s.
    pub to: f64,
    /// With which step at most, s.
    pub step: f64,
}
