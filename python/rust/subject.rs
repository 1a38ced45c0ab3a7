//! What a study is of: a scene, or a case with the times and the methods that are its own.

use crate::case::Case;
use crate::error::{raise, wrong, wrong_type};
use crate::plan::Plan;
use crate::scene::Scene;
use pyo3::prelude::*;
use signorini as sg;

/// A scene, or that of a case.
pub struct Subject<'py> {
    pub scene: Bound<'py, Scene>,
    case: Option<Bound<'py, Case>>,
}

impl<'a, 'py> FromPyObject<'a, 'py> for Subject<'py> {
    type Error = PyErr;

    fn extract(subject: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(case) = subject.cast::<Case>() {
            let scene = case.get().scene.bind(subject.py()).clone();
            return Ok(Self { scene, case: Some(case.to_owned()) });
        }
        match subject.cast::<Scene>() {
            Ok(scene) => Ok(Self { scene: scene.to_owned(), case: None }),
            Err(_) => Err(wrong_type(&subject, "a Scene or a Case")),
        }
    }
}

impl Subject<'_> {
    /// The scene of the library.
    pub fn inner(&self) -> &sg::Scene {
        &self.scene.get().scene
    }

    /// The case of the library; `None` for a scene.
    pub fn case(&self) -> Option<&sg::case::Case> {
        self.case.as_ref().map(|case| &case.get().case)
    }

    /// The penalties of the case; none for a scene.
    pub fn laws(&self) -> &[sg::PenaltyLaw] {
        self.case().map_or(&[], |case| &case.penalty.laws)
    }

    /// The methods of these names; settings that they leave open are those of the case.
    pub fn methods(&self, names: &[String]) -> PyResult<Vec<sg::Method>> {
        let method = |name: &String| self.case().map_or_else(|| name.parse(), |case| case.method(name));
        names.iter().map(|name| method(name).map_err(raise)).collect()
    }

    /// The times of a run; what is left out is that of the case.
    pub fn time(
        &self,
        step: Option<f64>,
        sample: Option<f64>,
        statistics_from: Option<f64>,
    ) -> PyResult<sg::TimeOptions> {
        if let Some(case) = self.case() {
            let (sample, from) = (sample.or(case.time.sample), statistics_from.unwrap_or(case.time.statistics_from));
            let step = step.unwrap_or(case.time.step);
            return Ok(sg::TimeOptions { step, sample, statistics_from: from, ..case.time });
        }
        let Some(step) = step else {
            return Err(wrong("step", "missing", "the step of the methods in s, or a case, which has one"));
        };
        Ok(Plan::new(self.inner(), None, Some(step), sample, statistics_from.unwrap_or(0.0))?.time)
    }
}
