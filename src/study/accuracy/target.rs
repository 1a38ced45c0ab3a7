//! The error asked for.

use crate::error::{Error, Result};
use crate::scheme::Method;
use crate::time::TimeOptions;

/// Steps that one run of a refinement may take unless a target says otherwise: seconds of a scalar scheme.
pub const MOST_STEPS: u64 = 1 << 24;

/// What a stepping run is held against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// The exact motion where there is one, else its own refinements.
    Exact,
    /// Its own refinements only.
    Refinements,
}

/// The error asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Largest error: of the displacement over the gap scale, and of each wall's numbers in the sense of [`Change`](crate::study::change::Change). Above 0, below 1.
    pub tolerance: f64,
    /// The method to refine; none leaves it to the scene.
    pub method: Option<Method>,
    /// Rows and window for statistics; its step is not used.
    pub time: TimeOptions,
    /// What a stepping run is held against.
    pub against: Against,
    /// Most steps of one run.
    pub most_steps: u64,
}

impl Target {
    /// An error of `tolerance`, by whatever the scene needs, with the rows and the window of `time`.
    #[must_use]
    pub fn new(tolerance: f64, time: TimeOptions) -> Self {
        Self { tolerance, method: None, time, against: Against::Exact, most_steps: MOST_STEPS }
    }

    /// Checks the error asked for.
    ///
    /// # Errors
    /// [`Error::Invalid`] for one that is no share.
    pub fn validate(&self) -> Result<()> {
        if self.tolerance > 0.0 && self.tolerance < 1.0 {
            return Ok(());
        }
        Err(Error::invalid("accuracy", self.tolerance, "a number above 0 and below 1, as a share of the gap"))
    }
}
