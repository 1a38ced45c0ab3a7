//! Supports around a place of a structure that moves in two planes: flats or a round hole, with
//! friction.

use super::planes::{PlaneRows, heading};
use super::system::{finite, nonnegative, positive};
use super::{Row, Scene, Wall, WallLaw};
use crate::error::{Error, Result, Subject};
use serde::{Deserialize, Serialize};
use std::collections::HashSet;

/// Largest coefficient of friction that is accepted.
const MOST_FRICTION: f64 = 10.0;

/// Rounding allowance: share of its gap by which a start may lie outside of a round hole.
const TOUCHING: f64 = 1e-12;

/// A support around one place of a structure that moves in two planes. The displacement there from
/// the support's centre c is w = (g_y · q, g_z · q) − c.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Support {
    /// Name; results name it.
    pub name: String,
    /// The place that it surrounds.
    pub at: PlaneRows,
    /// The centre c, m.
    pub centre: [f64; 2],
    /// What bounds w.
    pub shape: Shape,
    /// Coefficient of Coulomb friction μ, from 0 to 10.
    pub friction: f64,
}

/// What bounds the displacement w at a support.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Shape {
    /// Flats: walls of the scene, which bound w along their normals.
    Flats(Vec<FlatWall>),
    /// A round hole: |w| ≤ γ. It pushes towards the centre.
    Round {
        /// The radial gap γ, m, above 0.
        gap: f64,
        /// The contact law along the normal.
        law: WallLaw,
    },
}

/// A flat of a support, as a wall of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FlatWall {
    /// Index of the wall in the scene.
    pub wall: usize,
    /// The direction of the flat's outward normal, degrees from +y towards +z.
    pub direction: f64,
}

/// A round support, with gap, restitution and law of its hole.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Hole<'a> {
    /// The support.
    pub support: &'a Support,
    /// The radial gap γ, m.
    pub gap: f64,
    /// The coefficient of restitution e along the normal.
    pub restitution: f64,
    /// The contact law along the normal.
    pub law: WallLaw,
}

impl Support {
    /// The displacement (or the velocity) of the place in both planes, for `q` of one value per
    /// degree of freedom: (g_y · q, g_z · q), without the centre.
    #[must_use]
    pub fn seen(&self, q: &[f64]) -> [f64; 2] {
        [self.at.y.dot(q), self.at.z.dot(q)]
    }

    /// The displacement w of the place from the centre of the support, m, for the displacement `q`
    /// (m, one value per degree of freedom).
    #[must_use]
    pub fn offset(&self, q: &[f64]) -> [f64; 2] {
        let [y, z] = self.seen(q);
        [y - self.centre[0], z - self.centre[1]]
    }

    /// The distance of each flat from the centre, m, where `walls` are those of the scene; of a
    /// round support the radial gap.
    #[must_use]
    pub fn gaps(&self, walls: &[Wall]) -> Vec<f64> {
        let distance = |flat: &FlatWall| {
            let wall = walls.get(flat.wall)?;
            let [y, z] = heading(flat.direction);
            Some(-wall.side.sign() * wall.position - y * self.centre[0] - z * self.centre[1])
        };
        match &self.shape {
            Shape::Flats(flats) => flats.iter().filter_map(distance).collect(),
            Shape::Round { gap, .. } => vec![*gap],
        }
    }

    /// The hole of a round support.
    #[must_use]
    pub fn hole(&self) -> Option<Hole<'_>> {
        match &self.shape {
            Shape::Round { gap, law } => {
                Some(Hole { support: self, gap: *gap, restitution: law.restitution().unwrap_or(0.0), law: *law })
            }
            Shape::Flats(_) => None,
        }
    }

    /// True for a rigid round support if the structure at `q` is outside of its hole, by more than
    /// the rounding of a place on its circle.
    pub(crate) fn holds_out(&self, q: &[f64]) -> bool {
        let [y, z] = self.offset(q);
        let distance = y.hypot(z);
        matches!(&self.shape, Shape::Round { gap, law } if law.is_rigid() && distance > gap * (1.0 + TOUCHING))
    }

    /// The same support, seen by a structure in other coordinates, where `row` turns each row into
    /// that of the same place there.
    pub(crate) fn carried(&self, mut row: impl FnMut(&Row) -> Row) -> Self {
        Self { at: PlaneRows { y: row(&self.at.y), z: row(&self.at.z) }, ..self.clone() }
    }
}

impl Scene {
    /// True if a support of the scene is a round hole or has friction: not every scheme steps such
    /// scenes.
    #[must_use]
    pub fn turns_or_rubs(&self) -> bool {
        self.supports.iter().any(|support| support.friction > 0.0 || matches!(support.shape, Shape::Round { .. }))
    }

    /// The round supports, in the scene's order: [`Step::holes`](crate::Step::holes) has one entry
    /// for each.
    pub fn holes(&self) -> impl Iterator<Item = Hole<'_>> {
        self.supports.iter().filter_map(Support::hole)
    }

    /// The laws of all places that a [`Contact`](crate::Contact) refers to: those of the walls,
    /// then those of the round supports.
    pub(crate) fn contact_laws(&self) -> impl Iterator<Item = WallLaw> {
        self.walls.iter().map(|wall| wall.law).chain(self.holes().map(|hole| hole.law))
    }

    /// The name of the wall or round support that a [`Contact`](crate::Contact) refers to: first
    /// the walls are counted, then the round supports.
    #[must_use]
    pub fn contact_name(&self, index: usize) -> Option<&str> {
        let hole = || self.holes().nth(index.checked_sub(self.walls.len())?).map(|hole| &*hole.support.name);
        self.walls.get(index).map(|wall| &*wall.name).or_else(hole)
    }

    /// True if wall number `wall` is a flat of a support.
    #[cfg(feature = "cli")]
    pub(crate) fn is_flat(&self, wall: usize) -> bool {
        let of = |shape: &Shape| match shape {
            Shape::Flats(flats) => flats.iter().any(|flat| flat.wall == wall),
            Shape::Round { .. } => false,
        };
        self.supports.iter().any(|support| of(&support.shape))
    }

    /// Checks the supports; `check_row` checks a row of one.
    pub(super) fn check_supports(&self, check_row: impl Fn(&Support, &Row) -> Result<()>) -> Result<()> {
        let mut names = HashSet::new();
        for support in &self.supports {
            let key = |part: &'static str| Subject::support(&support.name).part(part);
            if !names.insert(support.name.as_str()) {
                let value = format!("{:?}, which another support has", support.name);
                return Err(Error::invalid(key("name"), value, "a name of its own for each support"));
            }
            check_row(support, &support.at.y)?;
            check_row(support, &support.at.z)?;
            support.check_planes()?;
            support.centre.iter().try_for_each(|&x| finite(key("centre"), x))?;
            nonnegative(key("friction"), support.friction)?;
            if support.friction > MOST_FRICTION {
                let expected = format!("from 0 to {MOST_FRICTION}");
                return Err(Error::invalid(key("friction"), format!("{:?}", support.friction), expected));
            }
            match &support.shape {
                Shape::Flats(flats) => flats.iter().try_for_each(|flat| support.check_flat(flat, &self.walls))?,
                Shape::Round { gap, law } => support.check_hole(*gap, law, &self.initial.q)?,
            }
        }
        Ok(())
    }
}

impl Support {
    fn check_flat(&self, flat: &FlatWall, walls: &[Wall]) -> Result<()> {
        let key = || Subject::support(&self.name).part("flats");
        finite(key(), flat.direction)?;
        let Some(wall) = walls.get(flat.wall) else {
            let expected = format!("the index of one of the {} walls", walls.len());
            return Err(Error::invalid(key(), flat.wall, expected));
        };
        // The wall's side and row must agree with the direction, or friction would act elsewhere.
        let [y, z] = heading(flat.direction);
        let sign = -wall.side.sign();
        let size = |row: &Row| row.entries().iter().map(|entry| entry.1.abs()).fold(0.0, f64::max);
        let scale = size(&self.at.y).max(size(&self.at.z));
        let parts = [(&wall.at, sign), (&self.at.y, -y), (&self.at.z, -z)];
        let entries = parts.iter().flat_map(|(row, share)| row.entries().iter().map(move |(i, x)| (*i, share * x)));
        let entries: Vec<(usize, f64)> = entries.collect();
        let rest = |i: usize| entries.iter().filter(|entry| entry.0 == i).map(|entry| entry.1).sum::<f64>();
        if entries.iter().any(|entry| rest(entry.0).abs() > 1e-9 * scale) {
            let value = format!("the wall {:?}, {:?}° from +y", wall.name, flat.direction);
            return Err(Error::invalid(key(), value, "a wall across that direction, at the place of the support"));
        }
        Ok(())
    }

    /// Refuses a place that can move along one line only.
    fn check_planes(&self) -> Result<()> {
        let product = |a: &Row, b: &Row| -> f64 {
            let beside =
                |i: usize| b.entries().iter().filter(move |entry| entry.0 == i).map(|entry| entry.1).sum::<f64>();
            a.entries().iter().map(|&(i, weight)| weight * beside(i)).sum()
        };
        let (y, z) = (&self.at.y, &self.at.z);
        let (yy, zz, yz) = (product(y, y), product(z, z), product(y, z));
        if yy * zz - yz * yz <= 1e-12 * yy * zz {
            let value = "a place that moves along one line only";
            return Err(Error::invalid(
                Subject::support(&self.name).part("at"),
                value,
                "a place that moves in both planes",
            ));
        }
        Ok(())
    }

    fn check_hole(&self, gap: f64, law: &WallLaw, start: &[f64]) -> Result<()> {
        let key = |part: &'static str| Subject::support(&self.name).part(part);
        positive(key("gap"), gap)?;
        if !law.is_linear() {
            return Err(Error::invalid(key("law"), "that of a penalty", "a rigid or an elastic hole"));
        }
        law.validate(key)?;
        let [y, z] = self.seen(start);
        let distance = (y - self.centre[0]).hypot(z - self.centre[1]);
        if self.holds_out(start) {
            let value = format!("{distance:?} m from the centre of the round support {:?}", self.name);
            return Err(Error::invalid(
                ("initial state", "displacement"),
                value,
                format!("at most its gap, {gap:?} m"),
            ));
        }
        Ok(())
    }
}
