//! A finished run.

use super::options::{Judged, Judging, Recorded, Recording};
use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::residual::{Finding, Residuals};
use crate::scene::State;
use crate::scheme::{Counters, Handed, Scheme};
use crate::time::TimeGrid;
use crate::trajectory::Trajectory;

/// A finished run: judged and recorded, unless the [`Options`](super::Options) left one of them out.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Run<J: Judging = Judged, R: Recording = Recorded> {
    /// The scheme that made it.
    pub scheme: Scheme,
    /// The solver of its quadratic programmes: the one in force, not `auto`.
    pub backend: Backend,
    /// Its steps and rows.
    pub grid: TimeGrid,
    /// The state at the end.
    pub state: State,
    /// The recorded motion, a [`Trajectory`]; `()` if the run was not recorded.
    pub trajectory: R::Motion,
    /// The judge's verdict, [`Residuals`]; `()` if the run was not judged.
    pub residuals: J::Verdict,
    /// Where that refutes the run, a list of [`Finding`]s: promises of the scheme that its steps broke beyond what the contract allows.
    /// With any of them the run's numbers are wrong. `()` if the run was not judged.
    pub findings: J::Findings,
    /// Contact [`Statistics`](crate::Statistics) over the window asked for; `()` if the run was not recorded.
    pub statistics: R::Statistics,
    /// What it cost, machine-independent.
    pub counters: Counters,
    /// What it cost, wall-clock seconds, recording and judging included where they were asked for.
    pub seconds: f64,
    /// Stretches that the exact scheme handed to moreau-jean; none for other schemes.
    pub handed: Vec<Handed>,
    /// What a reader must know of this run, in sentences.
    pub notes: Vec<String>,
}

impl<J: Judging, R: Recording> Run<J, R> {
    /// The judge's verdict, if the run was judged: for code that takes runs of any kind.
    #[must_use]
    pub fn judged(&self) -> Option<&Residuals> {
        J::residuals(&self.residuals)
    }

    /// [`Error::Refuted`] where the judge has refuted the run; none for a run that kept its word, or was not judged.
    #[must_use]
    pub fn refuted(&self) -> Option<Error> {
        let findings = J::findings(&self.findings);
        let text = findings.iter().map(Finding::to_string).collect::<Vec<_>>().join("; ");
        (!findings.is_empty()).then(|| Error::Refuted { runs: vec![format!("{}: {text}", self.scheme)] })
    }

    /// The run, unless the judge has refuted it: for whoever measures others by it.
    ///
    /// # Errors
    /// [`Error::Refuted`].
    pub fn unrefuted(self) -> Result<Self> {
        self.refuted().map_or(Ok(self), Err)
    }

    /// The recorded motion, if the run was recorded: for code that takes runs of any kind.
    #[must_use]
    pub fn recorded(&self) -> Option<&Trajectory> {
        R::trajectory(&self.trajectory)
    }
}
