//! `moreau-jean` for several degrees of freedom: see the scalar kernel for the mathematics.
//!
//! A δ = b + Gᵀ p, A = M + hθC + h²θ²K, b = h[f_θ − (C + hθK) v − K q] + J, over the rows of the walls that q + ½hv reaches.

use super::body::Body;
use super::frame::Frame;
use super::programme::Programme;
use crate::error::Result;
use crate::linear::{Operator, Symmetric};
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
    /// Whether a row's rigid walls pushed in the last step, and from which side: the sign of their force.
    last: Vec<f64>,
    pushed: bool,
    frozen: u64,
}

impl MoreauJean {
    pub fn new(scene: &Scene, theta: f64, h: f64, backend: Backend) -> Result<Self> {
        let body = Body::new(scene, h);
        let ht = h * theta;
        let m = &body.matrices;
        let a = Symmetric::sum(&[(1.0, &m.mass), (ht, &m.damping), (ht * ht, &m.stiffness)]);
        let drag = Operator::new(&Symmetric::sum(&[(1.0, &m.damping), (ht, &m.stiffness)]));
        let compliance = |k: f64, c: f64| 1.0 / (ht * ht * (k + c / ht));
        let programme = Programme::new(scene, a, scene.gap_scale() / h, compliance, backend)?;
        let (n, rows) = (body.n, programme.places.len());
        Ok(Self { body, theta, drag, programme, b: vec![0.0; n], last: vec![0.0; rows], pushed: false, frozen: 0 })
    }

    pub fn advance(&mut self, step: u64, frame: &mut Frame) -> Result<()> {
        let Self { body, theta, drag, b, .. } = self;
        let (h, theta) = (body.h, *theta);
        frame.begin(step, h);
        b.iter_mut().zip(&frame.extra).for_each(|(b, extra)| *b = h * extra);
        body.loads.add_force(frame.start, h * (1.0 - theta), b);
        body.loads.add_force(frame.end, h * theta, b);
        drag.add_product(-h, &frame.v, b);
        body.stiffness.add_product(-h, &frame.q, b);
        frame.before.copy_from_slice(&frame.v);
        frame.blown = body.strike((frame.start, frame.end), &frame.v, 1.0, b, &mut frame.struck);
        self.bind(frame);
        let body = &self.body;
        let upper = |wall: usize| body.walls[wall].upper;
        let touched = self.programme.solve(&self.b, frame.start, step, upper, &mut frame.impulse)?;
        let delta = self.programme.x();
        for ((q, v), d) in frame.q.iter_mut().zip(&mut frame.v).zip(delta) {
            *q += h * (*v + theta * d);
            *v += d;
        }
        frame.after.copy_from_slice(&frame.v);
        frame.touched = touched;
        if touched {
            frame.force.iter_mut().zip(&frame.impulse).for_each(|(f, p)| *f = p / h);
        }
        if touched || self.pushed {
            self.watch_freezing(&frame.impulse);
        }
        Ok(())
    }

    /// The bounds of the rows, in δ.
    #[inline]
    fn bind(&mut self, frame: &Frame) {
        let (h, ht) = (self.body.h, self.body.h * self.theta);
        for row in 0..self.programme.places.len() {
            let (w, before) = (self.programme.rows.dot(row, &frame.q), self.programme.rows.dot(row, &frame.v));
            let struck = if frame.blown { self.programme.rows.dot(row, &frame.struck) } else { before };
            let reach = w + 0.5 * h * struck;
            self.programme.free(row);
            for seat in 0..self.programme.places[row].walls.len() {
                let index = self.programme.places[row].walls[seat];
                let wall = self.body.walls[index];
                match wall.law {
                    WallLaw::Elastic { stiffness, damping } => {
                        let stiff = stiffness + damping / ht;
                        let ahead = w + ht * before;
                        let offset = h * (stiffness * (ahead - wall.g) + damping * (ahead - wall.plate(w)) / ht);
                        self.programme.bound(row, index, wall.upper, -offset / (ht * ht * stiff));
                    }
                    WallLaw::Rigid { restitution } if wall.depth(reach) >= -self.body.touch => {
                        let epsilon = if wall.sign * struck <= 0.0 { restitution } else { 1.0 };
                        let bound = -(1.0 + epsilon) * struck + (struck - before);
                        self.programme.bound(row, index, wall.upper, bound);
                    }
                    _ => {}
                }
            }
        }
    }

    /// Counts a step in which the walls on opposite sides of one place took turns.
    fn watch_freezing(&mut self, impulse: &[f64]) {
        self.pushed = false;
        let mut frozen = false;
        for (place, last) in self.programme.places.iter().zip(&mut self.last) {
            let push: f64 = if place.rigid { place.walls.iter().map(|&wall| impulse[wall]).sum() } else { 0.0 };
            let side = if push == 0.0 { 0.0 } else { push.signum() };
            frozen |= side * *last < 0.0;
            self.pushed |= side != 0.0;
            *last = side;
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
