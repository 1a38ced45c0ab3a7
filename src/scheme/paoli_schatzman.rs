//! `paoli-schatzman`: central differences with the restitution written into the bound.
//!
//! Paoli & Schatzman 2002, SIAM J. Numer. Anal. 40(2), doi:10.1137/S003614290037873X. With q⁺ = q + Δ and q⁻ = q − h v₋,
//!
//! M(Δ/h − v₋)/h + C(Δ/h + v₋)/2 + K(¼q⁻ + ½q + ¼q⁺) = f(t) + r        (blows: see [`crate::step::Balance`])
//!
//! is the optimality condition A Δ = b + r of
//!
//! minimise ½ A Δ² − b Δ   subject to   (1+e_l)g_l − e_l q⁻ ≤ q⁺ ≤ (1+e_u)g_u − e_u q⁻,    A = M/h² + C/2h + K/4.
//!
//! The multiplier r is the force at t. The velocity between the grid's instants is what the scheme carries: v₋ and
//! v₊ = Δ/h; without walls it is the trapezoidal rule on the half steps, so it conserves their energy.

use super::grid::{Counters, Frame, Scalar, StartForce};
use super::programme::{Programme, compliances, elastic_row};
use crate::error::Result;
use crate::qp::{Backend, ScalarRow};
use crate::scene::{Scene, WallLaw};

#[derive(Debug)]
pub(super) struct PaoliSchatzman {
    s: Scalar,
    q: f64,
    /// v₋ = (q − q⁻)/h, m/s.
    v: f64,
    /// f(t) at the step's start, N.
    load: f64,
    /// The caller's extra force in the last step, N; 0 before the first.
    extra: f64,
    /// True if rigid walls differ in e, so that their bounds could cross.
    unequal: bool,
    programme: Programme,
}

impl PaoliSchatzman {
    pub fn new(scene: &Scene, h: f64, backend: Backend) -> Result<Self> {
        let s = Scalar::new(scene, h);
        let (q, v0) = s.start(scene);
        // q⁻ = q − h v + ½h² a with the wall's reaction in a: without it a body at rest on a wall with e = 1 would bounce.
        let StartForce { total, .. } = s.start_force(q, v0);
        let v = back(&s, v0, total);
        let a = s.m / (h * h) + 0.5 * s.c / h + 0.25 * s.k;
        let rows = compliances(&s, |k, c| 0.25 * k + 0.5 * c / h);
        let programme = Programme::new(a, scene.gap_scale(), &rows, backend)?;
        let load = s.forcing.force(0.0);
        let unequal = unequal(&s);
        Ok(Self { s, q, v, load, extra: 0.0, unequal, programme })
    }

    /// Takes the motion up anew at `time` (s), as from a start there.
    pub fn restart(&mut self, time: f64, q: f64, v: f64) {
        self.s.since = time;
        let s = &self.s;
        let v = back(s, v, s.start_force(q, v).total);
        (self.q, self.v, self.load, self.extra) = (q, v, s.forcing.force(time), 0.0);
    }

    #[inline]
    pub fn advance(&mut self, step: u64, extra: f64, frame: &mut Frame) -> Result<()> {
        let s = &self.s;
        let h = s.h;
        let (start, end) = (step as f64 * h, (step + 1) as f64 * h);
        let (q, v) = (self.q, self.v);
        let back = q - h * v;
        let blow = s.forcing.impulse_about_since(s.since, step, h);
        // A blow comes first, and the wall answers the velocity it leaves: q⁻ in the bound is where that would have come from.
        let struck = s.struck(v, blow);
        let felt = centred(&mut self.extra, extra);
        frame.extra[0] = felt;
        let load = self.load + felt;
        let b = s.m * v / h - 0.5 * s.c * v - s.k * (q - 0.25 * h * v) + load + blow / h;
        let shared = self.shared_restitution(q - h * struck);
        for (row, wall) in self.programme.rows.iter_mut().zip(&s.walls) {
            *row = match wall.law {
                WallLaw::Elastic { stiffness, damping } => {
                    // |r| = k_a s̄ + c_a(s⁺ − s⁻₊)/2h, written in Δ.
                    let offset = stiffness * (q - 0.25 * h * v - wall.g) + 0.5 * damping * (q - wall.plate(back)) / h;
                    elastic_row(wall.upper, 0.25 * stiffness + 0.5 * damping / h, offset)
                }
                _ => {
                    let e = shared.or(wall.law.restitution()).unwrap_or(0.0);
                    let bound = (1.0 + e) * (wall.g - q) + e * h * struck;
                    let (lo, hi) = if wall.upper { (f64::NEG_INFINITY, bound) } else { (bound, f64::INFINITY) };
                    ScalarRow { lo, hi, compliance: 0.0 }
                }
            };
        }
        let mut delta = self.settle(b, (start, step), frame)?;
        if let Some(blows) = self.s.blows(&[count_span(step, h)])
            && let Some(shift) = self.s.carried(Some(blows), frame)
            && self.s.c != 0.0
        {
            delta = self.settle(b - self.s.c * shift / h, (start, step), frame)?;
        }
        let s = &self.s;
        let q_end = q + delta + s.land(&blow_spans(step, h), frame);
        let v_half = delta / h;
        let load_end = s.forcing.force(end);
        let v_end = arrival(s, q_end, v_half, load_end + extra) + s.forcing.impulse((step as f64 + 0.5) * h, end) / s.m;
        (self.q, self.v, self.load) = (q_end, v_half, load_end);
        frame.arrive(start, end, v, q_end, v_end);
        frame.after[0] = v_half;
        frame.struck[0] = struck;
        frame.check(step)
    }

    /// Δ over the rows as they are, and the walls' forces.
    #[inline]
    fn settle(&mut self, b: f64, (start, step): (f64, u64), frame: &mut Frame) -> Result<f64> {
        frame.clear();
        let free = self.programme.free(b);
        if self.programme.admits(free) {
            return Ok(free);
        }
        let delta = self.programme.solve(b, start, step)?;
        for ((p, force), &r) in frame.impulse.iter_mut().zip(&mut frame.force).zip(&self.programme.multiplier) {
            (*p, *force) = (self.s.h * r, r);
        }
        frame.touched = true;
        Ok(delta)
    }

    pub fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
    }
}

/// The blows that the momentum balance of a step from t on counts as at t, and that instant: (from, to, t), s.
#[inline]
pub(super) fn count_span(step: u64, h: f64) -> (f64, f64, f64) {
    // The edges of `Forcing::impulse_about`.
    let edge = |half_steps: f64| (half_steps * h).max(0.0);
    (edge(step as f64 - 0.5), edge(step as f64 + 0.5), step as f64 * h)
}

/// The blows of the step from t on, which come half a step about its ends in the momentum balance, and the instant from which the balance
/// counts each: (from, to, counted), s.
#[inline]
pub(super) fn blow_spans(step: u64, h: f64) -> [(f64, f64, f64); 2] {
    let (start, middle, end) = (step as f64 * h, (step as f64 + 0.5) * h, (step + 1) as f64 * h);
    [(start, middle, start), (middle, end, end)]
}

/// Velocity at t⁺ from v₊ at t⁺ − ½h: half a step under the smooth force, (1 + hC/2M)v⁺ = v₊ + (h/2M)(f⁺ − K q⁺ + r⁺).
/// A body at or behind a rigid wall is not accelerated further into it, and an elastic wall too stiff for the step is left out: there v₊
/// is all that is known. A blow since t⁺ − ½h is not in v₊ yet, and the caller's to add.
#[inline]
pub(super) fn arrival(s: &Scalar, q: f64, v_half: f64, load: f64) -> f64 {
    let mut force = load - s.k * q;
    for wall in &s.walls {
        let depth = wall.depth(q);
        if depth < -s.touch {
            continue;
        }
        let tangent = wall.law.tangent(depth);
        if wall.law.is_rigid() {
            if wall.sign * (force - s.c * v_half) < 0.0 {
                return v_half;
            }
        } else if s.h * s.h * tangent > s.m {
            return v_half;
        } else {
            force += wall.sign * wall.law.pressure(depth, -wall.sign * v_half);
        }
    }
    let half = 0.5 * s.h / s.m;
    (v_half + half * force) / (1.0 + half * s.c)
}

/// v₋ half a step before the start, v − ½h a, from the velocity (m/s) and the force (N) there. The damping that a contains is divided
/// as an implicit half step would: h² apart, and a heavy damper does not throw the extrapolation by h C v/2M.
pub(super) fn back(s: &Scalar, v: f64, force: f64) -> f64 {
    v - 0.5 * s.h * force / (s.m + 0.5 * s.h * s.c)
}

/// The extra force over t ± ½h, when `extra` is constant over the step from t on and `last` was so before it; takes `extra` for `last`.
/// At t = 0 the first half acts before the start, on nothing: v₋ is extrapolated without it.
#[inline]
pub(super) fn centred(last: &mut f64, extra: f64) -> f64 {
    0.5 * (std::mem::replace(last, extra) + extra)
}

impl PaoliSchatzman {
    /// The smallest e of the rigid walls, if with its own e for each the bounds of a lower and an upper one would cross: unequal e, and a body
    /// so deep in one wall that the other's bound lies behind it.
    fn shared_restitution(&self, back: f64) -> Option<f64> {
        if !self.unequal {
            return None;
        }
        let (mut lo, mut hi, mut least) = (f64::NEG_INFINITY, f64::INFINITY, 1.0_f64);
        for wall in &self.s.walls {
            let Some(e) = wall.law.restitution() else { continue };
            let bound = (1.0 + e) * wall.g - e * back;
            (lo, hi) = if wall.upper { (lo, hi.min(bound)) } else { (lo.max(bound), hi) };
            least = least.min(e);
        }
        (lo > hi).then_some(least)
    }
}

/// True if rigid walls differ in e.
fn unequal(s: &Scalar) -> bool {
    let mut rigid = s.walls.iter().filter_map(|w| w.law.restitution());
    rigid.next().is_some_and(|first| rigid.any(|e| e != first))
}
