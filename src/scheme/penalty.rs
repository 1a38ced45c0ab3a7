//! `penalty`: every rigid wall becomes a spring, and each step solves for the displacement by Newton's method.
//!
//! With v_θ = (1−θ)v + θv⁺, q⁺ = q + h v_θ as in the velocity-level scheme, the balance
//!
//! A (v_θ − v)/θ = b + h Σ ± P̄(s, s⁺),    A = M + hθC + h²θ²K,
//!
//! holds a mean pressure P̄ per wall: (1−θ)|r|(s) + θ|r|(s⁺) for `trapezoidal` (θ = ½) and `implicit-euler` (θ = 1), or, with θ = ½, the
//! discrete gradient ΔU/Δs of the wall's energy (Gonzalez 1996, doi:10.1007/BF02440162), which keeps the energy of the penalised system at
//! any step. (With a displacement for unknown, v⁺ would be a quotient by h, whose rounding has a constant part: the energy drifts by 1e-16
//! a step. The mean velocity is small where a stiff wall turns the body round, and so is the work of its rounding.) The trapezoidal rule
//! does not, once h²k_w/m is not small: "unconditionally stable" is a statement about linear systems.

use super::grid::{Counters, Frame, Scalar};
use super::stop::Stop;
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

    /// Takes the motion up anew at `time` (s).
    pub fn restart(&mut self, time: f64, q: f64, v: f64) {
        (self.q, self.v, self.load) = (q, v, self.s.forcing.force(time));
    }

    #[inline]
    pub fn advance(&mut self, step: u64, extra: f64, frame: &mut Frame) -> Result<()> {
        let s = &self.s;
        let (h, theta) = (s.h, self.theta);
        let ht = h * theta;
        let (start, end) = (step as f64 * h, (step + 1) as f64 * h);
        let (q, v) = (self.q, self.v);
        let load_end = s.forcing.force(end);
        let load = (1.0 - theta) * self.load + theta * load_end + extra;
        let a = s.m + ht * s.c + ht * ht * s.k;
        // No wall is rigid here: the blows take the body all their way, which the damper feels.
        let shift = s.blows(&[(start, end, end - ht)]).map_or(0.0, |(shift, _)| shift);
        let b = h * (load - s.c * v - s.k * (q + ht * v)) + s.forcing.impulse(start, end) - s.c * shift;
        frame.clear();
        let delta = b / a;
        let mut mean = v + theta * delta;
        let mut v_end = v + delta;
        let inside = |w: f64| s.walls.iter().any(|wall| wall.depth(w) > 0.0);
        if inside(q) || inside(q + h * mean) {
            mean = self.newton(a / theta, b, mean, start, step)?;
            v_end = (mean - (1.0 - theta) * v) / theta;
            for ((p, force), wall) in frame.impulse.iter_mut().zip(&mut frame.force).zip(&self.s.walls) {
                *force = wall.sign * self.pressure(wall, q, h * mean).0;
                *p = h * *force;
            }
            frame.touched = true;
        }
        let q_end = q + h * mean + shift;
        (self.q, self.v, self.load) = (q_end, v_end, load_end);
        frame.arrive(start, end, v, q_end, v_end);
        frame.check(step)
    }

    /// The v_θ at which a (v_θ − v) − b − h Σ ± P̄ = 0, a function that increases with it: Newton from the free step, kept in a
    /// bracket.
    fn newton(&mut self, a: f64, b: f64, free: f64, time: f64, step: u64) -> Result<f64> {
        let h = self.s.h;
        let (mut lo, mut hi) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut mean = free;
        let mut residual = f64::NAN;
        for _ in 0..NEWTON_LIMIT {
            self.newton += 1;
            let shift = h * mean;
            residual = a * (mean - self.v) - b;
            let mut slope = a;
            let mut size = a * (mean.abs() + self.v.abs()) + b.abs();
            for wall in &self.s.walls {
                let (pressure, tangent) = self.pressure(wall, self.q, shift);
                residual -= h * wall.sign * pressure;
                slope += h * h * tangent;
                // The depth itself is known to rounding of its parts only.
                size += h * (pressure + tangent * (wall.depth(self.q).abs() + shift.abs()));
            }
            let next = mean - residual / slope;
            // Below two units of rounding of the terms that cancel, the residual is noise. Newton comes from one side: the last
            // correction takes that bias out of the energy.
            if residual.abs() <= 2.0 * f64::EPSILON * size {
                return Ok(next);
            }
            if residual > 0.0 {
                hi = hi.min(mean);
            } else {
                lo = lo.max(mean);
            }
            let bracketed = lo.is_finite() && hi.is_finite() && !(next > lo && next < hi);
            let next = if bracketed { 0.5 * (lo + hi) } else { next };
            if next == mean || next == lo || next == hi {
                return Ok(next);
            }
            mean = next;
        }
        Err(Error::Newton { time, step, residual: residual.abs() / h })
    }

    /// Mean pressure of a wall while the body goes from `w` to `w + shift`, and its derivative with respect to the end's depth.
    #[inline]
    fn pressure(&self, wall: &Stop, w: f64, shift: f64) -> (f64, f64) {
        let s0 = wall.depth(w);
        mean_pressure(&wall.law, self.mean, self.theta, self.s.h, s0, s0 - wall.sign * shift)
    }

    pub fn count(&self, counters: &mut Counters) {
        counters.newton_iterations = self.newton;
    }
}

/// Mean pressure of a law over a step of `h` seconds from depth `s0` to `s1`, and its derivative with respect to `s1`: it never falls with that.
#[inline]
pub(super) fn mean_pressure(law: &WallLaw, mean: Mean, theta: f64, h: f64, s0: f64, s1: f64) -> (f64, f64) {
    if s0 <= 0.0 && s1 <= 0.0 {
        return (0.0, 0.0);
    }
    let (mut pressure, mut tangent) = match mean {
        Mean::Ends => {
            let ends = (1.0 - theta) * law.pressure(s0, 0.0) + theta * law.pressure(s1, 0.0);
            (ends, theta * law.tangent(s1))
        }
        Mean::DiscreteGradient => discrete_gradient(law, s0, s1),
    };
    if let WallLaw::Elastic { damping, .. } = *law
        && damping > 0.0
    {
        pressure += damping * (s1.max(0.0) - s0.max(0.0)) / h;
        tangent += if s1 > 0.0 { damping / h } else { 0.0 };
        if pressure < 0.0 {
            return (0.0, 0.0);
        }
    }
    (pressure, tangent)
}

/// ΔU/Δs between two depths, and its derivative with respect to the second; without division by zero.
fn discrete_gradient(law: &WallLaw, s0: f64, s1: f64) -> (f64, f64) {
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
