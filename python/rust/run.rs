//! A finished run.

use crate::array::{Array, view};
use crate::error::raise;
use crate::json::loads;
use crate::pickle::{Reduced, pickled, unpickled};
use crate::scene::Scene;
use crate::work::compute_beside;
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use signorini as sg;
use signorini::study::verdict::Verdict;

/// Version, scene, and the bytes of the rest.
type Pickled<'py> = (&'static str, Py<Scene>, Bound<'py, PyBytes>);

/// A finished run: see `Scene.run`. Its arrays are read-only views of its memory, which they keep
/// alive. Runs can be pickled.
#[pyclass(frozen, module = "signorini")]
pub struct Run {
    pub run: sg::Run,
    pub time: sg::TimeOptions,
    pub scene: Py<Scene>,
    /// How the accuracy asked for was reached, as JSON.
    pub accuracy: Option<String>,
}

impl Run {
    /// A run of a study.
    pub fn of(scene: &Bound<'_, Scene>, run: sg::Run, time: sg::TimeOptions) -> Self {
        Self { run, time, scene: scene.clone().unbind(), accuracy: None }
    }

    fn method(&self) -> sg::Method {
        sg::Method { scheme: self.run.scheme, backend: self.run.backend }
    }

    /// Calls a function of the Python half of the package.
    fn by_python<'py>(slf: &Bound<'py, Self>, function: &str) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("signorini._run")?.call_method1(function, (slf,))
    }
}

#[pymethods]
impl Run {
    /// The scene that was run.
    #[getter]
    fn scene(&self, py: Python<'_>) -> Py<Scene> {
        self.scene.clone_ref(py)
    }

    /// The scheme, in words.
    #[getter]
    fn scheme(&self) -> String {
        self.run.scheme.to_string()
    }

    /// The step, s; None for the exact scheme.
    #[getter]
    fn step(&self) -> Option<f64> {
        (self.run.scheme != sg::Scheme::Event).then_some(self.run.grid.step)
    }

    /// Times of the rows, s; shape (rows,).
    #[getter]
    fn time<'py>(slf: &Bound<'py, Self>) -> Array<'py> {
        view(slf, slf.get().run.trajectory.time())
    }

    /// Displacement of the first probe, m; shape (rows,), or (0,) without a probe.
    #[getter]
    fn displacement<'py>(slf: &Bound<'py, Self>) -> Array<'py> {
        view(slf, slf.get().run.trajectory.displacement())
    }

    /// Velocity of the first probe, m/s; shape (rows,), or (0,) without a probe.
    #[getter]
    fn velocity<'py>(slf: &Bound<'py, Self>) -> Array<'py> {
        view(slf, slf.get().run.trajectory.velocity())
    }

    /// Displacement (m) and velocity (m/s) of a probe, each of shape (rows,).
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Of the probe.
    ///
    /// Returns
    /// -------
    /// displacement : numpy.ndarray
    ///     m.
    /// velocity : numpy.ndarray
    ///     m/s.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a name that no probe has; it lists those there are.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> chain = sg.chain([1.0, 1.0], [100.0], velocity=[0.0, 1.0], probes={"end": 1})
    /// >>> q, v = chain.run("event").probe("end")
    /// >>> float(v[0])
    /// 1.0
    fn probe<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<(Array<'py>, Array<'py>)> {
        let (q, v) = slf.get().run.trajectory.probe(name).map_err(raise)?;
        Ok((view(slf, q), view(slf, v)))
    }

    /// Mean force of a wall on the body since the row before, N; shape (rows,): its impulse there
    /// over the distance of the rows. An upper wall pushes down, ≤ 0.
    ///
    /// Parameters
    /// ----------
    /// wall : str
    ///     Its name.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     N.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a name that no wall has; it lists those there are.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> run = sg.load("elastic-wall").run()
    /// >>> bool((run.contact_force(run.walls[0]) != 0.0).any())
    /// True
    fn contact_force<'py>(slf: &Bound<'py, Self>, wall: &str) -> PyResult<Array<'py>> {
        Ok(view(slf, slf.get().run.trajectory.contact_force(wall).map_err(raise)?))
    }

    /// Impulse of a wall on the body since the row before, N s; shape (rows,).
    ///
    /// Parameters
    /// ----------
    /// wall : str
    ///     Its name.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     N s.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a name that no wall has; it lists those there are.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> run = sg.load("rigid-walls-sine").run()
    /// >>> abs(run.contact_impulse("upper").sum() - run.impulse("upper")) < 1e-12
    /// np.True_
    fn contact_impulse<'py>(slf: &Bound<'py, Self>, wall: &str) -> PyResult<Array<'py>> {
        Ok(view(slf, slf.get().run.trajectory.contact_impulse(wall).map_err(raise)?))
    }

    /// Impulse of a wall on the body over the whole run, N s.
    ///
    /// Parameters
    /// ----------
    /// wall : str
    ///     Its name.
    ///
    /// Returns
    /// -------
    /// float
    ///     N s.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a name that no wall has; it lists those there are.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.load("rigid-walls-sine").run().impulse("upper") < 0.0
    /// True
    fn impulse(&self, wall: &str) -> PyResult<f64> {
        self.run.trajectory.impulse(wall).map_err(raise)
    }

    /// The names of the round supports.
    #[getter]
    fn holes(&self) -> Vec<String> {
        self.run.trajectory.holes().to_vec()
    }

    /// Mean force of a round support on the body since the row before along y and z, friction
    /// included, N; each of shape (rows,).
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Of the support.
    ///
    /// Returns
    /// -------
    /// along_y, along_z : numpy.ndarray
    ///     N.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a name that no round support has; it lists those there are.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> run = sg.load("whirl-in-a-hole").scene.replace(duration=0.1).run(step=1e-3)
    /// >>> y, z = run.hole_force("hole")
    /// >>> y.shape
    /// (101,)
    fn hole_force<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<(Array<'py>, Array<'py>)> {
        let motion = &slf.get().run.trajectory;
        let [y, z] = of("round support", motion.holes(), motion.hole_forces(), name)?;
        Ok((view(slf, y), view(slf, z)))
    }

    /// Impulse of a round support on the body along y and z since the row before, friction
    /// included, N s; each of shape (rows,).
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Of the support.
    ///
    /// Returns
    /// -------
    /// along_y, along_z : numpy.ndarray
    ///     N s.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a name that no round support has; it lists those there are.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> run = sg.load("whirl-in-a-hole").scene.replace(duration=0.1).run(step=1e-3)
    /// >>> y, z = run.hole_impulse("hole")
    /// >>> z.shape
    /// (101,)
    fn hole_impulse<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<(Array<'py>, Array<'py>)> {
        let motion = &slf.get().run.trajectory;
        let [y, z] = of("round support", motion.holes(), motion.hole_impulses(), name)?;
        Ok((view(slf, y), view(slf, z)))
    }

    /// The statistics of each support in two planes, flats and round ones, over the window, by its
    /// name: a mapping to `SupportStatistics`, empty in one plane.
    #[getter]
    fn supports<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        Self::by_python(slf, "supports")
    }

    /// Work of wear at a support from the start to each row, J; shape (rows,). Without friction it
    /// is an upper figure.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Of the support.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     J.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a name that no support has; it lists those there are.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> run = sg.load("whirl-in-a-hole").scene.replace(duration=0.1).run(step=1e-3)
    /// >>> bool(run.wear_work("hole")[-1] > 0.0)
    /// True
    fn wear_work<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Array<'py>> {
        let motion = &slf.get().run.trajectory;
        Ok(view(slf, of("support", motion.supports(), motion.wear_work(), name)?))
    }

    /// The names of the flat walls.
    #[getter]
    fn walls(&self) -> Vec<String> {
        let motion = &self.run.trajectory;
        motion.walls().iter().filter(|name| !motion.holes().contains(name)).cloned().collect()
    }

    /// The names of the probes.
    #[getter]
    fn probes(&self) -> Vec<String> {
        self.run.trajectory.probes().to_vec()
    }

    /// The state at the end, m and m/s; shape (degrees of freedom,) each.
    #[getter]
    fn state<'py>(slf: &Bound<'py, Self>) -> (Array<'py>, Array<'py>) {
        let state = &slf.get().run.state;
        (view(slf, &state.q), view(slf, &state.v))
    }

    /// Wall-clock seconds that it took.
    #[getter]
    fn seconds(&self) -> f64 {
        self.run.seconds
    }

    /// Notes that a reader of the results must know, in sentences.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.run.notes.clone()
    }

    /// The judge's findings, in sentences; empty for a sound run.
    #[getter]
    fn findings(&self) -> Vec<String> {
        self.run.findings.iter().map(ToString::to_string).collect()
    }

    /// The contact episodes as a structured array with the fields ``wall`` (name), ``start`` and
    /// ``end`` (s), ``impulse`` (N s), ``peak_force`` (N), ``approach_speed`` and
    /// ``departure_speed`` (m/s); with supports also ``angle`` (degrees, where around the support
    /// it began), ``work`` (of wear, J) and ``sliding`` (m). nan where there is no value.
    #[getter]
    fn contacts<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        Self::by_python(slf, "contacts")
    }

    /// All rows, by the column names that ``trajectory.csv`` has.
    #[getter]
    fn columns<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        Self::by_python(slf, "columns")
    }

    /// The states of the probes at the scene's output times (`Scene.replace`), by the column names
    /// that ``output.csv`` has; empty without such times.
    #[getter]
    fn output<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        Self::by_python(slf, "output")
    }

    /// Contact statistics of each wall over the window, by its name, with the keys of
    /// ``summary.json``; ``half_width_95`` holds the half widths of 95 % intervals.
    #[getter]
    fn statistics<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        Self::by_python(slf, "statistics")
    }

    /// The wear in service at each support, by its name: a mapping to `Wear`, with an entry for
    /// each support for which the case has a wear coefficient.
    #[getter]
    fn wear<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        Self::by_python(slf, "wear")
    }

    /// Residuals, statistics, counters, and the accuracy reached where one was asked for.
    #[getter]
    fn summary<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        Self::by_python(slf, "summary")
    }

    /// The derivatives of the run with respect to numbers of its scene: of its contacts, and of
    /// displacement and velocity of its first probe. They are those of the exact motion.
    ///
    /// Parameters
    /// ----------
    /// keys : sequence of str
    ///     Numbers of the scene: ``wall.NAME.position``, ``.restitution``, ``.stiffness``,
    ///     ``.damping``, ``load.1.harmonic.amplitude`` and so on, as in `derivative`.
    /// times : sequence of float, optional
    ///     Where displacement and velocity are differentiated, s; increasing.
    ///
    /// Returns
    /// -------
    /// Derivative
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a run of another scheme than ``event``, and as `derivative`.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> floor = sg.Wall.lower("floor", 0.0, restitution=0.8)
    /// >>> weight = sg.Load.constant(-9.81)
    /// >>> ball = sg.oscillator(1.0, 0.0, 0.0, walls=[floor], loads=[weight], displacement=1.0)
    /// >>> by = ball.run("event").derivative(["wall.floor.restitution"])
    /// >>> by.contacts["impulse_by"]["wall.floor.restitution"].round(3)  # 4.429 is its speed
    /// array([4.429])
    #[pyo3(signature = (keys, *, times=None))]
    fn derivative<'py>(
        slf: &Bound<'py, Self>,
        keys: Vec<String>,
        times: Option<Vec<f64>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let run = slf.get();
        if run.run.scheme != sg::Scheme::Event {
            let expected = "event: derivatives are those of the exact motion";
            return Err(crate::error::wrong("the scheme of the run", run.run.scheme, expected));
        }
        let given = (run.scene.clone_ref(slf.py()), keys, times.unwrap_or_default());
        slf.py().import("signorini._derivative")?.call_method1("of_run", given)
    }

    /// The rows as a pandas DataFrame.
    ///
    /// Returns
    /// -------
    /// pandas.DataFrame
    ///     The columns of `Run.columns`.
    ///
    /// Raises
    /// ------
    /// ImportError
    ///     Without pandas.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> run = sg.load("rigid-walls-sine").run()
    /// >>> run.to_pandas().shape
    /// (10001, 7)
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        Self::by_python(slf, "to_pandas")
    }

    /// Draws displacement, velocity and contact forces or impulses with matplotlib.
    ///
    /// Of round supports the size of the force or impulse is drawn, friction included.
    ///
    /// Parameters
    /// ----------
    /// axes : sequence of three matplotlib axes, optional
    ///     Made if left out.
    ///
    /// Returns
    /// -------
    /// sequence of matplotlib axes
    ///
    /// Raises
    /// ------
    /// ImportError
    ///     Without matplotlib.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> axes = sg.load("rigid-walls-sine").run().plot()
    /// >>> axes[0].get_ylabel()
    /// 'displacement (mm)'
    #[pyo3(signature = (axes=None))]
    fn plot<'py>(slf: &Bound<'py, Self>, axes: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("signorini._plot")?.call_method1("run", (slf, axes))
    }

    /// The refinement verdict: the run with half the step (the exact scheme: with other roundings)
    /// beside this one.
    ///
    /// Returns
    /// -------
    /// dict
    ///     The changes of displacement, impulses and contacts; ``text`` says them in a sentence.
    ///
    /// Raises
    /// ------
    /// RunError
    ///     Where the other run fails.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> verdict = sg.load("rigid-walls-sine", set={"time.end": 2.0}).run().verdict()
    /// >>> verdict["walls"][0]["contacts"]
    /// [10, 10]
    fn verdict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let scene = &self.scene.get().scene;
        let (run, method, time) = (&self.run, self.method(), &self.time);
        let verdict = compute_beside(py, || Verdict::of(scene, &method, run, time, &mut |_| {}), &mut |_| Ok(()))?;
        let dict = loads(py, &serde_json::to_string(&verdict).unwrap_or_default())?;
        dict.set_item("text", verdict.to_string())?;
        Ok(dict)
    }

    /// The output times, s, and displacement (m) and velocity (m/s) of each probe there.
    fn _output<'py>(slf: &Bound<'py, Self>) -> (Array<'py>, Vec<(Array<'py>, Array<'py>)>) {
        let states = slf.get().run.trajectory.output();
        let columns = states.displacement.iter().zip(&states.velocity);
        let columns = columns.map(|(displacement, velocity)| (view(slf, displacement), view(slf, velocity)));
        (view(slf, &states.time), columns.collect())
    }

    /// Columns of the contacts.
    fn _contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let contacts = self.run.trajectory.contacts();
        let column = |f: &dyn Fn(&sg::Contact) -> f64| contacts.iter().map(f).collect::<Vec<f64>>().into_pyarray(py);
        let or_nan = |x: Option<f64>| x.unwrap_or(f64::NAN);
        let dict = PyDict::new(py);
        dict.set_item("wall", contacts.iter().map(|c| c.wall as i64).collect::<Vec<_>>().into_pyarray(py))?;
        let motion = &self.run.trajectory;
        dict.set_item("names", motion.walls())?;
        dict.set_item("start", column(&|c| c.start))?;
        dict.set_item("end", column(&|c| or_nan(c.end)))?;
        dict.set_item("impulse", column(&|c| c.impulse))?;
        dict.set_item("peak_force", column(&|c| or_nan(c.peak_force)))?;
        dict.set_item("approach_speed", column(&|c| c.approach_speed))?;
        dict.set_item("departure_speed", column(&|c| or_nan(c.departure_speed)))?;
        if !motion.supports().is_empty() {
            let column = |f: fn(&sg::EpisodeWear) -> f64| {
                let wear = motion.contact_wear().iter();
                wear.map(|wear| wear.as_ref().map_or(f64::NAN, f)).collect::<Vec<f64>>().into_pyarray(py)
            };
            dict.set_item("angle", column(|wear| wear.angle))?;
            dict.set_item("work", column(|wear| wear.work))?;
            dict.set_item("sliding", column(|wear| wear.sliding))?;
        }
        Ok(dict)
    }

    fn _summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let run = &self.run;
        let value = serde_json::json!({
            "scheme": run.scheme.to_string(),
            "residuals": run.residuals,
            "statistics": run.statistics,
            "counters": run.counters,
            "seconds": run.seconds,
            "notes": run.notes,
            "findings": run.findings,
        });
        let dict = loads(py, &value.to_string())?;
        if let Some(accuracy) = &self.accuracy {
            dict.set_item("accuracy", loads(py, accuracy)?)?;
        }
        Ok(dict)
    }

    /// Contact and wear statistics of each support, and the wear by its work rate.
    fn _supports<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (statistics, laws) = (&self.run.statistics, &self.scene.get().laws);
        let known = statistics.wear.iter().zip(&statistics.supports).map(|(wear, contact)| {
            let law = laws.iter().find(|(name, ..)| *name == wear.support);
            let worn = law.map(|(_, law, growth)| {
                let mut worn = serde_json::json!(law.worn(wear.work_rate_w));
                worn["depth_deepest_m"] = serde_json::json!(law.deepest_in_service(*growth, &wear.rates()));
                worn
            });
            let window = statistics.to_s - statistics.from_s;
            let periodic = statistics.periods_per_batch.is_some();
            serde_json::json!({
                "wear": wear, "contact": contact, "worn": worn, "window_s": window, "periodic": periodic,
            })
        });
        loads(py, &serde_json::Value::from(known.collect::<Vec<_>>()).to_string())
    }

    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        Self::by_python(slf, "html")
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py, Pickled<'py>>> {
        let this = slf.get();
        let (version, bytes) = pickled(slf.py(), &(&this.run, &this.time, &this.accuracy))?;
        Ok((slf.get_type().getattr("_restore")?, (version, this.scene.clone_ref(slf.py()), bytes)))
    }

    #[staticmethod]
    fn _restore(version: &str, scene: Py<Scene>, bytes: &[u8]) -> PyResult<Self> {
        let (run, time, accuracy) = unpickled(version, bytes)?;
        Ok(Self { run, time, scene, accuracy })
    }

    fn __repr__(&self) -> String {
        let motion = &self.run.trajectory;
        let refuted = if self.run.findings.is_empty() { "" } else { "refuted " };
        format!(
            "<{refuted}Run: {}, {} rows to {:?} s, {} contacts>",
            self.run.scheme,
            motion.time().len(),
            self.run.grid.end,
            motion.contacts().len()
        )
    }
}

/// The column of that name.
fn of<'a, T>(kind: &'static str, names: &[String], columns: &'a [T], name: &str) -> PyResult<&'a T> {
    let found = names.iter().position(|known| known == name).and_then(|index| columns.get(index));
    found.ok_or_else(|| raise(sg::Error::Unknown { kind, name: name.to_owned(), known: names.to_vec() }))
}
