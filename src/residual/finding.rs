//! What the judge refutes of a run: a promise of its scheme that the steps did not keep.

use serde::Serialize;
use std::fmt;

/// Which promise a run broke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Refuted {
    /// The body stands behind a rigid wall whose scheme keeps it in front.
    Penetration,
    /// A wall pulls.
    Tension,
    /// A rigid wall pushes where it is open, or the bound or the law of impact that the scheme states is passed.
    Complementarity,
    /// The force of an elastic wall is not the one its law gives.
    WallLaw,
    /// Momentum changes by something else than the forces.
    MomentumBalance,
    /// The impulses recorded of the walls do not carry the momentum of the run from its start to its end.
    Impulses,
    /// The displacement does not follow from the velocities.
    Kinematics,
    /// The energy ledger does not close although the scheme conserves energy.
    Energy,
}

/// A broken promise: what, by how much, when and where. A run with a finding is wrong; its numbers are not to be used.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Finding {
    /// Which promise.
    pub refuted: Refuted,
    /// The residual at its worst less what rounding may leave there; dimensionless, over the scales of
    /// [`Residuals`](super::Residuals).
    pub residual: f64,
    /// What the scheme's [`Tolerances`](crate::step::Tolerances) allow.
    pub tolerance: f64,
    /// Why they allow that much and no more.
    pub reason: &'static str,
    /// End of the step in which it was worst, s; of ledgers, which are sums, the end of the run so far.
    pub time_s: f64,
    /// Name of the wall; none where the promise is not one of a wall.
    pub wall: Option<String>,
}

impl fmt::Display for Refuted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Penetration => "the body stands behind a rigid wall, in gap scales",
            Self::Tension => "a wall pulls, in shares of the largest contact force",
            Self::Complementarity => "complementarity at a rigid wall",
            Self::WallLaw => "the force of a wall is not that of its law, in shares of the largest contact force",
            Self::MomentumBalance => "momentum balance",
            Self::Impulses => {
                "the recorded impulses do not carry the momentum of the run, in shares of what was exchanged"
            }
            Self::Kinematics => "displacement and velocities do not belong together",
            Self::Energy => "the energy ledger does not close",
        })
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {:.1e}", self.refuted, self.residual)?;
        if let Some(wall) = &self.wall {
            write!(f, " at wall {wall:?}")?;
        }
        write!(f, ", t = {:.6} s; allowed {:e} ({})", self.time_s, self.tolerance, self.reason)
    }
}
