//! One step at a time.

use crate::array::Array;
use crate::error::{raise, wrong};
use crate::scene::Scene;
use crate::values::Values;
use crate::work::{LARGE, compute_apart, kept};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use signorini as sg;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Steps between two readings of the clock, and time between two checks for signals.
const STRIDE: u64 = 16;
const INTERVAL: Duration = Duration::from_millis(50);

/// Advances a scene step by step: for co-simulation and control.
///
/// Parameters
/// ----------
/// scene : Scene
///     What is stepped.
/// scheme : str
///     As in `Scene.run`.
/// step : float
///     s; for ``event`` the maximum length of a step.
///
/// Raises
/// ------
/// ValueError
///     For a scene, scheme or step that makes no sense.
///
/// Examples
/// --------
/// >>> import signorini as sg
/// >>> scene = sg.oscillator(1.0, 0.0, 100.0, walls=[sg.Wall.upper("stop", 0.01)], velocity=1.0)
/// >>> stepper = sg.Stepper(scene, "moreau-jean", 1e-3)
/// >>> for _ in range(20):
/// ...     time = stepper.step(-50.0 * stepper.v[0])
/// >>> round(time, 6), bool(stepper.q[0] < 0.011)
/// (0.02, True)
#[pyclass(module = "signorini")]
pub struct Stepper {
    /// Never contended, since each caller has exclusive access to the stepper: it makes the class
    /// `Sync`.
    inner: Mutex<Inner>,
}

struct Inner {
    stepper: sg::Stepper,
    force: Vec<f64>,
    impulse: Vec<f64>,
}

/// A force on the degrees of freedom, N: a number for one, an array for more.
pub enum Force<'py> {
    Array(PyReadonlyArray1<'py, f64>),
    Values(Values),
}

impl<'py> FromPyObject<'_, 'py> for Force<'py> {
    type Error = PyErr;

    fn extract(force: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        force.extract().map(Self::Array).or_else(|_| force.extract().map(Self::Values))
    }
}

impl Inner {
    fn step(&mut self, force: Option<&Force<'_>>) -> PyResult<f64> {
        let step = match force {
            None => self.stepper.step(),
            Some(Force::Values(Values::One(force))) => self.stepper.step_with(&[*force]),
            Some(Force::Values(Values::Several(force))) => self.stepper.step_with(force),
            Some(Force::Array(force)) => match force.as_slice() {
                Ok(force) => self.stepper.step_with(force),
                // A view with strides, such as every second entry.
                Err(_) => self.stepper.step_with(&force.as_array().to_vec()),
            },
        };
        let step = step.map_err(|error| kept().unwrap_or_else(|| raise(error)))?;
        self.force.copy_from_slice(step.force);
        self.impulse.copy_from_slice(step.impulse);
        Ok(step.end)
    }
}

impl Stepper {
    fn inner(&mut self) -> &mut Inner {
        self.inner.get_mut().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Stepper {
    #[new]
    #[pyo3(signature = (scene, scheme, step))]
    fn new(py: Python<'_>, scene: &Scene, scheme: &str, step: f64) -> PyResult<Self> {
        let method: sg::Method = scheme.parse().map_err(raise)?;
        let stepper = if scene.scene.system.degrees_of_freedom() < LARGE {
            let made = py.detach(|| sg::Stepper::new(&scene.scene, &method, step));
            made.map_err(|error| kept().unwrap_or_else(|| raise(error)))?
        } else {
            let inner = scene.scene.clone();
            compute_apart(py, move || sg::Stepper::new(&inner, &method, step))?
        };
        let none = vec![0.0; scene.scene.walls.len()];
        Ok(Self { inner: Mutex::new(Inner { stepper, force: none.clone(), impulse: none }) })
    }

    /// Makes one step and returns the time reached, s.
    ///
    /// ``located`` divides a step at its impacts, and each part counts as one here: the time
    /// reached is then that of the impact, and the next call makes the next part. `advance` goes
    /// on to a time whatever the parts.
    ///
    /// Parameters
    /// ----------
    /// force : float or array of shape (degrees of freedom,), optional
    ///     An extra force, N, constant over the step, of ``located`` over this part of it.
    ///
    /// Returns
    /// -------
    /// float
    ///     The time, s.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a force of the wrong shape or not finite.
    /// RunError
    ///     Where the step fails.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> stepper = sg.Stepper(sg.oscillator(1.0, 0.0, 0.0), "moreau-jean", 1e-3)
    /// >>> stepper.step(2.0), stepper.v
    /// (0.001, array([0.002]))
    #[pyo3(signature = (force=None))]
    fn step(&mut self, force: Option<Force<'_>>) -> PyResult<f64> {
        self.inner().step(force.as_ref())
    }

    /// Makes steps until ``end`` (s) is reached, and returns their number.
    ///
    /// Parameters
    /// ----------
    /// end : float
    ///     s.
    /// force : callable, optional
    ///     ``force(time, q, v)`` gives the extra force of each step, N, from the state before it,
    ///     of ``located`` that of each part: numbers for one degree of freedom, arrays for more.
    ///
    /// Returns
    /// -------
    /// int
    ///     The number of steps; of ``located`` each part counts as one.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For an end that is below 0 or not finite, and forces as in `Stepper.step`.
    /// RunError
    ///     Where a step fails.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> stepper = sg.Stepper(sg.oscillator(1.0, 0.0, 0.0, velocity=1.0), "moreau-jean", 1e-3)
    /// >>> stepper.advance(0.1, lambda t, q, v: -50.0 * v)
    /// 100
    #[pyo3(signature = (end, force=None))]
    fn advance(slf: &Bound<'_, Self>, end: f64, force: Option<Bound<'_, PyAny>>) -> PyResult<u64> {
        let py = slf.py();
        if !(end.is_finite() && end >= 0.0) {
            return Err(wrong("end", format!("{end:?}"), "a time, 0 or more"));
        }
        let mut steps = 0;
        let Some(force) = force else {
            let mut this = slf.try_borrow_mut()?;
            let inner = this.inner();
            return py.detach(|| {
                let mut looked = Instant::now();
                while inner.stepper.time() < end * (1.0 - 1e-12) {
                    inner.step(None)?;
                    steps += 1;
                    if steps % STRIDE == 0 && looked.elapsed() > INTERVAL {
                        looked = Instant::now();
                        Python::attach(|py| py.check_signals())?;
                    }
                }
                Ok(steps)
            });
        };
        loop {
            // The function may access the stepper, which is therefore not borrowed during the call.
            let (time, state) = {
                let mut this = slf.try_borrow_mut()?;
                let stepper = &this.inner().stepper;
                (stepper.time(), stepper.state())
            };
            if time >= end * (1.0 - 1e-12) {
                return Ok(steps);
            }
            let extra = match (state.q.as_slice(), state.v.as_slice()) {
                ([q], [v]) => force.call1((time, *q, *v))?,
                (q, v) => force.call1((time, PyArray1::from_slice(py, q), PyArray1::from_slice(py, v)))?,
            };
            slf.try_borrow_mut()?.inner().step(Some(&extra.extract()?))?;
            steps += 1;
        }
    }

    /// Sets time and state, to repeat a step or to continue from a saved state.
    ///
    /// Parameters
    /// ----------
    /// time : float
    ///     s; for a scheme with a step a multiple of it, for ``located`` and ``event`` any.
    /// q, v : float or array of shape (degrees of freedom,)
    ///     m, m/s.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a time or a state that the scheme cannot continue from.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> stepper = sg.Stepper(sg.oscillator(1.0, 0.0, 100.0, velocity=1.0), "moreau-jean", 1e-3)
    /// >>> saved = stepper.time, stepper.q, stepper.v
    /// >>> guess = stepper.step(1.0)
    /// >>> stepper.set_state(*saved)
    /// >>> stepper.time
    /// 0.0
    #[pyo3(signature = (time, q, v))]
    fn set_state(&mut self, time: f64, q: Values, v: Values) -> PyResult<()> {
        let values = |values: Values| match values {
            Values::One(x) => vec![x],
            Values::Several(x) => x,
        };
        let state = sg::State { q: values(q), v: values(v) };
        self.inner().stepper.set_state(time, &state).map_err(raise)
    }

    /// The time reached, s.
    #[getter]
    fn time(&mut self) -> f64 {
        self.inner().stepper.time()
    }

    /// Displacements, m; shape (degrees of freedom,).
    #[getter]
    fn q<'py>(&mut self, py: Python<'py>) -> Array<'py> {
        PyArray1::from_vec(py, self.inner().stepper.state().q)
    }

    /// Velocities, m/s; shape (degrees of freedom,).
    #[getter]
    fn v<'py>(&mut self, py: Python<'py>) -> Array<'py> {
        PyArray1::from_vec(py, self.inner().stepper.state().v)
    }

    /// Force of each wall in the last step, N; shape (walls,): impulse over the length of the step,
    /// which an impact makes as large as the step is short; of ``event`` the force at its end, of
    /// ``located`` that over the part of a step, without an impact at its end, whose impulse is in
    /// `impulse` alone.
    #[getter]
    fn force<'py>(&mut self, py: Python<'py>) -> Array<'py> {
        PyArray1::from_slice(py, &self.inner().force)
    }

    /// Impulse of each wall over the last step, N s; shape (walls,).
    #[getter]
    fn impulse<'py>(&mut self, py: Python<'py>) -> Array<'py> {
        PyArray1::from_slice(py, &self.inner().impulse)
    }

    fn __repr__(&mut self) -> String {
        let inner = self.inner();
        format!("<Stepper: {}, at {:?} s>", inner.stepper.scheme(), inner.stepper.time())
    }
}
