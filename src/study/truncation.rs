//! Modal truncation.

use crate::error::Result;
use crate::scene::{Damping, Reduction, Scene};

/// A scene before it is cut to modes, and how it is cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Whole {
    /// The scene in its own degrees of freedom.
    pub scene: Scene,
    /// Damping that is given to the modes, in place of the scene's own; none where the scene has it.
    pub damping: Option<Damping>,
    /// True if walls are given the compliance of the modes left out.
    pub static_correction: bool,
}

impl Whole {
    /// The scene cut to its `modes` slowest modes.
    ///
    /// # Errors
    /// As [`Scene::reduced`].
    pub fn cut(&self, modes: usize) -> Result<Reduction> {
        let reduction = self.scene.reduced(modes, self.static_correction)?;
        match &self.damping {
            Some(damping) => reduction.with_damping(damping),
            None => Ok(reduction),
        }
    }
}
