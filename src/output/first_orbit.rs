//! The orbit on which a case settles, or that of a file.

use super::periodic::{read, read_shot, tells_state};
use crate::case::Case;
use crate::error::{Error, Result};
use crate::orbit::branch::Start;
use crate::orbit::{Orbit, Problem, Shot, shoot};
use crate::scene::Scene;
use std::path::Path;

/// An orbit by its events, of one degree of freedom, or by its state.
#[derive(Debug)]
pub enum FirstOrbit {
    /// By its events.
    Orbit(Orbit),
    /// By its state.
    Shot(Shot),
}

impl FirstOrbit {
    /// The orbit in a file of `signorini orbit`; `problem` is the case's, if it has one degree of
    /// freedom.
    ///
    /// # Errors
    /// As [`read`] and [`read_shot`], and where no orbit of the case is found near it.
    pub fn read(path: &Path, case: &Case, problem: Option<&Problem>) -> Result<Self> {
        match problem {
            Some(problem) if !tells_state(path)? => problem.correct(&read(path, problem.scene())?).map(Self::Orbit),
            _ => read_shot(path, &case.scene, case.truncated.is_some())?.corrected(&case.scene).map(Self::Shot),
        }
    }

    /// The orbit on which `scene` settles over `settle` forcing periods or more; `problem` is the
    /// scene's, if it has one degree of freedom. `progress` is called with the share of the run
    /// that is done.
    ///
    /// # Errors
    /// As [`Problem::settled`] and [`shoot`].
    pub fn settled(scene: &Scene, problem: Option<&Problem>, settle: u32, progress: &dyn Fn(f64)) -> Result<Self> {
        match problem.map(|problem| problem.settled_with(settle, progress)) {
            Some(Ok(orbit)) => Ok(Self::Orbit(orbit)),
            // A motion that never leaves a wall has no events, but a state.
            Some(Err(error @ Error::NoOrbit { .. })) => {
                shoot(scene, settle, progress).map(Self::Shot).map_err(|_| error)
            }
            Some(Err(error)) => Err(error),
            None => shoot(scene, settle, progress).map(Self::Shot),
        }
    }

    /// Where branches begin.
    #[must_use]
    pub fn start(&self) -> Start<'_> {
        match self {
            Self::Orbit(orbit) => Start::Orbit(orbit),
            Self::Shot(shot) => Start::Shot(shot),
        }
    }
}
