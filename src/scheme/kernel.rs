//! The state of whichever scheme was asked for.

use super::central_difference::CentralDifference;
use super::event::Event;
use super::grid::Counters;
use super::moreau_jean::MoreauJean;
use super::paoli_schatzman::PaoliSchatzman;
use super::penalty::{Mean, Penalty};
use super::position::Position;
use super::structure::Structure;
use super::structure_event::StructureEvent;
use super::{Integrator, Scheme};
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::Scene;
use std::sync::Arc;

/// The state and constants of one scheme on one scene. Smallness is a variant's content: these hold floats, no matrices.
#[derive(Debug)]
pub(super) enum Kernel {
    Position(Position),
    PaoliSchatzman(PaoliSchatzman),
    MoreauJean(MoreauJean),
    Penalty(Penalty),
    CentralDifference(CentralDifference),
    Event(Box<Event>),
    Structure(Box<Structure>),
    StructureEvent(Box<StructureEvent>),
}

impl Kernel {
    /// `scheme` on `scene` with steps of `step` seconds; `single` says whether the kernels of one degree of freedom can hold the scene.
    pub fn new(scene: &Arc<Scene>, scheme: &Scheme, step: f64, backend: Backend, single: bool) -> Result<Self> {
        Ok(match *scheme {
            Scheme::Event if !single => Self::StructureEvent(Box::new(StructureEvent::new(scene, step)?)),
            // Of generalized-α there is no scalar kernel: an oscillator is a structure of 1 × 1 matrices to it.
            _ if !single => Self::Structure(Box::new(Structure::new(scene, scheme, step, backend)?)),
            Scheme::ImplicitEuler => Self::Position(Position::new(scene, 1.0, step, backend)?),
            Scheme::Newmark => Self::Position(Position::new(scene, 0.5, step, backend)?),
            Scheme::PaoliSchatzman => Self::PaoliSchatzman(PaoliSchatzman::new(scene, step, backend)?),
            Scheme::MoreauJean { theta } => Self::MoreauJean(MoreauJean::new(scene, theta, step, backend)?),
            Scheme::GeneralizedAlpha { .. } => Self::Structure(Box::new(Structure::new(scene, scheme, step, backend)?)),
            Scheme::Penalty { integrator, .. } => match integrator {
                Integrator::Trapezoidal => Self::Penalty(Penalty::new(scene, 0.5, Mean::Ends, step)),
                Integrator::ImplicitEuler => Self::Penalty(Penalty::new(scene, 1.0, Mean::Ends, step)),
                Integrator::DiscreteGradient => Self::Penalty(Penalty::new(scene, 0.5, Mean::DiscreteGradient, step)),
                Integrator::CentralDifference => Self::CentralDifference(CentralDifference::new(scene, step)),
            },
            Scheme::Event => Self::Event(Box::new(Event::over(scene, step)?)),
        })
    }

    /// Takes the motion up anew at `time` (s) from `q` (m) and `v` (m/s), n entries each.
    pub fn restart(&mut self, scene: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        let first = |x: &[f64]| x.first().copied().unwrap_or(0.0);
        let (single, rate) = (first(q), first(v));
        match self {
            Self::Position(kernel) => kernel.restart(time, single, rate),
            Self::PaoliSchatzman(kernel) => kernel.restart(time, single, rate),
            Self::MoreauJean(kernel) => kernel.restart(time, single, rate),
            Self::Penalty(kernel) => kernel.restart(time, single, rate),
            Self::CentralDifference(kernel) => kernel.restart(time, single, rate),
            Self::Event(event) => event.restart(scene, time, single, rate)?,
            Self::Structure(kernel) => kernel.restart(scene, time, q, v)?,
            Self::StructureEvent(event) => event.restart(time, q, v)?,
        }
        Ok(())
    }

    /// Adds what the scheme has cost so far.
    pub fn count(&self, counters: &mut Counters) {
        match self {
            Self::Position(kernel) => kernel.count(counters),
            Self::PaoliSchatzman(kernel) => kernel.count(counters),
            Self::MoreauJean(kernel) => kernel.count(counters),
            Self::Penalty(kernel) => kernel.count(counters),
            Self::CentralDifference(_) => {}
            Self::Structure(kernel) => kernel.count(counters),
            Self::Event(event) => of_events(counters, event.counters()),
            Self::StructureEvent(event) => {
                of_events(counters, event.counters());
                event.count(counters);
            }
        }
    }
}

fn of_events(counters: &mut Counters, inner: super::event::Counters) {
    counters.events = inner.events;
    counters.flow_evaluations = inner.evaluations;
}
