//! Case files.

use crate::error::{ResultWarning, raise, wrong};
use crate::json::loads;
use crate::origin::Origin;
use crate::pickle::{Reduced, State, pickled, unpickled};
use crate::place::Model;
use crate::plan::Plan;
use crate::run::Run;
use crate::run_folder::{reason, stepped};
use crate::scene::Scene;
use crate::work::{compute, compute_apart};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};
use signorini as sg;
use signorini::case::{CaseFile, KeyValue};
use signorini::study::choice::choose;
use std::path::PathBuf;

/// A case file: its scene, and the times at which it is run. See ``load``.
#[pyclass(frozen, module = "signorini")]
pub struct Case {
    pub file: CaseFile,
    pub case: sg::case::Case,
    pub scene: Py<Scene>,
}

/// A value of a case file.
pub fn value(key: &str, value: &Bound<'_, PyAny>) -> PyResult<KeyValue> {
    if value.is_instance_of::<PyBool>() {
        return Ok(KeyValue::from(value.extract::<bool>()?));
    }
    if let Ok(whole) = value.extract::<i64>() {
        return Ok(KeyValue::from(whole));
    }
    if let Ok(number) = value.extract::<f64>() {
        return Ok(KeyValue::from(number));
    }
    if let Ok(word) = value.extract::<String>() {
        return Ok(KeyValue::from(word.as_str()));
    }
    if let Ok(list) = value.extract::<Vec<f64>>() {
        return format!("{list:?}").parse().map_err(raise);
    }
    Err(wrong(key, value.repr()?, "a number, True or False, a text, or a list of numbers"))
}

/// Reads a case file, or takes the built-in case of that name.
///
/// Parameters
/// ----------
/// case : str or path
///     A file (``case.toml``, or the ``summary.json`` of a run), or the name of a built-in case.
/// set : mapping of str to value, optional
///     Values to change, by the keys of the case format: ``{"wall.*.restitution": 0.8}``.
///
/// Returns
/// -------
/// Case
///
/// Raises
/// ------
/// ValueError
///     For a case that makes no sense: file, line, key, and what would be accepted.
/// OSError
///     For a file that cannot be read.
///
/// Warns
/// -----
/// UserWarning
///     Of a random force of more than 2^20 rows, with its size: such a table takes seconds and
///     hundreds of megabytes.
///
/// Examples
/// --------
/// >>> import signorini as sg
/// >>> case = sg.load("rigid-walls-sine", set={"wall.upper.position": 6e-3})
/// >>> case.scene.walls[0].position, case.step
/// (0.006, 0.0001)
#[pyfunction]
#[pyo3(signature = (case, *, set=None))]
pub fn load(py: Python<'_>, case: PathBuf, set: Option<Bound<'_, PyDict>>) -> PyResult<Case> {
    let mut file = compute(py, || match case.to_str() {
        Some(name) if !name.contains(['/', '\\', '.']) => CaseFile::embedded(name),
        _ => CaseFile::read(&case),
    })?;
    for (key, new) in set.iter().flatten() {
        let key = key.extract::<String>()?;
        file.set(&key.parse().map_err(raise)?, &value(&key, &new)?).map_err(raise)?;
    }
    built(py, file)
}

/// The case of a text; files that it names are looked for in the working folder.
#[pyfunction]
pub fn _case(py: Python<'_>, text: &str, name: &str) -> PyResult<Case> {
    built(py, CaseFile::from_text(text, name, ""))
}

/// The case of a file, and its scene.
fn built(py: Python<'_>, file: CaseFile) -> PyResult<Case> {
    let (file, case) = compute_apart(py, move || {
        let case = file.case()?;
        Ok((file, case))
    })?;
    for size in case.large_random_forces() {
        // Written here, without NUL.
        let text = std::ffi::CString::new(size).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)?;
    }
    let model = match &case.model {
        // A place is a row of both planes.
        _ if case.planes.is_two() => Model::Numbered,
        sg::case::Model::Bar(bar) => Model::Bar(bar.clone()),
        sg::case::Model::Beam(beam) => Model::Beam(beam.clone()),
        sg::case::Model::Modal(modal) => Model::Modal(modal.clone()),
        _ => Model::Numbered,
    };
    let origin = case.truncated.as_ref().map(|truncated| {
        let sg::study::truncation::Unreduced { scene, damping, static_correction, turbulence, sliders, .. } =
            truncated.whole.clone();
        let modes = Some(truncated.reduction.modes.count());
        Origin { scene, damping, modes, static_correction, turbulence, sliders }
    });
    let slides = || Origin { sliders: case.sliders.clone(), ..Origin::of(case.without_sliders().into_owned()) };
    let origin = origin.or_else(|| (!case.sliders.is_empty()).then(slides)).map(Box::new);
    let supports = case.scene.supports.iter().zip(&case.written.supports).enumerate();
    let law = |(index, (support, written)): (usize, (&sg::Support, &sg::case::Support))| {
        Some((support.name.clone(), case.archard(index)?, written.growth))
    };
    let laws = supports.filter_map(law).collect();
    let scene = Py::new(py, Scene { scene: case.scene.clone(), model, origin, laws })?;
    Ok(Case { file, case, scene })
}

impl Case {
    /// How it is run: with `step` (s) in place of its own, by `scheme` in place of that chosen.
    pub fn plan(&self, scheme: Option<&str>, step: Option<f64>) -> PyResult<Plan> {
        let name = scheme.map_or_else(|| choose(&self.case.scene).method.to_string(), str::to_owned);
        let method = self.case.method(&name).map_err(raise)?;
        let time = sg::TimeOptions { step: step.unwrap_or(self.case.time.step), ..self.case.time };
        let plan = Plan { method, time };
        plan.check_step(step)?;
        Ok(plan)
    }
}

#[pymethods]
impl Case {
    /// The name of the file without folder and extension.
    #[getter]
    fn name(&self) -> &str {
        &self.case.name
    }

    /// One line that describes the case.
    #[getter]
    fn title(&self) -> Option<&str> {
        self.case.title.as_deref()
    }

    /// The scene that it describes.
    #[getter]
    fn scene(&self, py: Python<'_>) -> Py<Scene> {
        self.scene.clone_ref(py)
    }

    /// Its step, s.
    #[getter]
    fn step(&self) -> f64 {
        self.case.time.step
    }

    /// Time between two recorded rows, s; None for every step.
    #[getter]
    fn sample(&self) -> Option<f64> {
        self.case.time.sample
    }

    /// Where the window of its statistics begins, s.
    #[getter]
    fn statistics_from(&self) -> f64 {
        self.case.time.statistics_from
    }

    /// The text of the case file, with the values that were set.
    #[getter]
    fn text(&self) -> PyResult<String> {
        self.file.text().map_err(raise)
    }

    /// Runs its scene with the step, the rows and the window of the file.
    ///
    /// Parameters
    /// ----------
    /// scheme, step, accuracy : optional
    ///     As in `Scene.run`; a step in place of that of the file. Under random loads the accuracy
    ///     is one of means, unless ``of`` says otherwise.
    /// of : {"motion", "means"}, optional
    ///     What the accuracy is one of. A run has that of its motion; that of means over
    ///     realisations is refused here: `realisations` has it, of a chaotic motion too.
    /// folder : path, optional
    ///     The files of ``signorini run`` are written there, with its page, ``report.html``. A
    ///     folder with results of another request is refused.
    /// verdict : bool
    ///     With ``folder``: whether the run is repeated with half the step, and with twice the
    ///     modes where modes are left out, for the verdicts on the page.
    ///
    /// Returns
    /// -------
    /// Run
    ///
    /// Raises
    /// ------
    /// ValueError, RunError
    ///     As `Scene.run`; of a run that the judge refutes the files are written all the same.
    /// OSError
    ///     For a ``folder`` that cannot be written, and one with other results.
    ///
    /// Warns
    /// -----
    /// AccuracyWarning, ResultWarning
    ///     As `Scene.run`; an AccuracyWarning where a check for the page failed; and a
    ///     ResultWarning where the flow of the case makes the tube unstable with all supports
    ///     active.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.load("rigid-walls-sine", set={"time.end": 2.0}).run()
    /// <Run: located, 2001 rows to 2.0 s, 20 contacts>
    #[pyo3(signature = (scheme=None, *, step=None, accuracy=None, of=None, folder=None, verdict=true))]
    #[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
    fn run(
        &self,
        py: Python<'_>,
        scheme: Option<&str>,
        step: Option<f64>,
        accuracy: Option<f64>,
        of: Option<&str>,
        folder: Option<PathBuf>,
        verdict: bool,
    ) -> PyResult<Py<Run>> {
        let (scene, time) = (self.scene.bind(py), &self.case.time);
        let one_motion = one_motion(of, accuracy)?;
        if let Some(tolerance) = accuracy {
            if self.case.judges_means() && !one_motion {
                let expected = "none for one run of a random load, which is a draw: sg.realisations(case, \
                                accuracy=...) finds the step for the error of means, of=\"motion\" for that of this \
                                draw";
                return Err(wrong("accuracy", format!("{tolerance:?}"), expected));
            }
            if let Some(folder) = folder {
                let expected = "none beside accuracy; a second run with the step that was found has files: \
                                case.run(run.scheme, step=run.step, folder=...)";
                return Err(wrong("folder", format!("{folder:?}"), expected));
            }
            let rows = (time.sample, time.statistics_from);
            return Run::to_accuracy(scene, (scheme, step), tolerance, rows, Some(&self.case));
        }
        let plan = self.plan(scheme, step)?;
        let run = match folder {
            None => Run::make(scene, plan, Some(&self.case))?,
            Some(folder) => {
                let case = stepped(&self.case, step).map_err(raise)?;
                Run::into_folder(scene, (&case, plan, reason(&case, scheme)), &folder, verdict)?
            }
        };
        if let Some(instability) = self.case.instability() {
            // Written here, without NUL.
            let text = std::ffi::CString::new(instability).unwrap_or_default();
            PyErr::warn(py, &py.get_type::<ResultWarning>(), &text, 1)?;
        }
        Ok(run)
    }

    /// The notes of the case, without a run: what reduction, flow and start change.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.case.notes()
    }

    /// The margins of tubes in a cross flow by Connors' criterion: a `FluidElastic`, or None where
    /// the case has no table ``flow``.
    #[getter]
    fn fluid_elastic<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("signorini._flow")?.call_method1("fluid_elastic", (slf,))
    }

    /// The same as a mapping.
    fn _fluid_elastic<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        loads(py, &serde_json::json!(self.case.fluid_elastic).to_string())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py, State<'py>>> {
        Ok((slf.get_type().getattr("_restore")?, pickled(slf.py(), &slf.get().file)?))
    }

    #[staticmethod]
    fn _restore(py: Python<'_>, version: &str, bytes: &[u8]) -> PyResult<Self> {
        built(py, unpickled(version, bytes)?)
    }

    fn __repr__(&self) -> String {
        let title = self.case.title.as_deref().unwrap_or("without a title");
        format!("<Case {}: {title}>", self.case.name)
    }
}

/// True if the accuracy of one motion is asked for by its name.
///
/// # Errors
/// `ValueError` for another name, and without an accuracy.
fn one_motion(of: Option<&str>, accuracy: Option<f64>) -> PyResult<bool> {
    let Some(of) = of else { return Ok(false) };
    let expected = match (of, accuracy) {
        (_, None) => "accuracy beside it: it says what that is one of",
        ("motion", _) => return Ok(true),
        ("means", _) => "\"motion\" for a run: sg.realisations(case, accuracy=...) has the accuracy of means",
        _ => "\"motion\"; sg.realisations(case, accuracy=...) has the accuracy of means",
    };
    Err(wrong("of", format!("{of:?}"), expected))
}
