//! A comparison of several methods, as data.

use crate::error::Result;
use crate::run::Run;
use crate::scene::{LoadKind, Scene};
use crate::scheme::Method;
use crate::study::horizon::Source;

/// Error over the gap beyond which a run no longer agrees with the reference.
pub const AGREEMENT: f64 = 0.1;

/// Departure speed over approach speed at the rigid walls and round supports of a scene, as a run
/// realised it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Restitution {
    /// Smallest of all impacts.
    pub least: f64,
    /// Median of all impacts.
    pub median: f64,
    /// Largest of all impacts.
    pub largest: f64,
}

/// One method of the comparison.
#[derive(Debug, Clone)]
pub struct Row {
    /// The method.
    pub method: Method,
    /// The run, or why there is none.
    pub outcome: Result<Run>,
    /// Restitution at the rigid walls and round supports; `None` without impacts.
    pub restitution: Option<Restitution>,
    /// Largest |Δu| of any probe against the reference over the gap scale, up to the horizon;
    /// `None` without a probe.
    pub error: Option<f64>,
    /// Time up to which |Δu| stays below [`AGREEMENT`] of the gap scale, s.
    pub agrees_until: Option<f64>,
    /// Nanoseconds per step: stepping only, without recorder or judge, best of three. One step of
    /// the exact scheme goes from event to event.
    pub step_ns: Option<f64>,
}

/// A comparison.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Comparison {
    /// The methods in the order asked for, the exact scheme last.
    pub rows: Vec<Row>,
    /// The exact run, or why there is none; a run that the judge refutes counts as none.
    pub reference: Result<Run>,
    /// The reference where there is no exact run: the chosen stepping scheme with steps finer by
    /// [`FINER`](super::FINER).
    pub refined: Option<(Method, Run)>,
    /// Time up to which a pointwise error is meaningful, s.
    pub horizon: f64,
    /// Growth of a small perturbation over the whole run; `None` where it is not known.
    pub growth: Option<f64>,
    /// How the growth was found.
    pub growth_by: Option<Source>,
    /// Explanations of the differences, in sentences.
    pub findings: Vec<String>,
}

impl Comparison {
    /// The run that errors are against: the exact one, or the refined one in its place.
    pub(crate) fn reference_run(&self) -> Option<&Run> {
        self.reference.as_ref().ok().or(self.refined.as_ref().map(|(_, run)| run))
    }

    /// What errors are against, in words; `None` where there is no reference.
    pub(crate) fn reference_in_words(&self) -> Option<String> {
        match (&self.reference, &self.refined) {
            (Ok(_), _) => Some("the exact motion".to_owned()),
            (_, Some((method, run))) => Some(format!("{method} with steps of {:.2e} s", run.grid.step)),
            (Err(_), None) => None,
        }
    }
}

/// True under loads that need not repeat themselves, such as random ones, and without one that
/// does: perturbations may then grow, but there is no attractor whose chaos that would be.
#[must_use]
pub fn is_aperiodic(scene: &Scene) -> bool {
    let any = |is: fn(&LoadKind) -> bool| scene.loads.iter().any(|load| is(&load.kind));
    any(|kind| matches!(kind, LoadKind::Table(_))) || !any(|kind| matches!(kind, LoadKind::Harmonic { .. }))
}
