//! `penalty` with the `central-difference` integrator: the explicit rule M(v₊ − v₋)/h = f − C(v₋ + v₊)/2 − K q + r(q).
//!
//! Stable while h²(K + k_w)/M ≤ 4; beyond that the walls throw the body back faster than it came. Smooth dampers are taken at the mean
//! velocity, so they cost no stability.

use super::grid::{Frame, Scalar};
use super::paoli_schatzman::{arrival, back, blow_spans, centred, count_span};
use crate::error::Result;
use crate::scene::{Scene, WallLaw};

#[derive(Debug)]
pub(super) struct CentralDifference {
    s: Scalar,
    q: f64,
    /// v₋ = (q − q⁻)/h, m/s.
    v: f64,
    load: f64,
    /// The caller's extra force in the last step, N; 0 before the first.
    extra: f64,
}

impl CentralDifference {
    pub fn new(scene: &Scene, h: f64) -> Self {
        let s = Scalar::new(scene, h);
        let (q, v0) = s.start(scene);
        let v = back(&s, v0, s.start_force(q, v0).total);
        let load = s.forcing.force(0.0);
        Self { s, q, v, load, extra: 0.0 }
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
        let blow = s.forcing.impulse_about_since(s.since, step, h);
        let felt = centred(&mut self.extra, extra);
        frame.extra[0] = felt;
        let carried = s.blows(&[count_span(step, h)]).map_or(0.0, |(shift, _)| shift);
        let smooth = self.load + felt + (blow - s.c * carried) / h - s.k * q;
        frame.clear();
        let mut v_end = velocity(s.m / h, s.c, v, smooth);
        if s.walls.iter().any(|wall| wall.depth(q) > 0.0) {
            v_end = self.touch(q, v, smooth, frame);
        }
        let q_end = q + h * v_end + s.land(&blow_spans(step, h), frame);
        let load_end = s.forcing.force(end);
        let v_reported =
            arrival(s, q_end, v_end, load_end + extra) + s.forcing.impulse((step as f64 + 0.5) * h, end) / s.m;
        (self.q, self.v, self.load) = (q_end, v_end, load_end);
        frame.arrive(start, end, v, q_end, v_reported);
        frame.after[0] = v_end;
        frame.check(step)
    }

    /// v₊ with the walls that hold the body: their springs at q, their dashpots at the mean velocity, none of them pulling.
    fn touch(&self, q: f64, v: f64, smooth: f64, frame: &mut Frame) -> f64 {
        let s = &self.s;
        let dashpot = |law: &WallLaw| if let WallLaw::Elastic { damping, .. } = *law { damping } else { 0.0 };
        frame.touched = true;
        // A wall found to pull lets go; each pass drops one at least, so there are no more passes than walls.
        frame.force.iter_mut().zip(&s.walls).for_each(|(f, wall)| *f = f64::from(u8::from(wall.depth(q) > 0.0)));
        loop {
            let (mut c, mut force) = (s.c, smooth);
            for (wall, _) in s.walls.iter().zip(&frame.force).filter(|&(_, &on)| on != 0.0) {
                c += dashpot(&wall.law);
                force += wall.sign * wall.law.pressure(wall.depth(q), 0.0);
            }
            let v_end = velocity(s.m / s.h, c, v, force);
            let mut pulled = false;
            for (wall, on) in s.walls.iter().zip(&mut frame.force).filter(|(_, on)| **on != 0.0) {
                let rate = -wall.sign * 0.5 * (v + v_end);
                if wall.law.pressure(wall.depth(q), 0.0) + dashpot(&wall.law) * rate < 0.0 {
                    *on = 0.0;
                    pulled = true;
                }
            }
            if pulled {
                continue;
            }
            for ((wall, force), p) in s.walls.iter().zip(&mut frame.force).zip(&mut frame.impulse) {
                if *force != 0.0 {
                    let rate = -wall.sign * 0.5 * (v + v_end);
                    *force = wall.sign * (wall.law.pressure(wall.depth(q), 0.0) + dashpot(&wall.law) * rate);
                }
                *p = s.h * *force;
            }
            return v_end;
        }
    }
}

/// v₊ from M(v₊ − v₋)/h = F − C(v₋ + v₊)/2.
#[inline]
fn velocity(m_over_h: f64, c: f64, v: f64, force: f64) -> f64 {
    ((m_over_h - 0.5 * c) * v + force) / (m_over_h + 0.5 * c)
}
