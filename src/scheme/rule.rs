//! The trait of a scheme on a grid, which each scheme's file implements.

use super::Counters;
use super::frame::Frame;
use super::space::Space;
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::Scene;
use crate::step::QuietSteps;
use std::fmt::Debug;

/// A rule that computes the state at one instant of the grid from that at the instant before. It
/// holds its constants, and what it carries from step to step beside the state.
pub(super) trait Rule<S: Space>: Debug + Send {
    /// Starts the motion at `time` (s) from the frame's state: at the beginning of a run, and
    /// whenever the caller sets the state. Sets everything that the rule carries from step to step.
    fn restart(&mut self, scene: &Scene, time: f64, frame: &Frame<S>) -> Result<()>;

    /// Makes step number `step`: advances the frame's state, and writes the results of the step to
    /// the frame. The caller has set the frame's extra force. A rule that divides steps makes the
    /// next part of this step, and sets the frame's `unfinished` unless it is the last.
    fn advance(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()>;

    /// Makes the steps from number `step` on that touch no wall, up to number `until`, as
    /// [`Rule::advance`] makes them one by one but with the state kept in registers, and adds those
    /// of one degree of freedom to `quiet`; returns the number of the first step that is not made.
    /// A rule without such a loop makes none.
    fn advance_quiet(
        &mut self,
        step: u64,
        _until: u64,
        _frame: &mut Frame<S>,
        _quiet: Option<&mut QuietSteps>,
    ) -> Result<u64> {
        Ok(step)
    }

    /// What the rule carries from step to step beside the state and decays with it, each with the
    /// power of h by which it is compared with a length: 1 for a velocity, 2 for an acceleration or
    /// a force.
    fn carried(&mut self) -> [Option<(&mut S::Vector, i32)>; 2] {
        [None, None]
    }

    /// Adds the work that the rule has done.
    fn count(&self, counters: &mut Counters);

    /// The solver of its quadratic programmes; `None` for a rule that has no such programmes.
    fn backend(&self) -> Option<Backend> {
        None
    }
}
