//! A finding: a promise of a scheme's contract that the steps of a run did not keep.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// Which promise a run broke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Refuted {
    /// The body is behind a rigid wall although the scheme promises gaps ≥ 0.
    Penetration,
    /// A wall pulls.
    Tension,
    /// A rigid wall pushes where its gap is open, or the bound or impact law of the scheme's
    /// contract is violated.
    Complementarity,
    /// The force of an elastic wall is not the one its law gives, or a hole out of reach pushes.
    WallLaw,
    /// A round hole pushes in another direction than along its normal.
    Normal,
    /// The friction of a support is not Coulomb's.
    Friction,
    /// The change of momentum is not the impulse of the forces.
    MomentumBalance,
    /// The recorded impulses of the walls do not account for the change of momentum from the start
    /// of the run to its end.
    Impulses,
    /// The displacement does not follow from the velocities.
    Kinematics,
    /// The energy ledger does not close although the scheme conserves energy.
    Energy,
    /// A residual or a statistic of the run is infinite or not a number.
    NotFinite,
    /// The run is more than 1e6 times faster than the energy of its start and the work of its loads
    /// allow, or its state is no longer finite; it ended there.
    Diverged,
}

/// A broken promise: which, by how much, when and where. A run with a finding is wrong; do not use
/// its numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Finding {
    /// Which promise.
    pub refuted: Refuted,
    /// The largest residual minus its rounding error; dimensionless, relative to the scales of
    /// [`Residuals`](super::Residuals).
    pub residual: f64,
    /// The limit in the scheme's [`Tolerances`](crate::step::Tolerances).
    pub tolerance: f64,
    /// Why that limit was chosen.
    pub reason: Cow<'static, str>,
    /// End of the step with the largest residual, s; for sums over the run (energy ledger,
    /// impulses), the end of the run so far.
    pub time_s: f64,
    /// Name of the wall or round support; `None` where the promise is not about one.
    pub wall: Option<String>,
}

impl Finding {
    /// The finding that the result named `part` (its keys) of a run up to `time_s` (s) is not
    /// finite.
    pub(crate) fn not_finite(part: &str, time_s: f64) -> Self {
        let reason = format!("{part} is infinite or not a number");
        Self::of_run(Refuted::NotFinite, f64::MAX, f64::MAX, reason, time_s)
    }

    /// A finding about the run as a whole.
    pub(crate) fn of_run(refuted: Refuted, residual: f64, tolerance: f64, reason: String, time_s: f64) -> Self {
        Self { refuted, residual, tolerance, reason: reason.into(), time_s, wall: None }
    }
}

impl fmt::Display for Refuted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Penetration => "the body stands behind a rigid wall, in gap scales",
            Self::Tension => "a wall pulls, in shares of the largest contact force",
            Self::Complementarity => "complementarity at a rigid wall",
            Self::WallLaw => "the force of a wall is not that of its law, in shares of the largest contact force",
            Self::Normal => "a hole pushes across its normal, in shares of the largest contact force",
            Self::Friction => "friction is not Coulomb's, in shares of the largest contact force",
            Self::MomentumBalance => "momentum balance",
            Self::Impulses => {
                "the recorded impulses do not carry the momentum of the run, in shares of what was exchanged"
            }
            Self::Kinematics => "displacement and velocities do not belong together",
            Self::Energy => "the energy balance does not close",
            Self::NotFinite => "a result of the run is not finite",
            Self::Diverged => {
                "the run diverged and ended there; its speed, in multiples of the largest that its start and its \
                 loads can give"
            }
        })
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.refuted == Refuted::NotFinite {
            return write!(f, "{}: {}", self.refuted, self.reason);
        }
        write!(f, "{}: {:.1e}", self.refuted, self.residual)?;
        if let Some(wall) = &self.wall {
            write!(f, " at wall {wall:?}")?;
        }
        write!(f, ", t = {:.6} s; allowed {:e} ({})", self.time_s, self.tolerance, self.reason)
    }
}
