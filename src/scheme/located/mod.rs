//! `located`: the θ-method with θ = ½, whose steps are divided at the impacts.
//!
//! Between impacts the rule is that of moreau-jean with θ = ½ ([`super::moreau_jean`]). Where the
//! path of a step crosses a rigid wall, the step is divided there: a part of length s ends at the
//! instant at which the part's own displacement meets the wall, g·q(s) = g_w, the impact law changes
//! the velocity at that instant, and the rest of the step follows as a part of its own. With
//! A(s) = M + ½sC + ¼s²K,
//!
//! A(s) δ = s[½(f + f⁺) + f_x − C v − K(q + ½s v)] + p,   q(s) = q + s(v + ½δ),   v(s) = v + δ.
//!
//! The velocity of the rule is linear over a step, so that the gaps are parabolas, along which the
//! search for the first crossing skips none (`crossing.rs`); the root of g·q(s) is then found by
//! Newton's method within the bracket of that search, one factor of A(s) an evaluation.
//!
//! At the instant of an impact the change of velocity is the solution of
//!
//! minimise ½ δᵀM δ   subject to   ẇ⁺ + ε ẇ ≤ 0 (upper), ≥ 0 (lower)
//!
//! over the walls that are touched, with ε = e where the body approaches or rests and 1 where it
//! separates: Moreau's law at an instant (Moreau 1988, doi:10.1007/978-3-7091-2624-0_1). A wall that
//! is still approached after that is struck again at the same instant.
//!
//! A body rests where it touches a wall without speed. Such walls bound the velocity at the end of
//! each part, ẇ⁺ ≤ 0, so that the body stays on the face, at no depth. If the pressing acceleration a
//! of the part before an impact would end the rebounds within a step, τ = 2e|ẇ|/(a(1 − e)) ≤ h, the
//! body rests at once (Studer 2009, doi:10.1007/978-3-642-01100-9, discusses such ends of
//! accumulations), which moves it by O(h²).
//!
//! Loads of no duration and jumps of tables divide a step too. Elastic walls act as in moreau-jean;
//! one with a dashpot divides the step where the body meets it, since its force jumps there.
//!
//! Order 2 through impacts. More than [`MOST_PARTS`] parts of one step (dense chatter, or a
//! step that does not resolve the motion between two walls) are given up: the rest of that step is
//! one of implicit-euler, which keeps the body in front of all walls and takes the energy of the
//! rebounds; such steps are counted and said.

mod crossing;
mod impact;
mod part;

use super::Counters;
use super::body::Body;
use super::entry::{Coverage, ONE_FOR_FRICTION, Realised, SchemeEntry, SchemeKind};
use super::flat_row::FlatRow;
use super::frame::{Frame, Stretch};
use super::jumps::Jumps;
use super::position;
use super::programme::{Programme, failure};
use super::rule::Rule;
use super::space::{Space, zero};
use crate::error::{Error, Result};
use crate::qp::{Backend, Failure};
use crate::scene::{Scene, WallLaw};
use crate::step::{Balance, Bound, Calm, Conserves, Contract, Law, Promise, Reached, Tolerances};
use crossing::GapPath;
use impact::Contacts;
use part::{Hold, Part};

/// θ of the rule.
const THETA: f64 = 0.5;

/// Maximum number of parts of a step.
const MOST_PARTS: u32 = 64;

/// Maximum number of evaluations of a part's end in the search for its length.
const MOST_EVALUATIONS: u32 = 60;

/// What is known of the scheme beside its rule.
pub(super) const ENTRY: SchemeEntry = SchemeEntry {
    name: "located",
    settings: &[],
    default: "",
    kind: SchemeKind::Qp,
    restitution: Realised::PerWall,
    realises: "e, per wall",
    purpose: "order 2 through impacts: steps are divided where a wall is struck; a body that rests stands on the face",
    fails: "a step with more than 64 parts ends without rebound (reported); an impact costs several steps",
    round: Coverage::Refused("moreau-jean or event: this scheme has no rule for the turning normal of a round support"),
    elastic_round: Coverage::Refused(
        "moreau-jean, implicit-euler or penalty, the schemes for elastic round supports",
    ),
    friction: Coverage::Refused(ONE_FOR_FRICTION),
};

/// What every step satisfies.
pub(super) fn contract() -> Contract {
    let promise = Promise::constraints(Some(Bound::End), Some(Reached::Closed), Law::Depth(THETA));
    let tolerances = Tolerances::of(Conserves::RigidWalls);
    Contract { balance: Balance::Theta(THETA), promise, instant: 1.0, tolerances, divides: true }
}

/// The contract of the rest of a step that was given up.
const GIVEN_UP: Contract = position::contract(1.0);

/// The scheme.
#[derive(Debug)]
pub(super) struct Located<S: Space> {
    body: Body<S>,
    /// The programme of a whole step.
    programme: Programme<S>,
    part: Part<S>,
    contacts: Contacts<S>,
    b: S::Vector,
    /// Control points of the step's path: q + ½hv and q⁺.
    ahead: S::Vector,
    arrived: S::Vector,
    /// True if all rigid walls are out of reach of the state.
    clear: bool,
    /// Walls that bound the velocity in the current part.
    holds: Vec<Hold>,
    /// The instants of blows and of jumps of loads, s, in order, and the jumps.
    breaks: Vec<f64>,
    jumps: Option<Jumps>,
    /// The caller's extra force in this step, N.
    extra: S::Vector,
    division: Option<Division>,
    counted: Counted,
}

/// How far a divided step has come.
#[derive(Debug, Clone, Copy)]
struct Division {
    /// The time reached and that of the step's end, s.
    reached: f64,
    end: f64,
    /// Parts of it so far.
    parts: u32,
}

/// The work that the division of steps has cost.
#[derive(Debug, Clone, Copy, Default)]
struct Counted {
    parts: u64,
    given_up: u64,
}

impl<S: Space> Located<S> {
    pub fn new(scene: &Scene, h: f64, backend: Backend) -> Result<Self> {
        let body = Body::<S>::new(scene, h)?;
        let ht = h * THETA;
        let compliance = |k: f64, c: f64| 1.0 / (ht * ht * (k + c / ht));
        let scale = scene.gap_scale() / h;
        let programme = Programme::new(scene, body.theta_matrix(THETA), scale, compliance, backend)?;
        let jumps = Jumps::new(scene, Balance::Theta(THETA), h);
        let mut breaks: Vec<f64> = jumps.iter().flat_map(Jumps::instants).chain(body.blow_instants()).collect();
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        let vector = || zero::<S>(body.n);
        Ok(Self {
            programme,
            part: Part::new(scene, &body, backend),
            contacts: Contacts::new(scene, &body, backend)?,
            b: vector(),
            ahead: vector(),
            arrived: vector(),
            clear: false,
            holds: Vec::with_capacity(scene.walls.len()),
            breaks,
            jumps,
            extra: vector(),
            division: None,
            counted: Counted::default(),
            body,
        })
    }

    /// The first blow or jump of a load in (`from`, `to`], s.
    fn next_break(&self, from: f64, to: f64) -> Option<f64> {
        let next = self.breaks.get(self.breaks.partition_point(|&time| time <= from));
        next.copied().filter(|&time| time <= to)
    }

    /// The bounds of the walls at which the body rests and of elastic walls, for a part of `length`
    /// seconds from the state of `frame`, with its contacts classified.
    fn hold(&mut self, frame: &Frame<S>, length: f64) {
        let Self { body, contacts, holds, .. } = self;
        holds.clear();
        for wall in 0..body.walls.len() {
            let face = body.walls[wall];
            let (w, rate) = (body.seen(wall, &frame.q), body.seen(wall, &frame.v));
            let (bound, compliance) = match face.law.spring() {
                Some(spring) => {
                    let st = length * THETA;
                    let compliance = 1.0 / (st * st * spring.over(st));
                    (-length * spring.force(w + st * rate, face.g, face.plate(w), st) * compliance, compliance)
                }
                None if contacts.rests(wall) && contacts.rests_between(wall) => (-rate, 0.0),
                None if contacts.rests(wall) => (rest_bound(face, w, rate, body.h), 0.0),
                None => continue,
            };
            holds.push(Hold { wall, upper: face.upper, bound, compliance });
        }
    }

    /// The first crossing of a wall by the path of `length` seconds that changes the velocity by
    /// `delta`: its instant within the path, s, and the wall.
    fn first_crossing(&self, frame: &Frame<S>, delta: &S::Vector, length: f64) -> Option<(f64, usize)> {
        let body = &self.body;
        let mut first: Option<(f64, usize)> = None;
        for (wall, face) in body.walls.iter().enumerate() {
            let damped = face.law.damping() > 0.0;
            if !face.law.is_rigid() && !damped || self.contacts.rests(wall) {
                continue;
            }
            let gap = -face.depth(body.seen(wall, &frame.q));
            if damped && gap <= body.touch {
                continue;
            }
            let [rate, change] = [&frame.v, delta].map(|v| face.sign * body.seen(wall, v));
            let path = GapPath { gap, rate, change, span: length };
            if let Some(at) = path.crossing(body.touch)
                && first.is_none_or(|(earliest, _)| at < earliest)
            {
                first = Some((at, wall));
            }
        }
        first
    }

    /// Makes the step number `step` whole, if its path crosses no wall. Returns whether it did.
    #[inline(always)]
    fn make_whole(&mut self, step: u64, frame: &mut Frame<S>) -> Result<bool> {
        let h = self.body.h;
        self.programme.free();
        set_ahead::<S>(0.5 * h, &frame.q, &frame.v, &mut self.ahead);
        let near = !self.clear || self.programme.first_near(&self.ahead).is_some();
        if near {
            self.bind(frame);
        }
        self.programme.solve(&self.b, (frame.start, step), &mut frame.impulse, &mut frame.pushing)?;
        let delta = self.programme.x();
        for ((arrived, ahead), (q, (v, d))) in self
            .arrived
            .as_mut()
            .iter_mut()
            .zip(self.ahead.as_mut())
            .zip(frame.q.as_ref().iter().zip(frame.v.as_ref().iter().zip(delta.as_ref())))
        {
            *arrived = q + h * (v + THETA * d);
            *ahead = v + d;
        }
        let clear = self.programme.first_near(&self.arrived).is_none();
        if !near && !clear {
            self.contacts.leave_all();
        }
        if (near || !clear) && self.first_crossing(frame, self.programme.x(), h).is_some() {
            return Ok(false);
        }
        self.clear = clear;
        frame.q.clone_from(&self.arrived);
        frame.v.clone_from(&self.ahead);
        frame.after.clone_from(&frame.v);
        for &wall in &frame.pushing {
            frame.force[wall] = frame.impulse[wall] / h;
        }
        Ok(true)
    }

    /// Sets the bounds of a whole step.
    #[inline(never)]
    fn bind(&mut self, frame: &Frame<S>) {
        self.contacts.classify(&self.body, &self.part, frame);
        self.hold(frame, self.body.h);
        let Self { programme, holds, .. } = self;
        let mut next = holds.iter().peekable();
        if next.peek().is_none() {
            return;
        }
        for row in 0..programme.count_rows() {
            for number in programme.walls(row) {
                let wall = programme.wall(number).index;
                if let Some(hold) = holds.iter().find(|hold| hold.wall == wall) {
                    programme.bind(row, number, hold.bound);
                }
            }
        }
    }

    /// Makes the next part of a divided step.
    #[inline(never)]
    fn make_part(&mut self, step: u64, frame: &mut Frame<S>, mut division: Division) -> Result<()> {
        let Division { reached: from, end, .. } = division;
        self.counted.parts += 1;
        frame.let_go();
        (frame.start, frame.blown) = (from, false);
        frame.before.clone_from(&frame.v);
        frame.extra.clone_from(&self.extra);
        let limit = self.next_break(from, end).unwrap_or(end);
        self.contacts.classify(&self.body, &self.part, frame);
        division.parts += 1;
        // What is given up ends before a blow or a jump of a load, with which the division goes on.
        let given_up = if self.breaks.is_empty() { limit } else { limit.next_down() };
        if division.parts > MOST_PARTS && given_up > from {
            self.give_up(step, frame, (from, given_up))?;
        } else if division.parts > MOST_PARTS {
            self.compute(step, frame, (from, limit, limit - from))?;
            self.commit(frame, limit - from, limit);
        } else if self.contacts.is_struck() {
            self.stay(frame, from);
        } else {
            self.advance_to_crossing(step, frame, (from, limit))?;
        }
        let at = frame.end;
        if !matches!(frame.stretch, Stretch::Other(..)) {
            frame.blown = at > from && self.body.kick(from, at, &mut frame.v);
            if frame.blown {
                frame.struck.clone_from(&frame.v);
            }
            self.contacts.strike(&self.body, &self.part, frame, step)?;
        }
        self.clear = false;
        division.reached = at;
        self.division = (at < end).then_some(division);
        frame.unfinished = self.division.is_some();
        Ok(())
    }

    /// Advances to the first crossing of a wall, or to `limit` (s) if there is none before.
    fn advance_to_crossing(&mut self, step: u64, frame: &mut Frame<S>, (from, limit): (f64, f64)) -> Result<()> {
        let whole = limit - from;
        let (mut low, mut high) = (0.0, whole);
        let (mut length, mut target) = (whole, None);
        for evaluation in 0..MOST_EVALUATIONS {
            self.compute(step, frame, (from, limit, length))?;
            let next = if let Some((at, wall)) = self.first_crossing(frame, &self.part.delta, length) {
                (high, target) = (length, Some(wall));
                at
            } else {
                let path = target.map(|wall| self.gap_path(frame, wall, length));
                let Some(path) = path.filter(|path| path.end() > self.body.touch) else {
                    self.commit(frame, length, if length == whole { limit } else { from + length });
                    return Ok(());
                };
                low = length;
                length - path.end() / (path.rate + path.change)
            };
            let within = low < next && next < high && evaluation < MOST_EVALUATIONS / 2;
            length = if within { next } else { 0.5 * (low + high) };
            if !(low < length && length < high) {
                break;
            }
        }
        // Neighbouring numbers: the path grazes the wall, and the part ends in front of it.
        if low > 0.0 {
            self.compute(step, frame, (from, limit, low))?;
            self.commit(frame, low, from + low);
        } else {
            self.stay(frame, from);
        }
        Ok(())
    }

    /// Ends a part where it begins, at `time` (s).
    fn stay(&mut self, frame: &mut Frame<S>, time: f64) {
        (frame.end, frame.stretch) = (time, Stretch::Part(0.0));
        frame.after.clone_from(&frame.v);
        self.contacts.forget_changes();
    }

    /// The gap of a wall along the part of `length` seconds that was computed last.
    fn gap_path(&self, frame: &Frame<S>, wall: usize, length: f64) -> GapPath {
        let face = self.body.walls[wall];
        let [rate, change] = [&frame.v, &self.part.delta].map(|v| face.sign * self.body.seen(wall, v));
        GapPath { gap: -face.depth(self.body.seen(wall, &frame.q)), rate, change, span: length }
    }

    /// Computes the part of `length` seconds from `from`; one that ends at `limit` (s) ends there to
    /// the last bit, and before a jump of the loads there.
    fn compute(&mut self, step: u64, frame: &mut Frame<S>, (from, limit, length): (f64, f64, f64)) -> Result<()> {
        let end = if length == limit - from { limit } else { from + length };
        if let Some(jumps) = &mut self.jumps {
            let extra = jumps.force_within((from, end), length, Some(self.extra.as_ref()));
            frame.extra.as_mut().copy_from_slice(extra);
        }
        self.hold(frame, length);
        let Self { part, body, holds, .. } = self;
        let computed = part.compute(body, (&frame.q, &frame.v, &frame.extra), (length, end, THETA), holds);
        computed.map_err(|fault| refusal(&fault, end, step))
    }

    /// Takes over the state at `end` (s) of the part of `length` seconds that was computed last.
    fn commit(&mut self, frame: &mut Frame<S>, length: f64, end: f64) {
        (frame.end, frame.stretch) = (end, Stretch::Part(length));
        self.take(frame, length, THETA);
    }

    fn take(&mut self, frame: &mut Frame<S>, length: f64, theta: f64) {
        let part = &mut self.part;
        for ((q, v), d) in frame.q.as_mut().iter_mut().zip(frame.v.as_mut()).zip(part.delta.as_ref()) {
            *q += length * (*v + theta * d);
            *v += d;
        }
        frame.after.clone_from(&frame.v);
        for &(wall, impulse) in &part.pushes {
            frame.push(wall, impulse, length);
        }
        self.contacts.set_changes(&self.body, &part.delta, length);
        std::mem::swap(&mut part.load_start, &mut part.load_end);
    }

    /// Makes the rest of a step up to `limit` (s) by implicit-euler: one part, at whose end the body
    /// is in front of all walls.
    #[cold]
    fn give_up(&mut self, step: u64, frame: &mut Frame<S>, (from, limit): (f64, f64)) -> Result<()> {
        self.counted.given_up += 1;
        let length = limit - from;
        self.holds.clear();
        for wall in 0..self.body.walls.len() {
            let face = self.body.walls[wall];
            let (w, rate) = (self.body.seen(wall, &frame.q), self.body.seen(wall, &frame.v));
            let (bound, compliance) = match face.law.spring() {
                Some(spring) => {
                    let compliance = 1.0 / (length * length * spring.over(length));
                    let force = spring.force(w + length * rate, face.g, face.plate(w), length);
                    (-length * force * compliance, compliance)
                }
                None => ((face.g - w) / length - rate, 0.0),
            };
            self.holds.push(Hold { wall, upper: face.upper, bound, compliance });
        }
        let Self { part, body, holds, .. } = self;
        let computed = part.compute(body, (&frame.q, &frame.v, &frame.extra), (length, limit, 1.0), holds);
        computed.map_err(|fault| refusal(&fault, limit, step))?;
        (frame.end, frame.stretch) = (limit, Stretch::Other(length, &GIVEN_UP));
        self.take(frame, length, 1.0);
        Ok(())
    }
}

/// The bound on the change of velocity at a rigid wall on which the body rests: no speed into it,
/// and out of it by what rounding has left behind the face.
fn rest_bound(face: FlatRow, w: f64, rate: f64, h: f64) -> f64 {
    let behind = face.depth(w).max(0.0);
    face.sign * behind / h - rate
}

/// Writes q + `span` · v to `out`.
#[inline(always)]
fn set_ahead<S: Space>(span: f64, q: &S::Vector, v: &S::Vector, out: &mut S::Vector) {
    for (out, (q, v)) in out.as_mut().iter_mut().zip(q.as_ref().iter().zip(v.as_ref())) {
        *out = q + span * v;
    }
}

/// The error of a programme that was not solved in the step that ends at `time` (s).
#[cold]
fn refusal(fault: &Failure, time: f64, step: u64) -> Error {
    match fault {
        Failure::NotFinite { .. } => Error::NotFinite { time, step, what: "motion" },
        _ => failure(fault, None, time, step),
    }
}

impl<S: Space> Rule<S> for Located<S> {
    fn restart(&mut self, _: &Scene, time: f64, _: &Frame<S>) -> Result<()> {
        self.body.restart(time);
        (self.clear, self.division) = (false, None);
        Ok(())
    }

    fn advance(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        if let Some(division) = self.division {
            return self.make_part(step, frame, division);
        }
        let h = self.body.h;
        frame.begin(step, h);
        frame.stretch = Stretch::Grid;
        frame.blown = false;
        self.body.theta_momentum(THETA, frame, &mut self.b);
        let (start, end) = (frame.start, frame.end);
        let free = self.breaks.is_empty() || self.next_break(start, end).is_none();
        if free && self.make_whole(step, frame)? {
            return Ok(());
        }
        self.part.load_start.clone_from(self.body.load_before());
        self.extra.clone_from(&frame.extra);
        self.make_part(step, frame, Division { reached: start, end, parts: 0 })
    }

    fn glide(&mut self, step: u64, until: u64, frame: &mut Frame<S>, mut calm: Option<&mut Calm>) -> Result<u64> {
        if !self.breaks.is_empty() || self.division.is_some() || !self.clear {
            return Ok(step);
        }
        self.programme.free();
        let Self { body, programme, b, ahead, arrived, .. } = self;
        let (h, mut next) = (body.h, step);
        while next < until {
            set_ahead::<S>(0.5 * h, &frame.q, &frame.v, ahead);
            if programme.first_near(ahead).is_some() {
                break;
            }
            let end = (next + 1) as f64 * h;
            body.momentum_to(end, THETA, (&frame.q, &frame.v, &frame.extra), b);
            programme.release(b, (next as f64 * h, next))?;
            let delta = programme.x();
            for (arrived, (q, (v, d))) in arrived
                .as_mut()
                .iter_mut()
                .zip(frame.q.as_ref().iter().zip(frame.v.as_ref().iter().zip(delta.as_ref())))
            {
                *arrived = q + h * (v + THETA * d);
            }
            if programme.first_near(arrived).is_some() {
                // The step is made again by itself, from the loads at its start.
                body.restart(next as f64 * h);
                break;
            }
            frame.before.clone_from(&frame.v);
            frame.v.as_mut().iter_mut().zip(delta.as_ref()).for_each(|(v, d)| *v += d);
            frame.q.clone_from(arrived);
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
        counters.qp_solves += self.part.solves + self.contacts.impacts;
        counters.parts = self.counted.parts;
        counters.steps_given_up = self.counted.given_up;
    }

    fn backend(&self) -> Option<Backend> {
        Some(self.programme.backend())
    }
}

/// True for a law that an impact obeys.
fn is_rigid(law: &WallLaw) -> bool {
    law.is_rigid()
}
