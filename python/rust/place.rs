//! Locations on a structure as Python passes them, and the structure that resolves them.

use crate::error::wrong;
use crate::json::dumps;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use signorini as sg;

/// A location as given; its meaning depends on the structure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Place {
    /// Not given: the only degree of freedom.
    Only,
    /// A position in m along a bar or beam; elsewhere the number of a degree of freedom.
    Number(f64),
    /// A stretch of a bar or beam, from and to in m: a load is spread over it, a probe is its mean.
    Stretch(f64, f64),
    /// A point of modal data.
    Point(String),
    /// Degrees of freedom with weights.
    Row(Vec<(usize, f64)>),
    /// Points of modal data with weights.
    Points(Vec<(String, f64)>),
    /// The value of `at` in a case file, as JSON: known to `sg.case` only.
    OfCase(String),
}

const EXPECTED: &str = "a number, a pair (from, to), the name of a point, or a list of pairs of a degree of freedom \
                        (or a point) and a weight";

impl<'a, 'py> FromPyObject<'a, 'py> for Place {
    type Error = PyErr;

    fn extract(at: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if at.is_none() {
            return Ok(Self::Only);
        }
        if at.is_instance_of::<PyDict>() {
            return Ok(Self::OfCase(dumps(&at)?));
        }
        if let Ok(x) = at.extract() {
            return Ok(Self::Number(x));
        }
        if let Ok(name) = at.extract() {
            return Ok(Self::Point(name));
        }
        if let Ok((from, to)) = at.extract() {
            return Ok(Self::Stretch(from, to));
        }
        if let Ok(row) = at.extract() {
            return Ok(Self::Row(row));
        }
        at.extract().map(Self::Points).map_err(|_| {
            let found = at.repr().map_or_else(|_| "of another type".to_owned(), |text| text.to_string());
            wrong("at", found, EXPECTED)
        })
    }
}

/// The kind of structure of a scene, which decides what locations mean.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Model {
    /// An oscillator, a chain or matrices: degrees of freedom by their numbers.
    Numbered,
    Bar(sg::Bar),
    Beam(sg::Beam),
    Modal(sg::ModalData),
}

impl Model {
    /// The row of a location of `owner` on a system of `n` degrees of freedom.
    pub fn row(&self, owner: &str, place: &Place, n: usize) -> PyResult<sg::Row> {
        let named = |error: sg::Error| match error {
            sg::Error::Invalid { value, expected, .. } => wrong(&format!("{owner}: at"), value, &expected),
            other => crate::error::raise(other),
        };
        if place.names_twice() {
            return Err(wrong(&format!("{owner}: at"), place.shown(), "each degree of freedom or point once"));
        }
        match (self, place) {
            (_, Place::Row(entries)) => Ok(sg::Row::new(entries.clone())),
            (Self::Bar(bar), Place::Number(x)) => bar.at(*x).map_err(named),
            (Self::Beam(beam), Place::Number(x)) => beam.at(*x).map_err(named),
            (Self::Bar(bar), Place::Stretch(from, to)) => bar.spread(*from, *to).map_err(named),
            (Self::Beam(beam), Place::Stretch(from, to)) => beam.spread(*from, *to).map_err(named),
            (Self::Modal(modal), Place::Point(name)) => modal.at(name).map_err(named),
            (Self::Modal(modal), Place::Points(points)) => modal.at_sum(points).map_err(named),
            (Self::Numbered, Place::Only) if n == 1 => Ok(sg::Row::dof(0)),
            (Self::Numbered | Self::Modal(_), Place::Number(x)) if x.fract() == 0.0 && *x >= 0.0 => {
                Ok(sg::Row::dof(*x as usize))
            }
            (model, place) => Err(wrong(&format!("{owner}: at"), place.shown(), model.accepted())),
        }
    }

    fn accepted(&self) -> &'static str {
        match self {
            Self::Numbered => {
                "a degree of freedom, a whole number from 0, or a list of pairs (degree of freedom, weight)"
            }
            Self::Bar(_) | Self::Beam(_) => {
                "a position in m from the left end, (from, to) in m, or a list of pairs (degree of freedom, weight)"
            }
            Self::Modal(_) => "the name of a point, or a list of pairs (point, weight)",
        }
    }
}

impl Place {
    /// True if a degree of freedom or a point occurs twice.
    fn names_twice(&self) -> bool {
        fn twice<T: PartialEq>(pairs: &[(T, f64)]) -> bool {
            pairs.iter().enumerate().any(|(i, (one, _))| pairs.iter().take(i).any(|(other, _)| other == one))
        }
        match self {
            Self::Row(entries) => twice(entries),
            Self::Points(points) => twice(points),
            _ => false,
        }
    }

    fn shown(&self) -> String {
        match self {
            Self::Only => "missing".to_owned(),
            Self::Number(x) => format!("{x:?}"),
            Self::Stretch(from, to) => format!("({from:?}, {to:?})"),
            Self::Point(name) => format!("{name:?}"),
            Self::Row(entries) => format!("{entries:?}"),
            Self::Points(points) => format!("{points:?}"),
            Self::OfCase(table) => format!("{table}, a place of sg.case"),
        }
    }

    /// The place as the value of `at` in a case file; `None` where it is not given.
    pub fn table(&self) -> Option<Value> {
        match self {
            Self::Only => None,
            Self::Number(x) => Some(json!({ "position": x })),
            Self::Stretch(from, to) => Some(json!({ "spread": [from, to] })),
            Self::Point(name) => Some(json!({ "point": name })),
            Self::Row(entries) => Some(json!({ "row": entries })),
            Self::Points(points) => Some(json!({ "points": points })),
            Self::OfCase(table) => serde_json::from_str(table).ok(),
        }
    }

    /// For the representation of a wall or load, after its other arguments.
    pub fn argument(&self) -> String {
        match self {
            Self::Only => String::new(),
            Self::OfCase(table) => format!(", at={table}"),
            place => format!(", at={}", place.shown()),
        }
    }
}
