//! One degree of freedom: vectors and matrices are numbers, and every programme is solved by a
//! clamp.
//!
//! Walls stand on the degree of freedom itself. An oscillator with a wall behind a lever is
//! computed by [`Matrices`](super::matrices::Matrices) of size 1.

use super::space::{Solve, Space, indefinite};
use crate::error::Result;
use crate::linear::Symmetric;
use crate::qp::{self, Backend, Failure, Problem, Rhs, ScalarRow};
use crate::scene::{Forcing, GridForcing, Load, Row, SharedStructure};

/// Vectors of one number.
#[derive(Debug, Clone)]
pub(super) struct Line;

impl Space for Line {
    type Vector = [f64; 1];
    type Operator = f64;
    type Factor = f64;
    type Polynomial = [f64; 3];
    type Rows = ();
    type Forces = GridForcing;
    type Solver = Clamp;

    fn vector(values: &[f64]) -> [f64; 1] {
        [values.first().copied().unwrap_or(0.0)]
    }

    fn operator(a: &Symmetric) -> f64 {
        a.get(0, 0)
    }

    fn factor(a: &Symmetric) -> Result<f64> {
        let a = a.get(0, 0);
        if a > 0.0 { Ok(a) } else { Err(indefinite(a)) }
    }

    fn polynomial(structure: &SharedStructure) -> [f64; 3] {
        [&structure.mass, &structure.damping, &structure.stiffness].map(|matrix| matrix.get(0, 0))
    }

    fn factor_at([mass, damping, stiffness]: &mut [f64; 3], s: f64, factor: &mut f64) -> Result<()> {
        *factor = *mass + s * *damping + s * s * *stiffness;
        if *factor > 0.0 { Ok(()) } else { Err(indefinite(*factor)) }
    }

    fn mass(structure: &SharedStructure) -> Result<f64> {
        Self::factor(&structure.mass)
    }

    fn rows<'a>(_: usize, _: impl Iterator<Item = &'a Row>) {}

    fn forces(loads: &[Load], h: f64) -> GridForcing {
        GridForcing::new(Forcing::on(0, loads), h)
    }

    #[inline]
    fn add_product(a: &f64, scale: f64, x: &[f64; 1], out: &mut [f64; 1]) {
        out[0] += scale * a * x[0];
    }

    #[inline]
    fn solve(a: &mut f64, x: &mut [f64; 1]) {
        x[0] /= *a;
    }

    #[inline]
    fn dot((): &(), _: usize, x: &[f64; 1]) -> f64 {
        x[0]
    }

    #[inline]
    fn add_transposed((): &(), _: usize, force: f64, out: &mut [f64; 1]) {
        out[0] += force;
    }

    #[inline]
    fn force(forces: &mut GridForcing, time: f64, out: &mut [f64; 1]) {
        out[0] = forces.at(time);
    }

    #[inline(always)]
    fn vectorised<R>(_: pulp::Arch, work: impl FnOnce() -> R) -> R {
        work()
    }
}

/// The programme in one unknown: solved by the clamp, or by another solver if one was asked for.
#[derive(Debug)]
pub(super) struct Clamp {
    a: f64,
    /// 1/a.
    inverse: f64,
    x: [f64; 1],
    rows: Vec<ScalarRow>,
    multiplier: Vec<f64>,
    /// True if a bound is active, so that the minimiser is not that without bounds.
    met: bool,
    other: Option<Box<qp::Solver>>,
    solves: u64,
}

impl Solve<[f64; 1]> for Clamp {
    fn new(problem: Problem, backend: Backend, scale: f64) -> std::result::Result<Self, Failure> {
        let row = |&compliance: &f64| ScalarRow { lo: f64::NEG_INFINITY, hi: f64::INFINITY, compliance };
        let rows: Vec<_> = problem.compliance.iter().map(row).collect();
        let (a, multiplier) = (problem.a.get(0, 0), vec![0.0; rows.len()]);
        let other = match backend {
            Backend::Auto | Backend::Clamp => None,
            Backend::Condensed | Backend::Clarabel => Some(Box::new(qp::Solver::new(problem, backend, scale)?)),
        };
        Ok(Self { a, inverse: 1.0 / a, x: [0.0], rows, multiplier, met: false, other, solves: 0 })
    }

    #[inline]
    fn solve(&mut self, b: &[f64; 1], (lo, hi): (&[f64], &[f64]), _: &[usize]) -> std::result::Result<(), Failure> {
        let free = b[0] * self.inverse;
        self.x[0] = free;
        // If the free motion is NaN, no bound is active, and the check of the state reports it.
        self.met = lo.iter().zip(hi).any(|(&lo, &hi)| free < lo || free > hi);
        if self.met { self.solve_bounded(b[0], lo, hi) } else { Ok(()) }
    }

    #[inline]
    fn release(&mut self, b: &[f64; 1], _: (&[f64], &[f64])) -> std::result::Result<(), Failure> {
        self.x[0] = b[0] * self.inverse;
        self.met = false;
        Ok(())
    }

    #[inline]
    fn x(&self) -> &[f64; 1] {
        &self.x
    }

    #[inline]
    fn multiplier(&self) -> Option<&[f64]> {
        self.met.then_some(&self.multiplier)
    }

    fn backend(&self) -> Backend {
        self.other.as_ref().map_or(Backend::Clamp, |other| other.backend())
    }

    fn counters(&self) -> qp::SolverCounters {
        let inner = self.other.as_ref().map(|other| other.counters()).unwrap_or_default();
        qp::SolverCounters { solves: self.solves, free: 0, ..inner }
    }
}

impl Clamp {
    /// Solves a programme whose free motion violates a bound. Not inlined: most do not.
    #[inline(never)]
    fn solve_bounded(&mut self, b: f64, lo: &[f64], hi: &[f64]) -> std::result::Result<(), Failure> {
        self.solves += 1;
        if let Some(other) = &mut self.other {
            let solution = other.solve(&Rhs { b: &[b], lo, hi })?;
            self.x.copy_from_slice(&solution.x);
            self.multiplier.copy_from_slice(&solution.multiplier);
            return Ok(());
        }
        for ((row, &lo), &hi) in self.rows.iter_mut().zip(lo).zip(hi) {
            (row.lo, row.hi) = (lo, hi);
        }
        self.x[0] = qp::clamp(self.a, b, &self.rows, &mut self.multiplier)?;
        Ok(())
    }
}
