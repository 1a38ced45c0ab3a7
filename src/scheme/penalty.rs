//! `penalty`: every rigid wall becomes a spring, and each step solves for the velocity by Newton's
//! method.
//!
//! With v_θ = (1−θ)v + θv⁺, q⁺ = q + h v_θ as in the velocity-level scheme, the balance
//!
//! A (v_θ − v)/θ = b + h Σ ± P̄(s, s⁺),    A = M + hθC + h²θ²K,
//!
//! contains a mean pressure P̄ per wall: (1−θ)|r|(s) + θ|r|(s⁺) for `trapezoidal` (θ = ½) and
//! `implicit-euler` (θ = 1), or, with θ = ½, the discrete gradient ΔU/Δs of the wall's energy
//! (Gonzalez 1996, doi:10.1007/BF02440162), which conserves the energy of the penalised system at
//! any step. (The unknown is the mean velocity: with the displacement as unknown, v⁺ would be a
//! quotient by h, and its rounding error would make the energy drift by 1e-16 per step.) The
//! trapezoidal rule does not conserve it once h²k_w/m is not small: "unconditionally stable" is a
//! statement about linear systems. Order 2 at θ = ½, 1 at θ = 1, which loses energy instead.
//!
//! One degree of freedom: Newton's method on v_θ itself, in a bracket. Several: the walls'
//! velocities y = G v_θ satisfy y = y_free + θh W P̄(y) with W = G A⁻¹ Gᵀ, which is solved first.
//! One Newton step for the whole v_θ follows: it removes the rounding error of the condensation,
//! which a stiff wall would turn into energy.

use super::Counters;
use super::body::Body;
use super::frame::Frame;
use super::newton::{Answer, Walls};
use super::rule::Rule;
use super::space::{Space, zero};
use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::scene::{Scene, WallLaw};

/// Maximum number of Newton iterations. A few are enough; reaching this many means that numbers are
/// not finite.
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
pub(super) struct Penalty<S: Space> {
    body: Body<S>,
    theta: f64,
    mean: Mean,
    /// A, and its factor.
    a: S::Operator,
    factor: S::Factor,
    walls: Walls,
    b: S::Vector,
    /// (v_θ − v)/θ.
    delta: S::Vector,
    /// v_θ as it changes, m/s.
    mean_velocity: S::Vector,
    residual: S::Vector,
    change: S::Vector,
    /// G q, m, and G v_θ as it changes, m/s.
    place: Vec<f64>,
    rate: Vec<f64>,
}

impl<S: Space> Penalty<S> {
    pub fn new(scene: &Scene, theta: f64, mean: Mean, h: f64) -> Result<Self> {
        let body = Body::<S>::new(scene, h)?;
        let a = body.theta_matrix(theta);
        let mut factor = S::factor(&a)?;
        let walls = Walls::new(&mut factor, &body, h * theta);
        let (over, along) = (zero::<S>(body.n), vec![0.0; body.walls.len()]);
        Ok(Self {
            theta,
            mean,
            a: S::operator(&a),
            factor,
            walls,
            b: over.clone(),
            delta: over.clone(),
            mean_velocity: over.clone(),
            residual: over.clone(),
            change: over,
            place: along.clone(),
            rate: along,
            body,
        })
    }

    /// The force of a wall in a step in which the mean velocity of its row is `rate`.
    #[inline]
    fn answer(&self, wall: usize, rate: f64) -> Answer {
        let (face, h) = (self.body.walls[wall], self.body.h);
        let s0 = face.depth(self.place[wall]);
        let s1 = s0 - face.sign * h * rate;
        let (pressure, tangent) = mean_pressure(&face.law, self.mean, self.theta, h, s0, s1);
        Answer { force: face.sign * pressure, slope: h * tangent, noise: s0.abs() / h }
    }

    /// v_θ of one degree of freedom in a step that may meet a wall, whose impulses it writes: the
    /// root of (A/θ)(v_θ − v) − b − h Gᵀ P̄, a function that increases with it.
    #[inline(never)]
    fn meet_alone(&mut self, frame: &mut Frame<S>, step: u64) -> Result<f64> {
        let (h, theta, v, b) = (self.body.h, self.theta, frame.v[0], self.b[0]);
        // The rows' entries and A, as products with 1.
        self.residual[0] = 1.0;
        self.change[0] = 0.0;
        S::add_product(&self.a, 1.0, &self.residual, &mut self.change);
        for (wall, weight) in self.rate.iter_mut().enumerate() {
            *weight = self.body.seen(wall, &self.residual);
        }
        let a = self.change[0] / theta;
        let (mut lo, mut hi) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut mean = v + theta * self.delta[0];
        let (mut residual, mut found) = (f64::NAN, None);
        for _ in 0..NEWTON_LIMIT {
            self.walls.iterations += 1;
            residual = a * (mean - v) - b;
            let mut slope = a;
            let mut size = a * (mean.abs() + v.abs()) + b.abs();
            for wall in 0..self.rate.len() {
                let weight = self.rate[wall];
                let Answer { force, slope: tangent, noise } = self.answer(wall, weight * mean);
                residual -= h * weight * force;
                slope += h * weight * weight * tangent;
                // The depth itself has the rounding error of its terms.
                size += h * weight.abs() * (force.abs() + tangent * (noise + (weight * mean).abs()));
            }
            let next = mean - residual / slope;
            // Below two units of rounding of the terms that cancel, the residual is rounding error.
            // Newton's iterates come from one side: the last correction removes this bias, which
            // would change the energy.
            if residual.abs() <= 2.0 * f64::EPSILON * size {
                found = Some(next);
                break;
            }
            if residual > 0.0 {
                hi = hi.min(mean);
            } else {
                lo = lo.max(mean);
            }
            let bracketed = lo.is_finite() && hi.is_finite() && !(next > lo && next < hi);
            let next = if bracketed { 0.5 * (lo + hi) } else { next };
            if next == mean || next == lo || next == hi {
                found = Some(next);
                break;
            }
            mean = next;
        }
        let Some(mean) = found else {
            return Err(Error::Newton { time: frame.start, step, residual: residual.abs() / h });
        };
        for wall in 0..self.rate.len() {
            frame.force[wall] = self.answer(wall, self.rate[wall] * mean).force;
        }
        frame.push_by_force(h);
        Ok(mean)
    }

    /// Solves for δ of a step that may meet a wall, and writes the walls' impulses. Not inlined:
    /// most steps meet no wall.
    #[inline(never)]
    fn meet(&mut self, frame: &mut Frame<S>, step: u64) -> Result<()> {
        let (h, theta) = (self.body.h, self.theta);
        // The solver is moved out, since it calls `self.answer`.
        let mut walls = std::mem::take(&mut self.walls);
        let solved = walls.solve(|wall, rate| self.answer(wall, rate));
        self.walls = walls;
        solved.map_err(|residual| Error::Newton { time: frame.start, step, residual })?;
        self.delta.clone_from(&self.b);
        self.body.push(h, &self.walls.force, &mut self.delta);
        S::solve(&mut self.factor, &mut self.delta);
        // A δ − b − h Gᵀ P̄ where P̄ is what the laws make of this very δ.
        self.see_rates(frame);
        self.residual.as_mut().iter_mut().zip(self.b.as_ref()).for_each(|(residual, b)| *residual = -b);
        S::add_product(&self.a, 1.0, &self.delta, &mut self.residual);
        for wall in 0..self.rate.len() {
            let answer = self.answer(wall, self.rate[wall]);
            self.walls.slope[wall] = answer.slope;
            S::add_transposed(&self.body.rows, wall, -h * answer.force, &mut self.residual);
        }
        self.change.clone_from(&self.residual);
        S::solve(&mut self.factor, &mut self.change);
        for (wall, rate) in self.rate.iter_mut().enumerate() {
            *rate = -theta * self.body.seen(wall, &self.change);
        }
        let more = self.walls.respond(&self.rate);
        self.body.push(h, more, &mut self.residual);
        S::solve(&mut self.factor, &mut self.residual);
        self.delta.as_mut().iter_mut().zip(self.residual.as_ref()).for_each(|(delta, change)| *delta -= change);
        self.see_rates(frame);
        for wall in 0..self.rate.len() {
            frame.force[wall] = self.answer(wall, self.rate[wall]).force;
        }
        frame.push_by_force(h);
        Ok(())
    }

    /// G v_θ = G(v + θδ).
    fn see_rates(&mut self, frame: &Frame<S>) {
        let Self { body, theta, mean_velocity, delta, rate, .. } = self;
        let states = frame.v.as_ref().iter().zip(delta.as_ref());
        for (mean, (v, d)) in mean_velocity.as_mut().iter_mut().zip(states) {
            *mean = v + *theta * d;
        }
        for (wall, rate) in rate.iter_mut().enumerate() {
            *rate = body.seen(wall, mean_velocity);
        }
    }
}

impl<S: Space> Rule<S> for Penalty<S> {
    fn restart(&mut self, _: &Scene, time: f64, _: &Frame<S>) -> Result<()> {
        self.body.restart(time);
        Ok(())
    }

    fn advance(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let Self { body, theta, factor, b, delta, place, .. } = self;
        let (h, theta) = (body.h, *theta);
        frame.begin(step, h);
        body.theta_momentum(theta, frame, b);
        frame.blown = body.strike((frame.start, frame.end), 1.0, b, frame);
        // No wall is rigid here: the structure always makes the displacement that the blows cause,
        // and the damper acts over it.
        let blown = body.find_blows(&[(frame.start, frame.end, frame.end - h * theta)]);
        if blown {
            body.damp_shift(1.0, b);
        }
        delta.clone_from(b);
        S::solve(factor, delta);
        let mut inside = false;
        for (wall, face) in body.walls.iter().enumerate() {
            let (w, rate) = (body.seen(wall, &frame.q), body.seen(wall, &frame.v));
            let free = rate + theta * body.seen(wall, delta);
            (place[wall], self.walls.free[wall]) = (w, free);
            inside |= face.depth(w) > 0.0 || face.depth(w + h * free) > 0.0;
        }
        if inside && self.body.n == 1 {
            let mean = self.meet_alone(frame, step)?;
            frame.q[0] += h * mean;
            frame.v[0] = (mean - (1.0 - theta) * frame.v[0]) / theta;
        } else {
            if inside {
                self.meet(frame, step)?;
            }
            for ((q, v), d) in frame.q.as_mut().iter_mut().zip(frame.v.as_mut()).zip(self.delta.as_ref()) {
                *q += h * (*v + theta * d);
                *v += d;
            }
        }
        frame.after.clone_from(&frame.v);
        if blown {
            self.body.shift(&mut frame.q);
        }
        Ok(())
    }

    fn count(&self, counters: &mut Counters) {
        counters.newton_iterations = self.walls.iterations;
    }

    fn backend(&self) -> Option<Backend> {
        None
    }
}

/// Mean pressure of a law over a step of `h` seconds from depth `s0` to `s1`, and its derivative
/// with respect to `s1`, which is ≥ 0.
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
        Mean::DiscreteGradient => law.mean_force(s0, s1),
    };
    let damping = law.damping();
    if damping > 0.0 {
        pressure += damping * (s1.max(0.0) - s0.max(0.0)) / h;
        tangent += if s1 > 0.0 { damping / h } else { 0.0 };
        if pressure < 0.0 {
            return (0.0, 0.0);
        }
    }
    (pressure, tangent)
}

#[cfg(test)]
mod tests;
