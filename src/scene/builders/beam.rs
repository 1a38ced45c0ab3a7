//! A beam in bending: a tube, a rod or a rectangular bar.

use super::mesh::{Mesh, elements};
use super::profile;
use crate::error::{Error, Result, Subject};
use crate::linear::Symmetric;
use crate::scene::system::{nonnegative, positive};
use crate::scene::{Row, Structure};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// The support of an end of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum BeamEnd {
    /// A free end.
    Free,
    /// A pinned end: no deflection, free rotation.
    Pinned,
    /// A clamped end: no deflection and no rotation.
    Clamped,
    /// Springs to the ground.
    Sprung {
        /// Against deflection, N/m; 0 or more.
        stiffness: f64,
        /// Against rotation, N m/rad; 0 or more.
        rotational: f64,
    },
}

/// The cross-section of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum BeamSection {
    /// A tube or a rod: I = π (D⁴ − d⁴)/64, A = π (D² − d²)/4.
    Tube {
        /// Outer diameter D, m; positive.
        outer_diameter: f64,
        /// Inner diameter d, m; 0 (a rod) or more, less than D.
        inner_diameter: f64,
    },
    /// A solid rectangle, which bends in the direction of its height: I = b h³/12, A = b h.
    Rectangle {
        /// Width b across the vibration, m; positive.
        width: f64,
        /// Height h in the direction of the vibration, m; positive.
        height: f64,
    },
}

/// Why some dimensions are not those of one section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SectionFault {
    /// A diameter beside a side of a rectangle.
    TwoSections,
    /// This dimension is missing.
    Missing(&'static str),
}

impl BeamSection {
    /// The section of the dimensions that are given (m): a tube of an outer and an inner diameter,
    /// 0 where that is left out, or a rectangle of a width and a height.
    ///
    /// # Errors
    /// [`SectionFault`], where these are not the dimensions of one section.
    pub fn of(diameters: [Option<f64>; 2], sides: [Option<f64>; 2]) -> std::result::Result<Self, SectionFault> {
        match (diameters, sides) {
            ([Some(outer_diameter), inner], [None, None]) => {
                Ok(Self::Tube { outer_diameter, inner_diameter: inner.unwrap_or(0.0) })
            }
            ([None, None], [Some(width), Some(height)]) => Ok(Self::Rectangle { width, height }),
            ([None, None], [Some(_), None]) => Err(SectionFault::Missing("height")),
            ([None, None], [None, Some(_)]) => Err(SectionFault::Missing("width")),
            ([None, _], [None, None]) => Err(SectionFault::Missing("outer_diameter")),
            _ => Err(SectionFault::TwoSections),
        }
    }

    /// Outer diameter of a tube, m; a rectangle has none.
    #[must_use]
    pub fn outer_diameter(&self) -> Option<f64> {
        match *self {
            Self::Tube { outer_diameter, .. } => Some(outer_diameter),
            Self::Rectangle { .. } => None,
        }
    }

    /// Inner diameter of a tube, m, 0 of a rod; a rectangle has none.
    #[must_use]
    pub fn inner_diameter(&self) -> Option<f64> {
        match *self {
            Self::Tube { inner_diameter, .. } => Some(inner_diameter),
            Self::Rectangle { .. } => None,
        }
    }

    /// Thickness of the wall of a tube, m; of a rod its radius. A rectangle has none.
    #[must_use]
    pub fn wall_thickness(&self) -> Option<f64> {
        match *self {
            Self::Tube { outer_diameter, inner_diameter } => Some(0.5 * (outer_diameter - inner_diameter)),
            Self::Rectangle { .. } => None,
        }
    }

    /// Checks the dimensions.
    fn check(&self) -> Result<()> {
        match *self {
            Self::Tube { outer_diameter, inner_diameter: inner } => {
                positive(("beam", "outer_diameter"), outer_diameter)?;
                if !(0.0..outer_diameter).contains(&inner) {
                    let expected = format!("0 or more, less than the outer diameter, {outer_diameter:?} m");
                    return Err(Error::invalid(("beam", "inner_diameter"), format_args!("{inner:?}"), expected));
                }
                Ok(())
            }
            Self::Rectangle { width, height } => {
                positive(("beam", "width"), width)?;
                positive(("beam", "height"), height)
            }
        }
    }
}

/// A straight beam in bending, Euler–Bernoulli, m′ ẅ + (E I w″)″ = f, by Hermite elements of equal
/// length with consistent mass. With I and A of its [section](BeamSection),
///
/// m′ = ρ A + added mass,  ℎ the length of an element,
///
/// K = EI/ℎ³ [12 6ℎ −12 6ℎ; · 4ℎ² −6ℎ 2ℎ²; · · 12 −6ℎ; · · · 4ℎ²],
/// M = m′ℎ/420 [156 22ℎ 54 −13ℎ; · 4ℎ² 13ℎ −3ℎ²; · · 156 −22ℎ; · · · 4ℎ²].
///
/// Two degrees of freedom per node from left to right, deflection (m) and rotation w′ (rad),
/// without those that the supports hold; the half bandwidth is 3. Frequencies are too high, at
/// fourth order; static deflections under forces and moments at nodes are exact at the nodes. Shear
/// deformation and rotary inertia are neglected: the model holds for wavelengths of many diameters
/// or heights.
///
/// ```
/// use signorini::{Beam, BeamEnd, BeamSection, Damping, Scene, Wall};
///
/// // A steel tube of three spans between loose supports, cut to its 20 slowest modes.
/// let tube = Beam {
///     length: 3.0,
///     youngs_modulus: 2.0e11,
///     density: 7850.0,
///     section: BeamSection::Tube { outer_diameter: 0.01905, inner_diameter: 0.01575 },
///     added_mass: 0.3,
///     elements: 60,
///     left: BeamEnd::Pinned,
///     right: BeamEnd::Pinned,
/// };
/// let support = Wall::upper("support", 2e-4).with_restitution(0.0).at(tube.at(1.0)?);
/// let scene = Scene::structure(tube.structure()?).with_wall(support);
/// let reduction = scene.reduced(20, false)?.with_damping(&Damping::Modal(vec![0.01]))?;
/// assert!(reduction.walls[0].share() > 0.9999);
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Beam {
    /// Length, m; positive.
    pub length: f64,
    /// Young's modulus E, Pa; positive.
    pub youngs_modulus: f64,
    /// Density ρ of the material, kg/m³; positive.
    pub density: f64,
    /// The cross-section.
    pub section: BeamSection,
    /// Additional mass per metre (fluid inside, fluid moved outside), kg/m; 0 or more.
    pub added_mass: f64,
    /// Number of elements, from 1 to [`MOST_ELEMENTS`](super::MOST_ELEMENTS).
    pub elements: usize,
    /// The support of the end at 0.
    pub left: BeamEnd,
    /// The support of the end at `length`.
    pub right: BeamEnd,
}

impl Beam {
    /// Bending stiffness E I, N m².
    #[must_use]
    pub fn bending_stiffness(&self) -> f64 {
        match self.section {
            BeamSection::Tube { outer_diameter, inner_diameter } => {
                self.youngs_modulus * PI / 64.0 * (outer_diameter.powi(4) - inner_diameter.powi(4))
            }
            BeamSection::Rectangle { width, height } => self.youngs_modulus * width * height.powi(3) / 12.0,
        }
    }

    /// Mass per metre m′, kg/m, with the added mass.
    #[must_use]
    pub fn mass_per_metre(&self) -> f64 {
        let area = match self.section {
            BeamSection::Tube { outer_diameter, inner_diameter } => {
                PI / 4.0 * (outer_diameter.powi(2) - inner_diameter.powi(2))
            }
            BeamSection::Rectangle { width, height } => width * height,
        };
        self.density * area + self.added_mass
    }

    /// Checks the values, and numbers the unknowns.
    fn mesh(&self) -> Result<Mesh<4>> {
        positive(("beam", "length"), self.length)?;
        positive(("beam", "youngs_modulus"), self.youngs_modulus)?;
        positive(("beam", "density"), self.density)?;
        self.section.check()?;
        nonnegative(("beam", "added_mass"), self.added_mass)?;
        elements(("beam", "elements"), self.elements)?;
        let mut fixed = Vec::new();
        for (key, end, node) in [("left", self.left, 0), ("right", self.right, self.elements)] {
            match end {
                BeamEnd::Free => {}
                BeamEnd::Pinned => fixed.push(2 * node),
                BeamEnd::Clamped => fixed.extend([2 * node, 2 * node + 1]),
                BeamEnd::Sprung { stiffness, rotational } => {
                    nonnegative(Subject::from(("beam", key)).part("stiffness"), stiffness)?;
                    nonnegative(Subject::from(("beam", key)).part("rotational"), rotational)?;
                }
            }
        }
        if self.elements == 1 && fixed.len() == 4 {
            let expected = "2 or more between two clamped ends: nothing could move";
            return Err(Error::invalid(("beam", "elements"), 1, expected));
        }
        Ok(Mesh { length: self.length, elements: self.elements, fixed })
    }

    /// M and K, without damping.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `system.beam.` and the name of the field.
    pub fn structure(&self) -> Result<Structure> {
        let mesh = self.mesh()?;
        let h = mesh.size();
        let k = self.bending_stiffness() / h.powi(3);
        let stiffness = [
            [12.0 * k, 6.0 * h * k, -12.0 * k, 6.0 * h * k],
            [6.0 * h * k, 4.0 * h * h * k, -6.0 * h * k, 2.0 * h * h * k],
            [-12.0 * k, -6.0 * h * k, 12.0 * k, -6.0 * h * k],
            [6.0 * h * k, 2.0 * h * h * k, -6.0 * h * k, 4.0 * h * h * k],
        ];
        let m = self.mass_per_metre() * h / 420.0;
        let mass = [
            [156.0 * m, 22.0 * h * m, 54.0 * m, -13.0 * h * m],
            [22.0 * h * m, 4.0 * h * h * m, 13.0 * h * m, -3.0 * h * h * m],
            [54.0 * m, 13.0 * h * m, 156.0 * m, -22.0 * h * m],
            [-13.0 * h * m, -3.0 * h * h * m, -22.0 * h * m, 4.0 * h * h * m],
        ];
        let mut springs = Vec::new();
        for (end, node) in [(self.left, 0), (self.right, self.elements)] {
            if let BeamEnd::Sprung { stiffness, rotational } = end {
                springs.extend([(2 * node, stiffness), (2 * node + 1, rotational)]);
            }
        }
        Ok(Structure {
            mass: mesh.assemble(&mass, &[]),
            damping: Symmetric::zeros(mesh.unknowns()),
            stiffness: mesh.assemble(&stiffness, &springs),
        })
    }

    /// The row of the deflection at a position, m from the left end. It is zero at an end that is
    /// held.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `position`, or of the beam itself.
    pub fn at(&self, position: f64) -> Result<Row> {
        let mesh = self.mesh()?;
        mesh.at(position, shape(mesh.size()))
    }

    /// The row of a force spread evenly over a stretch, from and to in m from the left end: the
    /// load is the resultant, N (a force per metre times the length of the stretch), applied as
    /// consistent nodal forces and moments. A probe with this row records the mean deflection of
    /// the stretch.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `from` or `to`, or of the beam itself.
    pub fn spread(&self, from: f64, to: f64) -> Result<Row> {
        let mesh = self.mesh()?;
        mesh.spread(from, to, shape(mesh.size()))
    }

    /// The vector q of a deflection (or its velocity) that is given along the beam as a function
    /// with values [value, slope], taken at the nodes. Errors name `subject`.
    ///
    /// # Errors
    /// [`Error::Invalid`] where the field is not finite, or not 0 where an end is held; or of the
    /// beam itself.
    pub fn field(&self, subject: impl Into<Subject>, field: &dyn Fn(f64) -> [f64; 2]) -> Result<Vec<f64>> {
        let mesh = self.mesh()?;
        let values: Vec<f64> = (0..=self.elements).flat_map(|i| field(mesh.node(i))).collect();
        mesh.gather(subject, &values)
    }

    /// The vector q of the smoothest deflection (or velocity) through `points` (position m, value):
    /// the cubic spline, which has the least bending energy of all curves through them, with slope
    /// 0 at a clamped end. Errors name `subject`.
    ///
    /// # Errors
    /// As [`Beam::field`]; and where the positions do not increase from 0 to the length.
    pub fn field_through(&self, subject: impl Into<Subject>, points: &[(f64, f64)]) -> Result<Vec<f64>> {
        let subject = subject.into();
        profile::check(&subject, points, self.length)?;
        let clamped = [self.left, self.right].map(|end| end == BeamEnd::Clamped);
        let slopes = profile::slopes(points, clamped);
        self.field(subject, &|x| profile::cubic(points, &slopes, x))
    }
}

/// Hermite's cubics of ξ from 0 to 1: deflection and rotation of the left node, then of the right,
/// for an element of length `h` (m).
fn shape(h: f64) -> impl Fn(f64) -> [f64; 4] {
    move |x| {
        let y = 1.0 - x;
        [y * y * (1.0 + 2.0 * x), h * x * y * y, x * x * (3.0 - 2.0 * x), -h * x * x * y]
    }
}
