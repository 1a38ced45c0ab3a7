//! The places of contact: walls, and supports made of them.

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
