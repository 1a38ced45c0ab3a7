//! Cases that are cut to modes.

use super::Case;
use crate::error::{Error, Result};
use crate::scene::{Reduction, Scene, System, WallTruncation};
use crate::study::truncation::Whole;

/// What a case was cut from, and what is left.
#[derive(Debug, Clone, PartialEq)]
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

    /// What a reader must know of the cut, in sentences; nothing for a case that runs in full.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let Some(Truncated { whole, reduction }) = &self.truncated else { return Vec::new() };
        let mut notes = Vec::new();
        let (k, n) = (reduction.modes.count(), reduction.degrees_of_freedom);
        if k == n {
            return notes;
        }
        let rigid = whole.scene.walls.iter().zip(&reduction.walls).filter(|(wall, _)| wall.law.is_rigid());
        if whole.static_correction {
            if rigid.clone().count() > 0 {
                notes.push(
                    "static correction: rigid walls are springs of the compliance that the modes leave out, without restitution".into(),
                );
            }
            if reduction.coupling_neglected > WORTH_SAYING {
                notes.push(format!(
                    "the residual compliance that couples walls at different places is neglected: up to {:.0} % of their own",
                    100.0 * reduction.coupling_neglected
                ));
            }
        } else if let Some((wall, left)) = rigid.max_by(|a, b| excess(a.1).total_cmp(&excess(b.1))) {
            notes.push(format!(
                "restitution holds with the mass that {k} of {n} modes have at a wall: {:.4} kg at {:?}, where all have {:.4} kg; it falls as modes are added, and impacts grow weaker and more",
                left.mass_kept, wall.name, left.mass
            ));
        }
        if reduction.start_energy_lost > WORTH_SAYING {
            notes.push(format!(
                "the modes leave out {:.1} % of the energy of the start",
                100.0 * reduction.start_energy_lost
            ));
        }
        notes
    }
}

/// Shares below this are not worth a sentence.
const WORTH_SAYING: f64 = 1e-2;

fn excess(left: &WallTruncation) -> f64 {
    left.mass_kept / left.mass
}
