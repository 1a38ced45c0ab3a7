//! What every scheme on a fixed grid shares: the oscillator's numbers, its walls, and the frame it fills.

use super::stop::Stop;
use crate::error::{Error, Result};
use crate::scene::{Forcing, Scene};

/// The scene of one degree of freedom as a kernel wants it.
#[derive(Debug, Clone)]
pub(super) struct Scalar {
    pub m: f64,
    pub c: f64,
    pub k: f64,
    pub h: f64,
    pub forcing: Forcing,
    pub walls: Vec<Stop>,
    /// Distance within which a wall counts as touched, m: 1e-12 of the gap scale.
    pub touch: f64,
    /// When the motion began or was taken up anew, s.
    pub since: f64,
}

impl Scalar {
    pub fn new(scene: &Scene, h: f64) -> Self {
        Self {
            m: scene.system.mass_form(&[1.0], &[1.0]),
            c: scene.system.damping_form(&[1.0], &[1.0]),
            k: scene.system.stiffness_form(&[1.0], &[1.0]),
            h,
            forcing: Forcing::on(0, &scene.loads),
            walls: scene.walls.iter().map(Stop::new).collect(),
            touch: scene.touching_distance(),
            since: 0.0,
        }
    }

    /// Where a body is certain to touch no wall: an open interval, m, with twice the touching distance to spare; empty
    /// where a wall is not rigid, and asks for a look in every step.
    pub fn clear(&self) -> (f64, f64) {
        if self.walls.iter().any(|w| !w.law.is_rigid()) {
            return (f64::INFINITY, f64::NEG_INFINITY);
        }
        let ends = |(lo, hi): (f64, f64), w: &Stop| match w.upper {
            true => (lo, hi.min(w.g - 2.0 * self.touch)),
            false => (lo.max(w.g + 2.0 * self.touch), hi),
        };
        self.walls.iter().fold((f64::NEG_INFINITY, f64::INFINITY), ends)
    }

    /// Velocity after a blow (N s); most steps have none, and none is divided.
    #[inline]
    pub fn struck(&self, v: f64, blow: f64) -> f64 {
        if blow == 0.0 { v } else { v + blow / self.m }
    }

    /// Where the blows in each (from, to] take the displacement by `about` beside what a step makes of their sum, and the sum of the
    /// velocities they give: m and m/s. `None` without blows, which costs a step a look at an empty list.
    #[inline]
    pub fn blows(&self, spans: &[(f64, f64, f64)]) -> Option<(f64, f64)> {
        if self.forcing.impulses.is_empty() { None } else { self.sum_blows(spans) }
    }

    #[inline(never)]
    fn sum_blows(&self, spans: &[(f64, f64, f64)]) -> Option<(f64, f64)> {
        let of = |(shift, jump), &(from, to, about): &(f64, f64, f64)| {
            (shift + self.forcing.impulse_moment(from, to, about), jump + self.forcing.impulse(from, to))
        };
        let (shift, jump) = spans.iter().fold((0.0, 0.0), of);
        (shift != 0.0).then_some((shift / self.m, jump / self.m))
    }

    /// Takes a body to where the blows of the step leave it, but for one that a rigid wall answered: m from the end of the step.
    #[inline]
    pub fn land(&self, spans: &[(f64, f64, f64)], frame: &Frame) -> f64 {
        self.carried(self.blows(spans), frame).unwrap_or(0.0)
    }

    /// The displacement of [`Scalar::blows`], unless a rigid wall of the step answered them.
    #[inline]
    pub fn carried(&self, blows: Option<(f64, f64)>, frame: &Frame) -> Option<f64> {
        blows.and_then(|(shift, jump)| (!self.answers(jump, frame)).then_some(shift))
    }

    /// True if a rigid wall that pushed in the step was what the blows, which give the velocity `jump` (m/s), drove into.
    fn answers(&self, jump: f64, frame: &Frame) -> bool {
        let mut walls = self.walls.iter().zip(&frame.impulse);
        frame.touched && walls.any(|(wall, &p)| wall.law.is_rigid() && p != 0.0 && wall.sign * jump < 0.0)
    }

    /// Displacement and velocity after any impulse at t = 0.
    pub fn start(&self, scene: &Scene) -> (f64, f64) {
        let first = |x: &[f64]| x.first().copied().unwrap_or(0.0);
        (first(&scene.initial.q), first(&scene.initial.v) + self.forcing.initial_impulse() / self.m)
    }

    /// Smooth force at the start plus what the walls answer there: elastic walls by their law, a rigid wall that is touched
    /// at rest by whatever keeps the body from accelerating through it.
    pub fn start_force(&self, q: f64, v: f64) -> StartForce {
        let smooth = self.forcing.force(self.since) - self.c * v - self.k * q;
        let mut wall = vec![0.0; self.walls.len()];
        for (r, w) in wall.iter_mut().zip(&self.walls) {
            *r = w.sign * w.law.pressure(w.depth(q), -w.sign * v);
        }
        let mut total = smooth + wall.iter().sum::<f64>();
        for (r, w) in wall.iter_mut().zip(&self.walls) {
            let rests = w.law.is_rigid() && w.depth(q) >= -self.touch && v == 0.0;
            if rests && w.sign * total < 0.0 {
                *r = -total;
                total = 0.0;
            }
        }
        StartForce { total, wall }
    }
}

/// Forces at the start, N.
pub(super) struct StartForce {
    /// Smooth force and wall forces together.
    pub total: f64,
    /// Force of each wall, signed.
    pub wall: Vec<f64>,
}

/// What a kernel writes of each step; the stepper lends it out as a [`crate::step::Step`].
#[derive(Debug, Clone)]
pub(super) struct Frame {
    pub start: f64,
    pub end: f64,
    pub q: [f64; 1],
    pub v: [f64; 1],
    pub before: [f64; 1],
    /// Velocity that a wall answers, m/s: `before` and the blows of the step.
    pub struck: [f64; 1],
    pub after: [f64; 1],
    pub extra: [f64; 1],
    pub impulse: Vec<f64>,
    pub force: Vec<f64>,
    pub jump: Vec<f64>,
    /// True if any impulse of the step is not zero.
    pub touched: bool,
}

impl Frame {
    pub fn new(q: f64, v: f64, walls: usize) -> Self {
        Self {
            start: 0.0,
            end: 0.0,
            q: [q],
            v: [v],
            before: [v],
            struck: [v],
            after: [v],
            extra: [0.0],
            impulse: vec![0.0; walls],
            force: vec![0.0; walls],
            jump: vec![0.0; walls],
            touched: false,
        }
    }

    /// The frame of a motion taken up anew at `time` (s) from `q` (m) and `v` (m/s).
    pub fn restart(&mut self, time: f64, q: f64, v: f64) {
        *self = Self { start: time, end: time, ..Self::new(q, v, self.impulse.len()) };
    }

    /// Clears the walls of the last step, if they were touched.
    #[inline]
    pub fn clear(&mut self) {
        if self.touched {
            self.impulse.fill(0.0);
            self.force.fill(0.0);
            self.touched = false;
        }
    }

    /// Writes the motion of a step whose momentum balance joins its end velocities.
    #[inline]
    pub fn arrive(&mut self, start: f64, end: f64, v_before: f64, q: f64, v: f64) {
        self.start = start;
        self.end = end;
        self.before[0] = v_before;
        self.struck[0] = v_before;
        self.after[0] = v;
        self.q[0] = q;
        self.v[0] = v;
    }

    /// Refuses a state that is not finite.
    #[inline]
    pub fn check(&self, step: u64) -> Result<()> {
        if self.q[0].is_finite() && self.v[0].is_finite() {
            return Ok(());
        }
        let what = if self.q[0].is_finite() { "velocity" } else { "displacement" };
        Err(Error::NotFinite { time: self.end, step, what })
    }
}

/// A stretch that the exact scheme handed to moreau-jean: more impacts crowd there than it follows one by one.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Handed {
    /// From when, s.
    pub from: f64,
    /// Until when, s.
    pub to: f64,
    /// With which step at most, s.
    pub step: f64,
}

/// True if every number is finite. Without a branch an entry, so that the compiler looks at several at once.
#[inline]
pub(super) fn all_finite(x: &[f64]) -> bool {
    x.iter().fold(true, |all, x| all & x.is_finite())
}

/// What a run has cost, in units that do not depend on the machine.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
#[non_exhaustive]
pub struct Counters {
    /// Steps taken (for the exact scheme: arcs between events).
    pub steps: u64,
    /// Steps that met a wall and solved a quadratic programme.
    pub qp_solves: u64,
    /// Interior-point iterations of those.
    pub interior_point_iterations: u64,
    /// Pivots of those.
    pub pivots: u64,
    /// Programmes that pivoting did not settle, and that were solved through Clarabel.
    pub qp_fallbacks: u64,
    /// Newton iterations of the penalty schemes.
    pub newton_iterations: u64,
    /// Contact events of the exact scheme.
    pub events: u64,
    /// Evaluations of the closed-form motion by the exact scheme's search for events.
    pub flow_evaluations: u64,
    /// Steps in which opposite walls took turns, so that the body stood still between them: the step is too large.
    pub frozen_steps: u64,
    /// Steps by which the exact scheme had moreau-jean cross stretches that it cannot close.
    pub handed_steps: u64,
}
