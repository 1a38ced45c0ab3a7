//! When steps end other than at events, and when a run is abandoned.

use super::ExactWall;
use super::guard::{EventCounters, Guard, WINDOWS};
use crate::error::{Error, Result};
use crate::interrupt::Asking;

/// The marks at which steps end, which are multiples of a stride and the end of the scene, and the
/// work done so far.
#[derive(Debug, Clone)]
pub(in crate::scheme) struct Clock {
    /// The end of the scene, s.
    pub duration: f64,
    /// s.
    pub stride: f64,
    /// Number of multiples of the stride passed, and the next one, s.
    marks: u64,
    mark: f64,
    /// A part of the duration, in which events and evaluations are counted, s.
    window: f64,
    guard: Guard,
    /// A single step may search for long.
    asking: Asking,
    /// The wall of the last event.
    pub last_wall: Option<usize>,
}

impl Clock {
    pub fn new(duration: f64, stride: f64) -> Self {
        let (window, guard, asking) = (duration / WINDOWS, Guard::default(), Asking::here());
        let mut clock = Self { duration, stride, marks: 0, mark: 0.0, window, guard, asking, last_wall: None };
        clock.begin(0);
        clock
    }

    /// Continues from `time` (s); the work counters are kept.
    pub fn restart(&mut self, time: f64) {
        // A mark that is ahead by rounding only counts as passed.
        self.begin((time / self.stride + 1e-9).floor() as u64);
        self.last_wall = None;
        self.guard.restart(time);
    }

    /// Sets the number of multiples of the stride passed. The next mark is the end of the scene
    /// where only rounding would separate the two.
    fn begin(&mut self, marks: u64) {
        let mark = (marks + 1) as f64 * self.stride;
        self.marks = marks;
        self.mark = if (self.duration - mark).abs() < 1e-9 * self.stride { self.duration } else { mark };
    }

    /// The latest end of a step from `time` (s): a mark, or the end of the scene if it is still
    /// ahead; s.
    pub fn limit(&self, time: f64) -> f64 {
        if time < self.duration { self.mark.min(self.duration) } else { self.mark }
    }

    /// Notes that a step has ended at `time` (s).
    pub fn pass(&mut self, time: f64) {
        if time >= self.mark {
            self.begin(self.marks + 1);
        }
    }

    /// Work done so far.
    pub fn total(&self) -> EventCounters {
        self.guard.total
    }

    /// Work done so far, to be increased.
    pub fn count(&mut self) -> &mut EventCounters {
        &mut self.guard.total
    }

    /// # Errors
    /// [`Error::TooManyEvents`], or evaluations, in the window that `time` (s) is in;
    /// [`Error::Stopped`].
    #[inline]
    pub fn check(&mut self, time: f64, barriers: &[ExactWall]) -> Result<()> {
        self.asking.pass(self.guard.total.evaluations)?;
        match self.guard.exceeded(time, self.window) {
            None => Ok(()),
            Some(count) => Err(self.refusal(time, count, barriers)),
        }
    }

    #[cold]
    fn refusal(&self, time: f64, count: u64, barriers: &[ExactWall]) -> Error {
        let wall = self.last_wall.and_then(|i| barriers.get(i)).or(barriers.first());
        let wall = wall.map_or_else(String::new, |b| b.name.clone());
        Error::TooManyEvents { time, wall, count, window: self.window }
    }
}

#[cfg(test)]
mod tests;
