//! Checks of round holes against a bound on the displacement at the end of a step
//! ([`Promise::hole`](crate::step::Promise::hole)): that the hole is not passed, that it pushes
//! only where it is touched, towards its centre, and never pulls.

use super::Judge;
use super::beyond::Worst;
use super::pushes::terms;
use crate::scene::Support;
use crate::step::{HoleStep, Normal, Step, Turning};

impl Judge {
    /// Checks the gap of a rigid hole at the end of the step, and that it pushes only without one.
    pub(super) fn hold_disk(&mut self, step: &Step<'_>, (place, support, gap): (usize, &Support, f64), pressure: f64) {
        let end = support.offset(step.q);
        let slack = gap - end[0].hypot(end[1]);
        self.pairs.add(slack, pressure);
        if slack < 0.0 || pressure != 0.0 {
            let noise = self.rounding.met(self.way(step, support, gap), self.energy.gap_scale);
            let force = self.rounding.wall_force(place, self.span, self.clock);
            self.doubts.gaps.add((slack, noise), (pressure, force), self.now, place);
        }
    }

    /// Checks that the hole pushes along w⁺; returns the part of its force that is not, N.
    pub(super) fn along_end(
        &mut self,
        step: &Step<'_>,
        (place, support, gap): (usize, &Support, f64),
        did: &HoleStep,
        doubt: &mut Worst,
    ) -> f64 {
        let force = did.impulse.hypot(did.friction) / self.h;
        if force == 0.0 {
            return 0.0;
        }
        let end = support.offset(step.q);
        let distance = end[0].hypot(end[1]);
        let askew = force * (did.normal[0] - end[0] / distance).hypot(did.normal[1] - end[1] / distance);
        let noise = force * self.rounding.of(self.way(step, support, gap)) / distance;
        doubt.see(askew - noise - self.rounding.wall_force(place, self.span, self.clock), self.now, Some(place));
        askew
    }

    /// True if a hole is closed after the step: touched there, or pushing.
    pub(super) fn closes_hole(&self, step: &Step<'_>) -> bool {
        let Some(Turning { normal: Normal::Middle(_), touching, .. }) = self.contract.promise.round else {
            return false;
        };
        self.scene.holes().zip(step.holes).any(|(hole, did)| {
            let [y, z] = hole.support.offset(step.q);
            did.impulse != 0.0 || y.hypot(z) >= hole.gap * (1.0 - 2.0 * touching)
        })
    }

    /// True if the velocity that the blows give drives the structure into a hole that is touched.
    pub(super) fn drives_into_hole(&self, step: &Step<'_>) -> bool {
        self.scene.holes().any(|hole| {
            let ([y, z], [vy, vz]) = (hole.support.offset(step.q), hole.support.seen(&self.blows.struck));
            y * vy + z * vz > 0.0
        })
    }

    /// Size of the terms that add up to a place's distance from the centre, for its rounding error,
    /// and of its way within a step, m.
    pub(super) fn way(&self, step: &Step<'_>, support: &Support, gap: f64) -> f64 {
        let speeds = terms(support, step.velocity_before) + terms(support, step.velocity_after);
        let centre = support.centre[0].abs() + support.centre[1].abs();
        terms(support, &self.q) + terms(support, step.q) + centre + gap + self.h * speeds
    }
}
