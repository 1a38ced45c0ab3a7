//! One branch, followed by steps of pseudo-arclength (Keller 1977).

use super::super::signature::Kind;
use super::arclength::{Stride, beyond, last_before, locate, scaled, tangent, turns_little, unit};
use super::curve::{Curve, Linear, Vector};
use super::events::{self, Test, point, tests};
use super::label::Label;
use super::line::{End, LEAST_LOOP, Line, Passed};
use super::point::Point;
use crate::error::{Error, Result};
use crate::interrupt::Asking;
use crate::order::sort_by_number;

/// The point at which a step begins.
struct StepStart {
    y: Vector,
    tangent: Vector,
    point: Point,
    tests: Vec<Test>,
}

fn step_start(curve: &Curve<'_>, y: Vector, linear: &Linear, along: &Vector) -> Result<StepStart> {
    let tangent = tangent(&linear.matrix, along)?;
    let point = point(curve, &linear.problem, &y)?;
    let tests = tests(curve, &linear.problem, &point, &y, &tangent);
    Ok(StepStart { y, tangent, point, tests })
}

/// A special point within a step, by its distance along the branch from the step's begin.
struct Crossed {
    at: f64,
    label: Label,
    event: usize,
    y: Vector,
}

/// How far a step goes: its length, and the value of the key at which it ends, where a full one
/// would leave the range.
#[derive(Clone, Copy)]
struct Reach {
    length: f64,
    bound: Option<f64>,
}

/// A branch as it is followed.
struct Follower<'c, 'a> {
    curve: &'c Curve<'a>,
    range: [f64; 2],
    /// The equations at its first point, that point, and the tangent there.
    linear: Linear,
    start: (Vector, Vector),
    now: StepStart,
    stride: Stride,
    line: Line<Curve<'a>>,
}

/// Follows `curve` from the solution `y` in the direction of `along`, while the key stays in
/// `range`. It takes at most `most` points, the first being that at `y`, and calls `seen` with
/// each.
pub(super) fn follow<'a>(
    curve: &Curve<'a>,
    y: Vector,
    along: &Vector,
    range: [f64; 2],
    most: usize,
    seen: &mut dyn FnMut(&Point),
) -> Result<Line<Curve<'a>>> {
    let linear = curve.linear(&y)?;
    let now = step_start(curve, y, &linear, along)?;
    let start = (now.y.clone(), now.tangent.clone());
    let line = Line { points: vec![now.point.clone()], passed: Vec::new(), end: End::Points };
    let mut follower = Follower { curve, range, linear, start, now, stride: Stride::new(), line };
    // No run does it where all flights are known in closed form.
    let (mut asking, mut steps) = (Asking::here(), 0);
    while follower.line.points.len() < most {
        asking.pass(steps)?;
        steps += 1;
        if let Some(end) = follower.advance(seen)? {
            follower.line.end = end;
            break;
        }
    }
    Ok(follower.line)
}

impl Follower<'_, '_> {
    /// Takes a step, or halves the stride; the end of the branch where it has come to one.
    fn advance(&mut self, seen: &mut dyn FnMut(&Point)) -> Result<Option<End>> {
        let reach = self.reach();
        // A branch that starts at an end of the range and leads out of it ends at once.
        if reach.length <= 0.0 {
            return Ok(Some(End::Range));
        }
        let next = match self.corrected(reach) {
            Ok(next) => next,
            Err(_) if self.stride.halve() => return Ok(None),
            Err(error) => return Ok(Some(End::of(&error))),
        };
        let mut crossed = match self.crossed(&next, reach.length) {
            Ok(crossed) => crossed,
            Err(why) => return Ok(Some(End::Stuck(why))),
        };
        let before_end = self.line.points.len();
        let limit = self.leave_range(&next, reach)?;
        if let Some(limit) = limit {
            crossed.retain(|crossed| crossed.at <= limit);
        }
        sort_by_number(&mut crossed, |a| a.at);
        forget_echoes(&mut crossed, &next.point, SAME_PLACE * reach.length);
        if let Some(label) = self.pass(crossed, before_end)? {
            return Ok(Some(End::Special(label)));
        }
        if limit.is_some() {
            return Ok(Some(End::Range));
        }
        seen(&next.point);
        if let Some(reason) = next.point.admissible.reason(self.linear.problem.scene()) {
            return Ok(Some(End::Stuck(reason)));
        }
        let back = (&next.y - &self.start.0).norm() <= reach.length && turns_little(&self.start.1, &next.tangent);
        let closed = before_end >= LEAST_LOOP && back;
        self.line.points.push(next.point.clone());
        if closed {
            return Ok(Some(End::Closed));
        }
        self.now = next;
        Ok(self.stride.grow(1.0).err().map(|error| End::Stuck(error.to_string())))
    }

    /// How far the next step goes: one that would leave the range is shortened to its end, since
    /// the key may accept no value outside.
    fn reach(&self) -> Reach {
        let now = &self.now;
        let slope = now.tangent[now.y.len() - 1] * self.curve.width;
        let bound = beyond(self.range, now.point.value + slope * self.stride.length);
        let length = bound.map_or(self.stride.length, |bound| (bound - now.point.value) / slope);
        Reach { length, bound }
    }

    /// The point at the end of a step, or why there is none nearby.
    fn corrected(&self, Reach { length, bound }: Reach) -> Result<StepStart> {
        let Self { curve, now, .. } = self;
        let last = now.y.len() - 1;
        let (mut guess, mut border) = (&now.y + &now.tangent * length, now.tangent.clone());
        if let Some(bound) = bound {
            (guess[last], border) = (scaled(bound, curve.width, self.range), unit(last + 1, last));
        }
        let tried = curve.correct(&guess, &border).and_then(|(y, linear, iterations)| {
            let mut next = step_start(curve, y, &linear, &now.tangent)?;
            next.point.value = bound.unwrap_or(next.point.value);
            Ok((next, iterations))
        });
        let (next, iterations) = tried?;
        if Stride::keeps(iterations, &now.tangent, &next.tangent) && next.point.value.is_finite() {
            return Ok(next);
        }
        Err(Error::no_orbit("the branch turns too sharply"))
    }

    /// All special points within a step of `length` to `next`, or why one was not located.
    fn crossed(&self, next: &StepStart, length: f64) -> std::result::Result<Vec<Crossed>, String> {
        let Self { curve, now, .. } = self;
        let mut crossed = Vec::new();
        for (index, (before, after)) in now.tests.iter().zip(&next.tests).enumerate() {
            // A test function that is 0 at the beginning belongs to the point where the branch
            // begins.
            let turned = before.value * after.value < 0.0 && before.value.abs() > ZERO;
            if !turned {
                continue;
            }
            let value = |s: f64| {
                let (y, linear, _) = curve.correct(&(&now.y + &now.tangent * s), &now.tangent)?;
                let tangent = tangent(&linear.matrix, &now.tangent)?;
                let point = point(curve, &linear.problem, &y)?;
                let all = tests(curve, &linear.problem, &point, &y, &tangent);
                Ok((all.get(index).map_or(f64::NAN, |test| test.value), y))
            };
            let located = locate([0.0, length], [before.value, after.value], value).or_else(|error| {
                // Near a contact of duration 0 the equations are singular.
                let touches = before.label == Label::GrazingIn || is_elastic(before.label, before.event, &now.point);
                touches.then(|| last_before([0.0, length], before.value, value)).flatten().ok_or(error)
            });
            let (at, y) = located.map_err(|error| format!("a {} ahead was not located: {error}", before.label))?;
            crossed.push(Crossed { at, label: before.label, event: before.event, y });
        }
        Ok(crossed)
    }

    /// Where a step to `next` leaves the range: adds the point at its end, and returns the distance
    /// along the branch to it.
    fn leave_range(&mut self, next: &StepStart, reach: Reach) -> Result<Option<f64>> {
        if reach.bound.is_some() {
            self.line.points.push(next.point.clone());
            return Ok(Some(reach.length));
        }
        let Self { curve, now, .. } = self;
        let Some(bound) = beyond(self.range, next.point.value) else { return Ok(None) };
        let ends = [now.point.value - bound, next.point.value - bound];
        let (limit, y) = locate([0.0, reach.length], ends, |s| {
            let (y, ..) = curve.correct(&(&now.y + &now.tangent * s), &now.tangent)?;
            Ok((curve.value(&y) - bound, y))
        })?;
        let linear = curve.linear(&y)?;
        self.line.points.push(point(curve, &linear.problem, &y)?);
        Ok(Some(limit))
    }

    /// Notes the special points of a step, before which the branch had `after` points; the label of
    /// the first one at which the branch ends.
    fn pass(&mut self, crossed: Vec<Crossed>, after: usize) -> Result<Option<Label>> {
        for Crossed { label, event, y, .. } in crossed {
            let problem = self.curve.problem(&y)?;
            let mut point = point(self.curve, &problem, &y)?;
            let (mut y, mut label, mut ends) = (y, label, label.ends());
            // Where orbits over several periods meet that of one, the branch turns back along
            // itself: beyond are the same orbits, shifted in time.
            if let Some((half, met)) = problem.halves(&point.orbit).filter(|_| label == Label::Fold) {
                (label, ends) = (met, true);
                // The amplitude is the root of the distance to that point, and not as small.
                if let Ok(once) = self.curve.corrected(&problem, &half, point.value) {
                    let whole = match met {
                        Label::PeriodDoubling => once.doubled(),
                        _ => once.unfolded(problem.mirror()),
                    };
                    y = self.curve.gather(&problem, &whole, point.value);
                    point = events::point(self.curve, &problem, &y)?;
                }
            }
            let (wall, curve) = (label.wall(event, &point), self.curve.clone());
            let line = &mut self.line;
            line.passed.push(Passed { label, event, wall, point: point.clone(), curve, y, after, beyond: None });
            if ends {
                line.points.truncate(after);
                line.points.push(point);
                return Ok(Some(label));
            }
        }
        Ok(None)
    }
}

/// A test function below this counts as zero: the branch begins at its special point.
const ZERO: f64 = 1e-9;

/// Special points closer to each other than this share of a step count as one.
const SAME_PLACE: f64 = 1e-4;

/// Where the contact or the pause of an elastic wall vanishes, its tests are located to this share
/// of a step.
const SAME_CONTACT: f64 = 1e-2;

/// True for a test that vanishes where event number `event` of `point`, one at an elastic wall,
/// meets the next one.
fn is_elastic(label: Label, event: usize, point: &Point) -> bool {
    let kind = point.orbit.signature.events.get(event).map(|event| event.kind);
    matches!(label, Label::GrazingOut | Label::ContactEnds | Label::Corner)
        && matches!(kind, Some(Kind::Enter | Kind::Leave | Kind::Again))
}

/// Where the duration of a contact with an elastic wall or of the flight between two goes to 0, the
/// equations themselves become singular. The other test functions (determinants, and the key's part
/// of the tangent) vanish there too without meaning anything, and are left out.
fn forget_echoes(crossed: &mut Vec<Crossed>, point: &Point, near: f64) {
    let kind = |event: usize| point.orbit.signature.events.get(event).map(|event| event.kind);
    let elastic = |crossed: &&Crossed| is_elastic(crossed.label, crossed.event, point);
    let among = |places: &[f64], at: f64| places.iter().any(|place| (place - at).abs() <= near);
    let ends: Vec<f64> = crossed.iter().filter(elastic).map(|crossed| crossed.at).collect();
    crossed.retain(|crossed| crossed.label.ends() || !among(&ends, crossed.at));
    // The force of a wall within a pause that vanishes vanishes there too.
    let corner = |crossed: &&Crossed| crossed.label == Label::Corner && elastic(crossed);
    let corners: Vec<f64> = crossed.iter().filter(corner).map(|crossed| crossed.at).collect();
    crossed.retain(|crossed| crossed.label != Label::ContactEnds || !among(&corners, crossed.at));
    // Beyond an impact of speed 0 the motion turns back behind its wall: this is not a new contact.
    // Nor is it a fold, though at restitution 0, where the key changes by the square of the speed,
    // the key's part of the tangent vanishes there.
    let gone = |crossed: &&Crossed| crossed.label == Label::GrazingOut;
    let turns: Vec<f64> = crossed.iter().filter(gone).map(|crossed| crossed.at).collect();
    let echoes = [Label::GrazingIn, Label::Fold];
    crossed.retain(|crossed| !echoes.contains(&crossed.label) || !among(&turns, crossed.at));
    // Where a contact vanishes, or the flight before it, its entry and an exit coincide: the speed
    // of the entry stands for that of the exit, and for the duration.
    let enters: Vec<(usize, f64)> = (crossed.iter().filter(gone))
        .filter(|crossed| kind(crossed.event) == Some(Kind::Enter))
        .map(|crossed| (crossed.event, crossed.at))
        .collect();
    let of_same = |crossed: &Crossed| {
        enters.iter().any(|&(entry, at)| {
            let count = point.orbit.signature.events.len().max(1);
            let beside = [entry, (entry + 1) % count, (entry + count - 1) % count];
            let same = matches!(crossed.label, Label::Corner | Label::ContactEnds) && beside.contains(&crossed.event);
            same && (crossed.at - at).abs() <= near / SAME_PLACE * SAME_CONTACT
        })
    };
    crossed.retain(|crossed| !of_same(crossed));
}
