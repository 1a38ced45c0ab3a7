//! A structure given by its modes, as exported by finite-element programs and modal tests.

use crate::error::{Error, Result, Subject};
use crate::linear::Symmetric;
use crate::scene::system::{above_minus_one, finite, nonnegative, positive};
use crate::scene::{Row, Structure};
use serde::{Deserialize, Serialize};

/// Modes of a structure. They are k uncoupled oscillators mᵢ äᵢ + 2 ζᵢ ωᵢ mᵢ ȧᵢ + mᵢ ωᵢ² aᵢ = φᵢ ·
/// f, whose modal coordinates aᵢ are the degrees of freedom; the displacement is Σ φᵢ aᵢ at each
/// point that walls, loads and probes need.
///
/// The scaling of shapes and generalised masses must agree: φᵢᵀ M φᵢ = mᵢ. Mass-normalised shapes
/// have mᵢ = 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModalData {
    /// ωᵢ, rad/s, 0 for a rigid-body motion; k entries.
    pub omega: Vec<f64>,
    /// Generalised masses mᵢ, kg for shapes without unit, 1 for mass-normalised shapes; k entries.
    pub masses: Vec<f64>,
    /// Damping ratios ζᵢ, shares of critical damping, above −1; k entries. A negative one makes its
    /// mode unstable.
    pub ratios: Vec<f64>,
    /// The points whose mode shapes are known.
    pub points: Vec<ModalPoint>,
}

/// One point of a structure, in one direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModalPoint {
    /// Its name.
    pub name: String,
    /// φᵢ there, one value per mode.
    pub shape: Vec<f64>,
}

/// The shape of a point.
fn shape_of(point: &str) -> Subject {
    Subject::from(("modal data", "shapes")).part(point.to_owned())
}

impl ModalData {
    /// M, C and K, all diagonal.
    ///
    /// # Errors
    /// [`Error::Invalid`] for values that make no sense.
    pub fn structure(&self) -> Result<Structure> {
        let k = self.omega.len();
        if k == 0 {
            return Err(Error::invalid(("modal data", "omega"), "an empty list", "one mode or more"));
        }
        let lists = [("masses", &self.masses), ("ratios", &self.ratios)];
        let shapes = self.points.iter().map(|point| (point.name.as_str(), &point.shape));
        for (key, list) in lists.into_iter().chain(shapes) {
            if list.len() != k {
                let shape = lists.iter().all(|(name, _)| *name != key);
                let all = Subject::of("modal data");
                let key = if shape { all.part("shapes").part(key.to_owned()) } else { all.part(key.to_owned()) };
                return Err(Error::invalid(key, format!("{} values", list.len()), format!("{k}, one per mode")));
            }
        }
        for (i, point) in self.points.iter().enumerate() {
            point.shape.iter().try_for_each(|&x| finite(shape_of(&point.name), x))?;
            if self.points.iter().take(i).any(|other| other.name == point.name) {
                let key = shape_of(&point.name);
                return Err(Error::invalid(key, "given twice", "a name of its own for each point"));
            }
        }
        let mut structure = [const { Vec::new() }; 3];
        for (i, ((&omega, &mass), &ratio)) in self.omega.iter().zip(&self.masses).zip(&self.ratios).enumerate() {
            let key = |what: &'static str| Subject::from(("modal data", what)).value(i);
            nonnegative(key("omega"), omega)?;
            positive(key("masses"), mass)?;
            above_minus_one(key("ratios"), ratio)?;
            let stiffness = mass * omega * omega;
            finite(key("omega"), stiffness)?;
            let entries = [mass, 2.0 * ratio * omega * mass, stiffness];
            structure.iter_mut().zip(entries).for_each(|(diagonal, x)| diagonal.push(x));
        }
        let [mass, damping, stiffness] = structure.map(|diagonal| Symmetric::diagonal(&diagonal));
        Ok(Structure { mass, damping, stiffness })
    }

    /// The row of the displacement of a point.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the points that exist.
    pub fn at(&self, point: &str) -> Result<Row> {
        self.at_sum(&[(point.to_owned(), 1.0)])
    }

    /// The row of a weighted sum of points: the difference of two is their relative motion.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the points that exist.
    pub fn at_sum(&self, points: &[(String, f64)]) -> Result<Row> {
        let mut sum = vec![0.0; self.omega.len()];
        for (name, weight) in points {
            let point = self.points.iter().find(|point| point.name == *name).ok_or_else(|| Error::Unknown {
                kind: "point",
                name: name.clone(),
                known: self.points.iter().map(|point| point.name.clone()).collect(),
            })?;
            sum.iter_mut().zip(&point.shape).for_each(|(sum, x)| *sum += weight * x);
        }
        Ok(Row::new(sum.into_iter().enumerate().filter(|entry| entry.1 != 0.0).collect()))
    }
}
