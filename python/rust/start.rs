//! Runs scenes, and raises where the judge refutes the run.

use crate::error::{AccuracyWarning, DivergedError, RefutedError, ResultWarning, raise, wrong};
use crate::plan::Plan;
use crate::run::Run;
use crate::run_folder::RunFolder;
use crate::scene::Scene;
use crate::work::{LARGE, compute, compute_apart, compute_beside};
use pyo3::prelude::*;
use signorini as sg;
use signorini::output::run_folder::{RunGoal, RunRequest};
use signorini::output::supports;
use signorini::study::accuracy::{Target, reach};
use std::path::Path;

impl Run {
    /// Runs `scene`; the run has the notes of its `case` too, where it has one.
    pub fn make(scene: &Bound<'_, Scene>, plan: Plan, case: Option<&sg::case::Case>) -> PyResult<Py<Self>> {
        let inner = &scene.get().scene;
        let options = sg::Options::new(plan.time);
        let run = if inner.system.degrees_of_freedom() < LARGE {
            compute(scene.py(), || sg::run(inner, &plan.method, &options))?
        } else {
            let inner = inner.clone();
            compute_apart(scene.py(), move || sg::run(&inner, &plan.method, &options))?
        };
        Self::judged(scene, run, plan.time, None, case)
    }

    /// Runs the scene of a `case`, whose `step` is that asked for, for the `reason`, and writes its
    /// files into `folder`; with `verdict` it is checked for them.
    pub fn into_folder(
        scene: &Bound<'_, Scene>,
        (case, plan, reason): (&sg::case::Case, Plan, String),
        folder: &Path,
        verdict: bool,
    ) -> PyResult<Py<Self>> {
        let py = scene.py();
        let asked = RunRequest { case, method: Some(&plan.method), goal: RunGoal::Step { verdict }, count: None };
        let work = || {
            let mut open = RunFolder::open(folder, &asked)?;
            let run = open.run(case, &plan.method, &mut |_| {})?;
            let unknown = open.write(case, (&run, &plan, reason), (None, None), verdict)?;
            Ok((run, unknown))
        };
        let (run, unknown) = compute_beside(py, work, &mut |_| Ok(()))?;
        let made = Self::judged(scene, run, plan.time, None, Some(case))?;
        for text in unknown {
            // Names are without NUL.
            let text = std::ffi::CString::new(text).unwrap_or_default();
            PyErr::warn(py, &py.get_type::<AccuracyWarning>(), &text, 1)?;
        }
        Ok(made)
    }

    /// Runs it to an accuracy.
    pub fn to_accuracy(
        scene: &Bound<'_, Scene>,
        (scheme, step): (Option<&str>, Option<f64>),
        tolerance: f64,
        (sample, statistics_from): (Option<f64>, f64),
        case: Option<&sg::case::Case>,
    ) -> PyResult<Py<Self>> {
        if let Some(step) = step {
            return Err(wrong("step", format!("{step:?}"), "no step beside accuracy, which finds one"));
        }
        let py = scene.py();
        let inner = &scene.get().scene;
        let step = 0.5 * inner.duration;
        let time = sg::TimeOptions { sample, statistics_from, ..sg::TimeOptions::with_step(step) };
        let method = scheme.map(|name| name.parse().map_err(raise)).transpose()?;
        let target = Target { method, ..Target::new(tolerance, time) };
        let outcome = compute_beside(py, || reach(inner, &target, &mut |_| {}), &mut |_| Ok(()))?;
        let refuted = outcome.run.refuted().is_some();
        if let Some(shortfall) = outcome.shortfall.filter(|_| !refuted) {
            let text = std::ffi::CString::new(shortfall.to_string()).unwrap_or_default();
            PyErr::warn(py, &py.get_type::<AccuracyWarning>(), &text, 1)?;
        }
        let time = sg::TimeOptions { step: outcome.run.grid.step, ..time };
        let accuracy = serde_json::to_string(&outcome.accuracy).unwrap_or_default();
        Self::judged(scene, outcome.run, time, Some(accuracy), case)
    }

    /// The run, unless the judge refutes it.
    fn judged(
        scene: &Bound<'_, Scene>,
        mut run: sg::Run,
        time: sg::TimeOptions,
        accuracy: Option<String>,
        case: Option<&sg::case::Case>,
    ) -> PyResult<Py<Self>> {
        let of_case = case.map(|case| [case.notes(), supports::warnings(case, &run)].concat());
        run.notes.extend(of_case.into_iter().flatten());
        let py = scene.py();
        let refuted = run.refuted();
        let cautions: Vec<String> = if refuted.is_none() { run.cautions.clone() } else { Vec::new() };
        let made = Py::new(py, Self { run, time, scene: scene.clone().unbind(), accuracy })?;
        match refuted {
            None => {
                for note in cautions {
                    // Names are without NUL.
                    let text = std::ffi::CString::new(note).unwrap_or_default();
                    PyErr::warn(py, &py.get_type::<ResultWarning>(), &text, 1)?;
                }
                Ok(made)
            }
            Some(error) => {
                let diverged = made.get().run.findings.iter().any(|found| found.refuted == sg::Refuted::Diverged);
                let text = error.to_string();
                let error = if diverged { DivergedError::new_err(text) } else { RefutedError::new_err(text) };
                error.value(py).setattr("run", made)?;
                Err(error)
            }
        }
    }
}
