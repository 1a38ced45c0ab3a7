//! Cases that are cut to modes.

use super::Case;
use crate::error::{Error, Result};
use crate::scene::{Reduction, Scene, System};
use crate::study::truncation::Whole;

/// What a case was cut from, and what is left.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Truncated {
    /// The whole structure.
    pub whole: Whole,
    /// What is left; its scene is that of the case.
    pub reduction: Reduction,
}

impl Case {
    /// The same case cut to its `modes` slowest modes, whatever it was cut to before.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an oscillator and for a count that does not fit; see [`Scene::reduced`].
    pub fn with_modes(mut self, modes: usize) -> Result<Self> {
        if let System::Oscillator(_) = self.scene.system {
            return Err(Error::invalid("modes", modes, "none: the case has one degree of freedom"));
        }
        let whole = match self.truncated.take() {
            Some(truncated) => truncated.whole,
            None => Whole { scene: self.scene.clone(), damping: None, static_correction: false },
        };
        self.cut(whole, modes)?;
        Ok(self)
    }

    /// The scene before it was cut to modes, or the scene itself.
    #[must_use]
    pub fn whole(&self) -> &Scene {
        self.truncated.as_ref().map_or(&self.scene, |truncated| &truncated.whole.scene)
    }

    /// Changes the scene before it is cut to modes, and so the one that is run.
    ///
    /// # Errors
    /// Those of the cut.
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
