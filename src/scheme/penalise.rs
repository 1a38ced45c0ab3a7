//! The scene of a penalty scheme: rigid walls replaced by springs.

use super::PenaltyLaw;
use crate::error::Result;
use crate::scene::Scene;

impl Scene {
    /// The scene with every rigid wall and round hole replaced by the penalty `law`; elastic ones
    /// stay.
    ///
    /// # Errors
    /// As [`PenaltyLaw::at`], and for numbers that make no sense.
    pub fn penalised(&self, law: PenaltyLaw) -> Result<Self> {
        let mut scene = self.clone();
        for (wall, original) in scene.walls.iter_mut().zip(&self.walls) {
            wall.law = law.at(original, &self.walls)?;
            wall.validate()?;
        }
        Ok(scene)
    }
}
