//! Loads.

use crate::error::{raise, wrong};
use crate::pickle::{Reduced, State, pickled, unpickled};
use crate::place::Place;
use crate::work::{called_in_run, nested};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use serde::{Deserialize, Serialize};
use signorini as sg;

/// A force that is a given function of time: see its static methods. Loads add up.
#[pyclass(frozen, eq, module = "signorini", from_py_object)]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// Its row is that of the place once it acts in a scene.
    pub load: sg::Load,
    pub place: Place,
}

/// The load, if its values make sense.
fn load(load: sg::Load, place: Place) -> PyResult<Load> {
    sg::Scene::oscillator(1.0, 0.0, 0.0).with_load(load.clone()).validate().map_err(|error| match error {
        // The load has no number yet.
        sg::Error::Invalid { subject, value, expected } => {
            let part = subject.parts().last().map_or("load".to_owned(), |part| match part {
                sg::Part::Name(name) => name.to_string(),
                other => format!("{other:?}"),
            });
            wrong(&format!("load: {part}"), value, &expected)
        }
        other => raise(other),
    })?;
    Ok(Load { load, place })
}

#[pymethods]
impl Load {
    /// A constant force (N).
    ///
    /// Parameters
    /// ----------
    /// force : float
    ///     N.
    /// at : place, optional
    ///     As in `Wall.upper`.
    ///
    /// Returns
    /// -------
    /// Load
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For values that make no sense.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.Load.constant(-9.81)
    /// Load.constant(-9.81)
    #[staticmethod]
    #[pyo3(signature = (force, *, at=Place::Only), text_signature = "(force, *, at=None)")]
    fn constant(force: f64, at: Place) -> PyResult<Self> {
        load(sg::Load::constant(force), at)
    }

    /// amplitude · sin(2π frequency t + phase): N, Hz, rad.
    ///
    /// Parameters
    /// ----------
    /// amplitude : float
    ///     N.
    /// frequency : float
    ///     Hz.
    /// phase : float
    ///     rad.
    /// at : place, optional
    ///     As in `Wall.upper`.
    ///
    /// Returns
    /// -------
    /// Load
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For values that make no sense.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.Load.harmonic(3.0, 5.0)
    /// Load.harmonic(3.0, 5.0, 0.0)
    #[staticmethod]
    #[pyo3(signature = (amplitude, frequency, phase=0.0, *, at=Place::Only),
           text_signature = "(amplitude, frequency, phase=0.0, *, at=None)")]
    fn harmonic(amplitude: f64, frequency: f64, phase: f64, at: Place) -> PyResult<Self> {
        load(sg::Load::harmonic(amplitude, frequency, phase), at)
    }

    /// A blow of ``impulse`` (N s) at ``time`` (s).
    ///
    /// Parameters
    /// ----------
    /// impulse : float
    ///     N s.
    /// time : float
    ///     s.
    /// at : place, optional
    ///     As in `Wall.upper`.
    ///
    /// Returns
    /// -------
    /// Load
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For values that make no sense.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.Load.impulse(0.5, 0.2)
    /// Load.impulse(0.5, 0.2)
    #[staticmethod]
    #[pyo3(signature = (impulse, time=0.0, *, at=Place::Only), text_signature = "(impulse, time=0.0, *, at=None)")]
    fn impulse(impulse: f64, time: f64, at: Place) -> PyResult<Self> {
        load(sg::Load::impulse(impulse, time), at)
    }

    /// A force (N) at increasing times (s): linear between them, zero outside.
    ///
    /// Parameters
    /// ----------
    /// time : sequence of float
    ///     s, increasing.
    /// force : sequence of float
    ///     N, one for each time.
    /// at : place, optional
    ///     As in `Wall.upper`.
    ///
    /// Returns
    /// -------
    /// Load
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For times that do not increase, lists of unequal length, and numbers that are not
    ///     finite.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.Load.table([0.0, 0.1, 0.2], [0.0, 10.0, 0.0])
    /// Load.table(<3 rows from 0.0 to 0.2 s>)
    #[staticmethod]
    #[pyo3(signature = (time, force, *, at=Place::Only), text_signature = "(time, force, *, at=None)")]
    fn table(time: Vec<f64>, force: Vec<f64>, at: Place) -> PyResult<Self> {
        load(sg::Load::table(sg::Table::new(time, force).map_err(raise)?), at)
    }

    /// The force that a function of the time returns.
    ///
    /// It is for the stepping schemes, which evaluate it at the ends of their steps. The exact
    /// scheme refuses it, and it cannot be pickled. An exception that it raises ends the run and is
    /// passed on. It may run scenes itself, up to 16 runs within one another.
    ///
    /// Parameters
    /// ----------
    /// force : callable
    ///     ``force(time)`` returns the force in N, of the time in s only.
    /// at : place, optional
    ///     As in `Wall.upper`.
    ///
    /// Returns
    /// -------
    /// Load
    ///
    /// Raises
    /// ------
    /// TypeError
    ///     For what cannot be called, or does not return a number.
    /// Exception
    ///     Whatever the function raises at time 0.
    /// RecursionError
    ///     Where the function makes a load of itself, and so on without end; during a run, where
    ///     more than 16 runs are within one another.
    ///
    /// Examples
    /// --------
    /// >>> import math
    /// >>> import signorini as sg
    /// >>> chirp = sg.Load.function(lambda t: math.sin(2 * math.pi * (10.0 + 5.0 * t) * t))
    #[staticmethod]
    #[pyo3(signature = (force, *, at=Place::Only), text_signature = "(force, *, at=None)")]
    fn function(force: Bound<'_, PyAny>, at: Place) -> PyResult<Self> {
        if !force.is_callable() {
            return Err(PyTypeError::new_err(format!("force is {}; expected a function of the time", force.repr()?)));
        }
        // Evaluated once here, so that an invalid function is refused at once.
        nested(|| force.call1((0.0,))?.extract::<f64>())?;
        let force = force.unbind();
        let call =
            move |t: f64| Python::attach(|py| force.bind(py).call1((t,)).and_then(|value| value.extract::<f64>()));
        let at_time = move |t: f64| called_in_run(|| call(t)).unwrap_or(f64::NAN);
        load(sg::Load::function(at_time), at)
    }

    fn __repr__(&self) -> String {
        let at = self.place.argument();
        match &self.load.kind {
            sg::LoadKind::Constant { force } => format!("Load.constant({force:?}{at})"),
            sg::LoadKind::Harmonic { amplitude, frequency, phase } => {
                format!("Load.harmonic({amplitude:?}, {frequency:?}, {phase:?}{at})")
            }
            sg::LoadKind::Impulse { impulse, time } => format!("Load.impulse({impulse:?}, {time:?}{at})"),
            sg::LoadKind::Table(table) => {
                let ends = [table.time().first(), table.time().last()].map(|t| t.copied().unwrap_or(f64::NAN));
                format!("Load.table(<{} rows from {:?} to {:?} s>{at})", table.time().len(), ends[0], ends[1])
            }
            _ => format!("Load.function(<a Python function>{at})"),
        }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py, State<'py>>> {
        Ok((slf.get_type().getattr("_restore")?, pickled(slf.py(), slf.get())?))
    }

    #[staticmethod]
    fn _restore(version: &str, bytes: &[u8]) -> PyResult<Self> {
        unpickled(version, bytes)
    }
}
