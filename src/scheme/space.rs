//! The arithmetic of the schemes on a grid: numbers for one degree of freedom, vectors and matrices
//! for several. Each scheme is written once, for both.

use crate::error::{Error, Result};
use crate::linear::Symmetric;
use crate::qp::{self, Backend, Failure, Problem};
use crate::scene::{Load, Row, SharedStructure};
use std::fmt::Debug;
use std::ops::IndexMut;

/// Vectors over the degrees of freedom, and the operations on them: [`Line`](super::line::Line) and
/// [`Matrices`](super::matrices::Matrices).
pub(super) trait Space: Debug + Sized + 'static {
    /// n numbers.
    type Vector: Debug + Clone + Default + Send + AsRef<[f64]> + AsMut<[f64]> + IndexMut<usize, Output = f64>;
    /// A symmetric matrix, stored for products with vectors.
    type Operator: Debug + Send;
    /// A positive definite matrix, factored.
    type Factor: Debug + Send;
    /// M + sC + s²K for many s.
    type Polynomial: Debug + Send;
    /// The rows of the walls.
    type Rows: Debug + Send;
    /// The loads without their impulses.
    type Forces: Debug + Send;
    /// The solver of the quadratic programme ½ xᵀA x − bᵀx under bounds on rows.
    type Solver: Solve<Self::Vector>;

    fn vector(values: &[f64]) -> Self::Vector;
    fn operator(a: &Symmetric) -> Self::Operator;
    /// # Errors
    /// [`Error::Invalid`] unless `a` is positive definite.
    fn factor(a: &Symmetric) -> Result<Self::Factor>;
    fn polynomial(structure: &SharedStructure) -> Self::Polynomial;
    /// M + sC + s²K, factored into `factor`.
    ///
    /// # Errors
    /// As [`Space::factor`].
    fn factor_at(polynomial: &mut Self::Polynomial, s: f64, factor: &mut Self::Factor) -> Result<()>;
    /// M, factored.
    ///
    /// # Errors
    /// As [`Space::factor`].
    fn mass(structure: &SharedStructure) -> Result<Self::Factor>;
    fn rows<'a>(n: usize, rows: impl Iterator<Item = &'a Row>) -> Self::Rows;
    fn forces(loads: &[Load], h: f64) -> Self::Forces;

    /// Adds `scale` · A x to `out`.
    fn add_product(a: &Self::Operator, scale: f64, x: &Self::Vector, out: &mut Self::Vector);
    /// Solves A x = b in place.
    fn solve(a: &mut Self::Factor, x: &mut Self::Vector);
    /// gᵢ · x.
    fn dot(rows: &Self::Rows, i: usize, x: &Self::Vector) -> f64;
    /// Adds `force` · gᵢᵀ to `out`.
    fn add_transposed(rows: &Self::Rows, i: usize, force: f64, out: &mut Self::Vector);
    /// Writes the loads at `time` (s) to `out`, N. `out` must be all zero at first, and must have
    /// been written by nothing but this function since.
    fn force(forces: &mut Self::Forces, time: f64, out: &mut Self::Vector);
    /// Does `work`, of several degrees of freedom with the widest vector instructions of the
    /// machine, in which each number is computed as without them. They reach what is inlined.
    fn vectorised<R>(arch: pulp::Arch, work: impl FnOnce() -> R) -> R;
}

/// Minimises ½ xᵀA x − bᵀx under lᵢ ≤ gᵢ·x ≤ uᵢ, where elastic rows exceed their bounds by their
/// compliance times their force.
pub(super) trait Solve<Vector>: Debug + Sized + Send {
    /// As [`qp::Solver::new`].
    fn new(problem: Problem, backend: Backend, scale: f64) -> std::result::Result<Self, Failure>;
    /// As [`qp::Solver::solve`]. Only the rows in `bounded`, in increasing order, have a bound.
    fn solve(&mut self, b: &Vector, bounds: (&[f64], &[f64]), bounded: &[usize]) -> std::result::Result<(), Failure>;
    /// The same where no row has a bound.
    fn release(&mut self, b: &Vector, bounds: (&[f64], &[f64])) -> std::result::Result<(), Failure>;
    /// The minimiser of the last programme.
    fn x(&self) -> &Vector;
    /// Its multipliers; `None` if the minimiser without bounds satisfies all of them.
    fn multiplier(&self) -> Option<&[f64]>;
    /// The solver that is used.
    fn backend(&self) -> Backend;
    fn counters(&self) -> qp::SolverCounters;
}

/// A vector of n zeros.
pub(super) fn zero<S: Space>(n: usize) -> S::Vector {
    S::vector(&vec![0.0; n])
}

/// Adds the change `delta` of the velocity in `h` seconds, and the displacement that follows from
/// it by the θ-rule, to the state.
#[inline(always)]
pub(super) fn add_change<S: Space>((h, theta): (f64, f64), delta: &S::Vector, q: &mut S::Vector, v: &mut S::Vector) {
    for ((q, v), d) in q.as_mut().iter_mut().zip(v.as_mut()).zip(delta.as_ref()) {
        *q += h * (*v + theta * d);
        *v += d;
    }
}

/// The error for a step whose matrix is not positive definite.
pub(super) fn indefinite(fault: impl std::fmt::Display) -> Error {
    Error::invalid(("system", "matrices"), fault, "a positive definite mass")
}
