//! The places of contact: walls, and supports made of them.

use crate::scene::Scene;
use serde::{Deserialize, Serialize};

/// Whether a place is a wall or a support.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlaceKind {
    /// A wall of the scene; each flat of a support is one.
    Wall,
    /// A support: all its flats together.
    Support,
}

/// A wall or a support.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ContactPlace {
    /// Name of the wall or the support.
    #[serde(rename = "place")]
    pub name: String,
    /// Which of the two it is.
    pub kind: PlaceKind,
}

impl ContactPlace {
    /// True for a support, and for a wall that is no flat of one.
    pub(crate) fn stands_alone(&self, scene: &Scene) -> bool {
        let wall = || scene.walls.iter().position(|wall| wall.name == self.name);
        self.kind == PlaceKind::Support || wall().is_none_or(|wall| scene.support_of(wall).is_none())
    }
}

/// A wall of a scene as results name it: a flat one by itself, a round one as its support.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactSite<'a> {
    /// Index among the walls of the scene.
    pub wall: usize,
    /// Name of the wall or the support.
    pub name: &'a str,
    /// Which of the two it is.
    pub kind: PlaceKind,
}

impl<'a> ContactSite<'a> {
    /// Every flat wall of `scene`, then every round support, in the scene's order.
    pub fn all(scene: &'a Scene) -> impl Iterator<Item = Self> {
        let flats = scene.walls.iter().enumerate().filter(|(_, wall)| !wall.is_round());
        let flats = flats.map(|(wall, flat)| Self { wall, name: &flat.name, kind: PlaceKind::Wall });
        let rounds = scene.holes().map(|hole| Self { wall: hole.index, name: hole.name, kind: PlaceKind::Support });
        flats.chain(rounds)
    }
}

impl PlaceKind {
    /// Its name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Wall => "wall",
            Self::Support => "support",
        }
    }
}
