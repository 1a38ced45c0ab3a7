//! Walls: the bounds on displacements.

use super::law::WallLaw;
use super::row::Row;
use super::system::finite;
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
        self.law.validate(key)
    }
}
