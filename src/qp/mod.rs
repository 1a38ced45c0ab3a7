//! The convex programme of a time step. This room knows no scene: only matrices, rows and bounds.
//!
//! minimise ½ xᵀA x − bᵀx + Σ sᵢ²/(2cᵢ)   subject to   lᵢ ≤ gᵢ·x ≤ uᵢ (cᵢ = 0),   lᵢ − sᵢ ≤ gᵢ·x ≤ uᵢ + sᵢ (cᵢ > 0).
//!
//! The multipliers r are signed so that A x = b + Gᵀ r: rᵢ ≥ 0 at a lower bound, rᵢ ≤ 0 at an upper bound.

use nalgebra::{DMatrix, DVector};

/// What stays the same over all steps of a run.
#[derive(Debug, Clone)]
pub struct Problem {
    /// A, n × n, symmetric positive definite.
    pub a: DMatrix<f64>,
    /// G, m × n, one row per wall.
    pub g: DMatrix<f64>,
    /// Compliance cᵢ of each row, m entries: 0 for a rigid row; above 0 the row yields, r = −(g·x − u)/c beyond its bound.
    pub compliance: DVector<f64>,
}

/// What changes from step to step. Infinite bounds are rows without that side.
#[derive(Debug, Clone, Copy)]
pub struct Rhs<'a> {
    /// b, n entries.
    pub b: &'a [f64],
    /// l, m entries.
    pub lo: &'a [f64],
    /// u, m entries.
    pub hi: &'a [f64],
}

/// The minimiser and its multipliers.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// x, n entries.
    pub x: Vec<f64>,
    /// r, m entries, signed.
    pub multiplier: Vec<f64>,
}
