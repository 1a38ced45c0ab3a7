//! How a scene is run.

use crate::error::{raise, wrong};
use pyo3::PyResult;
use signorini as sg;

/// How a scene is run.
#[derive(Debug, Clone, Copy)]
pub struct Plan {
    pub method: sg::Method,
    pub time: sg::TimeOptions,
}

impl Plan {
    pub fn new(
        scene: &sg::Scene,
        scheme: Option<&str>,
        step: Option<f64>,
        sample: Option<f64>,
        statistics_from: f64,
    ) -> PyResult<Self> {
        let method = match scheme {
            Some(name) => name.parse::<sg::Method>().map_err(raise)?,
            None => sg::study::choice::choose(scene).method,
        };
        let step = match (step, method.scheme) {
            (Some(step), _) => step,
            // The exact scheme has no step; half the duration passes every check of a step.
            (None, sg::Scheme::Event) => 0.5 * scene.duration,
            (None, _) => return Err(wrong("step", "missing", &format!("the step of {method} in s, or accuracy"))),
        };
        let time = sg::TimeOptions { sample, statistics_from, ..sg::TimeOptions::with_step(step) };
        Ok(Self { method, time })
    }

    /// Refuses a step that the caller gave to the exact scheme, which has none.
    pub fn check_step(&self, given: Option<f64>) -> PyResult<()> {
        match given {
            Some(step) if self.method.scheme == sg::Scheme::Event => {
                let expected = "a scheme that has a step: event has none, and sample sets its rows";
                Err(wrong("step", format!("{step:?}"), expected))
            }
            _ => Ok(()),
        }
    }
}
