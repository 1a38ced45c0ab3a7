//! `penalty`: every rigid wall becomes a spring, and each step solves for the displacement by Newton's method.
//!
//! With q⁺ = q + Δ and v⁺ = (Δ/h − (1−θ)v)/θ as in the position-level schemes, the balance
//!
//! A Δ = b + (1/θ) Σ ± P̄(s, s⁺),    A = M/(hθ)² + C/(hθ) + K,
//!
//! holds a mean pressure P̄ per wall: (1−θ)|r|(s) + θ|r|(s⁺) for `trapezoidal` (θ = ½) and `implicit-euler` (θ = 1), or, with
//! θ = ½, the discrete gradient ΔU/Δs of the wall's energy (Gonzalez 1996, doi:10.1007/BF02440162), which keeps the energy of the penalised
//! system at any step. The trapezoidal rule does not, once h²k_w/m is not small: "unconditionally stable" is a statement about linear systems.

use super::grid::{Counters, Frame, Scalar, ScalarWall};
use crate::error::{Error, Result};
use crate::scene::{Scene, WallLaw};

/// Newton's method with a bracket needs a handful of iterations; more than this many means that numbers are not finite.
const NEWTON_LIMIT: u64 = 200;

/// How a step averages the pressure of a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mean {
    /// (1−θ)|r|(s) + θ|r|(s⁺).
    Ends,
    /// (U(s⁺) − U(s))/(s⁺ − s).
    DiscreteGradient,
}

#[derive(Debug)]
pub(super) struct Penalty {
    s: Scalar,
    theta: f64,
    mean: Mean,
    q: f64,
    v: f64,
    /// f(t) at the step's start, N.
    load: f64,
    newton: u64,
}

impl Penalty {
    pub fn new(scene: &Scene, theta: f64, mean: Mean, h: f64) -> Self {
        let s = Scalar::new(scene, h);
        let (q, v) = s.start(scene);
        let load = s.forcing.force(0.0);
        Self { s, theta, mean, q, v, load, newton: 0 }
    }

    #[inline]
    pub fn advance(&mut self, step: u64, extra: f64, frame: &mut Frame) -> Result<()> {
        let s = &self.s;
        let (h, theta) = (s.h, self.theta);
        let (ht, rest) = (h * theta, (1.0 - theta) / theta);
        let (start, end) = (step as f64 * h, (step + 1) as f64 * h);
        let (q, v) = (self.q, self.v);
        let load_end = s.forcing.force(end);
        let a = s.m / (ht * ht) + s.c / ht + s.k;
        // (1−θ)/θ times F + C v = f − K q, then the end's share.
        let b = s.m * v / (ht * theta)
            + rest * (self.load + extra - s.k * q)
            + (load_end + extra - s.k * q)
            + s.forcing.impulse(start, end) / ht;
        frame.clear();
        let mut delta = b / a;
        let inside = |w: f64| s.walls.iter().any(|wall| wall.depth(w) > 0.0);
        if inside(q) || inside(q + delta) {
            delta = self.newton(a, b, delta, start, step)?;
            for ((p, force), wall) in frame.impulse.iter_mut().zip(&mut frame.force).zip(&self.s.walls) {
                *force = wall.sign * self.pressure(wall, q, q + delta).0;
                *p = h * *force;
            }
            frame.touched = true;
        }
        let q_end = q + delta;
        let v_end = (delta / h - (1.0 - theta) * v) / theta;
        (self.q, self.v, self.load) = (q_end, v_end, load_end);
        frame.arrive(start, end, v, q_end, v_end);
        frame.check(step)
    }

    /// The root of A Δ − b − (1/θ) Σ ± P̄, a function that increases with Δ: Newton from the free step, kept in a bracket.
    fn newton(&mut self, a: f64, b: f64, free: f64, time: f64, step: u64) -> Result<f64> {
        let (mut lo, mut hi) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut delta = free;
        let mut residual = f64::NAN;
        for _ in 0..NEWTON_LIMIT {
            self.newton += 1;
            residual = a * delta - b;
            let mut slope = a;
            let mut size = (a * delta).abs() + b.abs();
            for wall in &self.s.walls {
                let (pressure, tangent) = self.pressure(wall, self.q, self.q + delta);
                residual -= wall.sign * pressure / self.theta;
                slope += tangent / self.theta;
                // The depth itself is known to rounding of the position only.
                size += (pressure + tangent * wall.g.abs()) / self.theta;
            }
            // Below two units of rounding of the terms that cancel, the residual is noise.
            if residual.abs() <= 2.0 * f64::EPSILON * size {
                return Ok(delta);
            }
            if residual > 0.0 {
                hi = hi.min(delta);
            } else {
                lo = lo.max(delta);
            }
            let mut next = delta - residual / slope;
            if !(next > lo && next < hi) && lo.is_finite() && hi.is_finite() {
                next = 0.5 * (lo + hi);
            }
            if next == delta || next == lo || next == hi {
                return Ok(next);
            }
            delta = next;
        }
        Err(Error::Newton { time, step, residual: residual.abs() })
    }

    /// Mean pressure of a wall while the body goes from `w` to `w_end`, and its derivative with respect to the end's depth.
    #[inline]
    fn pressure(&self, wall: &ScalarWall, w: f64, w_end: f64) -> (f64, f64) {
        let (s0, s1) = (wall.depth(w), wall.depth(w_end));
        if s0 <= 0.0 && s1 <= 0.0 {
            return (0.0, 0.0);
        }
        let (mut mean, mut tangent) = match self.mean {
            Mean::Ends => {
                let ends = (1.0 - self.theta) * wall.law.pressure(s0, 0.0) + self.theta * wall.law.pressure(s1, 0.0);
                (ends, self.theta * wall.law.tangent(s1))
            }
            Mean::DiscreteGradient => discrete_gradient(&wall.law, s0, s1),
        };
        if let WallLaw::Elastic { damping, .. } = wall.law
            && damping > 0.0
        {
            mean += damping * (s1.max(0.0) - s0.max(0.0)) / self.s.h;
            tangent += if s1 > 0.0 { damping / self.s.h } else { 0.0 };
            if mean < 0.0 {
                return (0.0, 0.0);
            }
        }
        (mean, tangent)
    }

    pub fn count(&self, counters: &mut Counters) {
        counters.newton_iterations = self.newton;
    }
}

/// ΔU/Δs between two depths, and its derivative with respect to the second; without division by zero.
pub(super) fn discrete_gradient(law: &WallLaw, s0: f64, s1: f64) -> (f64, f64) {
    if s0 <= 0.0 && s1 <= 0.0 {
        return (0.0, 0.0);
    }
    if s0 <= 0.0 {
        let slope = law.energy(s1) / (s1 - s0);
        return (slope, (law.pressure(s1, 0.0) - slope) / (s1 - s0));
    }
    if s1 <= 0.0 {
        let slope = law.energy(s0) / (s0 - s1);
        return (slope, slope / (s0 - s1));
    }
    match *law {
        WallLaw::Rigid { .. } => (0.0, 0.0),
        WallLaw::Elastic { stiffness, .. } => (0.5 * stiffness * (s0 + s1), 0.5 * stiffness),
        WallLaw::Quartic { epsilon, span } => {
            let phi = s0 * (s0 + span) + s1 * (s1 + span);
            let sum = s0 + s1 + span;
            (phi * sum / (2.0 * epsilon), ((2.0 * s1 + span) * sum + phi) / (2.0 * epsilon))
        }
    }
}
