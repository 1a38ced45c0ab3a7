//! Loads.

use crate::error::{raise, wrong, wrong_type};
use crate::json::loads;
use crate::pickle::{Reduced, State, pickled, unpickled};
use crate::place::Place;
use crate::values::{Reals, whole};
use crate::work::{called_in_run, nested};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use signorini as sg;
use std::path::PathBuf;

/// A force that is a given function of time: see its static methods. Loads add up.
#[pyclass(frozen, eq, module = "signorini", from_py_object)]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Load {
    force: Force,
    place: Place,
    direction: Option<Direction>,
}

/// What acts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Force {
    /// Its row is that of the place once it acts in a scene.
    Known(sg::Load),
    /// A kind of load that the reader of case files makes, from its duration and its files, with
    /// its values as JSON.
    OfCase { kind: String, values: String },
}

/// Where a load of two planes points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Direction {
    Degrees(f64),
    Word(String),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Direction {
    type Error = PyErr;

    fn extract(direction: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(degrees) = direction.extract() {
            return Ok(Self::Degrees(degrees));
        }
        // The reader of case files knows which words there are.
        direction.extract().map(Self::Word).map_err(|_| wrong_type(&direction, "a number of degrees, or \"both\""))
    }
}

/// The number from which a random signal follows.
struct Seed(u64);

impl<'a, 'py> FromPyObject<'a, 'py> for Seed {
    type Error = PyErr;

    fn extract(seed: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        whole("load: seed", &seed, 0, u64::MAX).map(Self)
    }
}

impl Load {
    /// A load of a scene, at its place.
    pub fn of_scene(load: sg::Load, place: Place) -> Self {
        Self { force: Force::Known(load), place, direction: None }
    }

    /// The load and its place, for a scene in one plane; `owner` names it in messages.
    pub fn in_one_plane(self, owner: &str) -> PyResult<(sg::Load, Place)> {
        let expected = "a case, as `tube` and `case` make, which has planes and a duration from the start";
        match (self.force, self.direction) {
            (Force::Known(load), None) => Ok((load, self.place)),
            (Force::OfCase { kind, .. }, _) => Err(wrong(&format!("{owner}: kind"), kind, expected)),
            (_, Some(_)) => Err(wrong(&format!("{owner}: direction"), "given", expected)),
        }
    }
}

/// The load, if its values make sense.
fn load(load: sg::Load, place: Place, direction: Option<Direction>) -> PyResult<Load> {
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
    Ok(Load { force: Force::Known(load), place, direction })
}

/// Refuses a number of a load that is infinite or not a number, which JSON cannot hold.
fn finite(name: &str, values: impl IntoIterator<Item = f64>) -> PyResult<()> {
    match values.into_iter().find(|value| !value.is_finite()) {
        Some(value) => Err(wrong(&format!("load: {name}"), value, "finite numbers")),
        None => Ok(()),
    }
}

/// The force that the `function` of a load returns at `time`, s.
fn evaluated(function: &Bound<'_, PyAny>, time: f64) -> PyResult<f64> {
    let force = function.call1((time,))?;
    let known = || {
        format!(
            "load {}: the force at t = {time:?} s",
            function.repr().map_or_else(|_| "of a function".to_owned(), |name| name.to_string())
        )
    };
    match force.extract::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(number) => Err(wrong(&known(), number, "a finite number, in N")),
        Err(_) => Err(PyTypeError::new_err(format!("{} is {}; expected a number, in N", known(), force.repr()?))),
    }
}

/// The values that are not null, as JSON.
fn given(values: Value) -> String {
    let Value::Object(values) = values else { return values.to_string() };
    Value::Object(values.into_iter().filter(|(_, value)| !value.is_null()).collect()).to_string()
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
    /// direction : float, optional
    ///     Degrees from +y towards +z, of a load in two planes.
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
    #[pyo3(signature = (force, *, at=Place::Only, direction=None),
           text_signature = "(force, *, at=None, direction=None)")]
    fn constant(force: f64, at: Place, direction: Option<Direction>) -> PyResult<Self> {
        load(sg::Load::constant(force), at, direction)
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
    /// direction : float, optional
    ///     Degrees from +y towards +z, of a load in two planes.
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
    #[pyo3(signature = (amplitude, frequency, phase=0.0, *, at=Place::Only, direction=None),
           text_signature = "(amplitude, frequency, phase=0.0, *, at=None, direction=None)")]
    fn harmonic(amplitude: f64, frequency: f64, phase: f64, at: Place, direction: Option<Direction>) -> PyResult<Self> {
        load(sg::Load::harmonic(amplitude, frequency, phase), at, direction)
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
    /// direction : float, optional
    ///     Degrees from +y towards +z, of a load in two planes.
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
    #[pyo3(signature = (impulse, time=0.0, *, at=Place::Only, direction=None),
           text_signature = "(impulse, time=0.0, *, at=None, direction=None)")]
    fn impulse(impulse: f64, time: f64, at: Place, direction: Option<Direction>) -> PyResult<Self> {
        load(sg::Load::impulse(impulse, time), at, direction)
    }

    /// A random force of a case, with the phases that follow from a seed.
    ///
    /// Parameters
    /// ----------
    /// rms : float, optional
    ///     N; its density is even over the band.
    /// band : pair of float, optional
    ///     Hz: from and to, beside ``rms``.
    /// psd : sequence of pairs of float, optional
    ///     The one-sided density in place of these: Hz and N²/Hz, straight between in logarithms.
    /// seed : int
    ///     0 or more.
    /// at : place, optional
    ///     As in `Wall.upper`.
    /// direction : float or str, optional
    ///     Degrees from +y towards +z, or ``"both"``: independent signals along y and z.
    ///
    /// Returns
    /// -------
    /// Load
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For numbers that are not finite, and a seed below 0; `tube` and `case` check the others.
    /// TypeError
    ///     For values of other types.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.Load.random(rms=3.0, band=(1.0, 100.0), at=0.5, direction="both")
    /// Load.random({"rms":3.0,"from":1.0,"to":100.0,"seed":0}, at=0.5, direction="both")
    #[staticmethod]
    #[pyo3(signature = (*, rms=None, band=None, psd=None, seed=Seed(0), at=Place::Only, direction=None),
           text_signature = "(*, rms=None, band=None, psd=None, seed=0, at=None, direction=None)")]
    fn random(
        rms: Option<f64>,
        band: Option<(f64, f64)>,
        psd: Option<Vec<(f64, f64)>>,
        seed: Seed,
        at: Place,
        direction: Option<Direction>,
    ) -> PyResult<Self> {
        finite("rms", rms)?;
        finite("band", band.into_iter().flat_map(|(from, to)| [from, to]))?;
        finite("psd", psd.iter().flatten().flat_map(|(frequency, density)| [*frequency, *density]))?;
        let Seed(seed) = seed;
        let (from, to) = band.unzip();
        let values = given(json!({ "rms": rms, "from": from, "to": to, "psd": psd, "seed": seed }));
        Ok(Self { force: Force::OfCase { kind: "random".to_owned(), values }, place: at, direction })
    }

    /// An acceleration of the base of a case: from a CSV file, a sine, or random.
    ///
    /// Parameters
    /// ----------
    /// file : path, optional
    ///     The file, with a column of times in s and one of accelerations.
    /// amplitude, frequency, phase : float, optional
    ///     In place of the file: m/s², Hz and rad of a sine.
    /// time, acceleration : str, optional
    ///     The headers of these columns, ``time_s`` and ``acceleration_m_per_s2``.
    /// scale : float, optional
    ///     How many m/s² one unit of the column is.
    /// rms : float, optional
    ///     m/s², in place of the file: of a random acceleration, its density even over the band.
    /// band : pair of float, optional
    ///     Hz: from and to, beside ``rms``.
    /// psd : sequence of pairs of float, optional
    ///     The one-sided density in place of ``rms`` and ``band``: Hz and (m/s²)²/Hz.
    /// seed : int, optional
    ///     0 or more, of a random acceleration.
    /// direction : float, optional
    ///     Degrees from +y towards +z, in two planes.
    ///
    /// Returns
    /// -------
    /// Load
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For numbers that are not finite; `tube` and `case` read the file.
    /// TypeError
    ///     For values of other types.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.Load.base("quake.csv", scale=9.80665)
    /// Load.base({"file":"quake.csv","scale":9.80665})
    /// >>> sg.Load.base(rms=2.0, band=(5.0, 100.0), seed=1)
    /// Load.base({"rms":2.0,"from":5.0,"to":100.0,"seed":1})
    #[staticmethod]
    #[pyo3(signature = (file=None, *, amplitude=None, frequency=None, phase=None, time=None, acceleration=None,
                        scale=None, rms=None, band=None, psd=None, seed=None, direction=None))]
    #[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
    fn base(
        file: Option<PathBuf>,
        amplitude: Option<f64>,
        frequency: Option<f64>,
        phase: Option<f64>,
        time: Option<&str>,
        acceleration: Option<&str>,
        scale: Option<f64>,
        rms: Option<f64>,
        band: Option<(f64, f64)>,
        psd: Option<Vec<(f64, f64)>>,
        seed: Option<Seed>,
        direction: Option<Direction>,
    ) -> PyResult<Self> {
        let numbers =
            [("amplitude", amplitude), ("frequency", frequency), ("phase", phase), ("scale", scale), ("rms", rms)];
        for (name, value) in numbers {
            finite(name, value)?;
        }
        finite("band", band.into_iter().flat_map(|(from, to)| [from, to]))?;
        finite("psd", psd.iter().flatten().flat_map(|(frequency, density)| [*frequency, *density]))?;
        let (from, to) = band.unzip();
        let values = given(json!({
            "file": file.map(|file| file.display().to_string()), "amplitude": amplitude, "frequency": frequency,
            "phase": phase, "time": time, "acceleration": acceleration, "scale": scale, "rms": rms, "from": from,
            "to": to, "psd": psd, "seed": seed.map(|Seed(seed)| seed),
        }));
        Ok(Self { force: Force::OfCase { kind: "base".to_owned(), values }, place: Place::Only, direction })
    }

    /// The weight of all masses of a case.
    ///
    /// Parameters
    /// ----------
    /// acceleration : float
    ///     m/s²: 9.81 on Earth.
    /// direction : float, optional
    ///     Degrees from +y towards +z, in two planes.
    ///
    /// Returns
    /// -------
    /// Load
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a number that is not finite.
    /// TypeError
    ///     For values of other types.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.Load.gravity(9.81, direction=270.0)
    /// Load.gravity({"acceleration":9.81}, direction=270.0)
    #[staticmethod]
    #[pyo3(signature = (acceleration, *, direction=None))]
    fn gravity(acceleration: f64, direction: Option<Direction>) -> PyResult<Self> {
        finite("acceleration", [acceleration])?;
        let values = given(json!({ "acceleration": acceleration }));
        Ok(Self { force: Force::OfCase { kind: "gravity".to_owned(), values }, place: Place::Only, direction })
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
    fn table(time: Reals, force: Reals, at: Place) -> PyResult<Self> {
        load(sg::Load::table(sg::Table::new(time.0, force.0).map_err(raise)?), at, None)
    }

    /// The force that a function of the time returns.
    ///
    /// It is for the stepping schemes, which evaluate it at the ends of their steps. The exact
    /// scheme refuses it, and it cannot be pickled. An exception that it raises ends the run and is
    /// passed on, and so does a force that is no finite number. It may run scenes itself, up to 16
    /// runs within one another.
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
    /// ValueError
    ///     For a force that is not finite.
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
        nested(|| evaluated(&force, 0.0))?;
        let force = force.unbind();
        let call = move |t: f64| Python::attach(|py| evaluated(force.bind(py), t));
        let at_time = move |t: f64| called_in_run(|| call(t)).unwrap_or(f64::NAN);
        load(sg::Load::function(at_time), at, None)
    }

    fn __repr__(&self) -> String {
        let direction = match &self.direction {
            Some(Direction::Degrees(degrees)) => format!(", direction={degrees:?}"),
            Some(Direction::Word(word)) => format!(", direction={word:?}"),
            None => String::new(),
        };
        let at = self.place.argument() + &direction;
        let load = match &self.force {
            Force::Known(load) => load,
            Force::OfCase { kind, values } => return format!("Load.{kind}({values}{at})"),
        };
        match &load.kind {
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

    /// The load as a table of a case file, on a beam.
    fn _table<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (kind, values) = match &self.force {
            Force::OfCase { kind, values } => (kind.as_str(), values.clone()),
            Force::Known(load) => match &load.kind {
                sg::LoadKind::Constant { force } => ("constant", json!({ "force": force }).to_string()),
                sg::LoadKind::Harmonic { amplitude, frequency, phase } => {
                    let values = json!({ "amplitude": amplitude, "frequency": frequency, "phase": phase });
                    ("harmonic", values.to_string())
                }
                sg::LoadKind::Impulse { impulse, time } => {
                    ("impulse", json!({ "impulse": impulse, "time": time }).to_string())
                }
                _ => {
                    let expected =
                        "a load that a case file describes: constant, harmonic, impulse, random, base or gravity";
                    return Err(wrong("load", self.__repr__(), expected));
                }
            },
        };
        let table = PyDict::new(py);
        table.set_item(kind, loads(py, &values)?)?;
        if let Some(at) = self.place.table() {
            table.set_item("at", loads(py, &at.to_string())?)?;
        }
        match &self.direction {
            Some(Direction::Degrees(degrees)) => table.set_item("direction", degrees)?,
            Some(Direction::Word(word)) => table.set_item("direction", word)?,
            None => {}
        }
        Ok(table.into_any())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py, State<'py>>> {
        Ok((slf.get_type().getattr("_restore")?, pickled(slf.py(), slf.get())?))
    }

    #[staticmethod]
    fn _restore(version: &str, bytes: &[u8]) -> PyResult<Self> {
        unpickled(version, bytes)
    }
}
