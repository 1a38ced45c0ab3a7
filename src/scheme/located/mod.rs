//! `located`: the θ-method with θ = ½, whose steps are divided at the impacts.
//!
//! Between impacts the rule is that of moreau-jean with θ = ½ ([`super::moreau_jean`]). Where the
//! path of a step crosses a rigid wall, the step is divided there: a part of length s ends at the
//! instant at which the part's own displacement meets the wall, g·q(s) = g_w, the impact law
//! changes the velocity at that instant, and the rest of the step follows as a part of its own.
//! With A(s) = M + ½sC + ¼s²K,
//!
//! A(s) δ = s[½(f + f⁺) + f_x − C v − K(q + ½s v)] + p,   q(s) = q + s(v + ½δ),   v(s) = v + δ.
//!
//! The velocity of the rule is linear over a step, so that the gaps are parabolas, along which the
//! search for the first crossing skips none (`crossing.rs`); the root of g·q(s) is then found by
//! Newton's method within the bracket of that search, one factor of A(s) an evaluation
//! (`division.rs`, `part.rs`).
//!
//! At the instant of an impact the change of velocity is the solution of
//!
//! minimise ½ δᵀM δ   subject to   ẇ⁺ + ε ẇ ≤ 0 (upper), ≥ 0 (lower)
//!
//! over the touched walls that the body approaches or rests on: Moreau's law at an instant (Moreau
//! 1988, doi:10.1007/978-3-7091-2624-0_1; `row_contacts.rs`). A wall that is approached after that
//! is struck next at the same instant, also one that the body was leaving: so a wall that is
//! touched does as one that is a rounding away.
//!
//! A body rests where it touches a wall without speed. Such walls bound the velocity at the end of
//! each part, ẇ⁺ ≤ 0, so that the body stays on the face, at no depth. If the pressing acceleration
//! a of the part before an impact would end the rebounds within a step, τ = 2e|ẇ|/(a(1 − e)) ≤ h,
//! the body rests at once (Studer 2009, doi:10.1007/978-3-642-01100-9, discusses such ends of
//! accumulations), which moves it by O(h²). What that impulse drives the body into, no faster than
//! it arrived, has e = 0 too: impacts that accumulate between several walls leave a velocity along
//! all of them. They do so without a force that presses the body on one of them, too: three
//! impacts at a wall within a step, ever faster and weaker, of which all that are left would come
//! within a step ([`LastImpacts`](crate::step::LastImpacts)). This is asked of walls without
//! friction.
//!
//! Loads of no duration and jumps of tables divide a step too, also a jump that is written as two
//! rows within a step. Elastic walls act as in moreau-jean;
//! they divide the step where the body meets them: the force of a dashpot jumps there, and a
//! contact begins with the speed of that instant.
//!
//! With round walls or friction ([`planar`], [`plane_contacts`]) the same division ends parts where
//! a place meets a circle (`round_path.rs`), where sliding ends and where it begins; a body that
//! slides along a circle is guided by an impulse along the middle of its path (`plane_bound.rs`,
//! `plane_holds.rs`). There the rest of a step of more than 64 parts has no rebounds, and
//! implicit-euler takes over after 256 more.
//!
//! Order 2 through impacts. More than 64 parts of one step (dense chatter, or a
//! step that does not resolve the motion between two walls) are given up: the rest of that step is
//! one of implicit-euler, which keeps the body in front of all walls and takes the energy of the
//! rebounds; such steps are counted and said.
//!
//! Impacts have the mass of all modes, and the rule turns the velocity of a mode that the step does
//! not resolve round in each part: what an impact sets off there never settles, and the impulses
//! depend on the step. Where a step makes the mass at a wall, that of M + ¼h²K, much larger than
//! that of M, a note says so.

mod contacts;
mod crossing;
mod division;
mod impact;
mod part;
mod planar;
mod plane_bound;
mod plane_contact;
mod plane_contacts;
mod plane_holds;
mod plane_path;
mod response;
mod round_path;
mod row_contacts;

pub(super) use planar::LocatedPlanar;

use super::Counters;
use super::body::Body;
use super::entry::{Coverage, Realised, SchemeEntry, SchemeKind};
use super::frame::{Frame, Stretch};
use super::programme::Programme;
use super::rule::Rule;
use super::space::{Space, zero};
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::Scene;
use crate::step::{Balance, Bound, Conserves, Contract, Friction, Law, Promise, QuietSteps, Reached, Tolerances};
use contacts::{Contacts, Event};
use division::Division;
use part::THETA;
use row_contacts::RowContacts;

/// What is known of the scheme beside its rule.
pub(super) const ENTRY: SchemeEntry = SchemeEntry {
    name: "located",
    settings: &[],
    default: "",
    kind: SchemeKind::Qp,
    restitution: Realised::PerWall,
    realises: "e, per wall",
    purpose: "the default at rigid flat walls without friction, at elastic walls with a dashpot, and for friction at \
              elastic round supports: order 2, since steps are divided where a wall is struck; round holes and \
              friction too",
    order: Some(2),
    fails: "a step with more than 64 parts ends without rebound (reported); a step that does not resolve what a wall \
            strikes has impulses that depend on it (a note); an impact costs several steps; a body that friction jams \
            may have no motion at a coarse step (an error)",
    round: Coverage::Stepped("finds the instants of contact, and follows the circle while the body slides along it"),
    elastic_round: Coverage::Stepped("presses with the force of the ring in the middle of each part"),
    friction: Coverage::Stepped("finds the instants at which sliding ends"),
    elastic_round_friction: Coverage::Stepped("presses along the middle of each part, and finds these instants too"),
};

/// What every step satisfies.
pub(super) fn contract() -> Contract {
    let mut promise = Promise::constraints(Some(Bound::End), Some(Reached::Closed), Law::Depth(THETA));
    (promise.hole, promise.friction) = (Some(Bound::Along), Some(Friction::EndVelocity));
    let tolerances = Tolerances::of(Conserves::RigidWalls);
    Contract { balance: Balance::Theta(THETA), promise, instant: 1.0, tolerances, divides: true }
}

/// The scheme.
#[derive(Debug)]
pub(super) struct Located<S: Space> {
    body: Body<S>,
    /// The programme of a whole step.
    programme: Programme<S>,
    division: Division<S, RowContacts<S>>,
    b: S::Vector,
    /// q⁺, v⁺ and q⁺ + ½hv⁺.
    arrived: S::Vector,
    after: S::Vector,
    ahead: S::Vector,
    /// True if all rigid walls are out of reach of the state and of q + ½hv.
    clear: bool,
}

impl<S: Space> Located<S> {
    pub fn new(scene: &Scene, h: f64, backend: Backend) -> Result<Self> {
        let body = Body::<S>::new(scene, h)?;
        let ht = h * THETA;
        let (a, scale) = (body.theta_matrix(THETA), scene.gap_scale() / h);
        let programme = Programme::new(scene, a, scale, |spring| spring.compliance(ht), backend)?;
        let division = Division::new(scene, &body, RowContacts::new(scene, &body, backend)?, backend)?;
        let [b, arrived, after, ahead] = [(); 4].map(|()| zero::<S>(body.n));
        Ok(Self { body, programme, division, b, arrived, after, ahead, clear: false })
    }

    /// Writes the state at the end of a whole step to `arrived` and `after`, and the control point
    /// of the step that follows, q⁺ + ½hv⁺, to `ahead`. Returns whether all rigid walls are out of
    /// reach of that point.
    #[inline(always)]
    fn arrive(&mut self, q: &S::Vector, v: &S::Vector) -> bool {
        let Self { body, programme, arrived, after, ahead, .. } = self;
        let (h, state) = (body.h, q.as_ref().iter().zip(v.as_ref()).zip(programme.x().as_ref()));
        let next = arrived.as_mut().iter_mut().zip(after.as_mut()).zip(ahead.as_mut());
        for (((arrived, after), ahead), ((q, v), d)) in next.zip(state) {
            *arrived = q + h * (v + THETA * d);
            *after = v + d;
            *ahead = *arrived + 0.5 * h * *after;
        }
        programme.first_near(ahead).is_none()
    }

    /// Makes step number `step` whole, if its path crosses no wall. Returns the first crossing
    /// otherwise.
    ///
    /// A parabola lies within the hull of its control points q, q + ½hv and q⁺: where these are
    /// clear of a wall, so is the path. q⁺ is the middle between the second of these and that of
    /// the step that follows, so that one look at that point settles both.
    #[inline(always)]
    fn make_whole(&mut self, step: u64, frame: &mut Frame<S>) -> Result<Option<(f64, Event)>> {
        self.programme.free();
        let near = !self.clear;
        if near {
            self.bind(frame);
        }
        self.programme.solve(&self.b, (frame.start, step), &mut frame.impulse, &mut frame.pushing)?;
        let clear = self.arrive(&frame.q, &frame.v);
        if (near || !clear)
            && let Some(crossing) = self.first_crossing(frame, near)
        {
            return Ok(Some(crossing));
        }
        self.clear = clear && (!near || self.programme.first_near(&self.arrived).is_none());
        frame.q.clone_from(&self.arrived);
        frame.v.clone_from(&self.after);
        frame.after.clone_from(&frame.v);
        for &wall in &frame.pushing {
            frame.force[wall] = frame.impulse[wall] / self.body.h;
        }
        Ok(None)
    }

    /// The first crossing of a wall on the path of a whole step, and its instant within it, s. The
    /// contacts are classified where the path begins `near` a wall.
    #[inline(never)]
    fn first_crossing(&mut self, frame: &Frame<S>, near: bool) -> Option<(f64, Event)> {
        if !near {
            self.division.classify(&self.body, frame);
        }
        self.division.contacts.first_event(&self.body, frame, (self.programme.x(), self.body.h))
    }

    /// Sets the bounds of a whole step.
    #[inline(never)]
    fn bind(&mut self, frame: &Frame<S>) {
        let Self { body, programme, division, .. } = self;
        division.classify(body, frame);
        division.contacts.set_holds(body, body.h);
        for hold in &division.contacts.holds {
            let row = programme.row_of(hold.wall);
            for number in programme.walls(row) {
                if programme.wall(number).index == hold.wall {
                    programme.bind(row, number, hold.bound);
                }
            }
        }
    }

    /// Makes the next part of a divided step.
    #[inline(never)]
    fn make_part(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        self.clear = false;
        self.division.make_part(&mut self.body, step, frame)
    }

    /// Makes step number `step`, or its next part.
    #[inline(always)]
    fn make(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        if self.division.is_under_way() {
            return self.make_part(step, frame);
        }
        frame.begin(step, self.body.h);
        (frame.stretch, frame.blown) = (Stretch::Grid, false);
        self.body.theta_momentum(THETA, frame, &mut self.b);
        let mut first = None;
        if !self.division.has_break(frame.start, frame.end) {
            first = self.make_whole(step, frame)?;
            if first.is_none() {
                return Ok(());
            }
        }
        self.division.begin(&self.body, [frame.start, frame.end], first);
        self.make_part(step, frame)
    }
}

impl<S: Space> Rule<S> for Located<S> {
    fn restart(&mut self, _: &Scene, time: f64, _: &Frame<S>) -> Result<()> {
        self.division.restart(&mut self.body, time);
        self.clear = false;
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
        mut calm: Option<&mut QuietSteps>,
    ) -> Result<u64> {
        if self.division.has_breaks() || self.division.is_under_way() || !self.clear {
            return Ok(step);
        }
        self.programme.free();
        let (h, mut next) = (self.body.h, step);
        while next < until && self.clear {
            let end = (next + 1) as f64 * h;
            self.body.momentum_to(end, THETA, (&frame.q, &frame.v, &frame.extra), &mut self.b);
            self.programme.release(&self.b, (next as f64 * h, next))?;
            let clear = self.arrive(&frame.q, &frame.v);
            if !clear && self.first_crossing(frame, false).is_some() {
                // The step is made again by itself, from the loads at its start.
                self.body.restart(next as f64 * h);
                break;
            }
            frame.before.clone_from(&frame.v);
            frame.v.clone_from(&self.after);
            frame.q.clone_from(&self.arrived);
            self.clear = clear;
            next += 1;
            if let Some(calm) = &mut calm {
                calm.add(end, (frame.q.as_ref(), frame.v.as_ref()), (frame.before.as_ref(), frame.v.as_ref()));
            }
        }
        if next > step {
            (frame.start, frame.end, frame.stretch) = ((next - 1) as f64 * h, next as f64 * h, Stretch::Grid);
            frame.after.clone_from(&frame.v);
        }
        Ok(next)
    }

    fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
        self.division.count(counters);
    }

    fn backend(&self) -> Option<Backend> {
        Some(self.programme.backend())
    }
}
