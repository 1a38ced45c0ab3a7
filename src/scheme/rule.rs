//! What a scheme on a grid is: the one thing that each file of a scheme writes.

use super::Counters;
use super::frame::Frame;
use super::space::Space;
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::Scene;
use std::fmt::Debug;

/// A rule that takes the state from one instant of the grid to the next, with the constants and the
/// memory that it has beside the state.
pub(super) trait Rule<S: Space>: Debug + Send {
    /// Takes the motion up at `time` (s), from the frame's state: at the start, and wherever the
    /// state is set. All memory is set here.
    fn restart(&mut self, scene: &Scene, time: f64, frame: &Frame<S>) -> Result<()>;

    /// Makes step number `step`: moves the frame's state, and writes what the step shows of itself.
    /// The frame's extra force is set.
    fn advance(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()>;

    /// Adds what the rule has cost.
    fn count(&self, counters: &mut Counters);

    /// The solver of its quadratic programmes; none for a rule without.
    fn backend(&self) -> Option<Backend>;
}
