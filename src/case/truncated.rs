//! Cases that are reduced to modes.

use super::Case;
use crate::error::{Error, Result};
use crate::scene::{Reduction, Scene, System};
use crate::study::truncation::Whole;

/// The scene before the reduction, and the reduction.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Truncated {
    /// The full structure.
    pub whole: Whole,
    /// The reduction; its scene is that of the case.
    pub reduction: Reduction,
}

impl Case {
    /// The same case reduced to its `modes` slowest modes, in two planes of each of them, whatever
    /// its present reduction.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an oscillator and for a count that does not fit; see
    /// [`Scene::reduced`].
    pub fn with_modes(mut self, modes: usize) -> Result<Self> {
        if let System::Oscillator(_) = self.scene.system {
            return Err(Error::invalid("modes", modes, "no modes: the case has one degree of freedom"));
        }
        let whole = match self.truncated.take() {
            Some(truncated) => truncated.whole,
            None => Whole {
                scene: self.scene.clone(),
                damping: None,
                static_correction: false,
                start: self.written.start,
                planes: self.planes.modes(),
            },
        };
        self.cut(whole, modes.saturating_mul(self.planes.modes()))?;
        Ok(self)
    }

    /// The scene before its reduction to modes, or the scene itself.
    #[must_use]
    pub fn whole(&self) -> &Scene {
        self.truncated.as_ref().map_or(&self.scene, |truncated| &truncated.whole.scene)
    }

    /// Changes the scene before the reduction to modes, and thus also the reduced one.
    ///
    /// # Errors
    /// Those of the reduction.
    pub fn change(&mut self, change: impl Fn(&mut Scene)) -> Result<()> {
        let Some(truncated) = &self.truncated else {
            change(&mut self.scene);
            return Ok(());
        };
        let (mut whole, modes) = (truncated.whole.clone(), truncated.reduction.modes.count());
        change(&mut whole.scene);
        self.cut(whole, modes)
    }

    fn cut(&mut self, whole: Whole, modes: usize) -> Result<()> {
        let reduction = whole.cut(modes)?;
        self.scene = reduction.scene.clone();
        self.truncated = Some(Truncated { whole, reduction });
        Ok(())
    }
}
