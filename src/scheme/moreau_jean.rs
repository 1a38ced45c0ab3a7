//! `moreau-jean`: the impact law on the velocity, for the walls the body is about to reach.
//!
//! Jean 1999, Comput. Methods Appl. Mech. Engrg. 177, doi:10.1016/S0045-7825(98)00383-1; Acary & Brogliato 2008, doi:10.1007/978-3-540-75392-6,
//! ch. 10. With v⁺ = v + δ, v_θ = v + θδ, q⁺ = q + h v_θ,
//!
//! M δ = h[f_θ − C v_θ − K(q + hθ v_θ)] + J − C d + p
//!
//! is the optimality condition A δ = b + p of
//!
//! minimise ½ A δ² − b δ   subject to   ẇ⁺ + ε ẇ ≤ 0 (upper), ≥ 0 (lower),    A = M + hθC + h²θ²K,
//!
//! with J the load impulses in the step and d what they add to the displacement beside the rule for it (see [`crate::step::Balance`]),
//! over the walls that q + ½h v reaches, with ε = e where the body approaches or rests, 1 where it separates; in both the velocity ẇ is that
//! after the blow J/M of the step, so that a body struck at rest on a wall rebounds like one that arrives.
//! With θ = ½, e = 1, no damping and no load the energy is conserved exactly.
//!
//! No wall acts on the displacement: a body that comes to rest on one stays as deep behind it as its last impact left it, by up to
//! ½h times the speed of arrival, and while it stays the force is that of its place: smaller by k times that depth than at the face, for a
//! spring k that the body hangs on. To lift it to the face takes work, which would be energy from nowhere to this rule.

use super::grid::{Counters, Frame, Scalar};
use super::programme::{FREE, Programme, compliances, elastic_row};
use crate::error::Result;
use crate::qp::{Backend, ScalarRow};
use crate::scene::{Scene, WallLaw};

#[derive(Debug)]
pub(super) struct MoreauJean {
    s: Scalar,
    theta: f64,
    q: f64,
    v: f64,
    /// f(t) at the step's start, N.
    load: f64,
    programme: Programme,
    /// The open interval, m: a body that reaches no further meets no wall. Empty with an elastic wall, whose spring
    /// decides for itself.
    clear: (f64, f64),
    /// Side (sign of its force) of the rigid wall that pushed in the last step; 0 if none did.
    last_side: f64,
    frozen: u64,
}

impl MoreauJean {
    pub fn new(scene: &Scene, theta: f64, h: f64, backend: Backend) -> Result<Self> {
        let s = Scalar::new(scene, h);
        let (q, v) = s.start(scene);
        let ht = h * theta;
        let a = s.m + ht * s.c + ht * ht * s.k;
        let rows = compliances(&s, |k, c| ht * ht * (k + c / ht));
        let programme = Programme::new(a, scene.gap_scale() / h, &rows, backend)?;
        let load = s.forcing.force(0.0);
        let clear = s.clear();
        Ok(Self { s, theta, q, v, load, programme, clear, last_side: 0.0, frozen: 0 })
    }

    /// Takes the motion up anew at `time` (s).
    pub fn restart(&mut self, time: f64, q: f64, v: f64) {
        (self.q, self.v, self.load) = (q, v, self.s.forcing.force(time));
        self.last_side = 0.0;
    }

    pub fn advance(&mut self, step: u64, extra: f64, frame: &mut Frame) -> Result<()> {
        let s = &self.s;
        let (h, theta) = (s.h, self.theta);
        let (start, end) = (step as f64 * h, (step + 1) as f64 * h);
        // Before the state is read: no number has to outlive the call of a sine.
        let load_end = s.forcing.force(end);
        let blows = s.forcing.impulse(start, end);
        let (q, v) = (self.q, self.v);
        let load = (1.0 - theta) * self.load + theta * load_end + extra;
        let b = h * (load - s.c * v - s.k * (q + h * theta * v)) + blows;
        // A blow comes first, and the wall answers the velocity it leaves.
        let struck = s.struck(v, blows);
        let reach = q + 0.5 * h * struck;
        frame.clear();
        let mut delta = if reach > self.clear.0 && reach < self.clear.1 {
            self.last_side = 0.0;
            self.programme.free(b)
        } else {
            self.meet(step, b, struck, frame)?
        };
        let mut q_end = q + h * (v + theta * delta);
        if let Some(blows) = self.s.blows(&[(start, end, end - h * theta)]) {
            let shift;
            (delta, shift) = self.carry(step, (b, delta), struck, blows, frame)?;
            q_end = q + h * (v + theta * delta) + shift;
        }
        let v_end = v + delta;
        (self.q, self.v, self.load) = (q_end, v_end, load_end);
        frame.arrive(start, end, v, q_end, v_end);
        frame.struck[0] = struck;
        frame.check(step)
    }

    /// The same step where its `blows` take the body beside the rule, and so do what the damper feels: δ, and how far (m). What a rigid wall
    /// answers stays as it is, which is known only when the walls have been asked without.
    #[inline(never)]
    fn carry(
        &mut self,
        step: u64,
        (b, delta): (f64, f64),
        struck: f64,
        blows: (f64, f64),
        frame: &mut Frame,
    ) -> Result<(f64, f64)> {
        let Some(shift) = self.s.carried(Some(blows), frame) else { return Ok((delta, 0.0)) };
        if self.s.c == 0.0 {
            return Ok((delta, shift));
        }
        frame.clear();
        Ok((self.meet(step, b - self.s.c * shift, struck, frame)?, shift))
    }

    /// δ of a step that may meet a wall, whose impulses it writes. Out of line: most steps are none.
    #[inline(never)]
    fn meet(&mut self, step: u64, b: f64, struck: f64, frame: &mut Frame) -> Result<f64> {
        let s = &self.s;
        let (h, q, v) = (s.h, self.q, self.v);
        let ht = h * self.theta;
        let reach = q + 0.5 * h * struck;
        for (row, wall) in self.programme.rows.iter_mut().zip(&s.walls) {
            *row = match wall.law {
                WallLaw::Elastic { stiffness, damping } => {
                    // p = −h[k_a(w_θ − g) + c_a(w_θ − plate)/θh] with w_θ = q + hθ v + hθ²δ.
                    let stiff = stiffness + damping / ht;
                    let offset = h * (stiffness * (q + ht * v - wall.g) + damping * (q + ht * v - wall.plate(q)) / ht);
                    elastic_row(wall.upper, ht * ht * stiff, offset)
                }
                WallLaw::Rigid { restitution } if wall.depth(reach) >= -s.touch => {
                    let epsilon = if wall.sign * struck <= 0.0 { restitution } else { 1.0 };
                    let bound = -(1.0 + epsilon) * struck + (struck - v);
                    let (lo, hi) = if wall.upper { (f64::NEG_INFINITY, bound) } else { (bound, f64::INFINITY) };
                    ScalarRow { lo, hi, compliance: 0.0 }
                }
                _ => FREE,
            };
        }
        let mut delta = self.programme.free(b);
        let mut side = 0.0;
        if !self.programme.admits(delta) {
            delta = self.programme.solve(b, step as f64 * h, step)?;
            for (i, &p) in self.programme.multiplier.iter().enumerate() {
                frame.impulse[i] = p;
                frame.force[i] = p / h;
                if p != 0.0 && s.walls[i].law.is_rigid() {
                    side = p.signum();
                }
            }
            frame.touched = true;
            if side * self.last_side < 0.0 {
                self.frozen += 1;
            }
        }
        self.last_side = side;
        Ok(delta)
    }

    pub fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
        counters.frozen_steps = self.frozen;
    }
}
