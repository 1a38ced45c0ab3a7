//! What a run has cost.

use serde::{Deserialize, Serialize};

/// What a run has cost, in units that do not depend on the machine.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Counters {
    /// Steps taken (for the exact scheme: arcs between events).
    pub steps: u64,
    /// Steps that met a wall and solved a quadratic programme.
    pub qp_solves: u64,
    /// Interior-point iterations of those.
    pub interior_point_iterations: u64,
    /// Pivots of those.
    pub pivots: u64,
    /// Programmes that pivoting did not settle, and that were solved through Clarabel.
    pub qp_fallbacks: u64,
    /// Newton iterations of the penalty schemes.
    pub newton_iterations: u64,
    /// Contact events of the exact scheme.
    pub events: u64,
    /// Evaluations of the closed-form motion by the exact scheme's search for events.
    pub flow_evaluations: u64,
    /// Steps in which opposite walls took turns, so that the body stood still between them: the
    /// step is too large.
    pub frozen_steps: u64,
    /// Steps by which the exact scheme had moreau-jean cross stretches that it cannot close.
    pub handed_steps: u64,
}
