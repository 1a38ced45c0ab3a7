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
//! One degree of freedom: Newton's method on v_θ itself, in a bracket (`alone.rs`). Several: the
//! walls' velocities y = G v_θ satisfy y = y_free + θh W P̄(y) with W = G A⁻¹ Gᵀ, which is solved
//! first. The forces that make this y make δ, after one correction for the y that δ then has in
//! fact: it removes the rounding error of the condensation, which a stiff wall would turn into
//! energy.
//!
//! The forces of a step are those that make its motion, on the tangents of the laws at the solution
//! found, rather than the laws at the rounded solution. These differ by k_w times the rounding
//! error of a depth; where h²k_w is 1e10 m, a force that is wrong by that much moves the body 1e10
//! times as far as the rounding error, and across a face of a wall.

mod alone;

use super::body::Body;
use super::entry::{Coverage, NO_LAW_OF_FRICTION, Realised, SchemeEntry, SchemeKind};
use super::frame::Frame;
use super::newton::{ForceLawSolver, LawResponse};
use super::rule::Rule;
use super::space::{Space, add_change, zero};
use super::{Counters, Integrator};
use crate::error::{Error, Result};
use crate::scene::{Scene, WallLaw};
use crate::step::{Balance, Conserves, Contract, Law, Promise, Tolerances};

/// What is known of the scheme beside its rules.
pub(super) const ENTRY: SchemeEntry = SchemeEntry {
    name: "penalty",
    settings: &["epsilon", "stiffness", "damping", "integrator"],
    default: "",
    kind: SchemeKind::Penalty,
    restitution: Realised::BySprings,
    realises: "≈ 1 while h²k_w/m ≪ 1",
    purpose: "comparison, and stops that are known springs, also Hertz's and Hunt and Crossley's",
    order: Some(1),
    fails: "`trapezoidal` and `central-difference` gain energy beyond that, `implicit-euler` loses it; \
            `discrete-gradient` (the default) conserves it",
    round: Coverage::Stepped(
        "(discrete-gradient) replaces a rigid round support by a ring that keeps energy and angular momentum; it \
         tends to restitution 1",
    ),
    elastic_round: Coverage::Stepped("(discrete-gradient) keeps energy and angular momentum"),
    friction: Coverage::Refused(NO_LAW_OF_FRICTION),
    elastic_round_friction: Coverage::Refused(NO_LAW_OF_FRICTION),
};

/// What every step by this integrator satisfies.
pub(super) fn contract(integrator: Integrator) -> Contract {
    let (balance, law, instant) = match integrator {
        Integrator::Trapezoidal => (Balance::Theta(0.5), Law::Ends(0.5), 0.5),
        Integrator::ImplicitEuler => (Balance::Theta(1.0), Law::Ends(1.0), 1.0),
        Integrator::CentralDifference => (Balance::Staggered(0.0), Law::Start, 0.0),
        Integrator::DiscreteGradient => (Balance::Theta(0.5), Law::Gradient, 0.5),
    };
    let conserves =
        if integrator == Integrator::DiscreteGradient { Conserves::UndampedWalls } else { Conserves::Nothing };
    Contract { balance, promise: Promise::springs(law), instant, tolerances: Tolerances::of(conserves), divides: false }
}

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
    /// The factor of A.
    factor: S::Factor,
    /// A/θ of one degree of freedom.
    alone: f64,
    walls: ForceLawSolver,
    b: S::Vector,
    /// (v_θ − v)/θ.
    delta: S::Vector,
    /// v_θ as it changes, m/s.
    mean_velocity: S::Vector,
    /// G q, m, and G v_θ as it changes, m/s; the latter is G itself for one degree of freedom.
    place: Vec<f64>,
    rate: Vec<f64>,
}

impl<S: Space> Penalty<S> {
    pub fn new(scene: &Scene, theta: f64, mean: Mean, h: f64) -> Result<Self> {
        let body = Body::<S>::new(scene, h)?;
        let a = body.theta_matrix(theta);
        let mut factor = S::factor(&a)?;
        let walls = ForceLawSolver::new(&mut factor, &body, h * theta);
        let (over, along) = (zero::<S>(body.n), vec![0.0; body.walls.len()]);
        let mut one = over.clone();
        one.as_mut()[0] = 1.0;
        let rate = (0..along.len()).map(|wall| body.seen(wall, &one)).collect();
        Ok(Self {
            theta,
            mean,
            factor,
            alone: a.diagonal_entries()[0] / theta,
            walls,
            b: over.clone(),
            delta: over.clone(),
            mean_velocity: over,
            place: along,
            rate,
            body,
        })
    }

    /// The force of a wall in a step in which the mean velocity of its row is `rate`.
    #[inline]
    fn law_response(&self, wall: usize, rate: f64) -> LawResponse {
        let (face, h) = (self.body.walls[wall], self.body.h);
        let s0 = face.depth(self.place[wall]);
        let s1 = s0 - face.sign * h * rate;
        let (pressure, tangent) = mean_pressure(&face.law, self.mean, self.theta, h, s0, s1);
        LawResponse { force: face.sign * pressure, slope: h * tangent, noise: s0.abs() / h }
    }

    /// Solves for δ of a step that may meet a wall, and writes the walls' impulses. Not inlined:
    /// most steps meet no wall.
    #[inline(never)]
    fn solve_contacts(&mut self, frame: &mut Frame<S>, step: u64) -> Result<()> {
        // The solver is moved out, since it calls `self.law_response`.
        let mut walls = std::mem::take(&mut self.walls);
        let solved = walls.solve(|wall, rate| self.law_response(wall, rate));
        self.walls = walls;
        solved.map_err(|residual| Error::Newton { time: frame.start, step, residual })?;
        self.push(frame);
        Ok(())
    }

    /// Makes δ by the forces of the walls, corrected until they are those of the laws at this very
    /// δ, and writes their impulses.
    fn push(&mut self, frame: &mut Frame<S>) {
        for correct in [true, false] {
            self.delta.clone_from(&self.b);
            self.body.push(self.body.h, &self.walls.guess, &mut self.delta);
            S::solve(&mut self.factor, &mut self.delta);
            if correct {
                self.update_rates(frame);
                self.walls.refine(&self.rate);
            }
        }
        frame.force.copy_from_slice(&self.walls.guess);
        frame.push_by_force(self.body.h);
    }

    /// G v_θ = G(v + θδ).
    fn update_rates(&mut self, frame: &Frame<S>) {
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
            let mean = self.solve_alone(frame, step)?;
            frame.q[0] += h * mean;
            frame.v[0] = (mean - (1.0 - theta) * frame.v[0]) / theta;
        } else {
            if inside {
                self.solve_contacts(frame, step)?;
            }
            add_change::<S>((h, theta), &self.delta, &mut frame.q, &mut frame.v);
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
}

/// Mean pressure of a law over a step of `h` seconds from depth `s0` to `s1`, and its derivative
/// with respect to `s1`, which is ≥ 0.
#[inline]
pub(super) fn mean_pressure(law: &WallLaw, mean: Mean, theta: f64, h: f64, s0: f64, s1: f64) -> (f64, f64) {
    let (elastic, tangent) = match mean {
        Mean::Ends => {
            let ends = (1.0 - theta) * law.pressure(s0, 0.0) + theta * law.pressure(s1, 0.0);
            (ends, theta * law.tangent(s1))
        }
        Mean::DiscreteGradient => law.mean_force(s0, s1),
    };
    if !law.is_damped() {
        return (elastic, tangent);
    }
    let rate = (s1.max(0.0) - s0.max(0.0)) / h;
    let pressure = elastic + law.dashpot(elastic) * rate;
    if pressure < 0.0 {
        return (0.0, 0.0);
    }
    let with_rate = if s1 > 0.0 { law.dashpot(elastic) / h } else { 0.0 };
    (pressure, tangent * (1.0 + law.dissipation() * rate) + with_rate)
}

#[cfg(test)]
mod tests;
