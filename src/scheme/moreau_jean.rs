//! `moreau-jean`: the impact law on the velocity, for the walls the body is about to reach.
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
//! with J the load impulses in the step and d what they add to the displacement beside the rule for
//! it (see [`crate::step::Balance`]), over the walls that q + ½h v reaches, with ε = e where the
//! body approaches or rests, 1 where it separates; in both the velocity ẇ is that after the blow
//! J/M of the step, so that a body struck at rest on a wall rebounds like one that arrives. With
//! θ = ½, e = 1, no damping and no load the energy is conserved exactly.
//!
//! No wall acts on the displacement: a body that comes to rest on one stays as deep behind it as
//! its last impact left it, by up to ½h times the speed of arrival, and while it stays the force is
//! that of its place: smaller by k times that depth than at the face, for a spring k that the body
//! hangs on. To lift it to the face takes work, which would be energy from nowhere to this rule.
//!
//! Order 1 through impacts. Where h v exceeds the gap, opposite walls take turns and the body
//! stands still between them: such steps are counted.

use super::Counters;
use super::body::Body;
use super::frame::Frame;
use super::programme::Programme;
use super::rule::Rule;
use super::space::{Space, zero};
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::{Scene, WallLaw};

#[derive(Debug)]
pub(super) struct MoreauJean<S: Space> {
    body: Body<S>,
    theta: f64,
    programme: Programme<S>,
    b: S::Vector,
    /// q + ½hv, with the velocity that the walls answer.
    ahead: S::Vector,
    /// The side from which a row's rigid walls pushed in the last step, as the sign of their force,
    /// 0 if none did; and the rows where it is not 0.
    last: Vec<f64>,
    pushed: Vec<usize>,
    frozen: u64,
}

impl<S: Space> MoreauJean<S> {
    pub fn new(scene: &Scene, theta: f64, h: f64, backend: Backend) -> Result<Self> {
        let body = Body::<S>::new(scene, h)?;
        let ht = h * theta;
        let compliance = |k: f64, c: f64| 1.0 / (ht * ht * (k + c / ht));
        let programme = Programme::new(scene, body.theta_matrix(theta), scene.gap_scale() / h, compliance, backend)?;
        let (b, ahead, last) = (zero::<S>(body.n), zero::<S>(body.n), vec![0.0; programme.count_rows()]);
        let pushed = Vec::with_capacity(scene.walls.len());
        Ok(Self { body, theta, programme, b, ahead, last, pushed, frozen: 0 })
    }

    /// Solves for δ, and the walls' impulses, where the row `first` may be met and none before it.
    /// Out of line: most steps meet none.
    #[inline(never)]
    fn meet(&mut self, first: usize, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let Self { body, programme, ahead, .. } = self;
        for row in first..programme.count_rows() {
            let reach = programme.seen(row, ahead);
            if !programme.is_clear(row, reach) {
                Self::bind(body, self.theta, programme, row, reach, frame);
            }
        }
        self.settle(step, frame)
    }

    /// The bounds of a row whose walls may be met, in δ.
    fn bind(body: &Body<S>, theta: f64, programme: &mut Programme<S>, row: usize, reach: f64, frame: &Frame<S>) {
        let (h, ht) = (body.h, body.h * theta);
        let (w, before) = (programme.seen(row, &frame.q), programme.seen(row, &frame.v));
        let struck = programme.seen(row, frame.struck());
        for seat in programme.seats(row) {
            let wall = programme.seat(seat).stop;
            let bound = match wall.law {
                WallLaw::Elastic { stiffness, damping } => {
                    // p = −h[k_a(w_θ − g) + c_a(w_θ − plate)/θh] with w_θ = w + hθẇ + hθ²δ.
                    let stiff = stiffness + damping / ht;
                    let ahead = w + ht * before;
                    let offset = h * (stiffness * (ahead - wall.g) + damping * (ahead - wall.plate(w)) / ht);
                    -offset / (ht * ht * stiff)
                }
                WallLaw::Rigid { restitution } if wall.depth(reach) >= -body.touch => {
                    let epsilon = if wall.sign * struck <= 0.0 { restitution } else { 1.0 };
                    -(1.0 + epsilon) * struck + (struck - before)
                }
                _ => continue,
            };
            programme.bind(row, seat, bound);
        }
    }

    /// Solves for δ, and the walls' impulses.
    fn settle(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        self.programme.solve(&self.b, (frame.start, step), &mut frame.impulse, &mut frame.pushing)
    }

    /// The same where the blows take the structure beside the rule, and so do what the damper
    /// feels. What a rigid wall answers stays as it is, which is known only when the walls have
    /// been asked without. Returns whether the blows carry the structure on.
    #[inline(never)]
    fn carry(&mut self, step: u64, frame: &mut Frame<S>) -> Result<bool> {
        let found = self.body.find_blows(&[(frame.start, frame.end, frame.end - self.body.h * self.theta)]);
        if !found || self.body.answers(&frame.pushing) {
            return Ok(false);
        }
        if self.body.damped {
            frame.let_go();
            self.body.damp_shift(1.0, &mut self.b);
            self.settle(step, frame)?;
        }
        Ok(true)
    }

    /// The forces of a step with impulses; counts it if the walls on opposite sides of one place
    /// took turns.
    #[inline(never)]
    fn watch(&mut self, frame: &mut Frame<S>) {
        let row_of = |wall: usize| self.programme.row_of(wall);
        let frozen = frame.pushing.iter().any(|&wall| self.last[row_of(wall)] * frame.impulse[wall] < 0.0);
        for row in self.pushed.drain(..) {
            self.last[row] = 0.0;
        }
        for &wall in &frame.pushing {
            let (row, impulse) = (row_of(wall), frame.impulse[wall]);
            frame.force[wall] = impulse / self.body.h;
            if self.programme.is_rigid(row) {
                self.last[row] = impulse.signum();
                self.pushed.push(row);
            }
        }
        self.frozen += u64::from(frozen);
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
        let Self { body, theta, b, .. } = self;
        let (h, theta) = (body.h, *theta);
        frame.begin(step, h);
        body.theta_momentum(theta, frame, b);
        // A blow comes first, and the wall answers the velocity it leaves.
        frame.blown = body.strike((frame.start, frame.end), 1.0, b, frame);
        let states = frame.q.as_ref().iter().zip(frame.struck().as_ref());
        for (ahead, (q, v)) in self.ahead.as_mut().iter_mut().zip(states) {
            *ahead = q + 0.5 * h * v;
        }
        self.programme.free();
        match self.programme.first_near(&self.ahead) {
            None => self.programme.release(&self.b, (frame.start, step))?,
            Some(row) => self.meet(row, step, frame)?,
        }
        let carried = self.body.blows.is_some() && self.carry(step, frame)?;
        let delta = self.programme.x().as_ref();
        for ((q, v), d) in frame.q.as_mut().iter_mut().zip(frame.v.as_mut()).zip(delta) {
            *q += h * (*v + theta * d);
            *v += d;
        }
        frame.after.clone_from(&frame.v);
        if carried {
            self.body.shift(&mut frame.q);
        }
        if !self.pushed.is_empty() || !frame.pushing.is_empty() {
            self.watch(frame);
        }
        Ok(())
    }

    fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
        counters.frozen_steps = self.frozen;
    }

    fn backend(&self) -> Option<Backend> {
        Some(self.programme.backend())
    }
}
