//! The programme of a step with round holes: disks beside intervals.
//!
//! minimise ½ xᵀA x − bᵀx + Σ |sᵢ|²/(2κᵢ)   subject to   |Pᵢ x − cᵢ| ≤ γᵢ + |sᵢ|   (a disk),
//! lᵢ − |sᵢ| ≤ nᵢ·Pᵢ x ≤ uᵢ + |sᵢ|   (a strip),
//!
//! over blocks i of one or two rows Pᵢ of G; κᵢ ≥ 0 is the compliance of a block, and without it
//! (κᵢ = 0) there is no yield sᵢ. The multipliers r, one per row, are signed so that A x = b + Gᵀr.
//! Written on the rows, with y = G A⁻¹b + W r and W = G A⁻¹Gᵀ + diag(κ), rigid and elastic blocks
//! obey one law. With z = y − c a disk has
//!
//! |z| ≤ γ,   r = −μ z,   0 ≤ μ ⟂ γ − |z| ≥ 0,
//!
//! so that the yielding disk pushes with (|Px − c| − γ)/κ towards its centre; and a strip has l ≤
//! n·y ≤ u, r = ρn with ρ ≥ 0 only at l and ρ ≤ 0 only at u.
//!
//! - One block alone is answered in closed form (`one.rs`).
//! - Several are answered in turn, in two sweeps; then Newton's method on the μ of the disks in
//!   play, with the strips in play as equations, settles them to rounding (`newton.rs`). A disk
//!   whose μ falls below 0 leaves, one that is passed enters. If that does not settle, more sweeps
//!   come before the next attempt.
//! - What then is not settled is left to Clarabel (`cones.rs`), from whose answer Newton's method
//!   starts again: an interior-point method alone leaves forces off by per cents where a disk is
//!   passed by a small share of its radius, since the radius sets its scale.
//! - Where Newton's method does not settle from there either, the strips are answered without the
//!   disks, by pivoting (`strips.rs`); that is the solution if it passes no disk.

mod cones;
mod newton;
mod one;
mod semidefinite;
mod solver;
mod strips;
mod system;

pub use solver::{DiskCounters, DiskSolver};

use super::{Failure, check_bounds, check_entries, finite, shape};
use crate::linear::{Rows, Symmetric};

/// What stays the same over all programmes with disks.
#[derive(Debug, Clone)]
pub struct DiskProblem {
    /// A, n × n, symmetric positive definite.
    pub a: Symmetric,
    /// G, m × n: the rows of all blocks, block after block.
    pub g: Rows,
    /// The number of rows of each block: 1 or 2.
    pub blocks: Vec<usize>,
    /// Compliance κ of each block; 0 for a rigid one.
    pub compliance: Vec<f64>,
}

/// What bounds a block in one programme, in the unit of G x.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum DiskBound {
    /// |P x − c| ≤ γ; of a block of one row the second entry of the centre is 0.
    Disk {
        /// The centre c.
        centre: [f64; 2],
        /// The radius γ, above 0.
        radius: f64,
    },
    /// l ≤ n·P x ≤ u.
    Strip {
        /// The unit vector n; of a block of one row (1, 0).
        normal: [f64; 2],
        /// l, finite or −∞.
        lo: f64,
        /// u, finite or +∞.
        hi: f64,
    },
}

impl DiskBound {
    /// No bound.
    pub const OPEN: Self = Self::Strip { normal: [1.0, 0.0], lo: f64::NEG_INFINITY, hi: f64::INFINITY };
}

impl DiskProblem {
    /// Checks that sizes agree and every entry is finite.
    fn check(&self) -> Result<(), Failure> {
        let n = self.a.size();
        shape("unknowns", 1, n.min(1))?;
        shape("columns of G", n, self.g.columns())?;
        shape("rows of blocks", self.g.count(), self.blocks.iter().sum())?;
        shape("compliances", self.blocks.len(), self.compliance.len())?;
        if let Some(&rows) = self.blocks.iter().find(|rows| !(1..=2).contains(*rows)) {
            return Err(Failure::Shape { what: "rows of a block", expected: 2, found: rows });
        }
        check_entries(&self.a, &self.g, &self.compliance)
    }
}

impl DiskBound {
    /// Checks the bound of block `index`.
    fn check(&self, index: usize, scale: f64) -> Result<(), Failure> {
        match *self {
            Self::Disk { centre, radius } => {
                finite("centre", &centre, f64::is_finite)?;
                let sound = radius.is_finite() && radius > 0.0;
                if sound { Ok(()) } else { Err(Failure::NotFinite { what: "radius", index }) }
            }
            Self::Strip { normal, lo, hi } => {
                finite("normal", &normal, f64::is_finite)?;
                check_bounds(index, lo, hi, scale)
            }
        }
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn norm(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}

#[cfg(test)]
mod tests;
