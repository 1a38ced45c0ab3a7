//! Structures from dimensions, matrices and modes; the Python side gives them their keywords.

use crate::error::{raise, wrong, wrong_type};
use crate::place::Model;
use crate::scene::Scene;
use crate::work::{LARGE, compute_apart};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use signorini as sg;
use signorini::linear::Symmetric;

/// The matrices of a structure of about `size` degrees of freedom.
fn built(
    py: Python<'_>,
    size: usize,
    structure: impl FnOnce() -> sg::Result<sg::Structure> + Send + 'static,
) -> PyResult<sg::Structure> {
    if size < LARGE { structure().map_err(raise) } else { compute_apart(py, structure) }
}

#[pyfunction]
pub fn _oscillator(mass: f64, damping: f64, stiffness: f64) -> PyResult<Scene> {
    let scene = sg::Scene::oscillator(mass, damping, stiffness);
    scene.validate().map_err(raise)?;
    Ok(Scene::new(scene, Model::Numbered))
}

#[pyfunction]
pub fn _chain(py: Python<'_>, masses: Vec<f64>, springs: Vec<f64>, grounds: (f64, f64)) -> PyResult<Scene> {
    let chain = sg::Chain { masses, springs, grounds: [grounds.0, grounds.1] };
    let structure = built(py, chain.masses.len(), move || chain.structure())?;
    Ok(Scene::new(sg::Scene::structure(structure), Model::Numbered))
}

/// A support of an end: its name, or its stiffnesses.
pub enum End {
    Named(String),
    Sprung(f64),
    Turned(f64, f64),
}

impl<'a, 'py> FromPyObject<'a, 'py> for End {
    type Error = PyErr;

    fn extract(end: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(name) = end.extract() {
            return Ok(Self::Named(name));
        }
        if let Ok(stiffness) = end.extract() {
            return Ok(Self::Sprung(stiffness));
        }
        let pair = end.extract().map(|(stiffness, rotational)| Self::Turned(stiffness, rotational));
        pair.map_err(|_| wrong_type(&end, "the name of a support, or its stiffnesses"))
    }
}

#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the dimensions of a bar")]
pub fn _bar(
    py: Python<'_>,
    length: f64,
    area: f64,
    youngs_modulus: f64,
    density: f64,
    elements: usize,
    left: End,
    right: End,
    lumped: bool,
) -> PyResult<Scene> {
    let end = |key: &str, end: End| match end {
        End::Named(name) if name == "free" => Ok(sg::BarEnd::Free),
        End::Named(name) if name == "fixed" => Ok(sg::BarEnd::Fixed),
        End::Sprung(stiffness) => Ok(sg::BarEnd::Sprung { stiffness }),
        End::Named(name) => Err(wrong(key, format!("{name:?}"), "\"free\", \"fixed\", or a stiffness in N/m")),
        End::Turned(..) => Err(wrong(key, "a pair", "\"free\", \"fixed\", or a stiffness in N/m")),
    };
    let mass = if lumped { sg::MassMatrix::Lumped } else { sg::MassMatrix::Consistent };
    let (left, right) = (end("bar: left", left)?, end("bar: right", right)?);
    let bar = sg::Bar { length, area, youngs_modulus, density, elements, left, right, mass };
    let structure = built(py, elements, {
        let bar = bar.clone();
        move || bar.structure()
    })?;
    Ok(Scene::new(sg::Scene::structure(structure), Model::Bar(bar)))
}

#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the dimensions of a beam")]
pub fn _beam(
    py: Python<'_>,
    length: f64,
    youngs_modulus: f64,
    density: f64,
    diameters: [Option<f64>; 2],
    sides: [Option<f64>; 2],
    added_mass: f64,
    elements: usize,
    left: End,
    right: End,
) -> PyResult<Scene> {
    let section = sg::BeamSection::of(diameters, sides).map_err(|fault| match fault {
        sg::SectionFault::TwoSections => {
            let expected = "outer_diameter and inner_diameter of a tube, or width and height of a rectangle";
            wrong("beam: section", "that of a tube and of a rectangle", expected)
        }
        sg::SectionFault::Missing(key) => {
            let expected = match key {
                "height" => "it beside width, in m",
                "width" => "it beside height, in m",
                _ => "it, in m, or width and height of a rectangle",
            };
            wrong(&format!("beam: {key}"), "missing", expected)
        }
    })?;
    let expected = "\"free\", \"pinned\", \"clamped\", or stiffnesses (N/m, N m/rad)";
    let end = |key: &str, end: End| match end {
        End::Named(name) if name == "free" => Ok(sg::BeamEnd::Free),
        End::Named(name) if name == "pinned" => Ok(sg::BeamEnd::Pinned),
        End::Named(name) if name == "clamped" => Ok(sg::BeamEnd::Clamped),
        End::Turned(stiffness, rotational) => Ok(sg::BeamEnd::Sprung { stiffness, rotational }),
        End::Named(name) => Err(wrong(key, format!("{name:?}"), expected)),
        End::Sprung(stiffness) => Err(wrong(key, format!("{stiffness:?}"), expected)),
    };
    let (left, right) = (end("beam: left", left)?, end("beam: right", right)?);
    let beam = sg::Beam { length, youngs_modulus, density, section, added_mass, elements, left, right };
    let structure = built(py, elements, {
        let beam = beam.clone();
        move || beam.structure()
    })?;
    Ok(Scene::new(sg::Scene::structure(structure), Model::Beam(beam)))
}

/// Rows, columns and values of a matrix.
type Entries<'py> = (PyReadonlyArray1<'py, i64>, PyReadonlyArray1<'py, i64>, PyReadonlyArray1<'py, f64>);

/// The lower triangles of M, C and K, by their entries.
#[pyfunction]
pub fn _matrices(n: usize, mass: Entries<'_>, damping: Entries<'_>, stiffness: Entries<'_>) -> PyResult<Scene> {
    let matrix = |(rows, columns, values): Entries<'_>| {
        let (rows, columns, values) = (rows.as_array(), columns.as_array(), values.as_array());
        let entries = rows.iter().zip(columns).zip(values);
        Symmetric::from_entries(n, entries.map(|((&i, &j), &value)| (i as usize, j as usize, value)))
    };
    let structure = sg::Structure { mass: matrix(mass), damping: matrix(damping), stiffness: matrix(stiffness) };
    Ok(Scene::new(sg::Scene::structure(structure), Model::Numbered))
}

#[pyfunction]
pub fn _modal(omega: Vec<f64>, masses: Vec<f64>, ratios: Vec<f64>, points: Vec<(String, Vec<f64>)>) -> PyResult<Scene> {
    let points = points.into_iter().map(|(name, shape)| sg::ModalPoint { name, shape }).collect();
    let modal = sg::ModalData { omega, masses, ratios, points };
    Ok(Scene::new(sg::Scene::structure(modal.structure().map_err(raise)?), Model::Modal(modal)))
}
