//! Runs of a study that are made together.

use super::check::Refined;
use super::realisation::Realisation;
use super::runner::realisations;
use crate::error::Result;
use crate::run::Options;
use crate::scene::Scene;
use crate::scheme::Method;
use std::ops::RangeInclusive;

/// Scenes that differ in the seeds of their random loads alone.
pub trait RandomScenes: Sync {
    /// The scene of realisation `number`, from 1.
    ///
    /// # Errors
    /// [`Error::Invalid`](crate::Error::Invalid) for a number that it does not have.
    fn realisation(&self, number: u64) -> Result<Scene>;

    /// The number of modes of these scenes, and of those with which they are checked; `None` where
    /// they leave no modes out.
    fn modes(&self) -> Option<[usize; 2]>;

    /// The scene of realisation `number` with so many modes.
    ///
    /// # Errors
    /// As [`RandomScenes::realisation`], and those of the reduction.
    fn with_modes(&self, number: u64, modes: usize) -> Result<Scene>;
}

/// What the runs of a batch are for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Purpose {
    /// To estimate how many realisations an interval needs.
    Pilots,
    /// The means.
    Means,
    /// The errors of the means.
    Check(Refined),
}

/// Runs of a study that are made together.
pub struct Batch<'a> {
    /// What they are for.
    pub purpose: Purpose,
    /// The numbers of the realisations.
    pub numbers: RangeInclusive<u64>,
    pub(super) scenes: &'a dyn RandomScenes,
    pub(super) method: &'a Method,
    pub(super) options: Options,
}

impl Batch<'_> {
    /// The same for other realisations.
    pub(super) fn of(&self, numbers: RangeInclusive<u64>) -> Self {
        let Self { purpose, scenes, method, options, .. } = *self;
        Self { purpose, numbers, scenes, method, options }
    }

    /// How many runs these are.
    #[must_use]
    pub fn count(&self) -> u64 {
        (self.numbers.end() + 1).saturating_sub(*self.numbers.start())
    }

    /// Their step, s.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.options.time.step
    }

    /// The scene of realisation `number` as it is run here.
    ///
    /// # Errors
    /// As [`RandomScenes::with_modes`].
    pub fn scene(&self, number: u64) -> Result<Scene> {
        match self.purpose {
            Purpose::Check(Refined::MoreModes { modes: [_, more] }) => self.scenes.with_modes(number, more),
            _ => self.scenes.realisation(number),
        }
    }

    /// Runs them on all cores. `progress` is called with the share of the work that is done.
    ///
    /// # Errors
    /// As [`realisations`].
    pub fn run(&self, progress: &mut dyn FnMut(f64)) -> Result<Vec<Realisation>> {
        realisations(self.numbers.clone(), &|number| self.scene(number), self.method, &self.options, progress)
    }
}
