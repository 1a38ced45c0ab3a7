//! A finished run.

use super::cautioned::Caution;
use super::judging::{Judged, Judging};
use super::recording::{Recorded, Recording};
use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::residual::{Finding, Refuted, Residuals};
use crate::scene::State;
use crate::scheme::{Counters, Handover, Scheme};
use crate::time::TimeGrid;
use crate::trajectory::Trajectory;
use serde::{Deserialize, Serialize};

/// A finished run: judged and recorded, unless the [`Options`](super::Options) left one of them
/// out.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(bound(
    serialize = "J::Verdict: Serialize, J::Findings: Serialize, R::Motion: Serialize, R::Statistics: Serialize",
    deserialize = "J::Verdict: Deserialize<'de>, J::Findings: Deserialize<'de>, R::Motion: Deserialize<'de>, \
                   R::Statistics: Deserialize<'de>"
))]
#[non_exhaustive]
pub struct Run<J: Judging = Judged, R: Recording = Recorded> {
    /// The scheme that made it.
    pub scheme: Scheme,
    /// The solver of its quadratic programmes: the one used, never `auto`.
    pub backend: Backend,
    /// Its steps and rows.
    pub grid: TimeGrid,
    /// The state at the end.
    pub state: State,
    /// The recorded motion, a [`Trajectory`]; `()` if the run was not recorded.
    pub trajectory: R::Motion,
    /// The run's [`Residuals`], from the judge; `()` if the run was not judged.
    pub residuals: J::Verdict,
    /// The list of [`Finding`]s: promises of the scheme's contract that the steps broke by more
    /// than its tolerances. If there is any, the run's numbers are wrong. `()` if the run was not
    /// judged.
    pub findings: J::Findings,
    /// Contact [`Statistics`](crate::Statistics) over the requested window; `()` if the run was not
    /// recorded.
    pub statistics: R::Statistics,
    /// Its cost in machine-independent counts.
    pub counters: Counters,
    /// Its cost in wall-clock seconds, including recording and judging where requested.
    pub seconds: f64,
    /// Stretches that the exact scheme handed to moreau-jean; empty for other schemes.
    pub handed: Vec<Handover>,
    /// Notes that a reader of the results must know, in sentences.
    pub notes: Vec<String>,
    /// Those of the notes that limit the use of the results: a step that does not resolve a load or
    /// a mode, energy that the scheme created, a restitution that it does not realise.
    pub cautions: Vec<String>,
    /// That of the notes on means that are others in the beginning of the window of the statistics
    /// than in the rest of it: the window begins before the motion has settled.
    pub unsettled: Option<String>,
}

impl<J: Judging, R: Recording> Run<J, R> {
    /// What limits the use of its results, in short.
    #[must_use]
    pub fn caution(&self) -> Caution {
        Caution { note: self.cautions.first().cloned(), unsettled: self.unsettled.clone() }
    }

    /// The residuals, if the run was judged: for code that takes runs of any kind.
    #[must_use]
    pub fn judged(&self) -> Option<&Residuals> {
        J::residuals(&self.residuals)
    }

    /// [`Error::Refuted`] where the judge has findings; `None` for a run without findings, or one
    /// that was not judged.
    #[must_use]
    pub fn refuted(&self) -> Option<Error> {
        let findings = J::findings(&self.findings);
        let text = findings.iter().map(Finding::to_string).collect::<Vec<_>>().join("; ");
        (!findings.is_empty()).then(|| Error::Refuted { runs: vec![format!("{}: {text}", self.scheme)] })
    }

    /// The run, unless the judge has findings, which every caller should ask for. It says nothing
    /// of [`Run::cautions`], nor of the error of the step, and nothing at all of a run that was not
    /// judged.
    ///
    /// # Errors
    /// [`Error::Refuted`]; [`Error::Diverged`] for a run that diverged, which a study of steps that
    /// are too large expects.
    pub fn unrefuted(self) -> Result<Self> {
        self.diverged().or_else(|| self.refuted()).map_or(Ok(self), Err)
    }

    /// [`Error::Diverged`] for a run that diverged.
    fn diverged(&self) -> Option<Error> {
        let found = J::findings(&self.findings).iter().find(|found| found.refuted == Refuted::Diverged)?;
        let (time, step) = (found.time_s, self.counters.steps);
        Some(Error::Diverged { time, step, ratio: found.residual, cause: found.reason.to_string() })
    }

    /// The recorded motion, if the run was recorded: for code that takes runs of any kind.
    #[must_use]
    pub fn recorded(&self) -> Option<&Trajectory> {
        R::trajectory(&self.trajectory)
    }
}
