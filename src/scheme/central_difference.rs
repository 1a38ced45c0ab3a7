//! `penalty` with the `central-difference` integrator: the explicit rule
//!
//! M(v₊ − v₋)/h = f − C(v₋ + v₊)/2 − K q + r(q).
//!
//! Stable while h²(K + k_w)/M ≤ 4; beyond that, the body leaves the walls faster than it arrived.
//! Smooth dampers are taken at the mean velocity, so they do not restrict the step. Order 2 where
//! the step resolves the walls' springs.
//!
//! (M/h + C/2)(v₊ − v₋) = f − C v₋ − K q + J/h + Gᵀ r, where r is known but for the walls'
//! dashpots, which act on the mean of v₋ and v₊ and never pull.

use super::Counters;
use super::body::Body;
use super::frame::Frame;
use super::newton::{ForceLawSolver, LawResponse};
use super::rule::Rule;
use super::space::{Space, zero};
use super::staggered::{Staggered, counted_blows};
use crate::error::{Error, Result};
use crate::linear::Symmetric;
use crate::scene::Scene;

#[derive(Debug)]
pub(super) struct CentralDifference<S: Space> {
    body: Body<S>,
    staggered: Staggered<S>,
    /// M/h + C/2.
    factor: S::Factor,
    /// The walls' velocities after the step as functions of their forces; `None` without dashpots.
    dashpots: Option<ForceLawSolver>,
    /// The right-hand side, then v₊ − v₋.
    b: S::Vector,
    change: S::Vector,
}

impl<S: Space> CentralDifference<S> {
    pub fn new(scene: &Scene, h: f64) -> Result<Self> {
        let body = Body::<S>::new(scene, h)?;
        let m = &body.matrices;
        let mut factor = S::factor(&Symmetric::sum(&[(1.0 / h, &m.mass), (0.5, &m.damping)]))?;
        let damped = body.walls.iter().any(|wall| wall.law.is_damped());
        let dashpots = damped.then(|| ForceLawSolver::new(&mut factor, &body, 1.0));
        let (staggered, b, change) = (Staggered::new(scene, &body)?, zero::<S>(body.n), zero::<S>(body.n));
        Ok(Self { body, staggered, factor, dashpots, b, change })
    }

    /// Adds the forces of the walls that the structure penetrates. Not inlined: in most steps it
    /// penetrates none.
    #[inline(never)]
    fn press(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let Self { body, staggered, factor, dashpots, b, change } = self;
        let v = &staggered.v;
        let depth = |wall: usize| body.walls[wall].depth(body.seen(wall, &frame.q));
        if let Some(dashpots) = dashpots {
            change.clone_from(b);
            S::solve(factor, change);
            for wall in 0..body.walls.len() {
                dashpots.free[wall] = body.seen(wall, v) + body.seen(wall, change);
            }
            let law = |wall: usize, after: f64| {
                let (face, depth) = (body.walls[wall], depth(wall));
                let rate = -face.sign * 0.5 * (body.seen(wall, v) + after);
                let elastic = face.law.pressure(depth, 0.0);
                let dashpot = face.law.dashpot(elastic);
                let pressure = elastic + dashpot * rate;
                // A wall that would pull has no force.
                let holds = depth > 0.0 && pressure > 0.0;
                let (force, slope) = if holds { (face.sign * pressure, 0.5 * dashpot) } else { (0.0, 0.0) };
                LawResponse { force, slope, noise: 0.0 }
            };
            let solved = dashpots.solve(law);
            solved.map_err(|residual| Error::Newton { time: frame.start, step, residual })?;
            // The forces that make the velocities: a stiff dashpot turns the rounding of those into
            // a far larger one of its law.
            dashpots.refine_pulls();
            frame.force.copy_from_slice(&dashpots.guess);
        } else {
            for (wall, face) in body.walls.iter().enumerate() {
                frame.force[wall] = face.sign * face.law.pressure(depth(wall), 0.0);
            }
        }
        frame.push_by_force(body.h);
        body.push(1.0, &frame.force, b);
        Ok(())
    }
}

impl<S: Space> Rule<S> for CentralDifference<S> {
    fn restart(&mut self, scene: &Scene, time: f64, frame: &Frame<S>) -> Result<()> {
        self.staggered.restart(scene, &mut self.body, time, frame)
    }

    fn carried(&mut self) -> [Option<(&mut S::Vector, i32)>; 2] {
        [Some((&mut self.staggered.v, 1)), None]
    }

    fn advance(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let Self { body, staggered, b, .. } = self;
        let h = body.h;
        staggered.begin(step, h, frame);
        body.applied(frame, b);
        S::add_product(&body.stiffness, -1.0, &frame.q, b);
        S::add_product(&body.damping, -1.0, &staggered.v, b);
        frame.blown = body.strike_about(step, 1.0 / h, b, frame);
        if body.find_blows(&[counted_blows(step, h)]) {
            body.damp_shift(1.0 / h, b);
        }
        if (0..body.walls.len()).any(|wall| body.walls[wall].depth(body.seen(wall, &frame.q)) > 0.0) {
            self.press(step, frame)?;
        }
        let Self { body, staggered, factor, b, .. } = self;
        S::solve(factor, b);
        for ((q, v), d) in frame.q.as_mut().iter_mut().zip(staggered.v.as_mut()).zip(b.as_ref()) {
            *v += d;
            *q += h * *v;
        }
        staggered.finish(body, step, frame)
    }

    fn count(&self, _: &mut Counters) {}
}
