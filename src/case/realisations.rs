//! Realisations of a case, as a study runs them.

use super::Case;
use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::scheme::Method;
use crate::study::accuracy::{MOST_STEPS, most_steps};
use crate::study::realisations::{RandomScenes, RealisationCount, StepSearch};
use crate::study::truncation::more_modes;

/// What several realisations need.
pub(crate) const RANDOM: &str =
    "a case with a random load or a start that scatters (initial.scatter): without one all runs are the same";

/// What their means are of.
const NO_WALL: &str = "a case with a wall or a support, whose forces have means over realisations; `sweep --seeds` has \
                       those of displacements (--measure displacement_rms)";

impl RandomScenes for Case {
    fn realisation(&self, number: u64) -> Result<Scene> {
        Ok(Case::realisation(self, number)?.scene)
    }

    fn modes(&self) -> Option<[usize; 2]> {
        let reduction = &self.truncated.as_ref()?.reduction;
        Some([reduction.modes.count(), more_modes(reduction)?])
    }

    fn with_modes(&self, number: u64, modes: usize) -> Result<Scene> {
        let realisation = Case::realisation(self, number)?;
        match &realisation.truncated {
            Some(truncated) => Ok(truncated.whole.cut(modes)?.scene),
            None => Ok(realisation.scene),
        }
    }
}

impl Case {
    /// True where the error of a result is one of means over realisations: the case is random, and
    /// there is a wall or a support whose forces have means.
    #[must_use]
    pub fn judges_means(&self) -> bool {
        self.is_random() && !self.scene.walls.is_empty()
    }

    /// The search for the step of `method` at which the means of the case err by `share` of them at
    /// most, from at most `most` realisations.
    #[must_use]
    pub fn step_search<'a>(&'a self, method: &'a Method, share: f64, most: u64) -> StepSearch<'a> {
        let most_steps = most_steps(&self.scene, MOST_STEPS);
        StepSearch { scenes: self, method, time: self.time, share, most, most_steps }
    }

    /// Refuses means over realisations of a case that is not random, or that has no wall and no
    /// support.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `seeds` or `until_interval`.
    pub fn check_realisations(&self, count: RealisationCount) -> Result<()> {
        let expected = match () {
            () if !self.is_random() => RANDOM,
            () if self.scene.walls.is_empty() => NO_WALL,
            () => return Ok(()),
        };
        Err(match count {
            RealisationCount::Exactly(count) => Error::invalid("seeds", count, expected),
            RealisationCount::Within { share, .. } => Error::invalid("until_interval", share, expected),
        })
    }
}
