//! What a run shows of itself after each step.

use super::StructureEvent;
use crate::scheme::Handed;
use crate::scheme::event::Counters;
use crate::step::{Contact, Path, Step};

impl StructureEvent {
    /// The last step, number `index`.
    pub fn step(&self, index: u64) -> Step<'_> {
        Step {
            index,
            start: self.start,
            end: self.time,
            q: &self.q,
            v: &self.v,
            velocity_before: &self.velocity_before,
            velocity_after: &self.v,
            impulse: &self.impulse,
            jump: &self.jump,
            force: &self.force,
            extra: &self.extra,
            closed: &self.closed,
            path: match self.handed {
                Some((ref contract, step)) => Path::Handed { contract, step },
                None => Path::Series(&self.series),
            },
        }
    }

    /// Time reached, s.
    pub fn end(&self) -> f64 {
        self.time
    }

    /// Displacement and velocity there, m and m/s, n entries each.
    pub fn state(&self) -> (&[f64], &[f64]) {
        (&self.q, &self.v)
    }

    /// Contact episodes under way.
    pub fn open_contacts(&self) -> impl Iterator<Item = &Contact> {
        self.barriers.iter().filter_map(|b| b.open.as_ref())
    }

    /// Stretches handed to moreau-jean so far.
    pub fn stretches(&self) -> &[Handed] {
        &self.crowd.stretches
    }

    /// Programmes solved, and steps handed over.
    pub fn count(&self, counters: &mut crate::scheme::Counters) {
        counters.handed_steps = self.crowd.steps;
        if let Some(solver) = &self.solver {
            let inner = solver.counters();
            counters.qp_solves = inner.solves - inner.free;
            counters.pivots = inner.pivots;
            counters.qp_fallbacks = inner.fallbacks;
        }
    }

    /// Work done so far.
    pub fn counters(&self) -> Counters {
        self.guard.total
    }
}
