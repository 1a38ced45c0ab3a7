//! Walls: the bounds on displacements.

use super::friction::FrictionCoefficients;
use super::law::WallLaw;
use super::planes::PlaneRows;
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
    /// `lower` or `upper`, as case files and tables write it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Lower => "lower",
            Self::Upper => "upper",
        }
    }

    /// The sign of the wall's force on the body: +1 for a lower wall, −1 for an upper one.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Lower => 1.0,
            Self::Upper => -1.0,
        }
    }
}

/// One wall, flat or round.
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
/// // On a structure a wall stands at a row: here the distance between two masses, which may shrink by 1 mm.
/// let between = Wall::lower("bumper", -1e-3).at(Row::new(vec![(1, 1.0), (0, -1.0)]));
/// assert!(between.gap(between.coordinate(&[0.0, -2e-3])) < 0.0); // they would overlap
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Wall {
    /// Name: letters, digits, `-` and `_`; results are looked up by it.
    pub name: String,
    /// Where it stands.
    pub face: Face,
    /// The contact law, of a round wall along its normal.
    pub law: WallLaw,
    /// Its coefficients of Coulomb friction, from 0 to 10; above 0 in two planes only.
    #[serde(default)]
    pub friction: FrictionCoefficients,
}

/// Where a wall stands, and what it bounds: its *coordinate*.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Face {
    /// A flat wall bounds the coordinate w = g · q of its row on one side.
    Flat {
        /// Which side of the body it stands on.
        side: Side,
        /// Its position g, m, in that coordinate.
        position: f64,
        /// The row of the coordinate, through which the wall also pushes.
        at: Row,
        /// The direction of its outward normal, degrees from +y towards +z; `None` in one plane.
        direction: Option<f64>,
    },
    /// A round wall bounds the distance |w| of a place from its centre c, w = (g_y · q, g_z · q) −
    /// c, from above; it pushes towards the centre.
    Round {
        /// The place.
        at: PlaneRows,
        /// The centre c, m.
        centre: [f64; 2],
        /// The radial gap γ, m, above 0: |w| ≤ γ.
        gap: f64,
    },
}

impl Wall {
    /// A rigid upper wall (e = 1) on the first degree of freedom: the body may not go above
    /// `position` (m).
    #[must_use]
    pub fn upper(name: &str, position: f64) -> Self {
        Self::flat(name, Side::Upper, position)
    }

    /// A rigid lower wall (e = 1) on the first degree of freedom: the body may not go below
    /// `position` (m).
    #[must_use]
    pub fn lower(name: &str, position: f64) -> Self {
        Self::flat(name, Side::Lower, position)
    }

    /// A rigid flat wall (e = 1) on this side of the first degree of freedom, at `position` (m).
    #[must_use]
    pub fn flat(name: &str, side: Side, position: f64) -> Self {
        Self::new(name, Face::Flat { side, position, at: Row::dof(0), direction: None })
    }

    /// A rigid round wall (e = 1) around a place that moves in two planes: its distance from the
    /// origin may not exceed `gap` (m).
    #[must_use]
    pub fn round(name: &str, at: PlaneRows, gap: f64) -> Self {
        Self::new(name, Face::Round { at, centre: [0.0; 2], gap })
    }

    fn new(name: &str, face: Face) -> Self {
        Self {
            name: name.to_owned(),
            face,
            law: WallLaw::Rigid { restitution: 1.0 },
            friction: FrictionCoefficients::default(),
        }
    }

    /// Opens the wall by `by` (m): a flat one recedes, a round one grows in radius, about a centre
    /// that moves by `shift` (m).
    pub(crate) fn open(&mut self, by: f64, shift: [f64; 2]) {
        match &mut self.face {
            Face::Flat { side, position, .. } => *position -= side.sign() * by,
            Face::Round { gap, centre, .. } => {
                *gap += by;
                centre.iter_mut().zip(shift).for_each(|(centre, shift)| *centre += shift);
            }
        }
    }

    /// The same wall at another row; a round wall stays where it is.
    #[must_use]
    pub fn at(mut self, row: Row) -> Self {
        if let Face::Flat { at, .. } = &mut self.face {
            *at = row;
        }
        self
    }

    /// The same wall at another position, m; of a round wall its gap.
    #[must_use]
    pub fn with_position(mut self, to: f64) -> Self {
        match &mut self.face {
            Face::Flat { position: place, .. } | Face::Round { gap: place, .. } => *place = to,
        }
        self
    }

    /// The same wall around another centre, m; a flat wall stays as it is.
    #[must_use]
    pub fn with_centre(mut self, to: [f64; 2]) -> Self {
        if let Face::Round { centre, .. } = &mut self.face {
            *centre = to;
        }
        self
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

    /// The same wall with the law of Hunt and Crossley: stiffness in N/mⁿ, exponent n and
    /// dissipation in s/m ([`WallLaw::HuntCrossley`]).
    #[must_use]
    pub fn with_hunt_crossley(mut self, stiffness: f64, exponent: f64, dissipation: f64) -> Self {
        self.law = WallLaw::HuntCrossley { stiffness, exponent, dissipation };
        self
    }

    /// The same wall with Coulomb friction of these coefficients, or of this one.
    #[must_use]
    pub fn with_friction(mut self, coefficients: impl Into<FrictionCoefficients>) -> Self {
        self.friction = coefficients.into();
        self
    }

    /// The side of the body on which it stands; of a round wall, which bounds a distance from
    /// above, the upper one.
    #[must_use]
    pub fn side(&self) -> Side {
        match self.face {
            Face::Flat { side, .. } => side,
            Face::Round { .. } => Side::Upper,
        }
    }

    /// Its position in its coordinate, m: of a round wall its gap γ.
    #[must_use]
    pub fn position(&self) -> f64 {
        match self.face {
            Face::Flat { position, .. } => position,
            Face::Round { gap, .. } => gap,
        }
    }

    /// The row of a flat wall; of a round wall, which has no row of its own, one without entries.
    #[must_use]
    pub fn row(&self) -> &Row {
        match &self.face {
            Face::Flat { at, .. } => at,
            Face::Round { .. } => {
                static NONE: Row = Row::NONE;
                &NONE
            }
        }
    }

    /// Its coordinate at the displacement `q` (m, one value per degree of freedom): g · q, or the
    /// distance |w| from the centre of a round wall.
    #[must_use]
    pub fn coordinate(&self, q: &[f64]) -> f64 {
        match &self.face {
            Face::Flat { at, .. } => at.dot(q),
            Face::Round { .. } => self.offset(q).map_or(0.0, |[y, z]| y.hypot(z)),
        }
    }

    /// The rate of the coordinate, m/s, for the displacement `q` (m) and the velocity `v` (m/s); 0
    /// at the very centre of a round wall.
    #[must_use]
    pub fn rate(&self, q: &[f64], v: &[f64]) -> f64 {
        match &self.face {
            Face::Flat { at, .. } => at.dot(v),
            Face::Round { at, .. } => {
                let ([y, z], [vy, vz]) = (self.offset(q).unwrap_or_default(), at.dot(v));
                let distance = y.hypot(z);
                if distance > 0.0 { (y * vy + z * vz) / distance } else { 0.0 }
            }
        }
    }

    /// The displacement w (m) from the centre of a round wall; `None` of a flat one.
    #[must_use]
    pub fn offset(&self, q: &[f64]) -> Option<[f64; 2]> {
        let Face::Round { at, centre, .. } = &self.face else { return None };
        let [y, z] = at.dot(q);
        Some([y - centre[0], z - centre[1]])
    }

    /// The sign with which results count the force of the wall: along the row of a flat one, +1 of
    /// a lower and −1 of an upper one; +1 of a round one, whose pushes count by their magnitude.
    #[must_use]
    pub fn sign(&self) -> f64 {
        if self.is_round() { 1.0 } else { self.side().sign() }
    }

    /// The same wall, seen by a structure in other coordinates, where `row` turns each row into
    /// that of the same place there.
    pub(crate) fn carried(&self, mut row: impl FnMut(&Row) -> Row) -> Self {
        let mut carried = self.clone();
        match &mut carried.face {
            Face::Flat { at, .. } => *at = row(at),
            Face::Round { at, .. } => *at = at.carried(row),
        }
        carried
    }

    /// True for a round wall.
    #[must_use]
    pub fn is_round(&self) -> bool {
        matches!(self.face, Face::Round { .. })
    }

    /// Gap at the coordinate `w` (m): positive before the wall, negative behind it.
    #[must_use]
    pub fn gap(&self, w: f64) -> f64 {
        self.side().sign() * (w - self.position())
    }

    /// True for a flat rigid wall if the structure at `q` is behind it by more than `touch` (m).
    pub(crate) fn is_before(&self, q: &[f64], touch: f64) -> bool {
        self.law.is_rigid() && !self.is_round() && self.gap(self.row().dot(q)) < -touch
    }

    /// Signed force r on the body (N) of an elastic or penalised wall at the coordinate `w` (m) and
    /// its rate `wdot` (m/s).
    #[must_use]
    pub fn law_force(&self, w: f64, wdot: f64) -> f64 {
        let sign = self.side().sign();
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
        if !self.is_round() {
            finite(key("position"), self.position())?;
        }
        if let Face::Flat { direction: Some(degrees), .. } = self.face {
            finite(key("direction"), degrees)?;
        }
        self.law.validate(key)
    }
}
