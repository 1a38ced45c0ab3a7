//! The division of a step: parts that end at impacts, blows and jumps of loads.

use super::super::Counters;
use super::super::body::Body;
use super::super::flat_row::FlatRow;
use super::super::frame::{Frame, Stretch};
use super::super::jumps::Jumps;
use super::super::position;
use super::super::programme::failure;
use super::super::space::{Space, zero};
use super::contacts::Contacts;
use super::crossing::GapPath;
use super::part::{Hold, Part};
use crate::error::{Error, Result};
use crate::qp::{Backend, Failure};
use crate::scene::Scene;
use crate::step::{Balance, Contract};

/// θ of the rule.
const THETA: f64 = 0.5;

/// Maximum number of parts of a step.
const MOST_PARTS: u32 = 64;

/// Maximum number of evaluations of a part's end in the search for its length.
const MOST_EVALUATIONS: u32 = 60;

/// The contract of the rest of a step that was given up.
const GIVEN_UP: Contract = position::contract(1.0);

/// The parts of a step, and what they need.
#[derive(Debug)]
pub(super) struct Division<S: Space> {
    part: Part<S>,
    pub contacts: Contacts<S>,
    /// Walls that bound the velocity in the current step or part.
    pub holds: Vec<Hold>,
    /// The instants of blows and of jumps of loads, s, in order, and the jumps.
    breaks: Vec<f64>,
    jumps: Option<Jumps>,
    /// The caller's extra force in this step, N.
    extra: S::Vector,
    progress: Option<Progress>,
    parts: u64,
    given_up: u64,
}

/// How far a divided step has come.
#[derive(Debug, Clone, Copy)]
struct Progress {
    /// The time reached and that of the step's end, s.
    reached: f64,
    end: f64,
    /// Parts of it so far.
    parts: u32,
}

impl<S: Space> Division<S> {
    pub fn new(scene: &Scene, body: &Body<S>, backend: Backend) -> Result<Self> {
        let jumps = Jumps::new(scene, Balance::Theta(THETA), body.h);
        let mut breaks: Vec<f64> = jumps.iter().flat_map(Jumps::instants).chain(body.blow_instants()).collect();
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        Ok(Self {
            part: Part::new(scene, body, backend),
            contacts: Contacts::new(scene, body, backend)?,
            holds: Vec::with_capacity(scene.walls.len()),
            breaks,
            jumps,
            extra: zero::<S>(body.n),
            progress: None,
            parts: 0,
            given_up: 0,
        })
    }

    /// Forgets the parts of the current step.
    pub fn restart(&mut self) {
        self.progress = None;
    }

    /// Begins the division of the step of `frame`, whose loads `body` has.
    pub fn begin(&mut self, body: &Body<S>, frame: &Frame<S>) {
        self.part.load_start.clone_from(body.load_before());
        self.extra.clone_from(&frame.extra);
        self.progress = Some(Progress { reached: frame.start, end: frame.end, parts: 0 });
    }

    /// True if a divided step has further parts.
    #[inline]
    pub fn is_under_way(&self) -> bool {
        self.progress.is_some()
    }

    /// True if there is a blow or a jump of a load at any time.
    #[inline]
    pub fn has_breaks(&self) -> bool {
        !self.breaks.is_empty()
    }

    /// True if there is one in (`from`, `to`], s.
    #[inline]
    pub fn has_break(&self, from: f64, to: f64) -> bool {
        self.has_breaks() && self.next_break(from, to).is_some()
    }

    /// The first blow or jump of a load in (`from`, `to`], s.
    fn next_break(&self, from: f64, to: f64) -> Option<f64> {
        let next = self.breaks.get(self.breaks.partition_point(|&time| time <= from));
        next.copied().filter(|&time| time <= to)
    }

    /// Finds which walls the state of `frame` touches.
    pub fn classify(&mut self, body: &Body<S>, frame: &Frame<S>) {
        self.contacts.classify(body, &self.part, frame);
    }

    /// Adds the work that the division has cost.
    pub fn count(&self, counters: &mut Counters) {
        counters.qp_solves += self.part.solves + self.contacts.impacts;
        (counters.parts, counters.steps_given_up) = (self.parts, self.given_up);
    }

    /// The bounds of the walls at which the body rests and of elastic walls, for a part of `length`
    /// seconds from the state of `frame`, with its contacts classified.
    pub fn hold(&mut self, body: &Body<S>, frame: &Frame<S>, length: f64) {
        let Self { contacts, holds, .. } = self;
        holds.clear();
        for (wall, &face) in body.walls.iter().enumerate() {
            if face.law.is_rigid() && !contacts.rests(wall) {
                continue;
            }
            let (w, rate) = (body.seen(wall, &frame.q), body.seen(wall, &frame.v));
            let (bound, compliance) = match face.law.spring() {
                Some(spring) => {
                    let st = length * THETA;
                    let compliance = 1.0 / (st * st * spring.over(st));
                    (-length * spring.force(w + st * rate, face.g, face.plate(w), st) * compliance, compliance)
                }
                None if contacts.rests_between(wall) => (-rate, 0.0),
                None => (rest_bound(face, w, rate, body.h), 0.0),
            };
            holds.push(Hold { wall, upper: face.upper, bound, compliance });
        }
    }

    /// The first crossing of a wall by the path of `length` seconds that changes the velocity by
    /// `delta`: its instant within the path, s, and the wall.
    pub fn first_crossing(
        &self,
        body: &Body<S>,
        frame: &Frame<S>,
        delta: &S::Vector,
        length: f64,
    ) -> Option<(f64, usize)> {
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

    /// Makes the next part of a divided step.
    pub fn make_part(&mut self, body: &mut Body<S>, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let Some(mut progress) = self.progress else { return Ok(()) };
        let Progress { reached: from, end, .. } = progress;
        (self.parts, progress.parts) = (self.parts + 1, progress.parts + 1);
        frame.let_go();
        (frame.start, frame.blown) = (from, false);
        frame.before.clone_from(&frame.v);
        frame.extra.clone_from(&self.extra);
        let limit = self.next_break(from, end).unwrap_or(end);
        self.classify(body, frame);
        // What is given up ends before a blow or a jump of a load, with which the division goes on.
        let given_up = if self.breaks.is_empty() { limit } else { limit.next_down() };
        if progress.parts > MOST_PARTS && given_up > from {
            self.give_up(body, step, frame, (from, given_up))?;
        } else if progress.parts > MOST_PARTS {
            self.compute(body, step, frame, (from, limit, limit - from))?;
            self.commit(body, frame, limit - from, limit);
        } else if self.contacts.is_struck() {
            self.stay(frame, from);
        } else {
            self.advance_to_crossing(body, step, frame, (from, limit))?;
        }
        let at = frame.end;
        if !matches!(frame.stretch, Stretch::Other(..)) {
            frame.blown = at > from && body.kick(from, at, &mut frame.v);
            if frame.blown {
                frame.struck.clone_from(&frame.v);
            }
            self.contacts.strike(body, &self.part, frame, step)?;
        }
        progress.reached = at;
        self.progress = (at < end).then_some(progress);
        frame.unfinished = self.progress.is_some();
        Ok(())
    }

    /// Advances to the first crossing of a wall, or to `limit` (s) if there is none before.
    fn advance_to_crossing(
        &mut self,
        body: &mut Body<S>,
        step: u64,
        frame: &mut Frame<S>,
        (from, limit): (f64, f64),
    ) -> Result<()> {
        let whole = limit - from;
        let (mut low, mut high) = (0.0, whole);
        let (mut length, mut target) = (whole, None);
        for evaluation in 0..MOST_EVALUATIONS {
            self.compute(body, step, frame, (from, limit, length))?;
            let next = if let Some((at, wall)) = self.first_crossing(body, frame, &self.part.delta, length) {
                (high, target) = (length, Some(wall));
                at
            } else {
                let path = target.map(|wall| self.gap_path(body, frame, wall, length));
                let Some(path) = path.filter(|path| path.end() > body.touch) else {
                    self.commit(body, frame, length, if length == whole { limit } else { from + length });
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
            self.compute(body, step, frame, (from, limit, low))?;
            self.commit(body, frame, low, from + low);
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
    fn gap_path(&self, body: &Body<S>, frame: &Frame<S>, wall: usize, length: f64) -> GapPath {
        let face = body.walls[wall];
        let [rate, change] = [&frame.v, &self.part.delta].map(|v| face.sign * body.seen(wall, v));
        GapPath { gap: -face.depth(body.seen(wall, &frame.q)), rate, change, span: length }
    }

    /// Computes the part of `length` seconds from `from`; one that ends at `limit` (s) ends there
    /// to the last bit, and before a jump of the loads there.
    fn compute(
        &mut self,
        body: &mut Body<S>,
        step: u64,
        frame: &mut Frame<S>,
        (from, limit, length): (f64, f64, f64),
    ) -> Result<()> {
        let end = if length == limit - from { limit } else { from + length };
        if let Some(jumps) = &mut self.jumps {
            let extra = jumps.force_within((from, end), length, Some(self.extra.as_ref()));
            frame.extra.as_mut().copy_from_slice(extra);
        }
        self.hold(body, frame, length);
        let Self { part, holds, .. } = self;
        let computed = part.compute(body, (&frame.q, &frame.v, &frame.extra), (length, end, THETA), holds);
        computed.map_err(|fault| refusal(&fault, end, step))
    }

    /// Takes over the state at `end` (s) of the part of `length` seconds that was computed last.
    fn commit(&mut self, body: &Body<S>, frame: &mut Frame<S>, length: f64, end: f64) {
        (frame.end, frame.stretch) = (end, Stretch::Part(length));
        self.take(body, frame, length, THETA);
    }

    fn take(&mut self, body: &Body<S>, frame: &mut Frame<S>, length: f64, theta: f64) {
        let part = &mut self.part;
        for ((q, v), d) in frame.q.as_mut().iter_mut().zip(frame.v.as_mut()).zip(part.delta.as_ref()) {
            *q += length * (*v + theta * d);
            *v += d;
        }
        frame.after.clone_from(&frame.v);
        for &(wall, impulse) in &part.pushes {
            frame.push(wall, impulse, length);
        }
        self.contacts.set_changes(body, &part.delta, length);
        std::mem::swap(&mut part.load_start, &mut part.load_end);
    }

    /// Makes the rest of a step up to `limit` (s) by implicit-euler: one part, at whose end the
    /// body is in front of all walls.
    #[cold]
    fn give_up(
        &mut self,
        body: &mut Body<S>,
        step: u64,
        frame: &mut Frame<S>,
        (from, limit): (f64, f64),
    ) -> Result<()> {
        self.given_up += 1;
        let length = limit - from;
        self.holds.clear();
        for (wall, face) in body.walls.iter().enumerate() {
            let (w, rate) = (body.seen(wall, &frame.q), body.seen(wall, &frame.v));
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
        let Self { part, holds, .. } = self;
        let computed = part.compute(body, (&frame.q, &frame.v, &frame.extra), (length, limit, 1.0), holds);
        computed.map_err(|fault| refusal(&fault, limit, step))?;
        (frame.end, frame.stretch) = (limit, Stretch::Other(length, &GIVEN_UP));
        self.take(body, frame, length, 1.0);
        Ok(())
    }
}

/// The bound on the change of velocity at a rigid wall on which the body rests: no speed into it,
/// and out of it by what rounding has left behind the face.
fn rest_bound(face: FlatRow, w: f64, rate: f64, h: f64) -> f64 {
    let behind = face.depth(w).max(0.0);
    face.sign * behind / h - rate
}

/// The error of a programme that was not solved in the step that ends at `time` (s).
#[cold]
fn refusal(fault: &Failure, time: f64, step: u64) -> Error {
    match fault {
        Failure::NotFinite { .. } => Error::NotFinite { time, step, what: "motion" },
        _ => failure(fault, None, time, step),
    }
}
