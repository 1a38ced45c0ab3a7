//! The place of a round hole over a step: where it is and how fast, at both ends, and the terms
//! that add up to each, from which their rounding errors follow; and whether the step can have
//! reached the hole.

use super::Judge;
use super::place::{AtPlace, Place, SUM};
use crate::scene::Hole;
use crate::step::{Normal, Step};
use pulp::Simd;

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

impl HoleMotion {
    /// The velocity to which the law of the hole applies, m/s.
    pub fn rate(&self) -> [f64; 2] {
        let (before, struck) = (self.before.value, self.struck.value);
        [before[0] + struck[0], before[1] + struck[1]]
    }
}

impl Judge {
    /// The `place` of `hole` in `step`.
    pub(super) fn hole_motion(&self, step: &Step<'_>, hole: &Hole<'_>, place: &Place) -> HoleMotion {
        let (before, after) = (step.velocity_before, step.velocity_after);
        let [start, end, before, after] = place.seen([&self.q[..], step.q, before, after]);
        // Without blows it is zero.
        let [struck] = if self.loads.has_blows() { place.seen([&self.blows.struck]) } else { Default::default() };
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

    /// True if it is certain that a rigid hole, which did not push, is out of reach throughout the
    /// step, and that the place is no faster than any before: then there is nothing to check at it.
    ///
    /// Certain means inside the circle at the end of the step and where the promise takes the
    /// normal, by more than all rounding errors: those of the products here, in any order of their
    /// terms, and those within which a hole counts as reached.
    #[inline(always)]
    pub(super) fn is_out_of_reach<S: Simd>(&self, simd: S, step: &Step<'_>, hole: &Hole<'_>, place: &Place) -> bool {
        // The sizes of a step that predicts and corrects are noted after this.
        let noted = self.sums.steps > 0 && self.previous.is_none();
        if self.loads.has_blows() || !noted || !hole.law.is_rigid() {
            return false;
        }
        let pushed = [step.impulse, step.friction].map(|x| x.get(hole.index).copied());
        if pushed != [Some(0.0); 2] {
            return false;
        }
        let (ahead, touching) = match self.contract.promise.round {
            Some(turning) => (if let Normal::Ahead(part) = turning.normal { part } else { 0.0 }, turning.touching),
            None => (0.0, 0.0),
        };
        let vectors = [&self.q[..], step.q, step.velocity_before, step.velocity_after];
        let Some(near) = place.near(simd, ahead * self.h, vectors) else { return false };
        // Places at both ends, and what the velocities at both add to them.
        let largest = 4.0 * place.weight * self.noise.largest_place(self.extent.normal_reach);
        let [cy, cz] = hole.centre;
        let size = largest + cy.abs() + cz.abs() + hole.gap;
        let inside = hole.gap * (1.0 - 2.0 * touching) - SUM * size;
        let far = |w: [f64; 2]| (w[0] - cy).powi(2) + (w[1] - cz).powi(2);
        let slow = near.speed * (1.0 + SUM) <= self.extent.speed;
        slow && inside > 0.0 && far(near.end) < inside * inside && far(near.ahead) < inside * inside
    }
}
