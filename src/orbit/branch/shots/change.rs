//! Where the walls that an orbit meets, or their order, change.

use super::Shots;
use super::graze::Contact;
use super::step_start::{StepStart, events};
use crate::orbit::branch::arclength::Vector;
use crate::orbit::branch::label::Label;
use crate::orbit::branch::line::{Begin, Passed};
use crate::orbit::branch::point::Point;
use crate::orbit::signature::{Event, Kind};
use crate::orbit::watch::Passage;
use crate::order::sort_by_number;

/// A graze is looked for where its test function, extrapolated linearly, vanishes within this
/// arclength (for points of size 1). Steps are shorter there, but impact speeds and gaps go to 0
/// linearly.
const AHEAD: f64 = 0.1;

/// Most contacts that are tried.
const MOST_TRIED: usize = 4;

/// A graze lies within this many times the distance at which it was expected.
const EXPECTED: f64 = 3.0;

/// Longest step within which any other change is looked for …
const SHORT: f64 = 5e-3;

/// … and the one at which it is located, as a share of that.
const LOCATED: f64 = 1e-10;

/// Touches of one wall at two points of the branch are the same if they differ by less than this,
/// in cycles.
const SAME: f64 = 0.1;

/// A change ahead of a point.
pub(super) struct Change<'a> {
    label: Label,
    event: usize,
    wall: Option<usize>,
    pub point: Point,
    y: Vector,
    /// How far ahead it lies.
    pub step: f64,
    beyond: Option<Begin<Shots<'a>>>,
}

/// A contact that may begin or vanish ahead.
struct Candidate {
    contact: Contact,
    /// Indices of its events among those of the point; empty for a contact that may begin.
    own: Vec<usize>,
    /// How far ahead.
    distance: f64,
}

impl<'a> Change<'a> {
    /// The special point after `after` points of the branch.
    pub fn passed(self, curve: &Shots<'a>, after: usize) -> Passed<Shots<'a>> {
        let Self { label, event, wall, point, y, beyond, .. } = self;
        let beyond = beyond.and_then(|begin| Shots::shortest(begin).ok()).map(Box::new);
        Passed { label, event, wall, point, curve: curve.clone(), y, after, beyond }
    }
}

impl<'a> Shots<'a> {
    /// The change ahead of `now` because of which a step was rejected: a graze, near which the map
    /// has a square root, or a change that Newton's method can step across. `before` is the point
    /// before, with its distance; `other` the orbit at the end of the step, if it has other events.
    pub(super) fn change(
        &self,
        now: &StepStart,
        before: Option<&(StepStart, f64)>,
        step: f64,
        other: Option<&StepStart>,
    ) -> Option<Change<'a>> {
        let mut candidates = self.candidates(now, before, step, other);
        sort_by_number(&mut candidates, |a| a.distance);
        let found = candidates.into_iter().take(MOST_TRIED).find_map(|candidate| self.grazes(now, step, &candidate));
        found.or_else(|| self.kink(now, step, other?))
    }

    /// The contacts that may vanish or begin within a few steps.
    fn candidates(
        &self,
        now: &StepStart,
        before: Option<&(StepStart, f64)>,
        step: f64,
        other: Option<&StepStart>,
    ) -> Vec<Candidate> {
        let passages = &now.passages;
        let ends = [self.strobe, self.strobe + self.cycles()];
        let previous = |i: usize| if i == 0 { ends[0] } else { passages[i - 1].phase };
        let following = |i: usize| passages.get(i).map_or(ends[1], |p| p.phase);
        let mut found = Vec::new();
        let last = before.filter(|(before, _)| before.meets_as(now));
        // Distance at which a quantity vanishes that was `a` a distance `s` before and is `b` now.
        let root = |a: f64, b: f64, s: f64| if a > b { s * b / (a - b) } else { f64::INFINITY };
        let differs = |wall: usize, more: bool| {
            let count = |here: &StepStart| {
                here.passages.iter().filter(|p| p.event.wall == wall && p.event.kind.is_approach()).count()
            };
            other.is_some_and(|other| if more { count(other) > count(now) } else { count(other) < count(now) })
        };
        for (i, passage) in passages.iter().enumerate() {
            let wall = passage.event.wall;
            let leave =
                passages.iter().skip(i).position(|p| p.event == Event { kind: Kind::Leave, wall }).map(|k| i + k);
            let (until, power) = match (passage.event.kind, leave) {
                (Kind::Impact, _) => (i, 1),
                // The depth of a short contact grows with the square of its speed.
                (Kind::Enter, Some(until)) => (until, 2),
                _ => continue,
            };
            let was = last.and_then(|(before, s)| Some((before.passages.get(i)?.speed, *s)));
            let mut distance = was.map_or(f64::INFINITY, |(v, s)| root(v.powi(power), passage.speed.powi(power), s));
            if differs(wall, false) {
                distance = distance.min(step);
            }
            let at = 0.5 * (passage.phase + passages[until].phase);
            let window = [0.5 * (previous(i) + passage.phase), 0.5 * (passages[until].phase + following(until + 1))];
            let own = (i..=until).filter(|&k| passages[k].event.wall == wall).collect();
            found.push(Candidate { contact: Contact { wall, window, at }, own, distance });
        }
        for touch in &now.touches {
            let was = last.and_then(|(before, s)| {
                let same = before.touches.iter().filter(|t| t.wall == touch.wall);
                let apart = |phase: f64| (phase - touch.phase).abs();
                let near = same.min_by(|a, b| apart(a.phase).total_cmp(&apart(b.phase)))?;
                (apart(near.phase) < SAME).then_some((near.gap, *s))
            });
            let mut distance = was.map_or(f64::INFINITY, |(gap, s)| root(gap, touch.gap, s));
            if differs(touch.wall, true) {
                distance = distance.min(step);
            }
            let i = passages.partition_point(|p| p.phase < touch.phase);
            let window = [0.5 * (previous(i) + touch.phase), 0.5 * (touch.phase + following(i))];
            let contact = Contact { wall: touch.wall, window, at: touch.phase };
            found.push(Candidate { contact, own: Vec::new(), distance });
        }
        found.retain(|candidate| candidate.distance <= AHEAD * now.size());
        found
    }

    /// The graze at which `candidate` begins or vanishes, if it lies near.
    fn grazes(&self, now: &StepStart, step: f64, candidate: &Candidate) -> Option<Change<'a>> {
        let Candidate { contact, own, distance } = candidate;
        let graze = self.graze(&(&now.y + &now.tangent * *distance), *contact).ok()?;
        let apart = &graze.y - &now.y;
        if apart.norm() > EXPECTED * step.max(*distance) || apart.dot(&now.tangent) < -LOCATED {
            return None;
        }
        // All other events must stay the same.
        let stays = now.passages.iter().enumerate().filter(|(i, _)| !own.contains(i)).map(|(_, p)| p.event);
        if !events(&graze.motion.passages).eq(stays) {
            return None;
        }
        let vanished: Vec<Passage> = own.iter().filter_map(|&i| now.passages.get(i)).copied().collect();
        let point = self.grazing(&graze, &vanished);
        let (label, event, beyond) = match own.first() {
            Some(&i) => (Label::GrazingOut, self.number(now, i), self.smooth_beside(&graze, false)),
            None if graze.rigid => (Label::GrazingIn, 0, self.striking_beside(&graze)),
            None => (Label::GrazingIn, 0, self.smooth_beside(&graze, true)),
        };
        let (wall, y) = (Some(contact.wall), graze.y);
        Some(Change { label, event, wall, point, y, step: apart.norm(), beyond: beyond.ok() })
    }

    /// The index in the branch's signature of event `i` after the strobe.
    fn number(&self, now: &StepStart, i: usize) -> usize {
        let count = now.passages.len() * if self.symmetric { 2 } else { 1 };
        let number = (i + count - self.first % count) % count;
        number % now.passages.len()
    }

    /// A change across which the branch continues, located by bisection between `now` and `other`.
    fn kink(&self, now: &StepStart, step: f64, other: &StepStart) -> Option<Change<'a>> {
        if step > SHORT * now.size() {
            return None;
        }
        let (mut low, mut high, mut left, mut right) = (0.0, step, None, None);
        while high - low > LOCATED * step {
            let middle = 0.5 * (low + high);
            let (here, _) = self.next(now, middle).ok()?;
            if here.meets_as(now) {
                (low, left) = (middle, Some(here));
            } else {
                (high, right) = (middle, Some(here));
            }
        }
        let (left, right) = (left.as_ref().unwrap_or(now), right.as_ref().unwrap_or(other));
        // If two different orbits exist at the same key, neither is the continuation of the other.
        if (&left.y - &right.y).norm() > 1e-3 * step {
            return None;
        }
        let (label, event) = difference(now, right);
        let wall = now.passages.get(event).or(right.passages.get(event)).map(|p| p.event.wall);
        let event = if event < now.passages.len() { self.number(now, event) } else { 0 };
        // The farther end of the step is the better start: finite differences in the key stay on
        // its side.
        let from = if other.meets_as(right) { other } else { right };
        let along = if from.tangent.dot(&now.tangent) < 0.0 { -&from.tangent } else { from.tangent.clone() };
        let beyond = Begin { curve: self.anew(), y: from.y.clone(), along, both: false };
        Some(Change {
            label,
            event,
            wall,
            point: left.point.clone(),
            y: left.y.clone(),
            step: high,
            beyond: Some(beyond),
        })
    }
}

/// The change between the events of two orbits, and the index, after the strobe, of the event that
/// changed.
fn difference(before: &StepStart, after: &StepStart) -> (Label, usize) {
    let (a, b) = (&before.passages, &after.passages);
    let event = a.iter().zip(b).take_while(|(a, b)| a.event == b.event).count();
    let count = |list: &[Passage], kinds: &[Kind]| list.iter().filter(|p| kinds.contains(&p.event.kind)).count();
    let more = |kinds: &[Kind]| count(b, kinds).cmp(&count(a, kinds));
    use std::cmp::Ordering::{Equal, Greater, Less};
    let rests = more(&[Kind::Release]);
    let meets = more(&[Kind::Impact, Kind::Enter, Kind::Rest, Kind::Chatter]);
    let label = match (rests, meets, more(&[Kind::Leave, Kind::Again])) {
        (Greater, ..) => Label::RestBegins,
        (Less, ..) => Label::RestEnds,
        (Equal, Greater, _) => Label::GrazingIn,
        (Equal, Less, _) => Label::GrazingOut,
        (Equal, Equal, Greater | Less) => Label::ContactEnds,
        (Equal, Equal, Equal) => Label::Corner,
    };
    (label, event)
}
