//! The convex quadratic programme (QP) of a time step. This room uses matrices, rows and bounds
//! only, no scene.
//!
//! minimise ½ xᵀA x − bᵀx + Σ sᵢ²/(2cᵢ) subject to lᵢ ≤ gᵢ·x ≤ uᵢ (cᵢ = 0), lᵢ − sᵢ ≤ gᵢ·x ≤ uᵢ +
//! sᵢ (cᵢ > 0).
//!
//! The multipliers r (forces or impulses on the rows) are signed so that A x = b + Gᵀ r: rᵢ ≥ 0 at
//! a lower bound, rᵢ ≤ 0 at an upper bound. A row is *in play* if it stands on one of its bounds;
//! the rows in play are the active set. Written on the rows alone, with y = G x + diag(c) r = G A⁻¹
//! b + W r and the Delassus operator W = G A⁻¹ Gᵀ + diag(c), rigid and elastic rows obey one law:
//!
//! lᵢ ≤ yᵢ ≤ uᵢ,   rᵢ ≥ 0 only where yᵢ = lᵢ,   rᵢ ≤ 0 only where yᵢ = uᵢ.
//!
//! | solver | what it does |
//! |---|---|
//! | [`Backend::Clamp`] | one unknown: exact, no iteration, some nanoseconds |
//! | [`Backend::Condensed`] | any number: block principal pivoting on W, warm-started from the last programme's active set; exact |
//! | [`Backend::Clarabel`] | any number: an interior-point method finds the active set, then its forces are solved for exactly |
//!
//! [`Backend::Auto`] takes the clamp for one unknown and the condensed solver for several: both are
//! exact, and where the free motion violates no bound they compute nothing else. Where rows are
//! linearly dependent, the multipliers are not unique, and those of least Σ Wᵢᵢ rᵢ² are returned.
//! If pivoting does not settle, it starts again from the active set that Clarabel finds; if it does
//! not settle from there either, a dual active-set method solves the programme. With more rows than
//! the motion has degrees of freedom, a dual active-set method that starts from the last
//! programme's rows is tried before Clarabel; with more than twice as many, after a single pass of
//! pivoting. Where A is a narrow band and so many rows are in play that a pass over W costs more
//! than one over the band, the unknowns of those rows are eliminated on the band instead.
//!
//! [`DiskSolver`] solves programmes with disks |P x − c| ≤ γ beside bounds, as round holes need.
//!
//! `coulomb.rs` solves the contacts of a step that rub, which is a complementarity problem and no
//! programme.
//!
//! [`clamp()`] solves the same scalar programme without matrices, for schemes that hold plain
//! floats.
//!
//! # Files
//!
//! The convex quadratic programme of a step; knows no scene: `solver.rs` solves one programme after
//! another by the choice of `backend.rs`, with `counters.rs` of what it did, or says why not
//! (`failure.rs`): `clamp.rs` (one unknown), `condensed.rs` (several, by the methods that follow),
//! `clarabel.rs` (the only file that names clarabel), `delassus.rs`, `pivoting.rs` with `block.rs`,
//! `envelope.rs` and `relations.rs` (several unknowns, by exchanging the active set, of which
//! `side.rs` is an entry and `cycle.rs` a repetition), `elimination.rs` (many rows in contact on a
//! narrow band), `redundant_rows.rs` (many more rows than degrees of freedom), `active_set.rs` (the
//! dual active-set method that `redundant_rows.rs` uses, and the last resort), `coulomb.rs`
//! (contacts with friction, which are no programme: `coulomb/unknowns.rs`, `lemke.rs` and
//! `dependent.rs`), `disks/`
//! (disks beside bounds: `disks/one.rs` in closed form, `disks/newton.rs` several, `disks/cones.rs`
//! by Clarabel), `sums.rs` (sums over slices).

use crate::linear::{Rows, Symmetric};

mod active_set;
mod backend;
mod block;
mod clamp;
mod clarabel;
mod condensed;
mod coulomb;
mod counters;
mod cycle;
mod delassus;
mod dependent;
mod disks;
mod elimination;
mod envelope;
mod failure;
mod lemke;
mod pivoting;
mod redundant_rows;
mod relations;
mod side;
mod solver;
mod sums;

pub use backend::Backend;
pub(crate) use clamp::is_one_place;
pub use clamp::{ScalarRow, clamp};
pub(crate) use coulomb::{Coulomb, CoulombContact};
pub use counters::SolverCounters;
pub(crate) use dependent::solve_dependent;
pub use disks::{DiskBound, DiskCounters, DiskProblem, DiskSolver};
pub use failure::Failure;
pub use solver::Solver;

/// What stays the same over all steps of a run.
#[derive(Debug, Clone)]
pub struct Problem {
    /// A, n × n, symmetric positive definite.
    pub a: Symmetric,
    /// G, m × n, one row per wall.
    pub g: Rows,
    /// Compliance cᵢ of each row, m entries: 0 for a rigid row; above 0 the row yields, r = −(g·x −
    /// u)/c beyond its bound.
    pub compliance: Vec<f64>,
}

/// What changes from step to step. An infinite bound means that the row has no bound on that side
/// in this step.
#[derive(Debug, Clone, Copy)]
pub struct Rhs<'a> {
    /// b, n entries, finite.
    pub b: &'a [f64],
    /// l, m entries, finite or −∞.
    pub lo: &'a [f64],
    /// u, m entries, finite or +∞.
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

/// How far a row's bounds may cross, relative to the lengths of the programme, and still count as
/// equal (dimensionless): walls at one place give bounds that differ by some ulps, 1e-16 each,
/// after a scheme has combined them with states.
const ROUNDING: f64 = 1e-12;

/// Rounding of bounds and free motion, relative to the lengths of the programme (dimensionless):
/// some ulps.
const NOISE: f64 = 16.0 * f64::EPSILON;

/// Rounding of the motion that the largest force causes, relative to it (dimensionless).
const ULPS: f64 = 4.0 * f64::EPSILON;

impl Problem {
    /// Checks that sizes agree and every entry is finite: n ≥ 1, A n × n, G m × n, compliance m
    /// entries, none negative.
    fn check(&self) -> Result<(), Failure> {
        let n = self.a.size();
        shape("unknowns", 1, n.min(1))?;
        shape("columns of G", n, self.g.columns())?;
        shape("compliances", self.g.count(), self.compliance.len())?;
        check_entries(&self.a, &self.g, &self.compliance)
    }
}

impl Rhs<'_> {
    /// Checks that sizes agree: n unknowns, m rows.
    #[inline]
    fn shape(&self, n: usize, m: usize) -> Result<(), Failure> {
        shape("entries of b", n, self.b.len())?;
        shape("lower bounds", m, self.lo.len())?;
        shape("upper bounds", m, self.hi.len())
    }

    /// Checks that l < +∞, u > −∞, and that no row's own bounds cross by more than rounding, for
    /// the rows `bounded`.
    fn check(&self, scale: f64, bounded: impl IntoIterator<Item = usize>) -> Result<(), Failure> {
        bounded.into_iter().try_for_each(|row| check_bounds(row, self.lo[row], self.hi[row], scale))
    }
}

/// The same for one row.
#[inline]
fn check_bounds(row: usize, lo: f64, hi: f64, scale: f64) -> Result<(), Failure> {
    if lo.is_nan() || lo == f64::INFINITY {
        return Err(Failure::NotFinite { what: "lower bound", index: row });
    }
    if hi.is_nan() || hi == f64::NEG_INFINITY {
        return Err(Failure::NotFinite { what: "upper bound", index: row });
    }
    if lo > hi && lo - hi > ROUNDING * scale.max(lo.abs()).max(hi.abs()) {
        return Err(Failure::Infeasible { row, against: row });
    }
    Ok(())
}

/// Checks that every entry of a programme is finite, and no compliance negative.
fn check_entries(a: &Symmetric, g: &Rows, compliance: &[f64]) -> Result<(), Failure> {
    if let Some((row, ..)) = a.not_finite() {
        return Err(Failure::NotFinite { what: "A, row", index: row });
    }
    let sound = |i: &usize| g.row(*i).iter().all(|entry| entry.1.is_finite());
    if let Some(row) = (0..g.count()).find(|i| !sound(i)) {
        return Err(Failure::NotFinite { what: "G, row", index: row });
    }
    finite("compliance", compliance, |v| v.is_finite() && v >= 0.0)
}

fn shape(what: &'static str, expected: usize, found: usize) -> Result<(), Failure> {
    if expected == found { Ok(()) } else { Err(Failure::Shape { what, expected, found }) }
}

#[inline]
fn finite(what: &'static str, values: &[f64], sound: impl Fn(f64) -> bool) -> Result<(), Failure> {
    // Without branches, so that the usual case, all sound, checks several values at once.
    if values.iter().fold(true, |all, &v| all & sound(v)) {
        return Ok(());
    }
    match values.iter().position(|&v| !sound(v)) {
        Some(index) => Err(Failure::NotFinite { what, index }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
