//! Supports made of flats, around a structure that moves in two planes.

use super::friction::FrictionCoefficients;
use super::planes::{PlaneRows, heading};
use super::support::Support;
use super::system::{finite, nonnegative};
use super::wall::Face;
use super::{Side, Wall, WallLaw};
use crate::error::{Error, Result, Subject};

/// Most flats of one support.
pub const MOST_FLATS: usize = 360;

/// One flat of a support, seen from the support's centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flat {
    /// The direction of its outward normal, degrees from +y towards +z.
    pub direction: f64,
    /// How far the structure may move from the centre in that direction, m.
    pub gap: f64,
}

/// A support of flats around one place of a structure that moves in two planes: bars of a lattice,
/// anti-vibration bars, the lands of a broached hole.
///
/// The displacement w = (w_y, w_z) of the place is bounded by n_k · (w − c) ≤ γ_k for each flat k,
/// with n_k = (cos α_k, sin α_k). Each flat is a wall like any other, so every scheme treats it as
/// it treats walls: a rigid flat by Signorini's condition and Newton's law of impact along its
/// normal, without friction; an elastic one by its spring and dashpot.
///
/// ```
/// use signorini::{Flat, Flats, PlaneRows, Row, Side, WallLaw};
///
/// // A square of half width 0.2 mm around the only mass of an oscillator in two planes.
/// let square = Flats {
///     name: "bars".to_owned(),
///     at: PlaneRows::doubled(&Row::dof(0), 1),
///     flats: [0.0, 90.0, 180.0, 270.0].map(|direction| Flat { direction, gap: 0.2e-3 }).to_vec(),
///     centre: [0.0, 0.0],
///     law: WallLaw::Rigid { restitution: 0.5 },
///     friction: 0.0.into(),
/// };
/// let walls = square.walls()?;
/// // The one opposite to the first.
/// assert_eq!((walls[2].side(), walls[2].position()), (Side::Lower, -0.2e-3));
/// assert_eq!(walls[2].row(), walls[0].row());
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Flats {
    /// Name: letters, digits, `-` and `_`; its walls are NAME`-flat-1`, NAME`-flat-2`, …
    pub name: String,
    /// The place it surrounds.
    pub at: PlaneRows,
    /// The flats; no two of one direction.
    pub flats: Vec<Flat>,
    /// The centre c, m.
    pub centre: [f64; 2],
    /// The contact law of every flat.
    pub law: WallLaw,
    /// The coefficients of Coulomb friction of every flat.
    pub friction: FrictionCoefficients,
}

impl Flats {
    /// The walls of the flats, in their order. Two opposite flats are an upper and a lower wall of
    /// one row; the direction of that row is from 0° to below 180°.
    ///
    /// # Errors
    /// [`Error::Invalid`] under the support's `directions`, `gap` or `centre`: no flats or more
    /// than [`MOST_FLATS`], a direction that is not finite or occurs twice, a gap below 0, a centre
    /// that is not finite. The law and the row are checked by
    /// [`Scene::validate`](super::Scene::validate).
    pub fn walls(&self) -> Result<Vec<Wall>> {
        let key = |part: &'static str| Subject::support(&self.name).part(part);
        if self.flats.is_empty() || self.flats.len() > MOST_FLATS {
            let count = format!("{} flats", self.flats.len());
            return Err(Error::invalid(key("directions"), count, format!("from 1 to {MOST_FLATS}")));
        }
        for x in self.centre {
            finite(key("centre"), x)?;
        }
        let mut walls: Vec<Wall> = Vec::with_capacity(self.flats.len());
        for (index, flat) in self.flats.iter().enumerate() {
            finite(key("directions").value(index), flat.direction)?;
            nonnegative(key("gap").value(index), flat.gap)?;
            let (direction, side) = facing(flat.direction);
            let at = self.at.along(direction);
            if walls.iter().any(|other| *other.row() == at && other.side() == side) {
                let value = format!("{:?}, for the second time", flat.direction);
                return Err(Error::invalid(key("directions").value(index), value, "each direction once"));
            }
            let [y, z] = heading(direction);
            let centre = y * self.centre[0] + z * self.centre[1];
            let position = centre - side.sign() * flat.gap;
            let name = format!("{}-flat-{}", self.name, index + 1);
            let face = Face::Flat { side, position, at, direction: Some(flat.direction) };
            walls.push(Wall { name, face, law: self.law, friction: self.friction });
        }
        Ok(walls)
    }

    /// The support that these flats make, where the first of their walls has index `first` in the
    /// scene.
    #[must_use]
    pub fn support(&self, first: usize) -> Support {
        let walls = first..first + self.flats.len();
        Support { name: self.name.clone(), at: self.at.clone(), centre: self.centre, walls }
    }

    /// The ways out between neighbouring flats a half turn or more apart, in which the structure is
    /// not bounded: the direction in the middle, degrees, and by how much more than a half turn.
    #[cfg(any(test, feature = "case"))]
    pub(crate) fn ways_out(&self) -> impl Iterator<Item = (f64, f64)> {
        let mut turns: Vec<f64> = self.flats.iter().map(|flat| flat.direction.rem_euclid(360.0)).collect();
        turns.sort_by(f64::total_cmp);
        turns.extend(turns.first().map(|first| first + 360.0));
        let pairs: Vec<(f64, f64)> =
            turns.windows(2).map(|pair| (0.5 * (pair[0] + pair[1]), pair[1] - pair[0])).collect();
        pairs.into_iter().filter(|(_, apart)| *apart >= 180.0).map(|(middle, apart)| (middle % 360.0, apart - 180.0))
    }
}

/// The direction from 0° to below 180° of the row that a flat bounds, and the side on which the
/// flat stands there.
fn facing(degrees: f64) -> (f64, Side) {
    let turn = degrees.rem_euclid(360.0) % 360.0;
    if turn < 180.0 { (turn, Side::Upper) } else { (turn - 180.0, Side::Lower) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Row;

    fn flats(directions: &[f64]) -> Flats {
        Flats {
            name: "s".to_owned(),
            at: PlaneRows::doubled(&Row::dof(0), 1),
            flats: directions.iter().map(|&direction| Flat { direction, gap: 1e-3 }).collect(),
            centre: [0.3e-3, -0.2e-3],
            law: WallLaw::Rigid { restitution: 1.0 },
            friction: 0.0.into(),
        }
    }

    #[test]
    fn a_flat_is_met_where_its_normal_says() {
        let support = flats(&[0.0, 75.0, 180.0, 261.0]);
        for (wall, flat) in support.walls().unwrap().iter().zip(&support.flats) {
            // The point of the flat's plane nearest to the centre has no gap there, the centre has
            // the whole one; a few roundings of 1e-3.
            let [y, z] = heading(flat.direction);
            let met = [support.centre[0] + flat.gap * y, support.centre[1] + flat.gap * z];
            assert!(wall.gap(wall.row().dot(&met)).abs() < 1e-18, "{wall:?}");
            assert!((wall.gap(wall.row().dot(&support.centre)) - flat.gap).abs() < 1e-18, "{wall:?}");
        }
    }

    #[test]
    fn flats_within_a_half_turn_leave_a_way_out() {
        let is_open = |directions: &[f64]| flats(directions).ways_out().next().is_some();
        assert!(is_open(&[0.0]) && is_open(&[0.0, 180.0]) && is_open(&[350.0, 10.0, 90.0]));
        assert!(!is_open(&[0.0, 120.0, 240.0]) && !is_open(&[-45.0, 45.0, 135.0, 225.0]));
    }

    #[test]
    fn what_makes_no_support_is_refused() {
        let mut negative = flats(&[0.0]);
        negative.flats[0].gap = -1e-3;
        let mut nowhere = flats(&[0.0]);
        nowhere.centre[1] = f64::NAN;
        for (support, words) in [
            (flats(&[]), "support \"s\": directions is 0 flats"),
            (flats(&[10.0, 370.0]), "value 2 is 370.0, for the second time"),
            (flats(&[f64::INFINITY]), "directions: value 1 is inf"),
            (negative, "gap: value 1 is -0.001"),
            (nowhere, "centre is NaN"),
        ] {
            let error = support.walls().unwrap_err();
            assert!(error.is_request() && error.to_string().contains(words), "{error}");
        }
    }
}
