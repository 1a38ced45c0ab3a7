//! `paoli-schatzman` for several degrees of freedom: see the scalar kernel for the mathematics.
//!
//! A Δ = b + Gᵀ r, A = M/h² + C/2h + K/4, b = M v₋/h − ½C v₋ − K(q − ¼h v₋) + f + J/h, over
//! (1+e_l)g_l − e_l w⁻ ≤ w⁺ ≤ (1+e_u)g_u − e_u w⁻ with w = G q.
//!
//! Where e differs between walls on rows that depend on one another (two masses and their distance), and one of them is penetrated, these
//! bounds may contradict. With one e they never do, since q⁺ = (1+e)q_a − e q⁻ keeps them for every admissible q_a: such a step is made
//! with the smallest e for all walls.

use super::arrival::{Arrival, back};
use super::body::Body;
use super::frame::Frame;
use super::programme::Programme;
use super::start::StartForce;
use crate::error::{Error, Result};
use crate::linear::Symmetric;
use crate::qp::Backend;
use crate::scene::{Scene, WallLaw};
use crate::scheme::Counters;
use crate::scheme::paoli_schatzman::count_span;

#[derive(Debug)]
pub(super) struct PaoliSchatzman {
    body: Body,
    /// v₋ = (q − q⁻)/h, m/s.
    v: Vec<f64>,
    /// f(t) at the step's start, N.
    load: Vec<f64>,
    /// The caller's extra force in the last step, N; 0 before the first.
    extra: Vec<f64>,
    /// Of each row: true if its rigid walls differ in e, so that their bounds could cross.
    unequal: Vec<bool>,
    /// The smallest e of all rigid walls, if they differ.
    least: Option<f64>,
    programme: Programme,
    arrival: Arrival,
    b: Vec<f64>,
    /// q − ¼h v₋, m.
    mean: Vec<f64>,
}

impl PaoliSchatzman {
    pub fn new(scene: &Scene, h: f64, backend: Backend, frame: &Frame) -> Result<Self> {
        let body = Body::new(scene, h);
        // Without the walls' reaction a body at rest on a wall with e = 1 would bounce.
        let start = StartForce::new(scene, &body, &frame.q, &frame.v)?;
        let v = back(&body, &frame.v, &start.total)?;
        let m = &body.matrices;
        let a = Symmetric::sum(&[(1.0 / (h * h), &m.mass), (0.5 / h, &m.damping), (0.25, &m.stiffness)]);
        let compliance = |k: f64, c: f64| 1.0 / (0.25 * k + 0.5 * c / h);
        let programme = Programme::new(scene, a, scene.gap_scale(), compliance, backend)?;
        let differ = |row: usize| {
            let mut rigid = programme.seats(row).filter_map(|seat| programme.seat(seat).stop.law.restitution());
            rigid.next().is_some_and(|first| rigid.any(|e| e != first))
        };
        let unequal = (0..programme.count_rows()).map(differ).collect();
        let rigid = || body.walls.iter().filter_map(|wall| wall.law.restitution());
        let (least, most) = (rigid().reduce(f64::min), rigid().reduce(f64::max));
        let least = if least == most { None } else { least };
        let arrival = Arrival::new(scene, &body)?;
        let zero = vec![0.0; body.n];
        let mut load = zero.clone();
        body.loads.add_force(0.0, 1.0, &mut load);
        Ok(Self { body, v, load, extra: zero.clone(), unequal, least, programme, arrival, b: zero.clone(), mean: zero })
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
        let h = self.body.h;
        frame.begin(step, h);
        let Self { body, v, load, extra, b, mean, .. } = self;
        centre(extra, &mut frame.extra);
        for i in 0..b.len() {
            b[i] = load[i] + frame.extra[i];
            mean[i] = frame.q[i] - 0.25 * h * v[i];
        }
        body.mass.add_product(1.0 / h, v, b);
        body.damping.add_product(-0.5, v, b);
        body.stiffness.add_product(-1.0, mean, b);
        // A blow comes first, and the wall answers the velocity it leaves: q⁻ in the bound is where that would have come from.
        frame.blown = body.strike_about(step, v, 1.0 / h, b, &mut frame.struck);
        frame.before.copy_from_slice(v);
        self.settle(step, frame)?;
        // What a rigid wall answers the damper does not feel, which is known only when the walls have been asked without.
        let blows = self.body.find_blows(&[count_span(step, h)]);
        if blows && self.body.damped && !self.body.answers(&frame.pushing) {
            frame.let_go();
            self.body.damp_shift(1.0 / h, &mut self.b);
            self.settle(step, frame)?;
        }
        let Self { body, v, load, extra, programme, arrival, .. } = self;
        for &wall in &frame.pushing {
            frame.impulse[wall] = h * frame.force[wall];
        }
        for ((q, v), d) in frame.q.iter_mut().zip(v.iter_mut()).zip(programme.x()) {
            *q += d;
            *v = d / h;
        }
        arrival.finish(body, step, v, (load, extra), frame)
    }

    /// Solves for Δ, and the walls' forces.
    fn settle(&mut self, step: u64, frame: &mut Frame) -> Result<()> {
        self.bind(frame, None);
        frame.one_restitution = false;
        let at = (frame.start, step);
        let solved = self.programme.solve(&self.b, at, &mut frame.force, &mut frame.pushing);
        if let (Err(Error::Qp { .. }), Some(least)) = (&solved, self.least) {
            self.bind(frame, Some(least));
            frame.one_restitution = true;
            return self.programme.solve(&self.b, at, &mut frame.force, &mut frame.pushing);
        }
        solved
    }

    /// The bounds of the rows, in Δ, with the restitution `one` for all rigid walls or the own of each.
    fn bind(&mut self, frame: &Frame, one: Option<f64>) {
        let h = self.body.h;
        for row in 0..self.programme.count_rows() {
            let (w, before) = (self.programme.seen(row, &frame.q), self.programme.seen(row, &frame.before));
            let struck = if frame.blown { self.programme.seen(row, &frame.struck) } else { before };
            let shared = if self.unequal[row] { self.shared_restitution(row, w - h * struck) } else { None };
            self.programme.free(row);
            for seat in self.programme.seats(row) {
                let wall = self.programme.seat(seat).stop;
                let bound = match wall.law {
                    WallLaw::Elastic { stiffness, damping } => {
                        // |r| = k_a s̄ + c_a(s⁺ − s⁻₊)/2h, written in Δ.
                        let plate = wall.plate(w - h * before);
                        let offset = stiffness * (w - 0.25 * h * before - wall.g) + 0.5 * damping * (w - plate) / h;
                        -offset / (0.25 * stiffness + 0.5 * damping / h)
                    }
                    _ => {
                        let e = one.or(shared).or(wall.law.restitution()).unwrap_or(0.0);
                        (1.0 + e) * (wall.g - w) + e * h * struck
                    }
                };
                self.programme.bind(row, seat, bound);
            }
        }
    }

    /// The smallest e of the rigid walls of a row, if with its own e for each the bounds of a lower and an upper one would cross, `back` being w⁻.
    fn shared_restitution(&self, row: usize, back: f64) -> Option<f64> {
        let (mut lo, mut hi, mut least) = (f64::NEG_INFINITY, f64::INFINITY, 1.0_f64);
        for seat in self.programme.seats(row) {
            let wall = self.programme.seat(seat).stop;
            let Some(e) = wall.law.restitution() else { continue };
            let bound = (1.0 + e) * wall.g - e * back;
            (lo, hi) = if wall.upper { (lo, hi.min(bound)) } else { (lo.max(bound), hi) };
            least = least.min(e);
        }
        (lo > hi).then_some(least)
    }

    pub fn backend(&self) -> Backend {
        self.programme.backend()
    }

    pub fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
    }
}

/// Puts the extra force over t ± ½h in place of the step's own in `felt`, which `last` keeps for the next step. At t = 0 the first half acts before the
/// start, on nothing.
pub(super) fn centre(last: &mut [f64], felt: &mut [f64]) {
    for (last, felt) in last.iter_mut().zip(felt) {
        let extra = *felt;
        *felt = 0.5 * (*last + extra);
        *last = extra;
    }
}
