//! `moreau-jean` for several degrees of freedom: see the scalar kernel for the mathematics.
//!
//! A δ = b + Gᵀ p, A = M + hθC + h²θ²K, b = h[f_θ − (C + hθK) v − K q] + J, over the rows of the walls that q + ½hv reaches.

use super::body::Body;
use super::frame::Frame;
use super::programme::Programme;
use crate::error::Result;
use crate::linear::Operator;
use crate::qp::Backend;
use crate::scene::{Scene, WallLaw};
use crate::scheme::Counters;

#[derive(Debug)]
pub(super) struct MoreauJean {
    body: Body,
    theta: f64,
    /// C + hθK.
    drag: Operator,
    programme: Programme,
    b: Vec<f64>,
    /// q + ½hv, with the velocity that the walls answer.
    ahead: Vec<f64>,
    /// The side from which a row's rigid walls pushed in the last step, as the sign of their force, 0 if none did; and the rows where it is not 0.
    last: Vec<f64>,
    pushed: Vec<usize>,
    frozen: u64,
}

impl MoreauJean {
    pub fn new(scene: &Scene, theta: f64, h: f64, backend: Backend) -> Result<Self> {
        let body = Body::new(scene, h);
        let ht = h * theta;
        let (a, drag) = body.theta_matrices(theta);
        let compliance = |k: f64, c: f64| 1.0 / (ht * ht * (k + c / ht));
        let programme = Programme::new(scene, a, scene.gap_scale() / h, compliance, backend)?;
        let (n, rows) = (body.n, programme.count_rows());
        Ok(Self {
            body,
            theta,
            drag,
            programme,
            b: vec![0.0; n],
            ahead: vec![0.0; n],
            last: vec![0.0; rows],
            pushed: Vec::with_capacity(scene.walls.len()),
            frozen: 0,
        })
    }

    /// Takes the motion up anew at `time` (s), from the frame's state.
    pub fn restart(&mut self, time: f64) {
        self.body.restart(time);
        for row in self.pushed.drain(..) {
            self.last[row] = 0.0;
        }
    }

    pub fn advance(&mut self, step: u64, frame: &mut Frame) -> Result<()> {
        let Self { body, theta, drag, b, .. } = self;
        let (h, theta) = (body.h, *theta);
        frame.begin(step, h);
        body.theta_momentum(theta, drag, frame, b);
        frame.blown = body.strike((frame.start, frame.end), &frame.v, 1.0, b, &mut frame.struck);
        self.bind(frame);
        self.programme.solve(&self.b, (frame.start, step), &mut frame.impulse, &mut frame.pushing)?;
        let blows = self.body.find_blows(&[(frame.start, frame.end, frame.end - h * theta)]);
        // What a rigid wall answers stays with the answer, which is known only when the walls have been asked without.
        let carried = blows && !self.body.answers(&frame.pushing);
        if carried && self.body.damped {
            frame.let_go();
            self.body.damp_shift(1.0, &mut self.b);
            self.programme.solve(&self.b, (frame.start, step), &mut frame.impulse, &mut frame.pushing)?;
        }
        let delta = self.programme.x();
        for ((q, v), d) in frame.q.iter_mut().zip(&mut frame.v).zip(delta) {
            *q += h * (*v + theta * d);
            *v += d;
        }
        frame.after.copy_from_slice(&frame.v);
        if carried {
            self.body.shift(&mut frame.q);
        }
        for &wall in &frame.pushing {
            frame.force[wall] = frame.impulse[wall] / h;
        }
        if !self.pushed.is_empty() || !frame.pushing.is_empty() {
            self.watch_freezing(frame);
        }
        Ok(())
    }

    /// The bounds of the rows, in δ.
    #[inline]
    fn bind(&mut self, frame: &Frame) {
        let (h, ht) = (self.body.h, self.body.h * self.theta);
        for ((ahead, q), v) in self.ahead.iter_mut().zip(&frame.q).zip(frame.struck()) {
            *ahead = q + 0.5 * h * v;
        }
        let programme = &mut self.programme;
        for row in 0..programme.count_rows() {
            let reach = programme.seen(row, &self.ahead);
            programme.free(row);
            if programme.is_clear(row, reach) {
                continue;
            }
            let (w, before) = (programme.seen(row, &frame.q), programme.seen(row, &frame.v));
            let struck = programme.seen(row, frame.struck());
            for seat in programme.seats(row) {
                let wall = programme.seat(seat).stop;
                match wall.law {
                    WallLaw::Elastic { stiffness, damping } => {
                        let stiff = stiffness + damping / ht;
                        let ahead = w + ht * before;
                        let offset = h * (stiffness * (ahead - wall.g) + damping * (ahead - wall.plate(w)) / ht);
                        programme.bind(row, seat, -offset / (ht * ht * stiff));
                    }
                    WallLaw::Rigid { restitution } if wall.depth(reach) >= -self.body.touch => {
                        let epsilon = if wall.sign * struck <= 0.0 { restitution } else { 1.0 };
                        programme.bind(row, seat, -(1.0 + epsilon) * struck + (struck - before));
                    }
                    _ => {}
                }
            }
        }
    }

    /// Counts a step in which the walls on opposite sides of one place took turns.
    fn watch_freezing(&mut self, frame: &Frame) {
        let row_of = |wall: usize| self.programme.row_of(wall);
        let frozen = frame.pushing.iter().any(|&wall| self.last[row_of(wall)] * frame.impulse[wall] < 0.0);
        for row in self.pushed.drain(..) {
            self.last[row] = 0.0;
        }
        for &wall in &frame.pushing {
            let row = row_of(wall);
            if self.programme.is_rigid(row) {
                self.last[row] = frame.impulse[wall].signum();
                self.pushed.push(row);
            }
        }
        self.frozen += u64::from(frozen);
    }

    pub fn backend(&self) -> Backend {
        self.programme.backend()
    }

    pub fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
        counters.frozen_steps = self.frozen;
    }
}
