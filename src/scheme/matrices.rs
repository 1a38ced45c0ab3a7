//! Several degrees of freedom: vectors, matrices and their factors, and programmes condensed onto
//! the walls.

use super::space::{Solve, Space, indefinite};
use crate::error::Result;
use crate::linear::{Factor, MatrixPolynomial, Operator, Rows, Symmetric};
use crate::qp::{self, Backend, Failure, Problem, Rhs};
use crate::scene::{LastPieces, Load, Loads, Row, SharedStructure};

/// Vectors of n numbers.
#[derive(Debug, Clone)]
pub(super) struct Matrices;

impl Space for Matrices {
    type Vector = Vec<f64>;
    type Operator = Operator;
    type Factor = Factor;
    type Polynomial = MatrixPolynomial;
    type Rows = Rows;
    type Forces = (Loads, LastPieces);
    type Solver = qp::Solver;

    fn vector(values: &[f64]) -> Vec<f64> {
        values.to_vec()
    }

    fn operator(a: &Symmetric) -> Operator {
        Operator::new(a)
    }

    fn factor(a: &Symmetric) -> Result<Factor> {
        Factor::new(a).map_err(indefinite)
    }

    fn polynomial(structure: &SharedStructure) -> MatrixPolynomial {
        MatrixPolynomial::new([&structure.mass, &structure.damping, &structure.stiffness])
    }

    fn factor_at(polynomial: &mut MatrixPolynomial, s: f64, factor: &mut Factor) -> Result<()> {
        factor.renew(polynomial.at(s)).map_err(indefinite)
    }

    fn mass(structure: &SharedStructure) -> Result<Factor> {
        structure.mass_factor().map_err(indefinite)
    }

    fn rows<'a>(n: usize, rows: impl Iterator<Item = &'a Row>) -> Rows {
        Rows::new(n, rows.map(Row::entries))
    }

    fn forces(loads: &[Load], _: f64) -> Self::Forces {
        let loads = Loads::new(loads);
        let last = LastPieces::new(&loads);
        (loads, last)
    }

    #[inline(always)]
    fn add_product(a: &Operator, scale: f64, x: &Vec<f64>, out: &mut Vec<f64>) {
        a.add_product(scale, x, out);
    }

    #[inline]
    fn solve(a: &mut Factor, x: &mut Vec<f64>) {
        a.solve(x);
    }

    #[inline]
    fn dot(rows: &Rows, i: usize, x: &Vec<f64>) -> f64 {
        rows.dot(i, x)
    }

    #[inline]
    fn add_transposed(rows: &Rows, i: usize, force: f64, out: &mut Vec<f64>) {
        rows.add_transposed(i, force, out);
    }

    #[inline(always)]
    fn force((loads, last): &mut Self::Forces, time: f64, out: &mut Vec<f64>) {
        // All other entries have been 0 from the beginning.
        loads.clear(out);
        loads.add_force_near(time, 1.0, out, last);
    }

    #[inline(always)]
    fn vectorised<R>(arch: pulp::Arch, work: impl FnOnce() -> R) -> R {
        arch.dispatch(work)
    }
}

impl Solve<Vec<f64>> for qp::Solver {
    fn new(problem: Problem, backend: Backend, scale: f64) -> std::result::Result<Self, Failure> {
        Self::new(problem, backend, scale)
    }

    #[inline]
    fn solve(
        &mut self,
        b: &Vec<f64>,
        (lo, hi): (&[f64], &[f64]),
        bounded: &[usize],
    ) -> std::result::Result<(), Failure> {
        self.solve_bounded(&Rhs { b, lo, hi }, bounded)
    }

    #[inline]
    fn release(&mut self, b: &Vec<f64>, (lo, hi): (&[f64], &[f64])) -> std::result::Result<(), Failure> {
        self.solve_bounded(&Rhs { b, lo, hi }, &[])
    }

    #[inline]
    fn x(&self) -> &Vec<f64> {
        &self.solution().x
    }

    #[inline]
    fn multiplier(&self) -> Option<&[f64]> {
        Some(&self.solution().multiplier)
    }

    fn backend(&self) -> Backend {
        self.backend()
    }

    fn counters(&self) -> qp::SolverCounters {
        self.counters()
    }
}
