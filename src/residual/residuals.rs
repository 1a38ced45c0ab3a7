//! What the judge hands over: the residuals of a run.

use super::Energy;
#[cfg(doc)]
use crate::step::Promise;
use serde::Serialize;

/// How well a run kept its word; all of it seen step by step, however few rows were recorded.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Residuals {
    /// Largest |min(γ/γ₀, |r|/r₀)| over steps and rigid walls, and of | |r| − law |/r₀ over elastic ones; dimensionless. γ and r are
    /// taken where the scheme promises them ([`Promise`]). A damped wall's law jumps where the body meets its face, from 0 to c_a ṡ: a
    /// body there to rounding may feel any pressure between.
    pub complementarity: f64,
    /// Deepest position behind each wall at the end of a step, m, ≥ 0, in the scene's order.
    pub depth_m: Vec<f64>,
    /// Deepest position behind a rigid wall, m.
    pub penetration_m: f64,
    /// Largest force with which a wall pulled, N, ≥ 0.
    pub tension_n: f64,
    /// Largest residual of the step's momentum balance, per h, N (N m in the balance of a rotation).
    pub force_balance_n: f64,
    /// The same over the largest force in that balance, or the mismatch of q⁺ − q with the velocities over the gap scale or the
    /// largest |q|, if that is more. Balances of several degrees of freedom, whose units may differ, are compared in the metric of the mass: forces
    /// over √Mᵢᵢ, displacements times it.
    pub force_balance: f64,
    /// The energy ledger.
    pub energy: Energy,
    /// γ₀: what gaps are measured by, m; for a velocity-level promise the run's largest speed at a rigid wall (Σ|gᵢvᵢ|, the size of what
    /// its speed is a sum of), or a gap in the run's duration if that is more (a body held fast has a speed of rounding), m/s. A promise on
    /// both levels measures its gaps by the first and its speeds by the second; the first is given.
    pub gap_scale: f64,
    /// r₀: the largest contact force of the run, N (impulse/h for a scheme on a grid). Contact forces below 1e-6 of the largest force in the
    /// momentum balance, which may be rounding, are measured by that share of it. Where there is none, an elastic wall that should
    /// have pushed is held against what the stiffest would make of the gap scale.
    pub force_scale_n: f64,
}
