//! What the scheme shows after each step.

use super::{Event, EventCounters};
use crate::error::Result;
use crate::flow::Arc;
use crate::scene::Scene;
use crate::scheme::motion::Motion;
use crate::step::{Contact, Path, Step};

impl Event {
    /// True once the end of the scene is reached; the motion goes on beyond it all the same.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.time >= self.clock.duration
    }

    /// The last step.
    #[must_use]
    pub fn step(&self) -> Step<'_> {
        Motion::step(self, self.steps)
    }

    /// The present, s.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.time
    }

    /// Displacement now, m: a slice of one.
    #[must_use]
    pub fn q(&self) -> &[f64] {
        std::slice::from_ref(&self.q)
    }

    /// Velocity now, m/s, after the jump at this instant: a slice of one.
    #[must_use]
    pub fn v(&self) -> &[f64] {
        std::slice::from_ref(&self.v)
    }

    /// Velocity at the end of the last step from the left, m/s: before the jump at that instant.
    #[must_use]
    pub fn velocity_left(&self) -> f64 {
        self.velocity_left
    }

    /// Open contact episodes.
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

    /// Time t∞ (s) to which the last tail of impacts accumulates, if one has been closed into
    /// lasting contact. The rest begins at the impact that opened the tail, earlier by flight/(1 −
    /// e).
    #[must_use]
    pub fn accumulation(&self) -> Option<f64> {
        self.accumulation
    }

    /// Work done so far.
    #[must_use]
    pub fn counters(&self) -> EventCounters {
        self.clock.total()
    }
}

impl Motion for Event {
    fn advance(&mut self, _: u64, extra: Option<&[f64]>) -> Result<()> {
        self.advance(extra.and_then(|extra| extra.first()).copied().unwrap_or(0.0))
    }

    fn step(&self, index: u64) -> Step<'_> {
        self.shown.step(index, self.time, (self.q(), self.v()), Path::Exact(&self.arc))
    }

    fn restart(&mut self, scene: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        let first = |x: &[f64]| x.first().copied().unwrap_or(0.0);
        let (q, v) = (first(q), first(v));
        let mut event = Self::over(scene, self.clock.stride)?;
        (event.time, event.q, event.v) = (time, q, v);
        event.shown.begin(time, &[v]);
        event.velocity_left = v;
        event.blow = event.forcing.impulses.iter().filter(|blow| blow.0 <= time).count();
        (event.clock, event.steps) = (self.clock.clone(), self.steps);
        event.clock.restart(time);
        event.reclassify();
        event.shown.closed.clear();
        event.set_forces(0.0);
        *self = event;
        Ok(())
    }

    fn open_contacts(&self) -> Vec<Contact> {
        self.open_contacts().copied().collect()
    }

    fn count(&self, counters: &mut crate::scheme::Counters) {
        counters.events = self.clock.total().events;
        counters.flow_evaluations = self.clock.total().evaluations;
    }
}
