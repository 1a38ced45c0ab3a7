//! `implicit-euler` (θ = 1) and `newmark` (β = ¼, γ = ½, that is θ = ½): the wall as a bound on the displacement at t⁺.
//!
//! With q⁺ = q + Δ, v⁺ = (Δ/h − (1−θ)v)/θ and F = f − C v − K q, the balance
//!
//! M(v⁺ − v) = h[(1−θ)(F + r) + θ(F⁺ + r⁺)] + J − C d
//!
//! with J the load impulses in the step and d what they add to the displacement beside the rule for it (see [`crate::step::Balance`]),
//! is, divided by hθ, the optimality condition A Δ = b + r⁺ of
//!
//! minimise ½ A Δ² − b Δ   subject to   g_l ≤ q + Δ ≤ g_u,    A = M/(hθ)² + C/(hθ) + K.
//!
//! θ = ½ is Newmark's average-acceleration rule (Newmark 1959, J. Eng. Mech. Div. ASCE 85(3)) with the constraint at t⁺:
//! it returns a restitution between 1/3 and 3 by chance of the phase and gains energy. It is here to be looked at.
//! θ = 1 returns e = 0 whatever the wall says.

use super::grid::{Counters, Frame, Scalar, StartForce};
use super::programme::{Programme, compliances, elastic_row};
use crate::error::Result;
use crate::qp::{Backend, ScalarRow};
use crate::scene::{Scene, WallLaw};

#[derive(Debug)]
pub(super) struct Position {
    s: Scalar,
    theta: f64,
    q: f64,
    v: f64,
    /// F + r at the step's start, N.
    force: f64,
    /// r of each wall at the step's start, N, and whether any is not zero.
    held: Vec<f64>,
    holds: bool,
    programme: Programme,
}

impl Position {
    pub fn new(scene: &Scene, theta: f64, h: f64, backend: Backend) -> Result<Self> {
        let s = Scalar::new(scene, h);
        let (q, v) = s.start(scene);
        let StartForce { total: force, wall: held } = s.start_force(q, v);
        let holds = held.iter().any(|&r| r != 0.0);
        let ht = h * theta;
        let a = s.m / (ht * ht) + s.c / ht + s.k;
        let programme = Programme::new(a, scene.gap_scale(), &compliances(&s, |k, c| k + c / h), backend)?;
        Ok(Self { s, theta, q, v, force, held, holds, programme })
    }

    /// Takes the motion up anew at `time` (s).
    pub fn restart(&mut self, time: f64, q: f64, v: f64) {
        self.s.since = time;
        let StartForce { total, wall } = self.s.start_force(q, v);
        (self.q, self.v, self.force) = (q, v, total);
        self.holds = wall.iter().any(|&r| r != 0.0);
        self.held = wall;
    }

    #[inline]
    pub fn advance(&mut self, step: u64, extra: f64, frame: &mut Frame) -> Result<()> {
        let s = &self.s;
        let (h, theta) = (s.h, self.theta);
        let (ht, rest) = (h * theta, (1.0 - theta) / theta);
        let (start, end) = (step as f64 * h, (step + 1) as f64 * h);
        let f = s.forcing.force(end) + extra;
        let blow = s.forcing.impulse(start, end);
        let (q, v) = (self.q, self.v);
        // The extra force is constant over the step: it enters F as well as F⁺.
        let before = self.force + extra;
        // The walls hold the body where the blows leave it, and the damper feels the way there.
        let shift = s.blows(&[(start, end, end - ht)]).map_or(0.0, |(shift, _)| shift);
        let b = s.m * v / (ht * theta) + rest * (before + s.c * v) + f - s.k * q + (blow - s.c * shift) / ht;
        let ahead = q + shift;
        for (row, wall) in self.programme.rows.iter_mut().zip(&s.walls) {
            *row = match wall.law {
                // |r| = k_a s⁺ + c_a(s⁺ − s₊)/h, written in Δ.
                WallLaw::Elastic { stiffness, damping } => {
                    let offset = stiffness * (q - wall.g) + damping * (q - wall.plate(q)) / h;
                    elastic_row(wall.upper, stiffness + damping / h, offset)
                }
                _ if wall.upper => ScalarRow { hi: wall.g - ahead, lo: f64::NEG_INFINITY, compliance: 0.0 },
                _ => ScalarRow { lo: wall.g - ahead, hi: f64::INFINITY, compliance: 0.0 },
            };
        }
        frame.clear();
        let mut delta = self.programme.free(b);
        let mut reaction = 0.0;
        let mut q_end = ahead + delta;
        let meets = !self.programme.admits(delta);
        if meets {
            delta = self.programme.solve(b, start, step)?;
            frame.force.copy_from_slice(&self.programme.multiplier);
            q_end = ahead + delta;
            for (wall, &r) in s.walls.iter().zip(&frame.force) {
                reaction += r;
                // On a rigid wall means on it: q + (g − q) may miss g by the last bit.
                if r != 0.0 && wall.law.is_rigid() {
                    q_end = wall.g;
                }
            }
        }
        if meets || self.holds {
            // p = h[(1−θ) r + θ r⁺]
            for ((p, held), &r) in frame.impulse.iter_mut().zip(&mut self.held).zip(&frame.force) {
                *p = h * ((1.0 - theta) * *held + theta * r);
                *held = r;
            }
            frame.touched = true;
            self.holds = meets;
        }
        let v_end = (delta / h - (1.0 - theta) * v) / theta;
        self.force = f - extra - s.c * v_end - s.k * q_end + reaction;
        (self.q, self.v) = (q_end, v_end);
        frame.arrive(start, end, v, q_end, v_end);
        frame.check(step)
    }

    pub fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
    }
}
