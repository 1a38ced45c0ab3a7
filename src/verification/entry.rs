//! An entry of the verification manual: a scene, a scheme, and the values that it must give.

use crate::case::{Case, CaseFile};
use crate::error::{Error, Result};
use crate::run::{Options, Run, run};
use crate::scheme::Method;

/// A scene of the manual.
#[derive(Debug, Clone, Copy)]
pub(super) enum Scene {
    /// A built-in case.
    BuiltIn(&'static str),
    /// A case file of the manual alone: its name and its text.
    Own(&'static str, &'static str),
}

/// One entry of the manual: a scene, run once by one scheme, and the values that it must give.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    pub scene: Scene,
    /// What distinguishes it from other entries of the same scene: keys of the case and their
    /// values.
    pub changes: &'static [(&'static str, f64)],
    /// The scheme, as on the command line.
    pub method: &'static str,
    /// Where the values come from.
    pub source: &'static str,
    pub values: &'static [Expected],
}

/// A value that an entry must give.
#[derive(Debug, Clone, Copy)]
pub(super) struct Expected {
    pub quantity: &'static str,
    pub unit: &'static str,
    pub value: f64,
    /// Largest deviation, in the unit of the value.
    pub tolerance: f64,
    /// Why the tolerance is what it is.
    pub reason: &'static str,
    pub found: fn(&Run) -> Option<f64>,
}

/// A value that an entry must give, by its fields in their order.
pub(super) const fn value(
    quantity: &'static str,
    unit: &'static str,
    value: f64,
    tolerance: f64,
    reason: &'static str,
    found: fn(&Run) -> Option<f64>,
) -> Expected {
    Expected { quantity, unit, value, tolerance, reason, found }
}

impl Entry {
    pub fn name(&self) -> &'static str {
        match self.scene {
            Scene::BuiltIn(name) | Scene::Own(name, _) => name,
        }
    }

    fn case(&self) -> Result<Case> {
        let mut file = match self.scene {
            Scene::BuiltIn(name) => CaseFile::embedded(name)?,
            Scene::Own(name, text) => CaseFile::from_text(text, name, ""),
        };
        for (key, value) in self.changes {
            file.set(&key.parse()?, &(*value).into())?;
        }
        file.case()
    }

    pub fn run(&self) -> Result<Run> {
        let case = self.case()?;
        let run = run(&case.scene, &self.method.parse::<Method>()?, &Options::new(case.time))?;
        if run.findings.is_empty() {
            Ok(run)
        } else {
            Err(Error::Refuted { runs: run.findings.iter().map(ToString::to_string).collect() })
        }
    }
}
