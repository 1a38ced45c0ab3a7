//! A bar in axial motion.

use super::mesh::{Mesh, elements};
use super::profile;
use crate::error::{Error, Result, Subject};
use crate::linear::Symmetric;
use crate::scene::system::{nonnegative, positive};
use crate::scene::{Row, Structure};
use serde::{Deserialize, Serialize};

/// The support of an end of a bar.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum BarEnd {
    /// A free end.
    Free,
    /// A fixed end: no displacement.
    Fixed,
    /// A spring to the ground.
    Sprung {
        /// Stiffness, N/m; 0 or more.
        stiffness: f64,
    },
}

/// The mass matrix of an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub enum MassMatrix {
    /// ∫ ρ A Nᵀ N dx: frequencies are too high, at second order.
    #[default]
    Consistent,
    /// Half of the element's mass on each of its nodes: M is diagonal; frequencies are too low, at
    /// second order. A wave then meets a wall one node at a time, which is why impact studies often
    /// choose it.
    Lumped,
}

/// A bar in axial motion, ρ A ü = (E A u′)′, by linear elements of equal length. With ℎ the length
/// of an element,
///
/// K = EA/ℎ [1 −1; −1 1],  M = ρAℎ/6 [2 1; 1 2] (consistent) or ρAℎ/2 [1 0; 0 1] (lumped).
///
/// Degrees of freedom are the displacements of the nodes from left to right, m, without those of
/// fixed ends. M and K are tridiagonal. Static displacements are exact at the nodes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Bar {
    /// Length, m; positive.
    pub length: f64,
    /// Area of the cross-section A, m²; positive.
    pub area: f64,
    /// Young's modulus E, Pa; positive.
    pub youngs_modulus: f64,
    /// Density ρ, kg/m³; positive.
    pub density: f64,
    /// Number of elements, from 1 to [`MOST_ELEMENTS`](super::MOST_ELEMENTS).
    pub elements: usize,
    /// The support of the end at 0.
    pub left: BarEnd,
    /// The support of the end at `length`.
    pub right: BarEnd,
    /// The mass matrix.
    pub mass: MassMatrix,
}

fn shape(xi: f64) -> [f64; 2] {
    [1.0 - xi, xi]
}

impl Bar {
    /// Checks the values, and numbers the unknowns.
    fn mesh(&self) -> Result<Mesh<2>> {
        positive(("bar", "length"), self.length)?;
        positive(("bar", "area"), self.area)?;
        positive(("bar", "youngs_modulus"), self.youngs_modulus)?;
        positive(("bar", "density"), self.density)?;
        elements(("bar", "elements"), self.elements)?;
        let mut fixed = Vec::new();
        for (key, end, node) in [("left", self.left, 0), ("right", self.right, self.elements)] {
            match end {
                BarEnd::Free => {}
                BarEnd::Fixed => fixed.push(node),
                BarEnd::Sprung { stiffness } => nonnegative(Subject::from(("bar", key)).part("stiffness"), stiffness)?,
            }
        }
        if self.elements == 1 && fixed.len() == 2 {
            return Err(Error::invalid(("bar", "elements"), 1, "2 or more between two fixed ends: nothing could move"));
        }
        Ok(Mesh { length: self.length, elements: self.elements, fixed })
    }

    /// M and K, without damping.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `system.bar.` and the name of the field.
    pub fn structure(&self) -> Result<Structure> {
        let mesh = self.mesh()?;
        let stiffness = self.youngs_modulus * self.area / mesh.size();
        let mass = self.density * self.area * mesh.size();
        let m = match self.mass {
            MassMatrix::Consistent => [[mass / 3.0, mass / 6.0], [mass / 6.0, mass / 3.0]],
            MassMatrix::Lumped => [[mass / 2.0, 0.0], [0.0, mass / 2.0]],
        };
        let ends = [(0, self.left), (self.elements, self.right)];
        let spring = |(node, end)| if let BarEnd::Sprung { stiffness } = end { Some((node, stiffness)) } else { None };
        let springs: Vec<_> = ends.into_iter().filter_map(spring).collect();
        Ok(Structure {
            mass: mesh.assemble(&m, &[]),
            damping: Symmetric::zeros(mesh.unknowns()),
            stiffness: mesh.assemble(&[[stiffness, -stiffness], [-stiffness, stiffness]], &springs),
        })
    }

    /// The row of the displacement at a position, m from the left end. It is zero at a fixed end.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `position`, or of the bar itself.
    pub fn at(&self, position: f64) -> Result<Row> {
        self.mesh()?.at(position, shape)
    }

    /// The row of a force spread evenly over a stretch, from and to in m from the left end: the
    /// load is the resultant, N (a force per metre times the length of the stretch), applied as
    /// consistent nodal forces. A probe with this row records the mean displacement of the stretch.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `from` or `to`, or of the bar itself.
    pub fn spread(&self, from: f64, to: f64) -> Result<Row> {
        self.mesh()?.spread(from, to, shape)
    }

    /// The vector q of a displacement (or velocity) that is given as a function along the bar: its
    /// values at the nodes. Errors name `subject`.
    ///
    /// # Errors
    /// [`Error::Invalid`] where the field is not finite, or not 0 at a fixed end; or of the bar
    /// itself.
    pub fn field(&self, subject: impl Into<Subject>, field: &dyn Fn(f64) -> f64) -> Result<Vec<f64>> {
        let mesh = self.mesh()?;
        let values: Vec<f64> = (0..=self.elements).map(|i| field(mesh.node(i))).collect();
        mesh.gather(subject, &values)
    }

    /// The vector q of a displacement (or velocity) that is linear between `points` (position m,
    /// value). Errors name `subject`.
    ///
    /// # Errors
    /// As [`Bar::field`]; and where the positions do not increase from 0 to the length.
    pub fn field_through(&self, subject: impl Into<Subject>, points: &[(f64, f64)]) -> Result<Vec<f64>> {
        let subject = subject.into();
        profile::check(&subject, points, self.length)?;
        self.field(subject, &|x| profile::linear(points, x))
    }
}
