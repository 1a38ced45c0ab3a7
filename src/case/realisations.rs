//! Realisations of a case, as a study runs them.

use super::Case;
use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::study::realisations::{RandomScenes, RealisationCount};
use crate::study::truncation::more_modes;

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
    /// Refuses several realisations of a case without random loads.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `seeds` or `until_interval`.
    pub fn check_random(&self, count: RealisationCount) -> Result<()> {
        if self.is_random() {
            return Ok(());
        }
        let expected = "a case with a random load: without one all runs are the same";
        Err(match count {
            RealisationCount::Exactly(count) => Error::invalid("seeds", count, expected),
            RealisationCount::Within { share, .. } => Error::invalid("until_interval", share, expected),
        })
    }
}
