//! The walls that touch during an arc.

use crate::scene::Side;

/// An elastic wall that touches during an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Touch {
    /// Index of the wall in the scene.
    pub wall: usize,
    /// Its position g, m.
    pub position: f64,
    /// k_a, N/m.
    pub stiffness: f64,
    /// c_a, N s/m.
    pub damping: f64,
}

/// The rigid wall that carries a body at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Support {
    /// Index of the wall in the scene.
    pub wall: usize,
    /// The side on which it stands.
    pub side: Side,
}
