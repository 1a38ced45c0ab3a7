//! Mean and largest of magnitudes.

use serde::{Deserialize, Serialize};

/// Mean and largest of a set of magnitudes, one per episode; both `None` if the set is empty.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Summary {
    /// Arithmetic mean over the episodes, not over time.
    pub mean: Option<f64>,
    /// Largest.
    pub max: Option<f64>,
}

impl Summary {
    pub(super) fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count();
        if count == 0 {
            return Self::default();
        }
        let max = values.clone().fold(0.0, f64::max);
        Self { mean: Some(values.sum::<f64>() / count as f64), max: Some(max) }
    }
}
