//! The law of contact of a wall: all that differs between rigid, elastic and penalised walls.

use super::system::{nonnegative, positive};
use crate::error::{Error, Result, Subject};
use serde::{Deserialize, Serialize};

/// The exponents n of the law of Hunt and Crossley.
const EXPONENTS: std::ops::RangeInclusive<f64> = 1.0..=10.0;
/// The relative change of the depth from which on a derivative is a quotient of differences.
const HARDLY: f64 = 1e-5;

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
    /// A spring that may stiffen with depth, and whose loss grows with its force (Hunt & Crossley
    /// 1975, doi:10.1115/1.3423596): |r| = k sⁿ max(0, 1 + α ṡ) while s > 0, which neither jumps
    /// where contact begins nor pulls. n = 3/2 is Hertz's contact of spheres.
    ///
    /// A body that arrives at the speed v and that nothing else pushes meanwhile leaves with e v,
    /// where αv − ln(1 + αv) = −αev − ln(1 − αev), whatever k and n: e ≈ 1 − ⅔ αv while αv ≪ 1.
    HuntCrossley {
        /// Stiffness k, N/mⁿ.
        stiffness: f64,
        /// Exponent n, from 1 to 10.
        exponent: f64,
        /// Dissipation α, s/m.
        dissipation: f64,
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
        let elastic = match *self {
            Self::Rigid { .. } => 0.0,
            Self::Elastic { stiffness, .. } => stiffness * s,
            Self::HuntCrossley { stiffness, exponent, .. } => stiffness * s.powf(exponent),
            Self::Quartic { epsilon, span } => s * (s + span) * (2.0 * s + span) / epsilon,
        };
        (elastic + self.dashpot(elastic) * rate).max(0.0)
    }

    /// The dashpot, N s/m, where the spring alone pushes with `elastic` N: c_a of an elastic wall,
    /// α k sⁿ of Hunt and Crossley's, 0 for the others.
    #[inline]
    pub(crate) fn dashpot(&self, elastic: f64) -> f64 {
        match *self {
            Self::Elastic { damping, .. } => damping,
            Self::HuntCrossley { dissipation, .. } => dissipation * elastic,
            Self::Rigid { .. } | Self::Quartic { .. } => 0.0,
        }
    }

    /// α of Hunt and Crossley's law, s/m; 0 for the others.
    #[inline]
    pub(crate) fn dissipation(&self) -> f64 {
        if let Self::HuntCrossley { dissipation, .. } = *self { dissipation } else { 0.0 }
    }

    /// True if the force depends on the rate as well.
    #[inline]
    pub(crate) fn is_damped(&self) -> bool {
        self.dashpot(1.0) > 0.0
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
            Self::HuntCrossley { stiffness, exponent, .. } => stiffness * exponent * s.powf(exponent - 1.0),
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
            Self::HuntCrossley { stiffness, exponent, .. } => stiffness * s.powf(exponent + 1.0) / (exponent + 1.0),
            Self::Quartic { epsilon, span } => 0.5 * (s * (s + span)).powi(2) / epsilon,
        }
    }

    /// ΔU/Δs between the depths `s0` and `s1` (m), the mean of |r| on the way, N, and its
    /// derivative with respect to `s1`, N/m; without division by zero.
    pub(crate) fn mean_force(&self, s0: f64, s1: f64) -> (f64, f64) {
        if s0 <= 0.0 && s1 <= 0.0 {
            return (0.0, 0.0);
        }
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
            Self::HuntCrossley { .. } => self.mean_force_of_power(s0, s1),
            Self::Quartic { epsilon, span } => {
                let phi = s0 * (s0 + span) + s1 * (s1 + span);
                let sum = s0 + s1 + span;
                (phi * sum / (2.0 * epsilon), ((2.0 * s1 + span) * sum + phi) / (2.0 * epsilon))
            }
        }
    }

    /// [`mean_force`](Self::mean_force) of k sⁿ between depths above 0: with p = n + 1 and
    /// x = Δs/s₀ it is k s₀ⁿ ((1 + x)ᵖ − 1)/(p x), without cancellation. Its derivative is the mean
    /// of t |r|′(s₀ + t Δs) over 0 ≤ t ≤ 1; where the depth hardly changes that is Gauss's formula
    /// of one point.
    fn mean_force_of_power(&self, s0: f64, s1: f64) -> (f64, f64) {
        let Self::HuntCrossley { stiffness, exponent, .. } = *self else { return (0.0, 0.0) };
        let (p, x) = (exponent + 1.0, (s1 - s0) / s0);
        let growth = if x == 0.0 { 1.0 } else { (p * x.ln_1p()).exp_m1() / (p * x) };
        let mean = stiffness * s0.powf(exponent) * growth;
        // Gauss's error is of order x², that of the quotient ε/x.
        let slope = if x.abs() < HARDLY {
            0.5 * self.tangent(s0 + 2.0 / 3.0 * (s1 - s0))
        } else {
            (self.pressure(s1, 0.0) - mean) / (s1 - s0)
        };
        (mean, slope)
    }

    /// ∂|r|/∂s where contact begins, N/m; `None` for a rigid wall.
    #[must_use]
    pub fn stiffness(&self) -> Option<f64> {
        (!self.is_rigid()).then(|| self.tangent(f64::MIN_POSITIVE))
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

    /// True if the force without its dashpot is a polynomial of third degree in the depth, or of a
    /// lower one.
    pub(crate) fn is_cubic(&self) -> bool {
        !matches!(self, Self::HuntCrossley { .. })
    }

    /// What kind of law it is, in the words of messages.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Rigid { .. } => "rigid",
            Self::Elastic { .. } => "elastic",
            Self::HuntCrossley { .. } => "the law of Hunt and Crossley",
            Self::Quartic { .. } => "the φ² penalty",
        }
    }

    /// The law with a massless spring of the compliance `s` (m/N) between wall and structure: the
    /// springs add up, and the dashpot feels the share of the motion that the wall's own spring
    /// takes. `None` for laws that are not linear, which such a spring makes other laws.
    pub(crate) fn in_series(&self, s: f64) -> Option<Self> {
        match *self {
            Self::Rigid { .. } => Some(Self::Elastic { stiffness: 1.0 / s, damping: 0.0 }),
            Self::Elastic { stiffness, damping } => {
                let series = 1.0 / (1.0 / stiffness + s);
                Some(Self::Elastic { stiffness: series, damping: damping * (series / stiffness).powi(2) })
            }
            Self::HuntCrossley { .. } | Self::Quartic { .. } => None,
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
            Self::HuntCrossley { stiffness, exponent, dissipation } => {
                positive(key("stiffness"), stiffness)?;
                if !EXPONENTS.contains(&exponent) {
                    return Err(Error::invalid(key("exponent"), format_args!("{exponent:?}"), "a number from 1 to 10"));
                }
                nonnegative(key("dissipation"), dissipation)
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
