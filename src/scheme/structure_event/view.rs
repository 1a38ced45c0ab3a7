//! What the scheme shows after each step.

use super::StructureEvent;
use crate::error::Result;
use crate::scene::Scene;
use crate::scheme::exact::ExactWall;
use crate::scheme::motion::Motion;
use crate::scheme::{Counters, Handover};
use crate::step::{Contact, Path, Step};

impl Motion for StructureEvent {
    fn advance(&mut self, _: u64, extra: Option<&[f64]>) -> Result<()> {
        self.advance(extra)
    }

    fn step(&self, index: u64) -> Step<'_> {
        let path = match self.handed {
            Some((ref contract, step)) => Path::Handed { contract, step },
            None => Path::Series(&self.series),
        };
        self.shown.step(index, self.time, (&self.q, &self.v), path)
    }

    fn restart(&mut self, _: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        self.restart(time, q, v)
    }

    fn open_contacts(&self) -> Vec<Contact> {
        self.barriers.iter().filter_map(ExactWall::shown).collect()
    }

    fn handed(&self) -> &[Handover] {
        &self.crowd.stretches
    }

    fn count(&self, counters: &mut Counters) {
        counters.events = self.clock.total().events;
        counters.flow_evaluations = self.clock.total().evaluations;
        counters.handed_steps = self.crowd.steps;
        let [solves, pivots, fallbacks] = self.solver_work();
        counters.qp_solves = solves;
        counters.pivots = pivots;
        counters.qp_fallbacks = fallbacks;
    }
}
