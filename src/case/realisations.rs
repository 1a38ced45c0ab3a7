//! Realisations of a case, as a study runs them.

use super::{Case, Truncated};
use crate::error::{Error, Result};
use crate::scene::{Row, Scene, Wall, forcing_period};
use crate::scheme::Method;
use crate::study::accuracy::{MOST_STEPS, most_steps};
use crate::study::realisations::{RandomScenes, RealisationCount, StepSearch};

/// What several realisations need.
pub(crate) const RANDOM: &str =
    "a case with a random load or a start that scatters (initial.scatter): without one all runs are the same";

/// What means over realisations need besides: something whose means they are.
const NO_WALL: &str = "a case with a wall or a support, whose forces have means over realisations; `sweep --seeds` has \
                       those of displacements (--measure displacement_rms)";

/// How far velocities of a start that nobody knows any better scatter, as a share of the gap in a
/// forcing period: far less than anybody measures, and far more than rounding.
const UNKNOWN: f64 = 1e-4;

impl RandomScenes for Case {
    fn realisation(&self, number: u64) -> Result<Scene> {
        Ok(Case::realisation(self, number)?.scene)
    }

    fn modes(&self) -> Option<[usize; 2]> {
        let Truncated { whole, reduction } = self.truncated.as_ref()?;
        // What refuses more modes is said by the runs with them.
        let more = whole.more_modes(reduction).unwrap_or(Some(2 * reduction.modes.count()));
        Some([reduction.modes.count(), more?])
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

    /// The case as one whose means over realisations can be judged: itself where something is
    /// random in it, else with a start whose velocities scatter by [`Case::start_scatter`]. The key
    /// `initial.scatter.velocity` then says so.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `of` where there is no wall and no support whose forces have means.
    pub fn with_scattered_start(&self) -> Result<Self> {
        if self.scene.walls.is_empty() {
            let expected = "motion: there is no wall and no support whose forces have means";
            return Err(Error::invalid("of", "means", expected));
        }
        if self.is_random() {
            return Ok(self.clone());
        }
        self.with("initial.scatter.velocity", self.start_scatter())
    }

    /// The standard deviation of the velocities of a start that nobody knows any better, m/s, or
    /// of modal velocities in √kg m/s: as a velocity at a wall at most 1e-4 of the gap in a forcing
    /// period, or without one in the time of the run; a power of ten.
    #[must_use]
    pub fn start_scatter(&self) -> f64 {
        let scene = &self.scene;
        let time = forcing_period(scene).unwrap_or(scene.duration);
        let weight = |row: &Row| row.entries().iter().map(|(_, weight)| weight * weight).sum::<f64>().sqrt();
        let round = scene.holes().flat_map(|hole| [&hole.at.y, &hole.at.z]);
        let weights = scene.walls.iter().map(Wall::row).chain(round).map(weight);
        let heaviest = weights.filter(|weight| *weight > 0.0).reduce(f64::max).unwrap_or(1.0);
        let most = UNKNOWN * scene.gap_scale() / time / heaviest;
        // As it is written: a product of tens may be off by a rounding.
        format!("1e{}", most.log10().floor()).parse().unwrap_or(most)
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
