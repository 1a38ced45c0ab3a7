//! The trait of what the stepper drives: a rule on a grid, or the exact motion.

use super::{Counters, Handover};
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::Scene;
use crate::step::{Contact, QuietSteps, Step};
use std::fmt::Debug;

/// A motion that is computed step by step.
pub(super) trait Motion: Debug + Send {
    /// Makes step number `step` under the extra force (N, n entries; `None` is zero force).
    fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()>;

    /// True if the last step was a part of one on the grid that has further parts, which
    /// [`Motion::advance`] makes.
    fn is_divided(&self) -> bool {
        false
    }

    /// Makes the steps from number `step` on that touch no wall, up to number `until`, and adds
    /// those of one degree of freedom to `quiet`; returns the number of the first step that is not
    /// made. A motion without such a loop makes none.
    fn advance_quiet(&mut self, step: u64, _until: u64, _quiet: Option<&mut QuietSteps>) -> Result<u64> {
        Ok(step)
    }

    /// Sets to 0 each degree of freedom that moves by less than `tiny` (m) within a step and is as
    /// near to 0. Exact motion, whose steps end at events, has no need of it.
    fn flush(&mut self, _tiny: f64) {}

    /// The last step, whose number is `index`.
    fn step(&self, index: u64) -> Step<'_>;

    /// Restarts the motion at `time` (s) from `q` (m) and `v` (m/s), n entries each.
    fn restart(&mut self, scene: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()>;

    /// Contact episodes that have not ended.
    fn open_contacts(&self) -> Vec<Contact>;

    /// Stretches that the exact scheme has left to moreau-jean so far.
    fn handed(&self) -> &[Handover] {
        &[]
    }

    /// Adds the work of the motion so far.
    fn count(&self, counters: &mut Counters);

    /// The solver of the quadratic programmes; `None` without such programmes.
    fn backend(&self) -> Option<Backend> {
        None
    }
}
