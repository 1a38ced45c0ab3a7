//! The penalty in scenes with round holes: every wall and every hole is a spring.
//!
//! The step is that of [`super::super::penalty`] with θ = ½: v_θ = (v + v⁺)/2, q⁺ = q + h v_θ. A
//! hole of the energy U(s), s = |w| − γ, gives the force
//!
//! F = −P̄ (w + w⁺)/(|w| + |w⁺|),    P̄ = ΔU/Δs + c_a(s⁺₊ − s₊)/h, at least 0,
//!
//! the discrete gradient of U as a function of |w|² (Gonzalez 1996, doi:10.1007/BF02440162). Its
//! work F·(w⁺ − w) is −ΔU without a dashpot, since (w⁺ − w)·(w⁺ + w) = |w⁺|² − |w|², and it has no
//! moment about the centre at the mean place: energy and angular momentum are kept at any step. The
//! φ² law of a hole has φ = |w|² − γ², which on a diameter is that of two walls 2γ apart.
//!
//! The velocities y = G v_θ of all rows satisfy y = y_free + θh W F(y) with W = G A⁻¹Gᵀ, which is
//! solved first, by Newton's method with a 2 × 2 derivative for each hole. Newton steps for the
//! whole v_θ follow: they remove the rounding error of the condensation.

use super::super::matrices::Matrices;
use super::super::penalty::{Mean, mean_pressure};
use super::super::space::Space;
use super::hole_body::HoleBody;
use crate::error::{Error, Result};
use crate::linear::{Factor, Rows};
use crate::scene::{Row, Scene};
use nalgebra::{DMatrix, DVector};

const THETA: f64 = 0.5;

/// Maximum number of Newton steps on y; a few are enough.
const MOST_STEPS: usize = 200;

/// Maximum number of halvings of a step that does not bring y nearer.
const HALVINGS: usize = 40;

/// The share of the sizes of its terms to which y is solved; the steps for the whole v_θ follow.
const NEAR: f64 = 1e-11;

/// Newton steps for the whole v_θ.
const POLISHES: usize = 2;

#[derive(Debug)]
pub(super) struct Springs {
    /// A, and its factor.
    a: <Matrices as Space>::Operator,
    factor: Factor,
    /// The rows of the walls, then two of each hole.
    rows: Rows,
    /// θh W.
    response: DMatrix<f64>,
    b: Vec<f64>,
    delta: Vec<f64>,
    mean: Vec<f64>,
    iterations: u64,
}

/// Forces on the rows, and −dF/dy.
struct LawResponse {
    force: DVector<f64>,
    slope: DMatrix<f64>,
}

impl Springs {
    pub fn new(scene: &Scene, held: &HoleBody) -> Result<Self> {
        let a = held.body.theta_matrix(THETA);
        let mut factor = Matrices::factor(&a)?;
        let mut all: Vec<&Row> = held.flats.iter().map(|&wall| scene.walls[wall].row()).collect();
        all.extend(scene.holes().flat_map(|hole| [&hole.at.y, &hole.at.z]));
        let (n, m) = (held.body.n, all.len());
        let rows = Rows::new(n, all.iter().map(|row| row.entries()));
        let mut response = DMatrix::zeros(m, m);
        for j in 0..m {
            let mut law_response = vec![0.0; n];
            rows.add_transposed(j, THETA * held.body.h, &mut law_response);
            factor.solve(&mut law_response);
            (0..m).for_each(|i| response[(i, j)] = rows.dot(i, &law_response));
        }
        let response = 0.5 * (&response + response.transpose());
        let zero = || vec![0.0; n];
        Ok(Self {
            a: Matrices::operator(&a),
            factor,
            rows,
            response,
            b: zero(),
            delta: zero(),
            mean: zero(),
            iterations: 0,
        })
    }

    /// Makes a step.
    pub fn advance(&mut self, step: u64, held: &mut HoleBody) -> Result<()> {
        let h = held.body.h;
        let (body, frame) = (&mut held.body, &mut held.frame);
        body.theta_momentum(THETA, frame, &mut self.b);
        frame.blown = body.strike((frame.start, frame.end), 1.0, &mut self.b, frame);
        // No contact is rigid here: the structure always makes the displacement that the blows
        // cause, and the damper acts over it.
        let blown = body.find_blows(&[(frame.start, frame.end, frame.end - h * THETA)]);
        if blown {
            body.damp_shift(1.0, &mut self.b);
        }
        self.delta.copy_from_slice(&self.b);
        self.factor.solve(&mut self.delta);
        let free = self.rates(held);
        if self.reaches(held, &free) {
            self.solve_contacts(step, held, free)?;
        }
        held.frame.add_change((h, THETA), &self.delta);
        if blown {
            held.body.shift(&mut held.frame.q);
        }
        Ok(())
    }

    /// G v_θ = G(v + θδ).
    fn rates(&mut self, held: &HoleBody) -> DVector<f64> {
        for (mean, (v, d)) in self.mean.iter_mut().zip(held.frame.v.iter().zip(&self.delta)) {
            *mean = v + THETA * d;
        }
        DVector::from_fn(self.rows.count(), |row, _| self.rows.dot(row, &self.mean))
    }

    /// True if a wall or hole is passed at the start of the step, or at its end with these mean
    /// velocities.
    fn reaches(&self, held: &HoleBody, y: &DVector<f64>) -> bool {
        let h = held.body.h;
        let flat = |(row, &wall): (usize, &usize)| {
            let (face, w) = (held.body.walls[wall], held.body.seen(wall, &held.frame.q));
            face.depth(w) > 0.0 || face.depth(w + h * y[row]) > 0.0
        };
        let hole = |hole: usize| {
            let (start, end) = ends(held, hole, y);
            start[0].hypot(start[1]).max(end[0].hypot(end[1])) > held.rounds[hole].gap
        };
        held.flats.iter().enumerate().any(flat) || (0..held.rounds.len()).any(hole)
    }

    /// The forces at these mean velocities.
    fn law_response(&self, held: &HoleBody, y: &DVector<f64>) -> LawResponse {
        let (m, h) = (self.rows.count(), held.body.h);
        let mut law_response = LawResponse { force: DVector::zeros(m), slope: DMatrix::zeros(m, m) };
        for (row, &wall) in held.flats.iter().enumerate() {
            let face = held.body.walls[wall];
            let s0 = face.depth(held.body.seen(wall, &held.frame.q));
            let s1 = s0 - face.sign * h * y[row];
            let (pressure, tangent) = mean_pressure(&face.law, Mean::DiscreteGradient, THETA, h, s0, s1);
            law_response.force[row] = face.sign * pressure;
            law_response.slope[(row, row)] = h * tangent;
        }
        for (hole, round) in held.rounds.iter().enumerate() {
            let first = held.flats.len() + 2 * hole;
            let (w0, w1) = ends(held, hole, y);
            let (r0, r1) = (w0[0].hypot(w0[1]), w1[0].hypot(w1[1]));
            let (pressure, tangent) =
                mean_pressure(&round.law, Mean::DiscreteGradient, THETA, h, r0 - round.gap, r1 - round.gap);
            if pressure == 0.0 {
                continue;
            }
            // r0 + r1 > γ, since one of the ends is outside.
            let both = r0 + r1;
            let along = [0, 1].map(|i: usize| (w0[i] + w1[i]) / both);
            let normal = w1.map(|w| if r1 > 0.0 { w / r1 } else { 0.0 });
            for (i, along) in along.into_iter().enumerate() {
                law_response.force[first + i] = -pressure * along;
                for (j, normal) in normal.into_iter().enumerate() {
                    let turned = if i == j { pressure / both } else { 0.0 };
                    let steeper = (tangent - pressure / both) * along * normal;
                    law_response.slope[(first + i, first + j)] = h * (turned + steeper);
                }
            }
        }
        law_response
    }

    /// Solves for δ in a step that passes a wall or hole, and writes the impulses.
    #[inline(never)]
    fn solve_contacts(&mut self, step: u64, held: &mut HoleBody, free: DVector<f64>) -> Result<()> {
        let y =
            self.settle(held, &free).map_err(|residual| Error::Newton { time: held.frame.start, step, residual })?;
        let h = held.body.h;
        let push = |rows: &Rows, scale: f64, force: &DVector<f64>, out: &mut Vec<f64>| {
            force.iter().enumerate().for_each(|(row, force)| rows.add_transposed(row, scale * force, out));
        };
        self.delta.copy_from_slice(&self.b);
        push(&self.rows, h, &self.law_response(held, &y).force, &mut self.delta);
        self.factor.solve(&mut self.delta);
        for _ in 0..POLISHES {
            // A δ − b − h Gᵀ F where F is what the laws make of this very δ.
            let y = self.rates(held);
            let law_response = self.law_response(held, &y);
            let mut residual: Vec<f64> = self.b.iter().map(|b| -b).collect();
            Matrices::add_product(&self.a, 1.0, &self.delta, &mut residual);
            push(&self.rows, -h, &law_response.force, &mut residual);
            let mut change = residual.clone();
            self.factor.solve(&mut change);
            let seen = DVector::from_fn(self.rows.count(), |row, _| self.rows.dot(row, &change));
            let Some(change) = self.solved(&law_response.slope, &seen) else { break };
            push(&self.rows, -THETA * h, &(&law_response.slope * change), &mut residual);
            self.factor.solve(&mut residual);
            self.delta.iter_mut().zip(&residual).for_each(|(delta, change)| *delta -= change);
        }
        let y = self.rates(held);
        let force = self.law_response(held, &y).force;
        for (&wall, force) in held.flats.iter().zip(&force) {
            held.frame.force[wall] = *force;
        }
        held.frame.push_by_force(h);
        for (hole, force) in force.as_slice()[held.flats.len()..].chunks_exact(2).enumerate() {
            held.push_hole(hole, h, [force[0], force[1]]);
        }
        Ok(())
    }

    /// (I + θh W D)⁻¹ x; `None` where that is singular.
    fn solved(&self, slope: &DMatrix<f64>, x: &DVector<f64>) -> Option<DVector<f64>> {
        let m = x.len();
        (DMatrix::identity(m, m) + &self.response * slope).lu().solve(x)
    }

    /// y = y_free + θh W F(y) − `Err` of the largest difference, in m/s, where Newton's method does
    /// not converge.
    fn settle(&mut self, held: &HoleBody, free: &DVector<f64>) -> std::result::Result<DVector<f64>, f64> {
        let open = |y: &DVector<f64>, law_response: &LawResponse| y - free - &self.response * &law_response.force;
        let (mut y, mut steps) = (free.clone(), 0);
        let mut law_response = self.law_response(held, &y);
        let mut residual = open(&y, &law_response);
        let found = loop {
            let pushed = self.response.map(f64::abs) * law_response.force.map(f64::abs);
            let settled = (0..y.len()).all(|i| residual[i].abs() <= NEAR * (y[i].abs() + free[i].abs() + pushed[i]));
            if settled {
                break Ok(y);
            }
            steps += 1;
            let Some(change) = self.solved(&law_response.slope, &residual).filter(|_| steps <= MOST_STEPS) else {
                break Err(residual.amax());
            };
            let mut share = 1.0;
            for halving in 0..=HALVINGS {
                let next = &y - share * &change;
                let there = self.law_response(held, &next);
                let left = open(&next, &there);
                if left.norm() < residual.norm() || halving == HALVINGS {
                    (y, law_response, residual) = (next, there, left);
                    break;
                }
                share *= 0.5;
            }
        };
        self.iterations += steps as u64;
        found
    }

    /// Newton steps so far.
    pub fn iterations(&self) -> u64 {
        self.iterations
    }
}

/// w of a hole at the start of a step, and at its end with these mean velocities.
fn ends(held: &HoleBody, hole: usize, y: &DVector<f64>) -> ([f64; 2], [f64; 2]) {
    let first = held.flats.len() + 2 * hole;
    let start = held.offset(hole, &held.frame.q);
    (start, [start[0] + held.body.h * y[first], start[1] + held.body.h * y[first + 1]])
}

#[cfg(test)]
mod tests;
