//! The place of a round hole over a step: where it is and how fast, at both ends, and the terms
//! that add up to each, from which their rounding errors follow.

use super::Judge;
use super::place::{AtPlace, Place};
use crate::scene::Hole;
use crate::step::Step;

/// The place of a hole in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct HoleMotion {
    /// Displacement from the centre at both ends of the step, m.
    pub start: [f64; 2],
    pub end: [f64; 2],
    /// Velocities that enter and leave the momentum balance, m/s, with their terms.
    pub before: AtPlace,
    pub after: AtPlace,
    /// Velocity that the blows of the step give, m/s.
    pub struck: AtPlace,
    /// Size of the terms of both places with centre and gap, m.
    pub size: f64,
}

impl Judge {
    /// The `place` of `hole` in `step`.
    pub(super) fn hole_motion(&self, step: &Step<'_>, hole: &Hole<'_>, place: &Place) -> HoleMotion {
        let (before, after) = (step.velocity_before, step.velocity_after);
        let vectors = [&self.q[..], step.q, before, after, &self.blows.struck];
        let [start, end, before, after, struck] = place.seen(vectors);
        let [cy, cz] = hole.centre;
        let [from, to] = [start, end].map(|at| [at.value[0] - cy, at.value[1] - cz]);
        let size = start.terms + end.terms + (cy.abs() + cz.abs()) + hole.gap;
        HoleMotion { start: from, end: to, before, after, struck, size }
    }

    /// Size of the terms that add up to a place's distance from the centre, for its rounding error,
    /// and of its way within a step, m; with those of the other degrees of freedom, from which the
    /// equations of the step find it.
    pub(super) fn way(&self, hole: &Hole<'_>, motion: &HoleMotion) -> f64 {
        motion.size + self.h * (motion.before.terms + motion.after.terms) + self.noise.reach(hole.index)
    }
}
