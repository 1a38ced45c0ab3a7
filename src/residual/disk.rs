//! Checks of round holes against a bound on the displacement at the end of a step
//! ([`Promise::hole`](crate::step::Promise::hole)): that the hole is not passed, that it pushes
//! only where it is touched, towards its centre, and never pulls.

use super::Judge;
use super::hole_motion::HoleMotion;
use super::largest_residual::Residual;
use super::round::HolePush;
use crate::scene::Hole;
use crate::step::Step;

impl Judge {
    /// Checks the gap of a rigid hole at the end of the step, and that it pushes only without one.
    pub(super) fn hold_disk(&mut self, hole: &Hole<'_>, motion: &HoleMotion, pressure: f64) {
        let slack = hole.gap - motion.end[0].hypot(motion.end[1]);
        self.walls.observe_gap(&self.noise, hole.index, (slack, self.way(hole, motion)), pressure);
    }

    /// Checks a rigid hole that pushes only while the body stays at it, along the middle of its
    /// path.
    pub(super) fn hold_along(&mut self, hole: &Hole<'_>, motion: &HoleMotion, did: &HolePush, askew: &mut Residual) {
        let (pressure, start, end) = (did.impulse / self.h, motion.start, motion.end);
        self.hold_disk(hole, motion, pressure);
        if pressure != 0.0 {
            let slack = hole.gap - start[0].hypot(start[1]);
            self.walls.observe_gap(&self.noise, hole.index, (slack, self.way(hole, motion)), pressure);
        }
        self.along((hole, motion), did, [start[0] + end[0], start[1] + end[1]], askew);
    }

    /// Checks that the hole pushes along w⁺, and notes the part of its force that is not in `askew`
    /// (N).
    pub(super) fn along_end(&self, hole: &Hole<'_>, motion: &HoleMotion, did: &HolePush, askew: &mut Residual) {
        self.along((hole, motion), did, motion.end, askew);
    }

    /// Notes the part of a hole's force that is not along `end` in `askew` (N).
    fn along(&self, (hole, motion): (&Hole<'_>, &HoleMotion), did: &HolePush, end: [f64; 2], askew: &mut Residual) {
        let force = did.impulse.hypot(did.friction) / self.h;
        if force == 0.0 {
            return;
        }
        let distance = end[0].hypot(end[1]);
        let across = force * (did.normal[0] - end[0] / distance).hypot(did.normal[1] - end[1] / distance);
        let noise = force * self.noise.of(self.way(hole, motion)) / distance + self.noise.wall_force(hole.index);
        askew.observe(across, noise, self.noise.end, Some(hole.index));
    }

    /// True if the velocity that the blows give drives the structure into a hole that is touched.
    pub(super) fn drives_into_hole(&self, step: &Step<'_>) -> bool {
        self.scene.holes().any(|hole| {
            let ([y, z], [vy, vz]) = (hole.offset(step.q), hole.seen(&self.blows.struck));
            y * vy + z * vz > 0.0
        })
    }
}
