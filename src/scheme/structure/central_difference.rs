//! `penalty` with the `central-difference` integrator for several degrees of freedom: see the scalar kernel for the mathematics.
//!
//! (M/h + C/2)(v₊ − v₋) = f − C v₋ − K q + J/h + Gᵀ r, where r is known but for the walls' dashpots, which feel the mean of v₋ and v₊.

use super::arrival::{Arrival, back};
use super::body::Body;
use super::factor::factor;
use super::frame::Frame;
use super::newton::{Answer, Walls};
use super::paoli_schatzman::centre;
use super::start::StartForce;
use crate::error::{Error, Result};
use crate::linear::{Factor, Symmetric};
use crate::scene::{Scene, WallLaw};
use crate::scheme::paoli_schatzman::count_span;

#[derive(Debug)]
pub(super) struct CentralDifference {
    body: Body,
    /// v₋ = (q − q⁻)/h, m/s.
    v: Vec<f64>,
    load: Vec<f64>,
    /// The caller's extra force in the last step, N; 0 before the first.
    extra: Vec<f64>,
    /// M/h + C/2.
    factor: Factor,
    /// The walls' velocities after the step as functions of their forces; none without dashpots.
    dashpots: Option<Walls>,
    arrival: Arrival,
    /// The right-hand side, then v₊ − v₋.
    b: Vec<f64>,
    change: Vec<f64>,
}

impl CentralDifference {
    pub fn new(scene: &Scene, h: f64, frame: &Frame) -> Result<Self> {
        let body = Body::new(scene, h);
        let start = StartForce::new(scene, &body, &frame.q, &frame.v)?;
        let v = back(&body, &frame.v, &start.total)?;
        let m = &body.matrices;
        let mut factor = factor(&Symmetric::sum(&[(1.0 / h, &m.mass), (0.5, &m.damping)]))?;
        let damped = body.walls.iter().any(|wall| dashpot(&wall.law) > 0.0);
        let dashpots = damped.then(|| Walls::new(&mut factor, &body.rows, 1.0));
        let arrival = Arrival::new(scene, &body)?;
        let zero = vec![0.0; body.n];
        let mut load = zero.clone();
        body.loads.add_force(0.0, 1.0, &mut load);
        Ok(Self { body, v, load, extra: zero.clone(), factor, dashpots, arrival, b: zero.clone(), change: zero })
    }

    /// Takes the motion up anew at `time` (s), as from a start in the frame's state.
    pub fn restart(&mut self, scene: &Scene, time: f64, frame: &Frame) -> Result<()> {
        self.body.restart(time);
        let start = StartForce::new(scene, &self.body, &frame.q, &frame.v)?;
        self.v = back(&self.body, &frame.v, &start.total)?;
        self.load.fill(0.0);
        self.body.loads.add_force(time, 1.0, &mut self.load);
        self.extra.fill(0.0);
        Ok(())
    }

    pub fn advance(&mut self, step: u64, frame: &mut Frame) -> Result<()> {
        let Self { body, v, load, extra, factor, dashpots, arrival, b, change } = self;
        let h = body.h;
        frame.begin(step, h);
        centre(extra, &mut frame.extra);
        b.iter_mut().enumerate().for_each(|(i, b)| *b = load[i] + frame.extra[i]);
        body.stiffness.add_product(-1.0, &frame.q, b);
        body.damping.add_product(-1.0, v, b);
        body.strike_about(step, v, 1.0 / h, b, &mut frame.struck);
        if body.find_blows(&[count_span(step, h)]) {
            body.damp_shift(1.0 / h, b);
        }
        frame.before.copy_from_slice(v);
        let depth = |body: &Body, wall: usize| body.walls[wall].depth(body.rows.dot(wall, &frame.q));
        if (0..body.walls.len()).any(|wall| depth(body, wall) > 0.0) {
            if let Some(dashpots) = dashpots {
                change.copy_from_slice(b);
                factor.solve(change);
                for wall in 0..body.walls.len() {
                    dashpots.free[wall] = body.rows.dot(wall, v) + body.rows.dot(wall, change);
                }
                let law = |wall: usize, after: f64| {
                    let (stop, depth) = (body.walls[wall], depth(body, wall));
                    let rate = -stop.sign * 0.5 * (body.rows.dot(wall, &frame.before) + after);
                    let pressure = stop.law.pressure(depth, 0.0) + dashpot(&stop.law) * rate;
                    // A wall found to pull lets go.
                    let holds = depth > 0.0 && pressure > 0.0;
                    let (force, slope) =
                        if holds { (stop.sign * pressure, 0.5 * dashpot(&stop.law)) } else { (0.0, 0.0) };
                    Answer { force, slope, noise: 0.0 }
                };
                let solved = dashpots.solve(law);
                solved.map_err(|residual| Error::Newton { time: frame.start, step, residual })?;
                frame.force.copy_from_slice(&dashpots.force);
            } else {
                for (wall, force) in frame.force.iter_mut().enumerate() {
                    *force = body.walls[wall].sign * body.walls[wall].law.pressure(depth(body, wall), 0.0);
                }
            }
            frame.push_by_force(h);
            body.push(1.0, &frame.force, b);
        }
        factor.solve(b);
        for ((q, v), d) in frame.q.iter_mut().zip(v.iter_mut()).zip(b.iter()) {
            *v += d;
            *q += h * *v;
        }
        arrival.finish(body, step, v, (load, extra), frame)
    }
}

/// c_a, N s/m; 0 for a wall without a dashpot.
fn dashpot(law: &WallLaw) -> f64 {
    if let WallLaw::Elastic { damping, .. } = *law { damping } else { 0.0 }
}
