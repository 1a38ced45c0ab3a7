//! An orbit of a branch.

use super::super::admissible::Admissible;
use super::super::floquet::Floquet;
use super::super::periodic::Orbit;
use super::super::strobe::Strobe;

/// An orbit of a branch with its multipliers and its admissibility.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The key's value.
    pub value: f64,
    /// The orbit.
    pub orbit: Orbit,
    /// Its multipliers.
    pub floquet: Floquet,
    /// Whether a body can follow it. A structure follows each of its orbits: they come from runs.
    pub admissible: Admissible,
    /// For a structure, an instant of the orbit and the state then: the events alone do not
    /// determine the motion.
    pub strobe: Option<Strobe>,
}
