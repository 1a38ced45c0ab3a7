//! `penalty` with the implicit integrators for several degrees of freedom: see the scalar kernel for the mathematics.
//!
//! A(v_θ − v)/θ = b + h Gᵀ P̄(G v_θ), A = M + hθC + h²θ²K. The walls' velocities y = G v_θ obey y = y_free + θh W P̄(y) with W = G A⁻¹ Gᵀ, which is
//! solved first. One Newton step for all of v_θ follows: it takes out the rounding of that detour, which a stiff wall would turn into work.

use super::body::Body;
use super::factor::factor;
use super::frame::Frame;
use super::newton::{Answer, Walls};
use crate::error::{Error, Result};
use crate::linear::{Factor, Operator};
use crate::scene::Scene;
use crate::scheme::Counters;
use crate::scheme::penalty::{Mean, mean_pressure};

#[derive(Debug)]
pub(super) struct Penalty {
    body: Body,
    theta: f64,
    mean: Mean,
    /// A, and its factor.
    a: Operator,
    factor: Factor,
    /// C + hθK.
    drag: Operator,
    walls: Walls,
    b: Vec<f64>,
    /// (v_θ − v)/θ.
    delta: Vec<f64>,
    residual: Vec<f64>,
    change: Vec<f64>,
    /// G q, m, and G v_θ as it changes, m/s.
    place: Vec<f64>,
    rate: Vec<f64>,
}

impl Penalty {
    pub fn new(scene: &Scene, theta: f64, mean: Mean, h: f64) -> Result<Self> {
        let body = Body::new(scene, h);
        let ht = h * theta;
        let (a, drag) = body.theta_matrices(theta);
        let mut factor = factor(&a)?;
        let walls = Walls::new(&mut factor, &body.rows, ht);
        let (over, along) = (vec![0.0; body.n], vec![0.0; body.walls.len()]);
        Ok(Self {
            theta,
            mean,
            a: Operator::new(&a),
            factor,
            drag,
            walls,
            b: over.clone(),
            delta: over.clone(),
            residual: over.clone(),
            change: over,
            place: along.clone(),
            rate: along,
            body,
        })
    }

    /// Takes the motion up anew at `time` (s), from the frame's state.
    pub fn restart(&mut self, time: f64) {
        self.body.restart(time);
    }

    pub fn advance(&mut self, step: u64, frame: &mut Frame) -> Result<()> {
        let Self { body, theta, drag, factor, b, delta, place, .. } = self;
        let (h, theta) = (body.h, *theta);
        frame.begin(step, h);
        body.theta_momentum(theta, drag, frame, b);
        body.strike((frame.start, frame.end), &frame.v, 1.0, b, &mut frame.struck);
        // No wall is rigid here: the blows take the structure all their way, which the damper feels.
        let blown = body.find_blows(&[(frame.start, frame.end, frame.end - h * theta)]);
        if blown {
            body.damp_shift(1.0, b);
        }
        delta.copy_from_slice(b);
        factor.solve(delta);
        let mut inside = false;
        for (wall, stop) in body.walls.iter().enumerate() {
            let (w, rate) = (body.rows.dot(wall, &frame.q), body.rows.dot(wall, &frame.v));
            let free = rate + theta * body.rows.dot(wall, delta);
            (place[wall], self.walls.free[wall]) = (w, free);
            inside |= stop.depth(w) > 0.0 || stop.depth(w + h * free) > 0.0;
        }
        if inside {
            self.meet(frame, step)?;
        }
        for ((q, v), d) in frame.q.iter_mut().zip(&mut frame.v).zip(&self.delta) {
            *q += h * (*v + theta * d);
            *v += d;
        }
        frame.after.copy_from_slice(&frame.v);
        if blown {
            self.body.shift(&mut frame.q);
        }
        Ok(())
    }

    /// The force of a wall in the step in which it sees the velocity `rate`.
    #[inline]
    fn answer(&self, wall: usize, rate: f64) -> Answer {
        let (stop, h) = (self.body.walls[wall], self.body.h);
        let s0 = stop.depth(self.place[wall]);
        let s1 = s0 - stop.sign * h * rate;
        let (pressure, tangent) = mean_pressure(&stop.law, self.mean, self.theta, h, s0, s1);
        Answer { force: stop.sign * pressure, slope: h * tangent, noise: s0.abs() / h }
    }

    /// δ of a step that may meet a wall, whose impulses it writes.
    fn meet(&mut self, frame: &mut Frame, step: u64) -> Result<()> {
        let (h, theta) = (self.body.h, self.theta);
        // The solver is lent out while the laws, which it asks, are read.
        let mut walls = std::mem::take(&mut self.walls);
        let solved = walls.solve(|wall, rate| self.answer(wall, rate));
        self.walls = walls;
        solved.map_err(|residual| Error::Newton { time: frame.start, step, residual })?;
        self.delta.copy_from_slice(&self.b);
        self.body.push(h, &self.walls.force, &mut self.delta);
        self.factor.solve(&mut self.delta);
        // A δ − b − h Gᵀ P̄ where P̄ is what the laws make of this very δ.
        self.see_rates(frame);
        self.residual.iter_mut().zip(&self.b).for_each(|(residual, b)| *residual = -b);
        self.a.add_product(1.0, &self.delta, &mut self.residual);
        for wall in 0..self.rate.len() {
            let answer = self.answer(wall, self.rate[wall]);
            self.walls.slope[wall] = answer.slope;
            self.body.rows.add_transposed(wall, -h * answer.force, &mut self.residual);
        }
        self.change.copy_from_slice(&self.residual);
        self.factor.solve(&mut self.change);
        for (wall, rate) in self.rate.iter_mut().enumerate() {
            *rate = -theta * self.body.rows.dot(wall, &self.change);
        }
        let more = self.walls.respond(&self.rate);
        self.body.push(h, more, &mut self.residual);
        self.factor.solve(&mut self.residual);
        self.delta.iter_mut().zip(&self.residual).for_each(|(delta, change)| *delta -= change);
        self.see_rates(frame);
        for wall in 0..self.rate.len() {
            frame.force[wall] = self.answer(wall, self.rate[wall]).force;
        }
        frame.push_by_force(h);
        Ok(())
    }

    /// G v_θ = G(v + θδ).
    fn see_rates(&mut self, frame: &Frame) {
        for (wall, rate) in self.rate.iter_mut().enumerate() {
            let rows = &self.body.rows;
            *rate = rows.row(wall).iter().map(|&(i, weight)| weight * (frame.v[i] + self.theta * self.delta[i])).sum();
        }
    }

    pub fn count(&self, counters: &mut Counters) {
        counters.newton_iterations = self.walls.iterations;
    }
}
