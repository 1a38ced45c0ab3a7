//! What the stepper drives: a rule on a grid, or the exact motion.

use super::{Counters, Handed};
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::Scene;
use crate::step::{Contact, Step};
use std::fmt::Debug;

/// A motion that goes on from step to step.
pub(super) trait Motion: Debug + Send {
    /// Makes a step, number `step`, under the extra force (N, n entries; none is none).
    fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()>;

    /// The step last made, whose number is `index`.
    fn step(&self, index: u64) -> Step<'_>;

    /// Takes the motion up anew at `time` (s) from `q` (m) and `v` (m/s), n entries each.
    fn restart(&mut self, scene: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()>;

    /// Time reached, s.
    fn end(&self) -> f64;

    /// Displacement and velocity there, m and m/s, n entries each.
    fn state(&self) -> (&[f64], &[f64]);

    /// Contact episodes under way.
    fn open_contacts(&self) -> Vec<Contact>;

    /// Stretches handed to moreau-jean so far.
    fn handed(&self) -> &[Handed] {
        &[]
    }

    /// Adds what the motion has cost so far.
    fn count(&self, counters: &mut Counters);

    /// The solver of the quadratic programmes; none without such programmes.
    fn backend(&self) -> Option<Backend>;
}
