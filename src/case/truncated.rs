//! Cases that are reduced to modes.

use super::Case;
use crate::scene::{Reduction, Scene};
use crate::study::truncation::Unreduced;

/// The scene before the reduction, and the reduction.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Truncated {
    /// The full structure.
    pub whole: Unreduced,
    /// The reduction; its scene is that of the case.
    pub reduction: Reduction,
}

impl Case {
    /// The scene before its reduction to modes, or the scene itself.
    #[must_use]
    pub fn unreduced(&self) -> &Scene {
        self.truncated.as_ref().map_or(&self.scene, |truncated| &truncated.whole.scene)
    }
}
