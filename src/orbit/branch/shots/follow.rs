//! One branch of orbits of a structure, followed by steps of pseudo-arclength (Keller 1977).

use super::Shots;
use super::change::Change;
use super::step_start::{StepStart, Tests};
use crate::error::{Error, Result};
use crate::orbit::branch::arclength::{Stride, Vector, beyond, locate, turns_little};
use crate::orbit::branch::label::Label;
use crate::orbit::branch::line::{End, LEAST_LOOP, Line, Passed};
use crate::orbit::branch::point::Point;
use crate::order::sort_by_number;

/// Multipliers closer than this to the unit circle lie on it to rounding.
const ON_CIRCLE: f64 = 1e-9;

/// Where several multipliers cross the circle within one step, the step is shortened to separate
/// them, but not below this.
const APART: f64 = 1e-4;

/// The branch goes to a change of its contacts in one step, and ends there, from within the
/// distance `LAST`, or where steps have become shorter than the share `CRAWL` of the distance left:
/// before a graze they become as short as the square of the impact's speed. From farther away it
/// approaches by steps of the share `SHARE` of the distance.
const LAST: f64 = 1e-2;
const CRAWL: f64 = 3e-2;
const SHARE: f64 = 0.7;

/// One of the test functions.
type Test = fn(&Tests) -> f64;

/// Special points of one step: arclength, label, and the point.
type Crossed = Vec<(f64, Label, Vector)>;

/// Follows `curve` from the solution `y` in the direction of `along`, while the key stays in
/// `range`. It takes at most `most` points, the first being that at `y`, and calls `seen` with
/// each.
pub(super) fn follow<'a>(
    curve: &Shots<'a>,
    y: Vector,
    along: &Vector,
    range: [f64; 2],
    most: usize,
    seen: &mut dyn FnMut(&Point),
) -> Result<Line<Shots<'a>>> {
    let linear = curve.linear(&y, &mut None)?;
    let now = curve.step_start(y, linear, along)?;
    let line = Line { points: vec![now.point.clone()], passed: Vec::new(), end: End::Points };
    let start = Some((now.y.clone(), now.tangent.clone()));
    let mut follower = Follower { curve: curve.clone(), range, start, before: None, now, stride: Stride::new(), line };
    while follower.line.points.len() < most {
        let end = match follower.advance(seen) {
            Ok(end) => end,
            Err(stopped @ Error::Stopped) => return Err(stopped),
            Err(error) => Some(End::of(&error)),
        };
        if let Some(end) = end {
            follower.line.end = end;
            break;
        }
    }
    Ok(follower.line)
}

/// Adds the special points of a step after the last point of `line`; the label of the one at which
/// the branch ends: where orbits over several periods meet that of one, it turns back along itself,
/// and beyond are the same orbits, shifted in time.
fn note<'a>(curve: &Shots<'a>, line: &mut Line<Shots<'a>>, mut crossed: Crossed) -> Result<Option<Label>> {
    sort_by_number(&mut crossed, |a| a.0);
    let after = line.points.len();
    for (_, label, y) in crossed {
        let linear = curve.linear(&y, &mut None)?;
        let own = super::step_start::multipliers_of(&linear);
        let point = curve.point(&y, linear.posed.period, &linear.motion, own);
        let met = match point.orbit.part(curve.mirror.as_deref()) {
            Some((_, true)) if matches!(label, Label::Fold | Label::BranchPoint) => Some(Label::SymmetryBreaking),
            Some((_, false)) if matches!(label, Label::Fold | Label::BranchPoint) => Some(Label::PeriodDoubling),
            _ => None,
        };
        let (label, last) = (met.unwrap_or(label), point.clone());
        line.passed.push(Passed { label, event: 0, wall: None, point, curve: curve.clone(), y, after, beyond: None });
        if met.is_some() {
            line.points.push(last);
            return Ok(met);
        }
    }
    Ok(None)
}

/// A branch as it is followed.
struct Follower<'a> {
    curve: Shots<'a>,
    range: [f64; 2],
    /// The first point of the branch and the tangent there, at the present strobe; `None` where it
    /// could not be moved there.
    start: Option<(Vector, Vector)>,
    /// The point before, and how far along the branch it lies.
    before: Option<(StepStart, f64)>,
    now: StepStart,
    stride: Stride,
    line: Line<Shots<'a>>,
}

impl<'a> Follower<'a> {
    /// Takes a step, or shortens the stride; the end of the branch where it has come to one.
    fn advance(&mut self, seen: &mut dyn FnMut(&Point)) -> Result<Option<End>> {
        self.move_strobe();
        let step = self.stride.length;
        if let Some(end) = self.end_at_bound(step, seen)? {
            return Ok(Some(end));
        }
        let tried = match self.curve.next(&self.now, step) {
            Err(stopped @ Error::Stopped) => return Err(stopped),
            tried => tried,
        };
        let mut crossed = None;
        match &tried {
            Ok(found) if self.keeps(found) => {
                crossed = Some(self.curve.crossed(&self.now, &found.0.tests, step)?);
            }
            tried => {
                let other = tried.as_ref().ok().map(|(next, _)| next).filter(|next| !next.meets_as(&self.now));
                let change = self.curve.change(&self.now, self.before.as_ref(), step, other);
                let within = |change: &Change<'_>| (self.range[0]..=self.range[1]).contains(&change.point.value);
                if let Some(change) = change.filter(within) {
                    if change.step <= LAST * self.now.size() || step <= CRAWL * change.step {
                        return Ok(Some(self.end_at_change(change, seen)));
                    }
                    if step > SHARE * change.step {
                        // No other special point may lie within this step.
                        self.stride.length = SHARE * change.step;
                        return Ok(None);
                    }
                }
            }
        }
        match (tried, crossed) {
            (Ok((next, _)), Some((crossed, true))) => self.accept(next, crossed, step, seen),
            _ if self.stride.halve() => Ok(None),
            (Err(error), _) => Err(error),
            _ => Err(Error::no_orbit("the branch turns too sharply, or other walls are met beyond")),
        }
    }

    /// Moves the strobe to where the motion is better told from its neighbours; otherwise it stays
    /// where it is.
    fn move_strobe(&mut self) {
        let Some(strobe) = self.curve.better_strobe(&self.now) else { return };
        let Ok((moved, there)) = self.curve.moved(&self.now, strobe) else { return };
        self.start = self.start.take().and_then(|(y, tangent)| self.curve.carried(&y, &tangent, strobe).ok());
        (self.curve, self.now, self.before) = (moved, there, None);
    }

    /// True if a point found in so many iterations goes on as the branch does.
    fn keeps(&self, (next, iterations): &(StepStart, usize)) -> bool {
        next.meets_as(&self.now)
            && Stride::keeps(*iterations, &self.now.tangent, &next.tangent)
            && next.point.value.is_finite()
    }

    /// The end of a branch whose next step would leave the range: that step is shortened to the
    /// range's end, since the key may accept no value outside. `None` where the branch stays
    /// within, or no point was found there.
    fn end_at_bound(&mut self, step: f64, seen: &mut dyn FnMut(&Point)) -> Result<Option<End>> {
        let Self { curve, now, range, .. } = self;
        let slope = now.tests.fold * curve.width;
        let Some(bound) = beyond(*range, now.point.value + slope * step) else { return Ok(None) };
        let short = (bound - now.point.value) / slope;
        if short <= 0.0 {
            return Ok(Some(End::Range));
        }
        if let Ok(found) = curve.at_bound(now, bound, *range, short)
            && self.keeps(&found)
            && let (crossed, true) = self.curve.crossed(&self.now, &found.0.tests, short)?
        {
            if let Some(met) = note(&self.curve, &mut self.line, crossed)? {
                return Ok(Some(End::Special(met)));
            }
            seen(&found.0.point);
            self.line.points.push(found.0.point);
            return Ok(Some(End::Range));
        }
        Ok(None)
    }

    /// Ends the branch at a change of its contacts.
    fn end_at_change(&mut self, change: Change<'a>, seen: &mut dyn FnMut(&Point)) -> End {
        let end = change.passed(&self.curve, self.line.points.len());
        seen(&end.point);
        self.line.points.push(end.point.clone());
        let label = end.label;
        self.line.passed.push(end);
        End::Special(label)
    }

    /// Goes on to the point `next` a step away, past the special points between; the end of the
    /// branch where that lies within the step.
    fn accept(
        &mut self,
        next: StepStart,
        crossed: Crossed,
        step: f64,
        seen: &mut dyn FnMut(&Point),
    ) -> Result<Option<End>> {
        let Self { curve, now, line, .. } = self;
        let value = next.point.value;
        if let Some(bound) = beyond(self.range, value) {
            let ends = [now.point.value - bound, value - bound];
            // A branch that starts at an end of the range and leads out of it ends at once.
            if ends[0] * ends[1] < 0.0 {
                let (limit, mut last) = locate([0.0, step], ends, |s| {
                    let (here, _) = curve.next(now, s)?;
                    Ok((here.point.value - bound, here.point))
                })?;
                last.value = bound;
                if let Some(met) = note(curve, line, crossed.into_iter().filter(|(s, ..)| *s <= limit).collect())? {
                    return Ok(Some(End::Special(met)));
                }
                line.points.push(last);
            }
            return Ok(Some(End::Range));
        }
        if let Some(met) = note(curve, line, crossed)? {
            return Ok(Some(End::Special(met)));
        }
        seen(&next.point);
        let back =
            |(y, tangent): &(Vector, Vector)| (&next.y - y).norm() <= step && turns_little(tangent, &next.tangent);
        let closed = line.points.len() >= LEAST_LOOP && self.start.as_ref().is_some_and(back);
        line.points.push(next.point.clone());
        if closed {
            return Ok(Some(End::Closed));
        }
        self.before = Some((std::mem::replace(&mut self.now, next), step));
        self.stride.grow(self.now.size())?;
        Ok(None)
    }
}

impl Shots<'_> {
    /// The special points within a step from `now` to a point with the tests `after`; false if they
    /// could not be separated.
    fn crossed(&self, now: &StepStart, after: &Tests, step: f64) -> Result<(Crossed, bool)> {
        let before = &now.tests;
        let turns = |a: f64, b: f64| a * b < 0.0;
        let flip = if self.symmetric { Label::SymmetryBreaking } else { Label::PeriodDoubling };
        let mut real: Vec<(Label, Test)> = Vec::new();
        if turns(before.fold, after.fold) {
            real.push((Label::Fold, |tests| tests.fold));
        }
        if turns(before.crossing, after.crossing) {
            real.push((Label::BranchPoint, |tests| tests.crossing));
        }
        if turns(before.flip, after.flip) {
            real.push((flip, |tests| tests.flip));
        }
        let more = before.outside.abs_diff(after.outside);
        let clear = before.pair.min(after.pair) > ON_CIRCLE;
        let pairs = if real.is_empty() && clear && more == 2 { 1 } else { 0 };
        if clear && step > APART && (more > real.len() + 2 * pairs || real.len() > 1) {
            return Ok((Vec::new(), false));
        }
        let mut crossed = Vec::new();
        for (label, test) in real {
            let found = locate([0.0, step], [test(before), test(after)], |s| {
                let here = self.between(now, s)?;
                Ok((test(&here.tests), here.y))
            });
            match found {
                Ok((s, y)) => crossed.push((s, label, y)),
                Err(_) if step > APART => return Ok((Vec::new(), false)),
                Err(error) => return Err(error),
            }
        }
        if pairs == 1 {
            let beside = |tests: &Tests| if tests.outside == before.outside { -tests.pair } else { tests.pair };
            let (s, y) = locate([0.0, step], [beside(before), beside(after)], |s| {
                let here = self.between(now, s)?;
                Ok((beside(&here.tests), here.y))
            })?;
            crossed.push((s, Label::NeimarkSacker, y));
        }
        Ok((crossed, true))
    }

    /// A point within a step, with the same walls in the same order.
    fn between(&self, now: &StepStart, step: f64) -> Result<StepStart> {
        let (here, _) = self.next(now, step)?;
        if here.meets_as(now) || step == 0.0 {
            return Ok(here);
        }
        Err(Error::no_orbit("other walls are met there"))
    }
}
