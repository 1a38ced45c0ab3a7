//! One part of a step: the θ-rule over a length of its own.

use super::super::Counters;
use super::super::body::Body;
use super::super::space::{Solve, Space, zero};
use crate::error::Result;
use crate::linear::Rows;
use crate::qp::{Backend, Failure, Problem, SolverCounters};
use crate::scene::{Row, Scene};

/// θ of the rule.
pub(super) const THETA: f64 = 0.5;

/// A bound on the velocity of a wall's row in a part: g·δ ≤ `bound` at an upper wall, ≥ at a lower
/// one, exceeded by compliance times impulse.
#[derive(Debug, Clone, Copy)]
pub(super) struct VelocityBound {
    pub wall: usize,
    pub upper: bool,
    pub bound: f64,
    pub compliance: f64,
}

/// What a wall does over a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Push {
    pub wall: usize,
    /// Impulse, signed as the wall's force, and that of friction along t, N s.
    pub impulse: f64,
    pub friction: f64,
    /// Outward normal of a round wall; zero for a flat one.
    pub normal: [f64; 2],
}

/// Whether δ and the impulses were found.
type Solution = std::result::Result<(), Failure>;

/// The part of a step that is being computed, from the state at its start.
#[derive(Debug)]
pub(super) struct Part<S: Space> {
    backend: Backend,
    /// A typical change of a velocity, m/s.
    scale: f64,
    /// The row of each wall.
    rows: Vec<Row>,
    /// The loads at its start and its end, N.
    pub load_start: S::Vector,
    pub load_end: S::Vector,
    mean: S::Vector,
    /// The momentum that all but the walls give, N s.
    pub b: S::Vector,
    /// A for parts of any length, and that of the current part, factored.
    pub polynomial: S::Polynomial,
    factor: S::Factor,
    /// A⁻¹gᵀ of the wall that holds.
    column: S::Vector,
    /// The change of the velocity, m/s.
    pub delta: S::Vector,
    pub pushes: Vec<Push>,
    /// Programmes solved, of one bound by hand and of several by solvers, and the work of these.
    solves: u64,
    work: SolverCounters,
}

impl<S: Space> Part<S> {
    pub fn new(scene: &Scene, body: &Body<S>, backend: Backend) -> Result<Self> {
        let vector = || zero::<S>(body.n);
        Ok(Self {
            backend,
            polynomial: S::polynomial(&body.matrices),
            factor: S::factor(&body.theta_matrix(THETA))?,
            scale: scene.gap_scale() / body.h,
            rows: scene.walls.iter().map(|wall| wall.row().clone()).collect(),
            load_start: vector(),
            load_end: vector(),
            mean: vector(),
            b: vector(),
            column: vector(),
            delta: vector(),
            pushes: Vec::with_capacity(scene.walls.len()),
            solves: 0,
            work: SolverCounters::default(),
        })
    }

    /// Adds what the parts have cost.
    pub fn count(&self, counters: &mut Counters) {
        counters.qp_solves += self.solves;
        counters.add_work(&self.work);
    }

    /// Rounding error of the velocity of a wall's row, m/s.
    pub fn rounding(&self, wall: usize, v: &S::Vector) -> f64 {
        ROUNDING * size_of(&self.rows[wall], v.as_ref())
    }

    /// Computes the momentum b that all but the walls give in a part of `length` seconds, with the
    /// loads at its ends known, from the displacement `q` and the velocity `v` under the extra
    /// force `extra`:
    ///
    /// [M + sθC + s²θ²K] δ = b + Gᵀ p,   b = s[f_θ + f_x − C v − K(q + sθ v)].
    pub fn set_momentum(
        &mut self,
        body: &Body<S>,
        (q, v, extra): (&S::Vector, &S::Vector, &S::Vector),
        (length, theta): (f64, f64),
    ) {
        self.pushes.clear();
        let loads = self.load_start.as_ref().iter().zip(self.load_end.as_ref()).zip(extra.as_ref());
        for (b, ((start, end), extra)) in self.b.as_mut().iter_mut().zip(loads) {
            *b = (1.0 - theta) * start + theta * end + extra;
        }
        for ((mean, q), v) in self.mean.as_mut().iter_mut().zip(q.as_ref()).zip(v.as_ref()) {
            *mean = q + length * theta * v;
        }
        S::add_product(&body.damping, -1.0, v, &mut self.b);
        S::add_product(&body.stiffness, -1.0, &self.mean, &mut self.b);
        self.b.as_mut().iter_mut().for_each(|b| *b *= length);
    }

    /// Computes δ and the impulses of the walls of `holds`, with `st` = sθ (s).
    pub fn solve_bounded(&mut self, body: &Body<S>, st: f64, holds: &[VelocityBound]) -> Solution {
        let asked = matches!(self.backend, Backend::Condensed | Backend::Clarabel);
        if holds.len() > 1 || asked && !holds.is_empty() {
            return self.solve(body, st, holds);
        }
        S::factor_at(&mut self.polynomial, st, &mut self.factor).map_err(indefinite)?;
        self.delta.clone_from(&self.b);
        S::solve(&mut self.factor, &mut self.delta);
        if let [hold] = holds {
            self.clamp(body, hold);
        }
        Ok(())
    }

    /// Adds the impulse of the only wall of a part to δ, where δ without it exceeds its bound.
    fn clamp(&mut self, body: &Body<S>, hold: &VelocityBound) {
        let beyond = body.seen(hold.wall, &self.delta) - hold.bound;
        if if hold.upper { beyond <= 0.0 } else { beyond >= 0.0 } {
            return;
        }
        self.solves += 1;
        self.column.as_mut().fill(0.0);
        S::add_transposed(&body.rows, hold.wall, 1.0, &mut self.column);
        S::solve(&mut self.factor, &mut self.column);
        let impulse = -beyond / (body.seen(hold.wall, &self.column) + hold.compliance);
        // Solved again rather than added, so that the balance keeps its rounding where both cancel.
        S::add_transposed(&body.rows, hold.wall, impulse, &mut self.b);
        self.delta.clone_from(&self.b);
        S::solve(&mut self.factor, &mut self.delta);
        self.pushes.push(Push { wall: hold.wall, impulse, friction: 0.0, normal: [0.0; 2] });
    }

    /// Computes δ and the impulses from b as a programme.
    fn solve(&mut self, body: &Body<S>, st: f64, holds: &[VelocityBound]) -> Solution {
        self.solves += 1;
        let rows = holds.iter().filter_map(|hold| self.rows.get(hold.wall)).map(Row::entries);
        let compliance = holds.iter().map(|hold| hold.compliance).collect();
        let problem = Problem { a: body.theta_matrix_over(st), g: Rows::new(body.n, rows), compliance };
        let mut solver = S::Solver::new(problem, self.backend, self.scale)?;
        let bound = |upper: bool, open: f64| -> Vec<f64> {
            holds.iter().map(|hold| if hold.upper == upper { hold.bound } else { open }).collect()
        };
        let (lo, hi) = (bound(false, f64::NEG_INFINITY), bound(true, f64::INFINITY));
        let all: Vec<usize> = (0..holds.len()).collect();
        let solved = solver.solve(&self.b, (&lo, &hi), &all);
        self.work.add(solver.counters());
        solved?;
        self.delta.clone_from(solver.x());
        let impulses = holds.iter().zip(solver.multiplier().unwrap_or_default());
        let push = |(hold, &impulse): (&VelocityBound, &f64)| Push {
            wall: hold.wall,
            impulse,
            friction: 0.0,
            normal: [0.0; 2],
        };
        self.pushes.extend(impulses.filter(|(_, p)| **p != 0.0).map(push));
        Ok(())
    }
}

/// The fault of a part whose matrix has no factor.
pub(super) fn indefinite<T>(_: T) -> Failure {
    Failure::NotFinite { what: "step matrix", index: 0 }
}

/// Rounding error of the velocity of a row, relative to the sum of its terms.
pub(super) const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The sum of the magnitudes of the terms of a row.
pub(super) fn size_of(row: &Row, x: &[f64]) -> f64 {
    row.entries().iter().filter_map(|&(i, g)| x.get(i).map(|x| (g * x).abs())).sum()
}
