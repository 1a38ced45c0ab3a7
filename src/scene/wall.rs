//! Walls: the bounds on displacements, and the law of contact there.

use super::row::Row;
use super::system::{finite, nonnegative, positive};
use crate::error::{Error, Result, Subject};
use serde::{Deserialize, Serialize};

/// The side of the body on which a wall stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Side {
    /// The body may not go below the position; the wall pushes up, r ≥ 0.
    Lower,
    /// The body may not go above the position; the wall pushes down, r ≤ 0.
    Upper,
}

impl Side {
    /// The sign of the wall's force on the body: +1 for a lower wall, −1 for an upper one.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Lower => 1.0,
            Self::Upper => -1.0,
        }
    }
}

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

    /// The restitution e of a rigid wall; `None` for the others, which have a force law instead.
    #[must_use]
    pub fn restitution(&self) -> Option<f64> {
        if let Self::Rigid { restitution } = *self { Some(restitution) } else { None }
    }

    /// The dashpot c_a of an elastic wall, N s/m; 0 for the others.
    pub(crate) fn damping(&self) -> f64 {
        if let Self::Elastic { damping, .. } = *self { damping } else { 0.0 }
    }

    /// True for a rigid wall.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        matches!(self, Self::Rigid { .. })
    }
}

/// One wall, which bounds the displacement of its row on one side.
///
/// ```
/// use signorini::{Row, Wall};
///
/// // A rigid stop above, from which a body rebounds with half its speed; below, a pad of 1e4 N/m and 20 N s/m.
/// let stop = Wall::upper("stop", 5e-3).with_restitution(0.5);
/// let pad = Wall::lower("pad", -5e-3).with_elasticity(1e4, 20.0);
/// assert_eq!(stop.gap(4e-3), 5e-3 - 4e-3); // m, before it
/// assert_eq!(pad.law_force(-6e-3, 0.0).round(), 10.0); // N, 1 mm inside: a lower wall pushes up
///
/// // On a structure a wall watches a row: here the distance between two masses, which may shrink by 1 mm.
/// let between = Wall { at: Row::new(vec![(1, 1.0), (0, -1.0)]), ..Wall::lower("bumper", -1e-3) };
/// assert!(between.gap(between.at.dot(&[0.0, -2e-3])) < 0.0); // they would overlap
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Wall {
    /// Name: letters, digits, `-` and `_`; results are looked up by it.
    pub name: String,
    /// Which side of the body it stands on.
    pub side: Side,
    /// Position g, m, in the coordinate w = g · q of the row `at`.
    pub position: f64,
    /// The contact law.
    pub law: WallLaw,
    /// The row of the bounded displacement, through which the wall also pushes.
    pub at: Row,
}

impl Wall {
    /// A rigid upper wall (e = 1) on the first degree of freedom: the body may not go above
    /// `position` (m).
    #[must_use]
    pub fn upper(name: &str, position: f64) -> Self {
        Self::new(name, Side::Upper, position)
    }

    /// A rigid lower wall (e = 1) on the first degree of freedom: the body may not go below
    /// `position` (m).
    #[must_use]
    pub fn lower(name: &str, position: f64) -> Self {
        Self::new(name, Side::Lower, position)
    }

    fn new(name: &str, side: Side, position: f64) -> Self {
        Self { name: name.to_owned(), side, position, law: WallLaw::Rigid { restitution: 1.0 }, at: Row::dof(0) }
    }

    /// The same wall, rigid with restitution `e` in [0, 1].
    #[must_use]
    pub fn with_restitution(mut self, e: f64) -> Self {
        self.law = WallLaw::Rigid { restitution: e };
        self
    }

    /// The same wall, elastic with stiffness in N/m and damping in N s/m.
    #[must_use]
    pub fn with_elasticity(mut self, stiffness: f64, damping: f64) -> Self {
        self.law = WallLaw::Elastic { stiffness, damping };
        self
    }

    /// Gap at displacement `w` (m): positive before the wall, negative behind it.
    #[must_use]
    pub fn gap(&self, w: f64) -> f64 {
        self.side.sign() * (w - self.position)
    }

    /// Signed force r on the body (N) of an elastic or penalised wall at displacement `w` (m) and
    /// velocity `wdot` (m/s).
    #[must_use]
    pub fn law_force(&self, w: f64, wdot: f64) -> f64 {
        let sign = self.side.sign();
        sign * self.law.pressure(-self.gap(w), -sign * wdot)
    }

    pub(crate) fn validate_name(&self, index: usize) -> Result<()> {
        let fits = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if self.name.is_empty() || !self.name.chars().all(fits) {
            let key = Subject::nth("wall", index).part("name");
            return Err(Error::invalid(key, format!("{:?}", self.name), "letters, digits, - and _"));
        }
        Ok(())
    }

    pub(crate) fn validate(&self) -> Result<()> {
        let key = |what: &'static str| Subject::wall(&self.name).part(what);
        finite(key("position"), self.position)?;
        match self.law {
            WallLaw::Rigid { restitution } if (0.0..=1.0).contains(&restitution) => Ok(()),
            WallLaw::Rigid { restitution } => {
                Err(Error::invalid(key("restitution"), format_args!("{restitution:?}"), "a number from 0 to 1"))
            }
            WallLaw::Elastic { stiffness, damping } => {
                positive(key("stiffness"), stiffness)?;
                nonnegative(key("damping"), damping)
            }
            WallLaw::Quartic { epsilon, span } => {
                positive(key("epsilon"), epsilon)?;
                positive(key("span between the walls"), span)
            }
        }
    }
}
