//! Counters of the work of a run.

use crate::qp::SolverCounters;
use serde::{Deserialize, Serialize};

/// The work of a run, in units that do not depend on the machine.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
#[non_exhaustive]
pub struct Counters {
    /// Steps taken (for the exact scheme: arcs between events).
    pub steps: u64,
    /// Steps that met a wall and solved a quadratic programme.
    pub qp_solves: u64,
    /// Interior-point iterations in these programmes.
    pub interior_point_iterations: u64,
    /// Pivots (exchanges of active sets) in these programmes.
    pub pivots: u64,
    /// Programmes in which pivoting found no solution, and which Clarabel solved.
    pub qp_fallbacks: u64,
    /// Steps in which rounding left the contacts of round holes and friction without a common
    /// state: their forces are those of the last sweep.
    pub qp_unsettled: u64,
    /// Steps in which contacts with friction gave up their rebound, since no impulses satisfy
    /// Coulomb's law together with it, as of a wedged body, or only some that add energy.
    pub wedged_steps: u64,
    /// Newton iterations of the penalty schemes.
    pub newton_iterations: u64,
    /// Parts into which located divided its steps.
    pub parts: u64,
    /// Steps of located with too many impacts, whose rest was made without rebound.
    pub steps_given_up: u64,
    /// Contact events of the exact scheme.
    pub events: u64,
    /// Evaluations of the closed-form motion by the exact scheme's search for events.
    pub flow_evaluations: u64,
    /// Steps in which a wall pushed right after the opposite one, so that the body stood still
    /// between them: the step is too large.
    pub frozen_steps: u64,
    /// Largest angle by which the normal of a round hole turned in a step in which it pushed, rad.
    pub largest_turn_rad: f64,
    /// Steps of moreau-jean through stretches of impacts that the exact scheme cannot resolve.
    pub handed_steps: u64,
}

impl Counters {
    /// Adds what programmes have cost a solver, but for their number.
    pub(crate) fn add_work(&mut self, solver: &SolverCounters) {
        self.interior_point_iterations += solver.iterations;
        self.pivots += solver.pivots;
        self.qp_fallbacks += solver.fallbacks;
    }
}
