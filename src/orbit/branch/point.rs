//! An orbit of a branch.

use super::super::admissible::Admissible;
use super::super::floquet::Floquet;
use super::super::periodic::Orbit;
use super::super::strobe::Strobe;

/// An orbit of a branch with all that is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The key's value.
    pub value: f64,
    /// The orbit.
    pub orbit: Orbit,
    /// Its multipliers.
    pub floquet: Floquet,
    /// Whether a body can follow it. An orbit of a structure is one that a body follows.
    pub admissible: Admissible,
    /// Of a structure an instant of the orbit and its state then: the events alone do not tell the
    /// motion.
    pub strobe: Option<Strobe>,
}
