//! The scene that a penalty scheme sees: rigid walls turned into springs.

use super::PenaltyLaw;
use crate::error::{Error, Result};
use crate::scene::{Scene, Side, WallLaw};

impl Scene {
    /// The scene with every rigid wall replaced by the penalty `law`; elastic walls stay. The φ² law pairs each rigid
    /// wall with the nearest rigid wall opposite it, whose distance sets its stiffness.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a law that makes no sense, or for the φ² law on a wall with none opposite.
    pub fn penalised(&self, law: PenaltyLaw) -> Result<Self> {
        let mut scene = self.clone();
        for (wall, original) in scene.walls.iter_mut().zip(&self.walls) {
            if !original.law.is_rigid() {
                continue;
            }
            wall.law = match law {
                PenaltyLaw::Linear { stiffness, damping } => WallLaw::Elastic { stiffness, damping },
                PenaltyLaw::Quartic { epsilon } => {
                    let opposite =
                        |w: &&crate::scene::Wall| w.side != original.side && w.at == original.at && w.law.is_rigid();
                    let distance = |w: &crate::scene::Wall| match original.side {
                        Side::Upper => original.position - w.position,
                        Side::Lower => w.position - original.position,
                    };
                    let span = self.walls.iter().filter(opposite).map(distance).reduce(f64::min);
                    let span = span.ok_or_else(|| {
                        Error::invalid(
                            format!(
                                "penalty.epsilon on the rigid wall {:?}, which has no rigid wall opposite,",
                                original.name
                            ),
                            epsilon,
                            "an upper and a lower wall; for a one-sided scene the linear law (penalty.stiffness, N/m)",
                        )
                    })?;
                    WallLaw::Quartic { epsilon, span }
                }
            };
            wall.validate()?;
        }
        Ok(scene)
    }
}
