//! What a run shows of itself after each step.

use super::{Counters, Event};
use crate::flow::Arc;
use crate::step::{Contact, Path, Step};

impl Event {
    /// The last step, number `index`, under the extra force `extra` (N).
    pub(crate) fn step<'a>(&'a self, index: u64, extra: &'a [f64]) -> Step<'a> {
        Step {
            index,
            start: self.start,
            end: self.time,
            q: self.q(),
            v: self.v(),
            velocity_before: self.velocity_before(),
            velocity_after: self.v(),
            impulse: &self.impulse,
            jump: &self.jump,
            force: &self.force,
            extra,
            closed: &self.closed,
            path: Path::Exact(&self.arc),
        }
    }

    /// True once the end of the scene is reached; the motion goes on beyond it all the same.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.time >= self.duration
    }

    /// Time at the start of the last step, s.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// Time at its end, s: the present.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.time
    }

    /// Displacement now, m: a slice of one.
    #[must_use]
    pub fn q(&self) -> &[f64] {
        std::slice::from_ref(&self.q)
    }

    /// Velocity now, m/s, after what happened in this instant: a slice of one.
    #[must_use]
    pub fn v(&self) -> &[f64] {
        std::slice::from_ref(&self.v)
    }

    /// Velocity at the start of the last step, m/s, from the right: a slice of one.
    #[must_use]
    pub fn velocity_before(&self) -> &[f64] {
        std::slice::from_ref(&self.velocity_before)
    }

    /// Velocity at the end of the last step from the left, m/s: before what happened in that instant.
    #[must_use]
    pub fn velocity_left(&self) -> f64 {
        self.velocity_left
    }

    /// Impulse of each wall over the last step, N s, signed, with its jump.
    #[must_use]
    pub fn impulse(&self) -> &[f64] {
        &self.impulse
    }

    /// The part of it that acted in the instant at the end, N s.
    #[must_use]
    pub fn jump(&self) -> &[f64] {
        &self.jump
    }

    /// Force of each wall now, N, signed.
    #[must_use]
    pub fn force(&self) -> &[f64] {
        &self.force
    }

    /// Contact episodes that ended in the last step.
    #[must_use]
    pub fn closed(&self) -> &[Contact] {
        &self.closed
    }

    /// Contact episodes under way.
    pub fn open_contacts(&self) -> impl Iterator<Item = &Contact> {
        self.barriers.iter().filter_map(|b| b.open.as_ref()).filter(|c| c.impulse != 0.0)
    }

    /// The motion of the last step.
    #[must_use]
    pub fn arc(&self) -> &Arc {
        &self.arc
    }

    /// The rigid wall the body rests against now, if it does.
    #[must_use]
    pub fn rests_on(&self) -> Option<usize> {
        self.support
    }

    /// Time t∞ (s) to which the last tail of impacts accumulates, if one has been closed into lasting contact. The rest
    /// begins at the impact that opened the tail, earlier by flight/(1 − e).
    #[must_use]
    pub fn accumulation(&self) -> Option<f64> {
        self.accumulation
    }

    /// Work done so far.
    #[must_use]
    pub fn counters(&self) -> Counters {
        self.guard.total
    }
}
