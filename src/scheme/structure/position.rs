//! `implicit-euler` (θ = 1) and `newmark` (θ = ½) for several degrees of freedom: see the scalar kernel for the mathematics.
//!
//! A Δ = b + Gᵀ r⁺, A = M/(hθ)² + C/(hθ) + K, b = M v/hθ² + (1−θ)/θ (F + r + C v) + f⁺ − K q + J/hθ, over g_l ≤ G(q + Δ) ≤ g_u.

use super::body::Body;
use super::frame::Frame;
use super::programme::Programme;
use super::start::StartForce;
use crate::error::Result;
use crate::linear::Symmetric;
use crate::qp::Backend;
use crate::scene::{Scene, WallLaw};
use crate::scheme::Counters;

#[derive(Debug)]
pub(super) struct Position {
    body: Body,
    theta: f64,
    /// F + Gᵀ r at the step's start, N; kept where θ < 1 only.
    force: Vec<f64>,
    /// r of each wall at the step's start, N, and the walls where it is not zero.
    held: Vec<f64>,
    holding: Vec<usize>,
    programme: Programme,
    /// f⁺, and b.
    load: Vec<f64>,
    b: Vec<f64>,
}

impl Position {
    pub fn new(scene: &Scene, theta: f64, h: f64, backend: Backend, frame: &Frame) -> Result<Self> {
        let body = Body::new(scene, h);
        let StartForce { total: force, wall: held } = StartForce::new(scene, &body, &frame.q, &frame.v)?;
        let mut holding = Vec::with_capacity(held.len());
        holding.extend((0..held.len()).filter(|&wall| held[wall] != 0.0));
        let ht = h * theta;
        let m = &body.matrices;
        let a = Symmetric::sum(&[(1.0 / (ht * ht), &m.mass), (1.0 / ht, &m.damping), (1.0, &m.stiffness)]);
        let programme = Programme::new(scene, a, scene.gap_scale(), |k, c| 1.0 / (k + c / h), backend)?;
        let zero = vec![0.0; body.n];
        Ok(Self { body, theta, force, held, holding, programme, load: zero.clone(), b: zero })
    }

    /// Takes the motion up anew at `time` (s), from the frame's state.
    pub fn restart(&mut self, scene: &Scene, time: f64, frame: &Frame) -> Result<()> {
        self.body.restart(time);
        let StartForce { total, wall } = StartForce::new(scene, &self.body, &frame.q, &frame.v)?;
        self.holding.clear();
        self.holding.extend((0..wall.len()).filter(|&index| wall[index] != 0.0));
        (self.force, self.held) = (total, wall);
        Ok(())
    }

    pub fn advance(&mut self, step: u64, frame: &mut Frame) -> Result<()> {
        let Self { body, theta, force, load, b, .. } = self;
        let (h, theta) = (body.h, *theta);
        let (ht, rest) = (h * theta, (1.0 - theta) / theta);
        frame.begin(step, h);
        load.fill(0.0);
        body.loads.add_force(frame.end, 1.0, load);
        // The extra force is constant over the step: it enters F as well as F⁺.
        for (i, b) in b.iter_mut().enumerate() {
            *b = rest * (force[i] + frame.extra[i]) + load[i] + frame.extra[i];
        }
        body.mass.add_product(1.0 / (ht * theta), &frame.v, b);
        if rest != 0.0 {
            body.damping.add_product(rest, &frame.v, b);
        }
        body.stiffness.add_product(-1.0, &frame.q, b);
        frame.before.copy_from_slice(&frame.v);
        body.strike((frame.start, frame.end), &frame.v, 1.0 / ht, b, &mut frame.struck);
        // The rigid walls hold the structure where the blows leave it, and the damper feels the way there.
        let blown = body.find_blows(&[(frame.start, frame.end, frame.end - ht)]);
        if blown {
            body.damp_shift(1.0 / ht, b);
        }
        self.bind(frame, blown);
        self.programme.solve(&self.b, (frame.start, step), &mut frame.force, &mut frame.pushing)?;
        for ((q, v), d) in frame.q.iter_mut().zip(&mut frame.v).zip(self.programme.x()) {
            *q += d;
            *v = (d / h - (1.0 - theta) * *v) / theta;
        }
        if blown {
            self.body.shift(&mut frame.q);
        }
        frame.after.copy_from_slice(&frame.v);
        if !frame.pushing.is_empty() || !self.holding.is_empty() {
            self.average(frame);
        }
        if rest != 0.0 {
            self.force.copy_from_slice(&self.load);
            self.body.damping.add_product(-1.0, &frame.v, &mut self.force);
            self.body.stiffness.add_product(-1.0, &frame.q, &mut self.force);
            for &wall in &frame.pushing {
                self.body.rows.add_transposed(wall, frame.force[wall], &mut self.force);
            }
        }
        Ok(())
    }

    /// The impulses p = h[(1−θ) r + θ r⁺] of the walls that push at either end.
    fn average(&mut self, frame: &mut Frame) {
        let (h, theta) = (self.body.h, self.theta);
        let now = frame.pushing.len();
        for wall in self.holding.drain(..) {
            let p = h * (1.0 - theta) * self.held[wall];
            self.held[wall] = 0.0;
            frame.impulse[wall] = p;
            if p != 0.0 && frame.force[wall] == 0.0 {
                frame.pushing.push(wall);
            }
        }
        for &wall in &frame.pushing[..now] {
            frame.impulse[wall] += h * theta * frame.force[wall];
            self.held[wall] = frame.force[wall];
            self.holding.push(wall);
        }
    }

    /// The bounds of the rows, in Δ.
    fn bind(&mut self, frame: &Frame, blown: bool) {
        let (h, programme) = (self.body.h, &mut self.programme);
        for row in 0..programme.count_rows() {
            let w = programme.seen(row, &frame.q);
            let shift = if blown { programme.seen(row, &self.body.shift) } else { 0.0 };
            programme.free(row);
            for seat in programme.seats(row) {
                let wall = programme.seat(seat).stop;
                let bound = match wall.law {
                    // |r| = k_a s⁺ + c_a(s⁺ − s₊)/h, written in Δ.
                    WallLaw::Elastic { stiffness, damping } => {
                        let offset = stiffness * (w - wall.g) + damping * (w - wall.plate(w)) / h;
                        -offset / (stiffness + damping / h)
                    }
                    _ => wall.g - w - shift,
                };
                programme.bind(row, seat, bound);
            }
        }
    }

    pub fn backend(&self) -> Backend {
        self.programme.backend()
    }

    pub fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
    }
}
