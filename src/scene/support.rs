//! Supports: walls around one place of a structure that moves in two planes.

use super::friction::FrictionCoefficients;
use super::planes::{PlaneRows, heading};
use super::system::{finite, positive};
use super::wall::{Face, Wall};
use super::{Row, Scene, WallLaw};
use crate::error::{Error, Result, Subject};
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::ops::Range;

/// Rounding of a velocity along a wall, relative to that of the place.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Rounding allowance: share of its gap by which a start may lie outside of a round wall.
const TOUCHING: f64 = 1e-12;

/// A support around one place of a structure that moves in two planes: one round wall or several
/// flat ones. The displacement there from the support's centre c is w = (g_y · q, g_z · q) − c.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Support {
    /// Name; results name it.
    pub name: String,
    /// The place that it surrounds.
    pub at: PlaneRows,
    /// The centre c, m.
    pub centre: [f64; 2],
    /// Its walls, which follow one another in the scene.
    pub walls: Range<usize>,
}

/// A round wall of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Hole<'a> {
    /// Its index among the scene's walls.
    pub index: usize,
    /// Its name.
    pub name: &'a str,
    /// The place that it surrounds.
    pub at: &'a PlaneRows,
    /// Its centre c, m.
    pub centre: [f64; 2],
    /// The radial gap γ, m.
    pub gap: f64,
    /// The coefficient of restitution e along the normal.
    pub restitution: f64,
    /// The contact law along the normal.
    pub law: WallLaw,
    /// The coefficients of Coulomb friction.
    pub friction: FrictionCoefficients,
}

impl Support {
    /// Its walls among those of the scene, with their indices.
    pub fn members<'a>(&self, walls: &'a [Wall]) -> impl Iterator<Item = (usize, &'a Wall)> + Clone + use<'a> {
        let (start, end) = (self.walls.start, self.walls.end);
        walls.iter().enumerate().take(end).skip(start)
    }

    /// The distance of each flat from the centre, m, where `walls` are those of the scene; of a
    /// round wall the radial gap.
    #[must_use]
    pub fn gaps(&self, walls: &[Wall]) -> Vec<f64> {
        let distance = |(_, wall): (usize, &Wall)| match wall.face {
            Face::Flat { side, position, direction, .. } => {
                let [y, z] = heading(direction?);
                Some(-side.sign() * position - y * self.centre[0] - z * self.centre[1])
            }
            Face::Round { gap, .. } => Some(gap),
        };
        self.members(walls).filter_map(distance).collect()
    }

    /// The round wall of the support, among those of the scene.
    #[must_use]
    pub fn hole<'a>(&self, walls: &'a [Wall]) -> Option<Hole<'a>> {
        self.members(walls).find_map(|(index, wall)| wall.hole(index))
    }

    /// The largest coefficients of friction of its walls, among those of the scene.
    #[must_use]
    pub fn friction(&self, walls: &[Wall]) -> FrictionCoefficients {
        self.members(walls).fold(FrictionCoefficients::default(), |most, (_, wall)| wall.friction.max(most))
    }

    /// The same support, seen by a structure in other coordinates, where `row` turns each row into
    /// that of the same place there.
    pub(crate) fn carried(&self, row: impl FnMut(&Row) -> Row) -> Self {
        Self { at: self.at.carried(row), ..self.clone() }
    }
}

impl Hole<'_> {
    /// (g_y · x, g_z · x), without the centre.
    #[must_use]
    pub fn seen(&self, x: &[f64]) -> [f64; 2] {
        self.at.dot(x)
    }

    /// The displacement w of the place from the centre, m, for the displacement `q` (m).
    #[must_use]
    pub fn offset(&self, q: &[f64]) -> [f64; 2] {
        let [y, z] = self.seen(q);
        [y - self.centre[0], z - self.centre[1]]
    }
}

impl Wall {
    /// A round wall as such, with its index in the scene.
    pub(crate) fn hole(&self, index: usize) -> Option<Hole<'_>> {
        let Face::Round { at, centre, gap } = &self.face else { return None };
        let restitution = self.law.restitution().unwrap_or(0.0);
        let (law, friction) = (self.law, self.friction);
        Some(Hole { index, name: &self.name, at, centre: *centre, gap: *gap, restitution, law, friction })
    }

    /// True for a rigid round wall if the structure at `q` is outside of it, by more than the
    /// rounding of a place on its circle.
    pub(crate) fn holds_out(&self, q: &[f64]) -> bool {
        self.is_round() && self.law.is_rigid() && self.coordinate(q) > self.position() * (1.0 + TOUCHING)
    }
}

impl Scene {
    /// True if a wall of the scene is round or has friction: not every scheme steps such scenes.
    #[must_use]
    pub fn turns_or_rubs(&self) -> bool {
        self.walls.iter().any(|wall| wall.friction.acts() || wall.is_round())
    }

    /// The round walls, in the scene's order.
    pub fn holes(&self) -> impl Iterator<Item = Hole<'_>> {
        self.walls.iter().enumerate().filter_map(|(index, wall)| wall.hole(index))
    }

    /// The name of wall number `wall`, as a [`Contact`](crate::Contact) refers to it.
    #[must_use]
    pub fn wall_name(&self, wall: usize) -> Option<&str> {
        self.walls.get(wall).map(|wall| &*wall.name)
    }

    /// The support that wall number `wall` belongs to, if any.
    #[must_use]
    pub fn support_of(&self, wall: usize) -> Option<&Support> {
        self.supports.iter().find(|support| support.walls.contains(&wall))
    }

    /// True if a body of the displacement `q` (m) and the velocity `v` (m/s) stands on wall number
    /// `index`: it touches the wall and does not slide along it. A contact of a run that begins so
    /// counts as one that stuck before.
    pub(crate) fn stands_on(&self, index: usize, q: &[f64], v: &[f64]) -> bool {
        let (Some(wall), Some(support)) = (self.walls.get(index), self.support_of(index)) else { return false };
        let [y, z] = match (&wall.face, wall.offset(q)) {
            (Face::Flat { direction, .. }, _) => heading(direction.unwrap_or_default()),
            (_, offset) => offset.unwrap_or_default(),
        };
        let rate = support.at.dot(v);
        let along = (y * rate[1] - z * rate[0]).abs();
        along <= ROUNDING * y.hypot(z) * rate[0].hypot(rate[1])
            && wall.gap(wall.coordinate(q)) <= self.touching_distance()
    }

    /// Checks the supports; `check_row` checks a row of one.
    pub(super) fn check_supports(&self, check_row: impl Fn(&str, &Row) -> Result<()>) -> Result<()> {
        let mut names = HashSet::new();
        for support in &self.supports {
            let key = |part: &'static str| Subject::support(&support.name).part(part);
            if !names.insert(support.name.as_str()) {
                let value = format!("{:?}, which another support has", support.name);
                return Err(Error::invalid(key("name"), value, "a name of its own for each support"));
            }
            check_row(&support.name, &support.at.y)?;
            check_row(&support.name, &support.at.z)?;
            check_planes(&support.name, &support.at)?;
            support.centre.iter().try_for_each(|&x| finite(key("centre"), x))?;
            if support.walls.is_empty() || support.walls.end > self.walls.len() {
                let value = format!("{:?}", support.walls);
                return Err(Error::invalid(
                    key("walls"),
                    value,
                    format!("one or more of the {} walls", self.walls.len()),
                ));
            }
            let shared = support.members(&self.walls).find(|(index, _)| self.support_of(*index) != Some(support));
            if let Some((_, wall)) = shared {
                let value = format!("{:?}, of which another support has {:?}", support.walls, wall.name);
                return Err(Error::invalid(key("walls"), value, "walls that belong to no other support"));
            }
            support.members(&self.walls).try_for_each(|(_, wall)| support.check_wall(wall))?;
            if support.hole(&self.walls).is_some() && support.walls.len() > 1 {
                let value = format!("a round wall among {}", support.walls.len());
                return Err(Error::invalid(key("walls"), value, "one round wall, or flat ones"));
            }
        }
        for (index, wall) in self.walls.iter().enumerate() {
            let support = self.support_of(index);
            let owner = match support {
                Some(support) => Subject::support(&support.name),
                None => Subject::wall(&wall.name),
            };
            wall.friction.validate(&owner)?;
            if wall.friction.acts() && support.is_none() {
                let expected = "0, or a wall of a support, around a place that moves in two planes";
                return Err(Error::invalid(owner.part("friction"), wall.friction, expected));
            }
            if let Face::Round { at, centre, gap } = &wall.face {
                check_row(&wall.name, &at.y)?;
                check_row(&wall.name, &at.z)?;
                check_planes(&wall.name, at)?;
                centre.iter().try_for_each(|&x| finite(owner.clone().part("centre"), x))?;
                Self::check_hole(wall, &owner, *gap)?;
            }
        }
        Ok(())
    }

    /// Refuses to keep so few `modes` that a place of a support no longer moves in both planes.
    pub(super) fn check_kept_planes(&self, modes: usize) -> Result<()> {
        let stuck = |support: &&Support| check_planes(&support.name, &support.at).is_err();
        self.supports.iter().find(stuck).map_or(Ok(()), |support| {
            let value = format!("{modes}, with which the support {:?} moves along one line at most", support.name);
            Err(Error::invalid("modes", value, "more, so that the place of each support moves in both planes"))
        })
    }

    fn check_hole(wall: &Wall, owner: &Subject, gap: f64) -> Result<()> {
        positive(owner.clone().part("gap"), gap)?;
        if !wall.law.is_linear() {
            let found = wall.law.kind();
            return Err(Error::invalid(owner.clone().part("law"), found, "a rigid or an elastic hole"));
        }
        wall.law.validate(|part: &'static str| owner.clone().part(part))
    }

    /// Refuses a start outside of a rigid hole.
    pub(super) fn check_start_in_holes(&self) -> Result<()> {
        let Some(wall) = self.walls.iter().find(|wall| wall.holds_out(&self.initial.q)) else { return Ok(()) };
        let distance = wall.coordinate(&self.initial.q);
        let value = format!("{distance:?} m from the centre of the round support {:?}", wall.name);
        let expected = format!("at most its gap, {:?} m", wall.position());
        Err(Error::invalid(("initial state", "displacement"), value, expected))
    }
}

impl Support {
    /// Refuses a wall that does not stand around the place of the support.
    fn check_wall(&self, wall: &Wall) -> Result<()> {
        let key = || Subject::support(&self.name).part("walls");
        let across = |rest: &[(&Row, f64)]| {
            let size = |row: &Row| row.entries().iter().map(|entry| entry.1.abs()).fold(0.0, f64::max);
            let scale = size(&self.at.y).max(size(&self.at.z));
            let entries = rest.iter().flat_map(|(row, share)| row.entries().iter().map(move |(i, x)| (*i, share * x)));
            let entries: Vec<(usize, f64)> = entries.collect();
            let left = |i: usize| entries.iter().filter(|entry| entry.0 == i).map(|entry| entry.1).sum::<f64>();
            entries.iter().any(|entry| left(entry.0).abs() > 1e-9 * scale)
        };
        let (apart, expected) = match &wall.face {
            // Side and row of the wall must agree with the direction, or friction acts elsewhere.
            Face::Flat { side, at, direction, .. } => {
                let [y, z] = heading(direction.unwrap_or(f64::NAN));
                let sign = -side.sign();
                let apart = across(&[(at, sign), (&self.at.y, -y), (&self.at.z, -z)]);
                (apart || direction.is_none(), "a wall across its direction, at the place of the support")
            }
            Face::Round { at, centre, .. } => {
                let other = across(&[(&at.y, 1.0), (&self.at.y, -1.0)]) || across(&[(&at.z, 1.0), (&self.at.z, -1.0)]);
                (other || *centre != self.centre, "a round wall around the place and the centre of the support")
            }
        };
        match (apart, &wall.face) {
            (false, _) => Ok(()),
            (true, Face::Flat { direction: Some(degrees), .. }) => {
                Err(Error::invalid(key(), format!("the wall {:?}, {degrees:?}° from +y", wall.name), expected))
            }
            (true, _) => Err(Error::invalid(key(), format!("the wall {:?}", wall.name), expected)),
        }
    }
}

/// Refuses a place that can move along one line only.
fn check_planes(name: &str, at: &PlaneRows) -> Result<()> {
    let product = |a: &Row, b: &Row| -> f64 {
        let beside = |i: usize| b.entries().iter().filter(move |entry| entry.0 == i).map(|entry| entry.1).sum::<f64>();
        a.entries().iter().map(|&(i, weight)| weight * beside(i)).sum()
    };
    let (y, z) = (&at.y, &at.z);
    let (yy, zz, yz) = (product(y, y), product(z, z), product(y, z));
    if yy * zz - yz * yz <= 1e-12 * yy * zz {
        let value = "a place that moves along one line only";
        return Err(Error::invalid(Subject::support(name).part("at"), value, "a place that moves in both planes"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::Symmetric;
    use crate::scene::{Structure, Wall};

    #[test]
    fn a_wall_belongs_to_one_support() {
        let identity = Symmetric::diagonal(&[1.0; 2]);
        let structure = Structure { mass: identity.clone(), damping: Symmetric::zeros(2), stiffness: identity };
        let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
        let hole = Wall::round("hole", at.clone(), 1e-3);
        let mut scene = Scene::structure(structure).with_support("first", at.clone(), [0.0; 2], vec![hole]);
        assert!(scene.validate().is_ok());
        scene.supports.push(Support { name: "second".to_owned(), at, centre: [0.0; 2], walls: 0..1 });
        let error = scene.validate().unwrap_err().to_string();
        assert!(error.contains("of which another support has \"hole\""), "{error}");
    }
}
