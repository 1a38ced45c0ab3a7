//! The law of contact of a wall: all that differs between rigid, elastic and penalised walls.

use super::system::{nonnegative, positive};
use crate::error::{Error, Result, Subject};
use serde::{Deserialize, Serialize};

/// The contact law of a wall. Depth s is the penetration −gap, and |r| the magnitude of the force.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum WallLaw {
    /// Signorini's condition 0 ≤ gap ⟂ |r| ≥ 0 with Newton's impact law ẇ⁺ = −e ẇ⁻.
    ///
    /// Where several walls are struck at once the law is Moreau's (1988,
    /// doi:10.1007/978-3-7091-2624-0_1): all of them answer in one impact, 0 ≤ ẇ⁺ + e ẇ⁻ ⟂ |p| ≥ 0
    /// at each. Three equal masses in a row that touch, the first with a speed of 1, leave with
    /// (−⅓, ⅔, ⅔) at e = 1, not with the (0, 0, 1) of Newton's cradle, which is a sequence of
    /// impacts: leave gaps between the masses where that is meant.
    Rigid {
        /// Restitution e, from 0 (stays) to 1 (rebounds at full speed).
        restitution: f64,
    },
    /// A spring and dashpot that never pull: |r| = max(0, k_a s + c_a ṡ) while s > 0.
    Elastic {
        /// Stiffness k_a, N/m.
        stiffness: f64,
        /// Damping c_a, N s/m.
        damping: f64,
    },
    /// The φ² penalty of a pair of walls a span apart: energy φ²/(2ε) with φ = s (s + span), hence
    /// |r| = s (s + span)(2s + span)/ε, which at the wall is a spring of stiffness span²/ε.
    Quartic {
        /// Penalty parameter ε, m³/N.
        epsilon: f64,
        /// Distance between the upper and the lower wall, m.
        span: f64,
    },
}

impl WallLaw {
    /// Force magnitude |r| in newtons at depth `s` (m) and rate `rate` = ṡ (m/s); 0 outside, and 0
    /// for a rigid wall, whose force is not a function of the state.
    #[must_use]
    pub fn pressure(&self, s: f64, rate: f64) -> f64 {
        if s <= 0.0 {
            return 0.0;
        }
        match *self {
            Self::Rigid { .. } => 0.0,
            Self::Elastic { stiffness, damping } => (stiffness * s + damping * rate).max(0.0),
            Self::Quartic { epsilon, span } => s * (s + span) * (2.0 * s + span) / epsilon,
        }
    }

    /// ∂|r|/∂s at depth `s` (m), N/m, without damping; 0 for s ≤ 0, also at s = 0, where the
    /// derivative from inside differs.
    #[must_use]
    pub fn tangent(&self, s: f64) -> f64 {
        if s <= 0.0 {
            return 0.0;
        }
        match *self {
            Self::Rigid { .. } => 0.0,
            Self::Elastic { stiffness, .. } => stiffness,
            Self::Quartic { epsilon, span } => (6.0 * s * (s + span) + span * span) / epsilon,
        }
    }

    /// Energy stored at depth `s` (m), J.
    #[must_use]
    pub fn energy(&self, s: f64) -> f64 {
        if s <= 0.0 {
            return 0.0;
        }
        match *self {
            Self::Rigid { .. } => 0.0,
            Self::Elastic { stiffness, .. } => 0.5 * stiffness * s * s,
            Self::Quartic { epsilon, span } => 0.5 * (s * (s + span)).powi(2) / epsilon,
        }
    }

    /// ΔU/Δs between the depths `s0` and `s1` (m), the mean of |r| on the way, N, and its
    /// derivative with respect to `s1`, N/m; without division by zero. One of both is above 0.
    pub(crate) fn mean_force(&self, s0: f64, s1: f64) -> (f64, f64) {
        if s0 <= 0.0 {
            let slope = self.energy(s1) / (s1 - s0);
            return (slope, (self.pressure(s1, 0.0) - slope) / (s1 - s0));
        }
        if s1 <= 0.0 {
            let slope = self.energy(s0) / (s0 - s1);
            return (slope, slope / (s0 - s1));
        }
        match *self {
            Self::Rigid { .. } => (0.0, 0.0),
            Self::Elastic { stiffness, .. } => (0.5 * stiffness * (s0 + s1), 0.5 * stiffness),
            Self::Quartic { epsilon, span } => {
                let phi = s0 * (s0 + span) + s1 * (s1 + span);
                let sum = s0 + s1 + span;
                (phi * sum / (2.0 * epsilon), ((2.0 * s1 + span) * sum + phi) / (2.0 * epsilon))
            }
        }
    }

    /// ∂|r|/∂s where contact begins, N/m; `None` for a rigid wall.
    #[must_use]
    pub fn stiffness(&self) -> Option<f64> {
        match *self {
            Self::Rigid { .. } => None,
            Self::Elastic { stiffness, .. } => Some(stiffness),
            Self::Quartic { epsilon, span } => Some(span * span / epsilon),
        }
    }

    /// The restitution e of a rigid wall; `None` for the others, which have a force law instead.
    #[must_use]
    pub fn restitution(&self) -> Option<f64> {
        if let Self::Rigid { restitution } = *self { Some(restitution) } else { None }
    }

    /// The spring of an elastic wall; `None` for the others.
    #[inline]
    #[must_use]
    pub fn spring(&self) -> Option<WallSpring> {
        if let Self::Elastic { stiffness, damping } = *self { Some(WallSpring { stiffness, damping }) } else { None }
    }

    /// True for a rigid or an elastic wall, which quadratic programmes and exact motion can follow:
    /// the force of neither depends on the depth in any other way than linearly.
    pub(crate) fn is_linear(&self) -> bool {
        self.is_rigid() || self.spring().is_some()
    }

    /// The dashpot c_a of an elastic wall, N s/m; 0 for the others.
    #[inline]
    pub(crate) fn damping(&self) -> f64 {
        self.spring().map_or(0.0, |spring| spring.damping)
    }

    /// The law with a massless spring of the compliance `s` (m/N) between wall and structure: the
    /// springs add up, and the dashpot feels the share of the motion that the wall's own spring
    /// takes. `None` for the φ² law, which such a spring makes another law.
    pub(crate) fn in_series(&self, s: f64) -> Option<Self> {
        match *self {
            Self::Rigid { .. } => Some(Self::Elastic { stiffness: 1.0 / s, damping: 0.0 }),
            Self::Elastic { stiffness, damping } => {
                let series = 1.0 / (1.0 / stiffness + s);
                Some(Self::Elastic { stiffness: series, damping: damping * (series / stiffness).powi(2) })
            }
            Self::Quartic { .. } => None,
        }
    }

    /// Checks the numbers of the law; `key` names the value of a wall or hole.
    pub(crate) fn validate(&self, key: impl Fn(&'static str) -> Subject) -> Result<()> {
        match *self {
            Self::Rigid { restitution } if (0.0..=1.0).contains(&restitution) => Ok(()),
            Self::Rigid { restitution } => {
                Err(Error::invalid(key("restitution"), format_args!("{restitution:?}"), "a number from 0 to 1"))
            }
            Self::Elastic { stiffness, damping } => {
                positive(key("stiffness"), stiffness)?;
                nonnegative(key("damping"), damping)
            }
            Self::Quartic { epsilon, span } => {
                positive(key("epsilon"), epsilon)?;
                positive(key("span between the walls"), span)
            }
        }
    }

    /// True for a rigid wall.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        matches!(self, Self::Rigid { .. })
    }
}

/// The spring and dashpot of an elastic wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallSpring {
    /// k_a, N/m.
    pub stiffness: f64,
    /// c_a, N s/m.
    pub damping: f64,
}

impl WallSpring {
    /// k_a + c_a/τ, N/m: what the force grows by per displacement that the body makes over `tau`
    /// seconds.
    #[inline]
    pub(crate) fn stiffness_over(&self, tau: f64) -> f64 {
        self.stiffness + self.damping / tau
    }

    /// 1/(τ²(k_a + c_a/τ)), m/s per N s: the change of velocity per impulse of spring and dashpot,
    /// in a step of the θ-rule in which `tau` is θ times its length, s.
    #[inline]
    pub(crate) fn compliance(&self, tau: f64) -> f64 {
        1.0 / (tau * tau * self.stiffness_over(tau))
    }

    /// k_a(w − g) + c_a(w − plate)/τ, N: the force against a body that arrives at `w` (m) after
    /// `tau` seconds, at a wall at `position` whose dashpot began at `plate`, as if it could pull.
    #[inline]
    pub(crate) fn force(&self, w: f64, position: f64, plate: f64, tau: f64) -> f64 {
        self.stiffness * (w - position) + self.damping * (w - plate) / tau
    }

    /// The distance from the centre, m, up to which a round hole of this radial gap (m) does not
    /// push a body that was at `from` (m, from the centre) `tau` seconds before: where spring and
    /// dashpot, whose plate began at the body or on the circle, balance each other.
    #[inline]
    pub(crate) fn freed_radius(&self, gap: f64, from: [f64; 2], tau: f64) -> f64 {
        let plate = from[0].hypot(from[1]).max(gap);
        (self.stiffness * gap + self.damping * plate / tau) / self.stiffness_over(tau)
    }
}
