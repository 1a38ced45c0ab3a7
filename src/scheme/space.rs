//! What the schemes on a grid compute with: numbers for one degree of freedom, vectors and matrices
//! for several. Each scheme is written once, over either.

use crate::error::{Error, Result};
use crate::linear::Symmetric;
use crate::qp::{self, Backend, Failure, Problem};
use crate::scene::{Load, Row, SharedStructure};
use std::fmt::Debug;
use std::ops::IndexMut;

/// Vectors over degrees of freedom, and what acts on them: [`Line`](super::line::Line) and
/// [`Matrices`](super::matrices::Matrices).
pub(super) trait Space: Debug + Sized + 'static {
    /// n numbers.
    type Vector: Debug + Clone + Send + AsRef<[f64]> + AsMut<[f64]> + IndexMut<usize, Output = f64>;
    /// A symmetric matrix made ready for products.
    type Operator: Debug + Send;
    /// A positive definite matrix made ready for division.
    type Factor: Debug + Send;
    /// The rows behind which walls stand.
    type Rows: Debug + Send;
    /// The loads but for their blows.
    type Forces: Debug + Send;
    /// Who minimises ½ xᵀA x − bᵀx over rows.
    type Solver: Solve<Self::Vector>;

    fn vector(values: &[f64]) -> Self::Vector;
    fn operator(a: &Symmetric) -> Self::Operator;
    /// # Errors
    /// [`Error::Invalid`] unless `a` is positive definite.
    fn factor(a: &Symmetric) -> Result<Self::Factor>;
    /// M, ready for division.
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
    /// Writes the loads at `time` (s) to `out`, N, which has held nothing else since it was 0.
    fn force(forces: &mut Self::Forces, time: f64, out: &mut Self::Vector);
}

/// Who minimises ½ xᵀA x − bᵀx over lᵢ ≤ gᵢ·x ≤ uᵢ, elastic rows yielding with a compliance.
pub(super) trait Solve<Vector>: Debug + Sized + Send {
    /// As [`qp::Solver::new`].
    fn new(problem: Problem, backend: Backend, scale: f64) -> std::result::Result<Self, Failure>;
    /// As [`qp::Solver::solve`]. Only the rows `bounded`, increasing, have a bound.
    fn solve(&mut self, b: &Vector, bounds: (&[f64], &[f64]), bounded: &[usize]) -> std::result::Result<(), Failure>;
    /// The same where no row has a bound.
    fn release(&mut self, b: &Vector, bounds: (&[f64], &[f64])) -> std::result::Result<(), Failure>;
    /// The minimiser last found.
    fn x(&self) -> &Vector;
    /// Its multipliers; none where every row keeps its bounds by itself.
    fn multiplier(&self) -> Option<&[f64]>;
    /// The solver in force.
    fn backend(&self) -> Backend;
    fn counters(&self) -> qp::SolverCounters;
}

/// A vector of n zeros.
pub(super) fn zero<S: Space>(n: usize) -> S::Vector {
    S::vector(&vec![0.0; n])
}

/// The refusal of a matrix of a step that is not positive definite.
pub(super) fn indefinite(fault: impl std::fmt::Display) -> Error {
    Error::invalid(("system", "matrices"), fault, "a positive definite mass")
}
