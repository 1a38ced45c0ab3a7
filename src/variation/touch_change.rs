//! What a key changes of an elastic wall that touches one degree of freedom.
//!
//! r = −k_a (G q − g) − c_a G q̇ with G = 1 changes by
//!
//! δr = −k_a δq − c_a δq̇ − A q − B q̇ + E,
//!
//! A = δk_a + k_a δG, B = δc_a + c_a δG, E = δk_a g + k_a δg,
//!
//! and the force on the body, G r, by δG r more.

use super::tangent::{SceneTangent, WallTangent};
use crate::flow::{Arc, Touch};

/// The law of an elastic wall that touches, and its change: A, B and E.
pub(super) struct TouchChange {
    pub touch: Touch,
    /// δG.
    pub row: f64,
    pub own: [f64; 3],
}

impl TouchChange {
    fn new(touch: &Touch, wall: &WallTangent) -> Self {
        let row = wall.row.dot(&[1.0]);
        let stiffness = wall.stiffness + touch.stiffness * row;
        let damping = wall.damping + touch.damping * row;
        let constant = wall.stiffness * touch.position + touch.stiffness * wall.position;
        Self { touch: *touch, row, own: [stiffness, damping, constant] }
    }

    /// Of the walls that touch during `arc`, by the key of `tangent`.
    pub fn all<'a>(arc: &'a Arc, tangent: &'a SceneTangent) -> impl Iterator<Item = Self> + 'a {
        arc.touching_walls().filter_map(|touch| Some(Self::new(touch, tangent.wall(touch.wall)?)))
    }
}
