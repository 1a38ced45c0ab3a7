//! The division of a step: parts that end at impacts, blows and jumps of loads.

use super::super::Counters;
use super::super::body::Body;
use super::super::frame::{Frame, Stretch, step_at};
use super::super::position;
use super::super::programme::failure;
use super::super::space::{Space, zero};
use super::contacts::{Ahead, Contacts, Event};
use super::part::{Part, THETA};
use crate::error::{Error, Result};
use crate::qp::{Backend, Failure};
use crate::scene::{LoadKind, Scene};
use crate::step::{Balance, Contract, Friction, LoadJumps};

/// Maximum number of parts of a step.
const MOST_PARTS: u32 = 64;

/// Maximum number of evaluations of a part's end in the search for its length.
const MOST_EVALUATIONS: u32 = 60;

/// The shortest part by implicit-euler, in steps.
const SHORTEST: f64 = 1e-6;

/// What a step is told that has no motion.
const UNSETTLED: &str = "no motion keeps the laws of all contacts; a smaller step or moreau-jean may do";

/// The contract of the rest of a step that was given up.
const GIVEN_UP: Contract = {
    let mut contract = position::contract(1.0);
    contract.promise.friction = Some(Friction::EndVelocity);
    contract
};

/// The parts of a step, and what they need.
#[derive(Debug)]
pub(super) struct Division<S: Space, C> {
    part: Part<S>,
    pub contacts: C,
    /// The instants of blows, of jumps of loads and of the rows of tables between which they nearly
    /// jump, s, in order, and the jumps.
    breaks: Vec<f64>,
    jumps: Option<LoadJumps>,
    /// The caller's extra force in this part, N.
    extra: S::Vector,
    /// The loads at the end of this step, N.
    load_end: S::Vector,
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
    /// The first event on the path of the whole step, where that is known.
    first: Option<(f64, Event)>,
}

impl<S: Space, C: Contacts<S>> Division<S, C> {
    pub fn new(scene: &Scene, body: &Body<S>, contacts: C, backend: Backend) -> Result<Self> {
        let jumps = LoadJumps::new(scene, Balance::Theta(THETA), body.h);
        let steep = scene.loads.iter().filter_map(|load| match &load.kind {
            LoadKind::Table(table) => Some(table.steep_rows(body.h)),
            _ => None,
        });
        let mut breaks: Vec<f64> = jumps.iter().flat_map(LoadJumps::instants).chain(body.blow_instants()).collect();
        breaks.extend(steep.flatten());
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        Ok(Self {
            part: Part::new(scene, body, backend)?,
            contacts,
            breaks,
            jumps,
            extra: zero::<S>(body.n),
            load_end: zero::<S>(body.n),
            progress: None,
            parts: 0,
            given_up: 0,
        })
    }

    /// Restarts `body` at `time` (s). Within a step its rest is to be made, in parts.
    pub fn restart(&mut self, body: &mut Body<S>, time: f64) {
        body.restart(time);
        self.contacts.restart();
        self.progress = None;
        if let (index, true) = step_at(time, body.h) {
            let end = (index + 1) as f64 * body.h;
            body.load_at(end);
            self.begin(body, [time, end], None);
        }
    }

    /// Begins the division of the step, or of its rest, between these two times (s), whose loads
    /// `body` has, with the `first` event on its path and the instant of that (s) within it, where
    /// the step was computed whole.
    pub fn begin(&mut self, body: &Body<S>, [start, end]: [f64; 2], first: Option<(f64, Event)>) {
        self.part.load_start.clone_from(body.load_before());
        self.load_end.clone_from(&body.load);
        self.progress = Some(Progress { reached: start, end, parts: 0, first });
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
        self.contacts.count(counters);
        self.part.count(counters);
        (counters.parts, counters.steps_given_up) = (self.parts, self.given_up);
    }

    /// Makes the next part of a divided step.
    pub fn make_part(&mut self, body: &mut Body<S>, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let Some(mut progress) = self.progress else { return Ok(()) };
        let Progress { reached: from, end, .. } = progress;
        self.extra.clone_from(&frame.extra);
        (self.parts, progress.parts) = (self.parts + 1, progress.parts + 1);
        frame.take_back_impulses();
        (frame.start, frame.blown) = (from, false);
        frame.before.clone_from(&frame.v);
        self.classify(body, frame);
        let mut limit = self.next_break(from, end).unwrap_or(end);
        if limit.next_down() > from && self.contacts.sets_blows_apart() && self.next_break(from, end).is_some() {
            limit = limit.next_down();
        }
        // What is given up ends before a blow or a jump of a load, with which the division goes on.
        let given_up = if self.breaks.is_empty() { limit } else { limit.next_down() };
        let spent = progress.parts > MOST_PARTS + self.contacts.parts_without_rebound();
        self.contacts.set_rebounds(progress.parts <= MOST_PARTS);
        self.given_up += u64::from(progress.parts == MOST_PARTS + 1);
        if spent && given_up > from {
            self.give_up(body, step, frame, (from, given_up))?;
        } else if spent {
            if !self.compute(body, step, frame, (from, limit, limit - from))? {
                return Err(refusal(&Failure::NotSolved { status: UNSETTLED }, limit, step));
            }
            self.commit(body, frame, limit - from, limit);
        } else if self.contacts.is_struck() {
            self.stay(frame, from);
        } else {
            self.advance_to_crossing(body, step, frame, (from, limit, progress.first.take()))?;
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

    /// Advances to the first crossing of a wall, or to `limit` (s) if there is none before. With
    /// the `first` event on the path up to there, the search begins at that.
    fn advance_to_crossing(
        &mut self,
        body: &mut Body<S>,
        step: u64,
        frame: &mut Frame<S>,
        (from, limit, first): (f64, f64, Option<(f64, Event)>),
    ) -> Result<()> {
        let whole = limit - from;
        let (mut low, mut high) = (0.0, whole);
        let first = first.filter(|(at, _)| low < *at && *at < high);
        let (mut length, mut target) = first.map_or((whole, None), |(at, event)| (at, Some(event)));
        for evaluation in 0..MOST_EVALUATIONS {
            let found = self.compute(body, step, frame, (from, limit, length))?;
            if !found && evaluation == 0 && self.contacts.stops() {
                self.stay(frame, from);
                return Ok(());
            }
            let motion = (&self.part.delta, length);
            let next = if !found {
                high = length;
                0.5 * (low + length)
            } else {
                let event = self.contacts.first_event(body, frame, motion);
                let sought = event.map_or(target, |(_, event)| Some(event));
                let ahead = sought.map(|event| self.contacts.ahead(body, frame, event, motion));
                // An event at the very end is met there, neither before nor after it.
                let met = |ahead: &Ahead| match event {
                    Some((at, _)) => at >= length && ahead.left.abs() <= ahead.met,
                    None => ahead.left <= ahead.met,
                };
                let Some(ahead) = ahead.filter(|ahead| !met(ahead)) else {
                    self.commit(body, frame, length, if length == whole { limit } else { from + length });
                    return Ok(());
                };
                target = sought;
                match event {
                    Some((at, _)) => {
                        high = length;
                        at
                    }
                    None => {
                        low = length;
                        length - ahead.left / ahead.rate
                    }
                }
            };
            let within = low < next && next < high && evaluation < MOST_EVALUATIONS / 2;
            length = if within { next } else { 0.5 * (low + high) };
            if !(low < length && length < high) {
                break;
            }
        }
        // Neighbouring numbers: the path grazes the wall, and the part ends in front of it.
        if low > 0.0 && self.compute(body, step, frame, (from, limit, low))? {
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
        self.contacts.stay();
    }

    /// Computes the part of `length` seconds from `from`, and returns whether it was found; one
    /// that ends at `limit` (s) ends there to the last bit, and before a jump of the loads there.
    fn compute(
        &mut self,
        body: &mut Body<S>,
        step: u64,
        frame: &mut Frame<S>,
        (from, limit, length): (f64, f64, f64),
    ) -> Result<bool> {
        let end = if length == limit - from { limit } else { from + length };
        if let Some(jumps) = &mut self.jumps {
            let extra = jumps.force_within((from, end), length, Some(self.extra.as_ref()));
            // Set through the frame, which takes it back in the next step: set beside it, a jump at
            // the end of a step would act for ever.
            frame.force(Some(extra));
        }
        let Self { part, contacts, progress, load_end, .. } = self;
        if progress.is_some_and(|progress| end == progress.end) {
            part.load_end.clone_from(load_end);
        } else {
            body.force_at(end, &mut part.load_end);
        }
        part.set_momentum(body, (&frame.q, &frame.v, &frame.extra), (length, THETA));
        contacts.solve_contacts(body, part, frame, length).map_err(|fault| refusal(&fault, end, step))
    }

    /// Takes over the state at `end` (s) of the part of `length` seconds that was computed last.
    fn commit(&mut self, body: &Body<S>, frame: &mut Frame<S>, length: f64, end: f64) {
        (frame.end, frame.stretch) = (end, Stretch::Part(length));
        self.take(body, frame, length, THETA);
    }

    fn take(&mut self, body: &Body<S>, frame: &mut Frame<S>, length: f64, theta: f64) {
        let part = &mut self.part;
        frame.add_change((length, theta), &part.delta);
        for push in &part.pushes {
            frame.push(push.wall, push.impulse, length);
            if let (Some(friction), Some(normal)) = (frame.friction.get_mut(push.wall), frame.normal.get_mut(push.wall))
            {
                (*friction, *normal) = (push.friction, push.normal);
            }
        }
        self.contacts.keep(body, part, frame, length);
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
        let whole = limit - from;
        let mut length = whole;
        let Self { part, contacts, progress, .. } = self;
        let last =
            progress.is_some_and(|progress| progress.parts > 2 * (MOST_PARTS + contacts.parts_without_rebound()));
        let end = loop {
            let end = if length == whole { limit } else { from + length };
            body.force_at(end, &mut part.load_end);
            part.set_momentum(body, (&frame.q, &frame.v, &frame.extra), (length, 1.0));
            let found = contacts.give_up(body, part, frame, length).map_err(|fault| refusal(&fault, end, step))?;
            if found {
                break end;
            }
            length *= 0.5;
            if last || length < SHORTEST * body.h {
                return Err(refusal(&Failure::NotSolved { status: UNSETTLED }, end, step));
            }
        };
        (frame.end, frame.stretch) = (end, Stretch::Other(length, &GIVEN_UP));
        self.take(body, frame, length, 1.0);
        self.contacts.forget();
        Ok(())
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
