//! The error asked for.

use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::scheme::Method;
use crate::time::TimeOptions;

/// Most steps of one run of a refinement, unless a target says otherwise: seconds of a scalar
/// scheme.
pub const MOST_STEPS: u64 = 1 << 24;

/// Unknowns times steps of the last run of a refinement, relative to one degree of freedom.
const MOST_WORK: u64 = 8;

/// Fewest steps that a run of a refinement may always take.
const FEWEST_STEPS: u64 = 1 << 16;

/// Most steps of one run on `scene`, where one degree of freedom may take `most`. The cost of a
/// step is proportional to the unknowns: a structure may cost some times as much as one degree of
/// freedom, but no more.
#[must_use]
pub fn most_steps(scene: &Scene, most: u64) -> u64 {
    let unknowns = (scene.system.degrees_of_freedom() as u64).max(1);
    (MOST_WORK.saturating_mul(most) / unknowns).clamp(FEWEST_STEPS.min(most), most)
}

/// The reference of a stepping run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// The exact motion where there is one, else the run's own refinements.
    Exact,
    /// The run's own refinements only.
    Refinements,
}

/// The error asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Largest error allowed: of the displacement over the gap, or without one over the
    /// largest displacement, and of the quantities of each wall in the sense of
    /// [`Change`](crate::study::change::Change). Above 0, below 1.
    pub tolerance: f64,
    /// The method to refine; with `None` it is chosen for the scene.
    pub method: Option<Method>,
    /// Rows and window for statistics; its step is ignored.
    pub time: TimeOptions,
    /// The reference of a stepping run.
    pub against: Against,
    /// Most steps of one run.
    pub most_steps: u64,
}

impl Target {
    /// A target of `tolerance` with the rows and the window of `time`; the method is chosen for the
    /// scene.
    #[must_use]
    pub fn new(tolerance: f64, time: TimeOptions) -> Self {
        Self { tolerance, method: None, time, against: Against::Exact, most_steps: MOST_STEPS }
    }

    /// Checks the error asked for.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a tolerance that is not above 0 and below 1.
    pub fn validate(&self) -> Result<()> {
        if self.tolerance > 0.0 && self.tolerance < 1.0 {
            return Ok(());
        }
        Err(Error::invalid(
            "accuracy",
            self.tolerance,
            "a number above 0 and below 1, as a share of the gap or of the largest displacement",
        ))
    }
}
