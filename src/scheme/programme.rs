//! The quadratic programme of a step in one unknown x, which every scheme on a grid states in the same form:
//!
//! minimise ½ a x² − b x over lᵢ ≤ x ≤ uᵢ, elastic rows yielding with a compliance.

use super::grid::{Counters, Scalar};
use crate::error::{Error, Result};
use crate::linear::{Rows, Symmetric};
use crate::qp::{self, Backend, Failure, Rhs, ScalarRow};

/// The programme with its rows, one per wall, and the solver that answers it.
#[derive(Debug)]
pub(super) struct Programme {
    a: f64,
    /// One row per wall; the kernel writes the bounds of the walls in play and frees the others.
    pub rows: Vec<ScalarRow>,
    /// Multiplier of each row, signed: ≥ 0 at a lower bound.
    pub multiplier: Vec<f64>,
    solver: Option<Box<Interior>>,
    solves: u64,
}

/// The same programme for Clarabel.
#[derive(Debug)]
struct Interior {
    solver: qp::Solver,
    lo: Vec<f64>,
    hi: Vec<f64>,
}

/// A row that binds nothing.
pub(super) const FREE: ScalarRow = ScalarRow { lo: f64::NEG_INFINITY, hi: f64::INFINITY, compliance: 0.0 };

impl Programme {
    /// A programme with curvature `a`, a typical length `scale` of its unknown, and the walls' `compliances` (0: rigid).
    pub fn new(a: f64, scale: f64, compliances: &[f64], backend: Backend) -> Result<Self> {
        let solver = match backend {
            Backend::Auto | Backend::Clamp => None,
            Backend::Condensed | Backend::Clarabel => {
                let m = compliances.len();
                let problem = qp::Problem {
                    a: Symmetric::diagonal(&[a]),
                    g: Rows::new(1, (0..m).map(|_| [(0, 1.0)].as_slice())),
                    compliance: compliances.to_vec(),
                };
                let solver = qp::Solver::new(problem, backend, scale).map_err(|f| failure(&f, 0.0, 0))?;
                Some(Box::new(Interior { solver, lo: vec![0.0; m], hi: vec![0.0; m] }))
            }
        };
        let rows = compliances.iter().map(|&compliance| ScalarRow { compliance, ..FREE }).collect();
        Ok(Self { a, rows, multiplier: vec![0.0; compliances.len()], solver, solves: 0 })
    }

    /// The unconstrained minimiser.
    #[inline]
    pub fn free(&self, b: f64) -> f64 {
        b / self.a
    }

    /// True if `x` is inside every row.
    #[inline]
    pub fn admits(&self, x: f64) -> bool {
        self.rows.iter().all(|row| x >= row.lo && x <= row.hi)
    }

    /// The minimiser over the rows; multipliers are left in `multiplier`.
    #[inline(never)]
    pub fn solve(&mut self, b: f64, time: f64, step: u64) -> Result<f64> {
        self.solves += 1;
        match &mut self.solver {
            None => qp::clamp(self.a, b, &self.rows, &mut self.multiplier).map_err(|f| failure(&f, time, step)),
            Some(interior) => {
                for ((lo, hi), row) in interior.lo.iter_mut().zip(&mut interior.hi).zip(&self.rows) {
                    (*lo, *hi) = (row.lo, row.hi);
                }
                let rhs = Rhs { b: &[b], lo: &interior.lo, hi: &interior.hi };
                let solution = interior.solver.solve(&rhs).map_err(|f| failure(&f, time, step))?;
                self.multiplier.copy_from_slice(&solution.multiplier);
                Ok(solution.x.first().copied().unwrap_or(f64::NAN))
            }
        }
    }

    pub fn count(&self, counters: &mut Counters) {
        counters.qp_solves = self.solves;
        if let Some(interior) = &self.solver {
            let inner = interior.solver.counters();
            counters.interior_point_iterations = inner.iterations;
            counters.pivots = inner.pivots;
        }
    }
}

fn failure(failure: &Failure, time: f64, step: u64) -> Error {
    Error::Qp { time, step, wall: None, reason: failure.to_string() }
}

/// The elastic row of a wall: its pressure as a function of the unknown, r = −stiffness · x − offset, holds beyond the
/// bound −offset/stiffness. `None` for a rigid wall.
pub(super) fn elastic_row(upper: bool, stiffness: f64, offset: f64) -> ScalarRow {
    let bound = -offset / stiffness;
    let compliance = 1.0 / stiffness;
    if upper { ScalarRow { hi: bound, compliance, ..FREE } } else { ScalarRow { lo: bound, compliance, ..FREE } }
}

/// Compliance of each wall's row, given the row stiffness a scheme sees behind an elastic wall (k_a, c_a).
pub(super) fn compliances(scalar: &Scalar, stiffness: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let law = |wall: &super::stop::Stop| match wall.law {
        crate::scene::WallLaw::Elastic { stiffness: k, damping: c } => 1.0 / stiffness(k, c),
        _ => 0.0,
    };
    scalar.walls.iter().map(law).collect()
}
