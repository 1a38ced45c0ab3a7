//! Accuracy against speed: every method over a range of steps, error against wall-clock time.
//!
//! | file | what it holds |
//! |---|---|
//! | `graph.rs` | the distance between motions with jumps |
//! | `errors.rs` | the four errors of a run |
//! | `kind.rs` | which of these errors is asked for |
//! | `reference.rs` | the reference of these errors, and until when it can be used |
//! | `ladder.rs` | the steps that are tried |
//! | `timing.rs` | timing |
//! | `measure.rs` | the study itself |
//! | `front.rs` | order, Pareto front, cheapest |
//! | `overlay.rs` | points of other programs |

mod errors;
mod front;
mod graph;
mod kind;
mod ladder;
mod measure;
mod overlay;
mod reference;
mod timing;

pub use errors::Errors;
pub use front::{order, pareto, reached};
pub use graph::{Graph, Scales};
pub use kind::Quantity;
pub use ladder::Steps;
pub use measure::study;
pub use overlay::{Peer, read};
pub use reference::{Horizon, Reference};

use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::scheme::{Counters, Integrator, Method, PenaltyLaw, Scheme, SchemeKind, Stepper};

/// The steps to try, and the limits on cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// The steps.
    pub steps: Steps,
    /// Timed runs of each point; the fastest counts.
    pub repeats: u32,
    /// Most seconds of a run, s: one that is expected to take longer is left out, and its point
    /// says so. A refined reference may take several times as long.
    pub most_seconds: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { steps: Steps::default(), repeats: 5, most_seconds: 1.0 }
    }
}

/// Outcome of one method at one step.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Outcome {
    /// It ran.
    Ran(Box<Measured>),
    /// It failed.
    Failed(Error),
    /// It was left out, since it would have taken this long, s.
    LeftOut(f64),
}

/// Measurements of a run.
#[derive(Debug, Clone)]
pub struct Measured {
    /// Errors against the scene: for a penalty, modelling and integration together.
    pub errors: Errors,
    /// Errors of a penalty against the motion of its own springs: integration only.
    pub own: Option<Errors>,
    /// Stepping, s: best of several.
    pub seconds: f64,
    /// Cost that does not depend on the machine.
    pub counters: Counters,
    /// Notes of the run, which the reader must know.
    pub notes: Vec<String>,
}

/// One method at one step.
#[derive(Debug, Clone)]
pub struct Point {
    /// Its step, s; `None` for the exact scheme.
    pub step: Option<f64>,
    /// Its outcome.
    pub outcome: Outcome,
}

impl Point {
    /// The measurements, if it ran.
    #[must_use]
    pub fn measured(&self) -> Option<&Measured> {
        if let Outcome::Ran(measured) = &self.outcome { Some(measured) } else { None }
    }
}

/// One method over its steps, coarsest first.
#[derive(Debug, Clone)]
pub struct MethodPoints {
    /// The method.
    pub method: Method,
    /// Its points.
    pub points: Vec<Point>,
}

/// Errors above this tell no order.
const COARSE: f64 = 0.1;

/// Errors below this may be rounding, which grows with the number of steps.
const ROUNDING: f64 = 1e-11;

impl MethodPoints {
    /// The points that ran: step (s; `None` for the exact scheme) and measurements.
    pub fn measured(&self) -> impl Iterator<Item = (Option<f64>, &Measured)> {
        self.points.iter().filter_map(|p| Some((p.step, p.measured()?)))
    }

    /// Order of convergence of the displacement error (of a penalty, against its own springs). It
    /// uses errors from the step on from which all are below a tenth, and of these the ones far
    /// enough above `known`, the uncertainty of the reference, and above rounding; `None` from
    /// fewer than two of these.
    #[must_use]
    pub fn order(&self, known: f64) -> Option<f64> {
        let error = |m: &Measured| m.own.as_ref().unwrap_or(&m.errors).displacement;
        let points: Vec<(f64, f64)> = self.measured().filter_map(|(h, m)| Some((h?, error(m)))).collect();
        let errors: Vec<f64> = points.iter().map(|point| point.1).collect();
        let first = reached(&errors, COARSE)?;
        order(points.into_iter().skip(first).filter(|point| point.1 > ROUNDING.max(10.0 * known)))
    }

    /// The cheapest point from which on the error of `quantity` stays at or below `tolerance`.
    #[must_use]
    pub fn cheapest(&self, quantity: Quantity, tolerance: f64) -> Option<(Option<f64>, &Measured)> {
        // An error that is missing, such as that of impulses in a run without contacts, misses
        // every tolerance.
        let error = |m: &Measured| quantity.of(&m.errors).unwrap_or(f64::NAN);
        let errors: Vec<f64> = self.measured().map(|(_, m)| error(m)).collect();
        let first = reached(&errors, tolerance)?;
        self.measured().skip(first).min_by(|a, b| a.1.seconds.total_cmp(&b.1.seconds))
    }
}

/// The modelling error of a penalty, which remains however small the step.
#[derive(Debug, Clone)]
pub struct Floor {
    /// The springs.
    pub law: PenaltyLaw,
    /// The motion with these springs, or why there is none.
    pub reference: Result<Reference>,
    /// Time up to which runs are compared with that motion, s: lossless springs may be more
    /// sensitive to the start than the scene.
    pub end: f64,
    /// Errors of that motion against the scene: the modelling error.
    pub errors: Option<Errors>,
}

/// Accuracy against speed on one scene.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct WorkPrecision {
    /// Time up to which runs are compared.
    pub horizon: Horizon,
    /// The reference.
    pub reference: Reference,
    /// One series per method.
    pub series: Vec<MethodPoints>,
    /// One floor per penalty law.
    pub floors: Vec<Floor>,
}

impl WorkPrecision {
    /// The cheapest method of a kind among those whose error of `quantity` stays at or below
    /// `tolerance` from some step on: its series, step (s; `None` for the exact scheme) and
    /// measurements.
    #[must_use]
    pub fn cheapest(
        &self,
        kind: SchemeKind,
        quantity: Quantity,
        tolerance: f64,
    ) -> Option<(&MethodPoints, Option<f64>, &Measured)> {
        let of_kind = self.series.iter().filter(|s| s.method.scheme.entry().kind == kind);
        let reached = of_kind.filter_map(|s| s.cheapest(quantity, tolerance).map(|(step, m)| (s, step, m)));
        reached.min_by(|a, b| a.2.seconds.total_cmp(&b.2.seconds))
    }

    /// The modelling error of a penalty; `None` for the other schemes.
    #[must_use]
    pub fn floor(&self, scheme: &Scheme) -> Option<&Floor> {
        let Scheme::Penalty { law, .. } = *scheme else { return None };
        self.floors.iter().find(|f| f.law == law)
    }

    /// The uncertainty, over the gap, of the reference for a scheme's own error: of the motion of a
    /// penalty's springs, else of the scene's reference.
    #[must_use]
    pub fn known(&self, scheme: &Scheme) -> f64 {
        let own = self.floor(scheme).and_then(|f| f.reference.as_ref().ok());
        own.unwrap_or(&self.reference).uncertainty.displacement
    }
}

/// Every scheme: the exact one, those of the constrained QP, and every penalty with every
/// integrator.
#[must_use]
pub fn every_method(laws: &[PenaltyLaw]) -> Vec<Method> {
    let alone = Scheme::ALL.into_iter().filter(|scheme| scheme.entry().kind != SchemeKind::Penalty);
    let (exact, stepped): (Vec<_>, Vec<_>) = alone.partition(Scheme::is_exact);
    let penalty = |&law| Integrator::ALL.into_iter().rev().map(move |integrator| Scheme::Penalty { law, integrator });
    let all = exact.into_iter().chain(stepped).chain(laws.iter().flat_map(penalty));
    all.map(Method::new).collect()
}

/// Every method that has a rule for the walls of `scene`, with every penalty of `laws`, and the
/// methods that refuse them.
#[must_use]
pub fn default_methods(scene: &Scene, laws: &[PenaltyLaw]) -> (Vec<Method>, Vec<Method>) {
    every_method(laws).into_iter().partition(|method| Stepper::takes(scene, &method.scheme, scene.duration))
}
