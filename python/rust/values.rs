//! Arguments of several forms: a number or several, damping in its kinds.

use crate::error::{wrong, wrong_type};
use crate::pickle::Reduced;
use pyo3::prelude::*;
use signorini as sg;

/// Damping of a structure: a damping ratio for all modes or one per mode, or Rayleigh's.
pub struct Damping(pub sg::Damping);

impl<'a, 'py> FromPyObject<'a, 'py> for Damping {
    type Error = PyErr;

    fn extract(damping: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(Rayleigh { mass, stiffness }) = damping.extract() {
            return Ok(Self(sg::Damping::Rayleigh { mass, stiffness }));
        }
        match damping.extract() {
            Ok(Values::One(ratio)) => Ok(Self(sg::Damping::Modal(vec![ratio]))),
            Ok(Values::Several(ratios)) => Ok(Self(sg::Damping::Modal(ratios))),
            Err(_) => Err(wrong_type(&damping, "a number, a sequence of numbers, or a Rayleigh")),
        }
    }
}

/// A column of real numbers: those of an array of complex ones would lose their imaginary parts.
pub struct Reals(pub Vec<f64>);

impl<'a, 'py> FromPyObject<'a, 'py> for Reals {
    type Error = PyErr;

    fn extract(column: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let kind = column.getattr("dtype").and_then(|dtype| dtype.getattr("kind")?.extract::<String>());
        if kind.is_ok_and(|kind| kind == "c") {
            return Err(wrong_type(&column, "real numbers"));
        }
        column.extract().map(Self)
    }
}

/// Rayleigh damping, C = mass · M + stiffness · K (1/s, s).
///
/// Parameters
/// ----------
/// mass : float
///     Factor of M, 1/s.
/// stiffness : float
///     Factor of K, s.
///
/// Examples
/// --------
/// >>> import signorini as sg
/// >>> sg.Rayleigh(0.1, 1e-5)
/// Rayleigh(0.1, 1e-5)
#[pyclass(frozen, eq, get_all, module = "signorini", from_py_object)]
#[derive(Debug, Clone, PartialEq)]
pub struct Rayleigh {
    /// Factor of M, 1/s.
    mass: f64,
    /// Factor of K, s.
    stiffness: f64,
}

#[pymethods]
impl Rayleigh {
    #[new]
    #[pyo3(signature = (mass, stiffness))]
    fn new(mass: f64, stiffness: f64) -> Self {
        Self { mass, stiffness }
    }

    fn __repr__(&self) -> String {
        format!("Rayleigh({:?}, {:?})", self.mass, self.stiffness)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> Reduced<'py, (f64, f64)> {
        (slf.get_type().into_any(), (slf.get().mass, slf.get().stiffness))
    }
}

/// One number, or one for each degree of freedom.
pub enum Values {
    One(f64),
    Several(Vec<f64>),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Values {
    type Error = PyErr;

    fn extract(values: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(number) = values.extract() {
            return Ok(Self::One(number));
        }
        let expected = "a number, or a sequence of numbers in one dimension";
        values.extract().map(Self::Several).map_err(|_| wrong_type(&values, expected))
    }
}

/// The whole number `value` of the argument `name`, within bounds, as the Python half checks it.
pub fn whole(name: &str, value: &Bound<'_, PyAny>, least: u64, most: u64) -> PyResult<u64> {
    value.py().import("signorini._types")?.call_method1("whole", (name, value, least, most))?.extract()
}

impl Values {
    pub fn put(self, name: &str, to: &mut Vec<f64>) -> PyResult<()> {
        match self {
            Self::One(x) if to.len() == 1 => *to = vec![x],
            Self::One(x) => {
                return Err(wrong(name, format!("{x:?}"), &format!("{} values, one per degree of freedom", to.len())));
            }
            Self::Several(values) => *to = values,
        }
        Ok(())
    }
}
