//! `moreau-jean`: the impact law on the velocity, at the walls that the body is about to reach.
//!
//! Jean 1999, Comput. Methods Appl. Mech. Engrg. 177, doi:10.1016/S0045-7825(98)00383-1; Acary &
//! Brogliato 2008, doi:10.1007/978-3-540-75392-6, ch. 10. With v⁺ = v + δ,
//! v_θ = v + θδ, q⁺ = q + h v_θ,
//!
//! M δ = h[f_θ − C v_θ − K(q + hθ v_θ)] + J − C d + p
//!
//! is the optimality condition A δ = b + p of
//!
//! minimise ½ A δ² − b δ   subject to   ẇ⁺ + ε ẇ ≤ 0 (upper), ≥ 0 (lower),    A = M + hθC + h²θ²K,
//!
//! over the walls that q + ½h v reaches. J are the load impulses in the step, and d is the
//! displacement that they cause in addition to the rule's (see [`crate::step::Balance`]). ε = e
//! where the body approaches or rests, 1 where it separates; the velocity ẇ is that after the load
//! impulses of the step, so that a body struck while it rests on a wall rebounds like one that
//! arrives. With θ = ½, e = 1, no damping and no load, energy is conserved exactly.
//!
//! Walls do not act on the displacement: a body that comes to rest on a wall stays at the depth at
//! which its last impact left it, up to ½h times the speed of arrival. The contact force is then
//! that of this position: with a spring k on the body, it is smaller than that at the wall's face
//! by k times the depth. The body is not moved to the face, since that would change its energy.
//!
//! Order 1 through impacts. If h v exceeds the gap, opposite walls push in alternate steps and the
//! body stands still between them: such steps are counted.

use super::Counters;
use super::body::Body;
use super::entry::{Coverage, Realised, SchemeEntry, SchemeKind};
use super::frame::{Frame, all_finite};
use super::programme::Programme;
use super::rule::Rule;
use super::space::{Space, add_change, zero};
use super::supports::TURNING;
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::Scene;
use crate::step::{Balance, Conserves, Contract, Friction, Law, Promise, QuietSteps, Reached, Tolerances};
use std::mem::take;

/// What is known of the scheme beside its rule.
pub(super) const ENTRY: SchemeEntry = SchemeEntry {
    name: "moreau-jean",
    settings: &["theta"],
    default: "θ, default ½",
    kind: SchemeKind::Qp,
    restitution: Realised::PerWall,
    realises: "e, per wall",
    purpose: "the default in rigid round holes, with friction, and at springs for walls: impacts and lasting contact \
              at the least cost of a step (docs/holes.md)",
    order: Some(1),
    fails: "order 1 (2 where all walls are springs without dashpots), at walls with a dashpot by chance more or less; \
            penetrates by up to h v(1 − e/2); a body that comes to rest stays at the depth at which it arrived, and \
            the contact force is too small by stiffness times that depth (reported); the body stands still when h v \
            exceeds the gap (reported)",
    round: Coverage::Stepped(
        "lets rebound by the restitution what arrives, and reflects what only the turning of the normal adds",
    ),
    elastic_round: Coverage::Stepped("presses with the force of the ring at θ"),
    friction: Coverage::Stepped("keeps Coulomb's law with the velocity at the end of the step"),
    elastic_round_friction: Coverage::Refused("the normal of an elastic round support follows from the step's end"),
};

/// What every step with this θ satisfies.
pub(super) fn contract(theta: f64) -> Contract {
    let mut promise = Promise::constraints(None, Some(Reached::Ahead(0.5)), Law::Depth(theta));
    (promise.round, promise.friction) = (Some(TURNING), Some(Friction::EndVelocity));
    let conserves = if theta == 0.5 { Conserves::RigidWalls } else { Conserves::Nothing };
    Contract {
        balance: Balance::Theta(theta),
        promise,
        instant: 0.5,
        tolerances: Tolerances::of(conserves),
        divides: false,
    }
}

#[derive(Debug)]
pub(super) struct MoreauJean<S: Space> {
    body: Body<S>,
    theta: f64,
    programme: Programme<S>,
    b: S::Vector,
    /// q + ½hv, with the velocity after the blows of the step.
    ahead: S::Vector,
    /// The sign of the force of each row's rigid walls in the last step, 0 if none pushed or they
    /// leave no room to move; and the rows where it is not 0.
    last: Vec<f64>,
    pushed: Vec<usize>,
    /// The walls that leave no room to move.
    snug: Vec<bool>,
    frozen: u64,
}

impl<S: Space> MoreauJean<S> {
    pub fn new(scene: &Scene, theta: f64, h: f64, backend: Backend) -> Result<Self> {
        let body = Body::<S>::new(scene, h)?;
        let ht = h * theta;
        let (a, scale) = (body.theta_matrix(theta), scene.gap_scale() / h);
        let programme = Programme::new(scene, a, scale, |spring| spring.compliance(ht), backend)?;
        let (b, ahead, last) = (zero::<S>(body.n), zero::<S>(body.n), vec![0.0; programme.count_rows()]);
        let pushed = Vec::with_capacity(scene.walls.len());
        Ok(Self { body, theta, programme, b, ahead, last, pushed, snug: scene.snug(), frozen: 0 })
    }

    /// Solves for δ and the walls' impulses, if the walls of row `first` may be met and those of no
    /// row before it. Not inlined: most steps meet no wall.
    #[inline(never)]
    fn solve_contacts(&mut self, first: usize, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let Self { body, programme, ahead, .. } = self;
        for row in first..programme.count_rows() {
            let reach = programme.seen(row, ahead);
            if !programme.is_clear(row, reach) {
                Self::bind(body, self.theta, programme, row, reach, frame);
            }
        }
        self.settle(step, frame)
    }

    /// Sets the bounds of a row whose walls may be met, in δ.
    fn bind(body: &Body<S>, theta: f64, programme: &mut Programme<S>, row: usize, reach: f64, frame: &Frame<S>) {
        let (h, ht) = (body.h, body.h * theta);
        let (w, before) = (programme.seen(row, &frame.q), programme.seen(row, &frame.v));
        let struck = programme.seen(row, frame.struck());
        for number in programme.walls(row) {
            let wall = programme.wall(number);
            let bound = match (wall.law.spring(), wall.law.restitution()) {
                // p = −h[k_a(w_θ − g) + c_a(w_θ − plate)/θh] with w_θ = w + hθẇ + hθ²δ.
                (Some(spring), _) => {
                    let offset = h * spring.force(w + ht * before, wall.g, wall.plate(w), ht);
                    -offset / (ht * ht * spring.stiffness_over(ht))
                }
                (_, Some(restitution)) if wall.depth(reach) >= -body.touch => {
                    let epsilon = if wall.sign * struck <= 0.0 { restitution } else { 1.0 };
                    -(1.0 + epsilon) * struck + (struck - before)
                }
                _ => continue,
            };
            programme.bind(row, number, bound);
        }
    }

    /// Solves for δ and the walls' impulses.
    fn settle(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        self.programme.solve(&self.b, (frame.start, step), &mut frame.impulse, &mut frame.pushing)
    }

    /// The blows of a step cause a displacement in addition to the rule's, over which the damper
    /// acts too: solves again with that, unless the blows drive the structure into a rigid wall
    /// that pushes, which shows only after the first solution. Returns whether the displacement by
    /// the blows must be added.
    #[inline(never)]
    fn solve_with_blows(&mut self, step: u64, frame: &mut Frame<S>) -> Result<bool> {
        let found = self.body.find_blows(&[(frame.start, frame.end, frame.end - self.body.h * self.theta)]);
        if !found || self.body.answers(&frame.pushing) {
            return Ok(false);
        }
        if self.body.damped {
            frame.take_back_impulses();
            self.body.damp_shift(1.0, &mut self.b);
            self.settle(step, frame)?;
        }
        Ok(true)
    }

    /// Writes the forces of a step with impulses, and counts the step as frozen if a wall pushed
    /// right after one on the opposite side of the same row.
    #[inline(never)]
    fn record_forces(&mut self, frame: &mut Frame<S>) {
        let row_of = |wall: usize| self.programme.row_of(wall);
        let frozen = frame.pushing.iter().any(|&wall| self.last[row_of(wall)] * frame.impulse[wall] < 0.0);
        for row in self.pushed.drain(..) {
            self.last[row] = 0.0;
        }
        for &wall in &frame.pushing {
            let (row, impulse) = (row_of(wall), frame.impulse[wall]);
            frame.force[wall] = impulse / self.body.h;
            if self.programme.is_rigid(row) && !self.snug[wall] {
                self.last[row] = impulse.signum();
                self.pushed.push(row);
            }
        }
        self.frozen += u64::from(frozen);
    }

    /// Makes step number `step`.
    #[inline(always)]
    fn make(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let Self { body, theta, b, .. } = self;
        let h = body.h;
        frame.begin(step, h);
        body.theta_momentum(*theta, frame, b);
        // Blows come first: the impact law applies to the velocity after them.
        frame.blown = body.strike((frame.start, frame.end), 1.0, b, frame);
        write_midpoint::<S>(h, &frame.q, frame.struck(), &mut self.ahead);
        self.programme.free();
        match self.programme.first_near(&self.ahead) {
            None => self.programme.release(&self.b, (frame.start, step))?,
            Some(row) => self.solve_contacts(row, step, frame)?,
        }
        let carried = self.body.blows.is_some() && self.solve_with_blows(step, frame)?;
        frame.add_change((h, self.theta), self.programme.x());
        if carried {
            self.body.shift(&mut frame.q);
        }
        if !self.pushed.is_empty() || !frame.pushing.is_empty() {
            self.record_forces(frame);
        }
        Ok(())
    }
}

/// Writes q + ½hv to `ahead`.
#[inline(always)]
fn write_midpoint<S: Space>(h: f64, q: &S::Vector, v: &S::Vector, ahead: &mut S::Vector) {
    for (ahead, (q, v)) in ahead.as_mut().iter_mut().zip(q.as_ref().iter().zip(v.as_ref())) {
        *ahead = q + 0.5 * h * v;
    }
}

impl<S: Space> Rule<S> for MoreauJean<S> {
    fn restart(&mut self, _: &Scene, time: f64, _: &Frame<S>) -> Result<()> {
        self.body.restart(time);
        for row in self.pushed.drain(..) {
            self.last[row] = 0.0;
        }
        Ok(())
    }

    fn advance(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        S::vectorised(self.body.arch, || self.make(step, frame))
    }

    fn advance_quiet(
        &mut self,
        step: u64,
        until: u64,
        frame: &mut Frame<S>,
        mut quiet: Option<&mut QuietSteps>,
    ) -> Result<u64> {
        if self.body.blows.is_some() || !self.pushed.is_empty() {
            return Ok(step);
        }
        self.programme.free();
        let Self { body, theta, programme, b, ahead, .. } = self;
        let (h, mut next, mut done, mut finite) = (body.h, step, Ok(()), true);
        // As variables of their own, numbers stay in registers.
        let (mut q, mut v, mut before) = (take(&mut frame.q), take(&mut frame.v), take(&mut frame.before));
        while next < until && done.is_ok() && finite {
            write_midpoint::<S>(h, &q, &v, ahead);
            if programme.first_near(ahead).is_some() {
                break;
            }
            body.momentum_to((next + 1) as f64 * h, *theta, (&q, &v, &frame.extra), b);
            done = programme.release(b, (next as f64 * h, next));
            before.clone_from(&v);
            add_change::<S>((h, *theta), programme.x(), &mut q, &mut v);
            finite = all_finite(q.as_ref()) && all_finite(v.as_ref());
            next += 1;
            if let Some(quiet) = &mut quiet {
                quiet.add(next as f64 * h, (q.as_ref(), v.as_ref()), (before.as_ref(), v.as_ref()));
            }
        }
        (frame.q, frame.v, frame.before) = (q, v, before);
        if next > step {
            (frame.start, frame.end, frame.blown) = ((next - 1) as f64 * h, next as f64 * h, false);
            frame.after.clone_from(&frame.v);
        }
        done.map(|()| next)
    }

    fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
        counters.frozen_steps = self.frozen;
    }

    fn backend(&self) -> Option<Backend> {
        Some(self.programme.backend())
    }
}
