//! One branch of orbits of a structure, followed by steps of pseudo-arclength (Keller 1977).

use super::Shots;
use super::here::{Here, Tests};
use crate::error::{Error, Result};
use crate::orbit::branch::arclength::{Stride, Vector, extended, locate, turns_little};
use crate::orbit::branch::label::Label;
use crate::orbit::branch::line::{End, Line, Passed};
use crate::orbit::branch::point::Point;
use crate::orbit::signature::Kind;
use crate::orbit::turn::{Look, run};

/// A curve has closed after at least this many points.
const LEAST_LOOP: usize = 6;

/// A step leads to the branch itself if it ends within this many of its lengths.
const NEAR: f64 = 2.0;

/// Multipliers within this of the unit circle are on it to rounding.
const ON_CIRCLE: f64 = 1e-9;

/// Above this step several multipliers that cross the circle at once are told apart by a shorter
/// one.
const APART: f64 = 1e-4;

/// A change of the contacts ends the branch from within this distance, or where steps have become
/// this share of what is left: before a graze they become as short as the square of the impact's
/// speed. From farther away steps of the last share go towards it.
const LAST: f64 = 1e-2;
const CRAWL: f64 = 3e-2;
const SHARE: f64 = 0.7;

/// One of the test functions.
type Test = fn(&Tests) -> f64;

/// Special points of one step: arclength, label, and the point.
type Crossed = Vec<(f64, Label, Vector)>;

/// Follows `curve` from `y`, a solution, on the side of `along`, while the key stays in `range`. At
/// most `most` points, the first being that at `y`; `seen` is told each.
pub(super) fn follow<'a>(
    curve: &Shots<'a>,
    y: Vector,
    along: &Vector,
    range: [f64; 2],
    most: usize,
    seen: &mut dyn FnMut(&Point),
) -> Result<Line<Shots<'a>>> {
    let mut curve = curve.clone();
    let linear = curve.linear(&y, &mut None)?;
    let mut now = curve.here(y, linear, along)?;
    // Where it began, at the present strobe; nothing where it could not be carried there.
    let mut start = Some((now.y.clone(), now.tangent.clone()));
    let mut line = Line { points: vec![now.point.clone()], passed: Vec::new(), end: End::Points };
    let mut stride = Stride::new();
    // The point before, and how far along the branch it lies.
    let mut before: Option<(Here, f64)> = None;
    while line.points.len() < most {
        if let Some(strobe) = curve.better_strobe(&now) {
            start = start.and_then(|(y, tangent)| curve.carried(&y, &tangent, strobe).ok());
            (curve, now) = curve.moved(&now, strobe)?;
            before = None;
        }
        let step = stride.0;
        let tried = curve.next(&now, step);
        let good = |(next, iterations): &(Here, usize)| {
            next.meets_as(&now)
                && Stride::keeps(*iterations, &now.tangent, &next.tangent)
                && next.point.value.is_finite()
        };
        let change = match &tried {
            Ok(found) if good(found) => None,
            Ok((next, _)) => curve.change(&now, before.as_ref(), step, Some(next).filter(|next| !next.meets_as(&now))),
            Err(_) => curve.change(&now, before.as_ref(), step, None),
        };
        if let Some(change) = change.filter(|change| (range[0]..=range[1]).contains(&change.point.value)) {
            let shorter = SHARE * change.step;
            let near = change.step <= LAST * now.size() || step <= CRAWL * change.step;
            if near {
                let end = change.passed(&curve, line.points.len());
                seen(&end.point);
                line.points.push(end.point.clone());
                line.end = End::Special(end.label);
                line.passed.push(end);
                return Ok(line);
            }
            if stride.0 > shorter {
                // Nothing else may happen on the way there.
                stride.0 = shorter;
                continue;
            }
        }
        let crossed = match &tried {
            Ok(found) if good(found) => Some(curve.crossed(&now, &found.0.tests, step)?),
            _ => None,
        };
        let (next, crossed) = match (tried, crossed) {
            (Ok((next, _)), Some((crossed, true))) => (next, crossed),
            (tried, _) => {
                if stride.halve() {
                    continue;
                }
                let sharp = || "the branch turns too sharply, or other walls are met beyond".to_owned();
                line.end = End::Stuck(tried.err().map_or_else(sharp, |error| error.to_string()));
                return Ok(line);
            }
        };
        let value = next.point.value;
        if value < range[0] || value > range[1] {
            let bound = if value < range[0] { range[0] } else { range[1] };
            let ends = [now.point.value - bound, value - bound];
            line.end = End::Range;
            // A start on the bound that goes outwards ends at once.
            if ends[0] * ends[1] < 0.0 {
                let (limit, mut last) = locate([0.0, step], ends, |s| {
                    let (here, _) = curve.next(&now, s)?;
                    Ok((here.point.value - bound, here.point))
                })?;
                last.value = bound;
                let inside = crossed.into_iter().filter(|(s, ..)| *s <= limit).collect();
                note(&curve, &mut line, inside)?;
                line.points.push(last);
            }
            return Ok(line);
        }
        note(&curve, &mut line, crossed)?;
        seen(&next.point);
        let back = line.points.len() >= LEAST_LOOP
            && start
                .as_ref()
                .is_some_and(|(y, tangent)| (&next.y - y).norm() <= step && turns_little(tangent, &next.tangent));
        line.points.push(next.point.clone());
        if back {
            line.end = End::Closed;
            return Ok(line);
        }
        before = Some((std::mem::replace(&mut now, next), step));
        stride.grow(now.size());
    }
    Ok(line)
}

/// Adds special points of a step after the last point of `line`.
fn note<'a>(curve: &Shots<'a>, line: &mut Line<Shots<'a>>, mut crossed: Crossed) -> Result<()> {
    crossed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let after = line.points.len();
    for (_, label, y) in crossed {
        let linear = curve.linear(&y, &mut None)?;
        let own = super::here::multipliers_of(&linear);
        let point = curve.point(&y, linear.posed.period, &linear.turn, own);
        // A branch of several turns that has come back to one.
        let label = match point.orbit.part(curve.mirror.as_deref()) {
            Some((_, true)) if matches!(label, Label::Fold | Label::BranchPoint) => Label::SymmetryBreaking,
            Some((_, false)) if matches!(label, Label::Fold | Label::BranchPoint) => Label::PeriodDoubling,
            _ => label,
        };
        line.passed.push(Passed { label, event: 0, wall: None, point, curve: curve.clone(), y, after, beyond: None });
    }
    Ok(())
}

impl<'a> Shots<'a> {
    /// The point a step from `now`, and how many iterations that took.
    ///
    /// # Errors
    /// [`Error::NoOrbit`] where there is none near.
    pub(super) fn next(&self, now: &Here, step: f64) -> Result<(Here, usize)> {
        let (y, linear, iterations) =
            self.correct(&(&now.y + &now.tangent * step), &now.tangent, Some(now.column.clone()))?;
        if (&y - &now.y).norm() > NEAR * step.abs() {
            return Err(Error::no_orbit("Newton's method left the neighbourhood"));
        }
        Ok((self.here(y, linear, &now.tangent)?, iterations))
    }

    /// What is passed on a step from `now` to a point with the tests `after`; false if it is not
    /// told apart.
    fn crossed(&self, now: &Here, after: &Tests, step: f64) -> Result<(Crossed, bool)> {
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
    fn between(&self, now: &Here, step: f64) -> Result<Here> {
        let (here, _) = self.next(now, step)?;
        if here.meets_as(now) || step == 0.0 {
            return Ok(here);
        }
        Err(Error::no_orbit("other walls are met there"))
    }

    /// The curve with its strobe moved to `strobe` (cycles), and the same point of it.
    fn moved(&self, now: &Here, strobe: f64) -> Result<(Self, Here)> {
        let passed = now.passages.iter().filter(|p| p.phase < strobe).count();
        let count = now.passages.len() * if self.symmetric { 2 } else { 1 };
        let turn = f64::from(self.periods);
        let moved = Self {
            strobe: strobe - (strobe / turn).floor() * turn,
            first: (self.first + 2 * count - passed) % count.max(1),
            ..self.clone()
        };
        let (y, along) = self.carried(&now.y, &now.tangent, strobe)?;
        let (y, linear, _) = moved.correct(&y, &along, None)?;
        let there = moved.here(y, linear, &along)?;
        Ok((moved, there))
    }

    /// Where the strobe is to be moved to, in cycles; nothing where it is well placed.
    fn better_strobe(&self, now: &Here) -> Option<f64> {
        let (start, turn) = (self.strobe, self.cycles());
        let close = now.touches.iter().filter(|touch| touch.gap < CLOSE * self.scales.length);
        let mut phases: Vec<f64> = now.passages.iter().map(|p| p.phase).chain(close.map(|touch| touch.phase)).collect();
        phases.sort_by(f64::total_cmp);
        let (first, last) = (*phases.first()?, *phases.last()?);
        phases.push(first + turn);
        // A state that a wall holds is known worse.
        let rests = |phase: f64| {
            now.passages.iter().any(|p| p.phase == phase && matches!(p.event.kind, Kind::Rest | Kind::Chatter))
        };
        let room = |pair: &[f64]| (pair[1] - pair[0]) * if rests(pair[0]) { HELD } else { 1.0 };
        let longest = phases.windows(2).max_by(|a, b| room(a).total_cmp(&room(b)))?;
        let left = (first - start).min(start + turn - last);
        (left < ROOM * (longest[1] - longest[0])).then(|| 0.5 * (longest[0] + longest[1]))
    }

    /// The point `y` and the unit tangent there with the state carried along to `strobe` (cycles).
    fn carried(&self, y: &Vector, tangent: &Vector, strobe: f64) -> Result<(Vector, Vector)> {
        let carried = |y: &Vector| -> Result<Vector> {
            let posed = self.posed(self.value(y))?;
            let span = [self.strobe, strobe].map(|phase| phase * posed.period);
            let turn = run(&posed.scene, posed.period, span, &self.state(y), Look::Events)?;
            Ok(extended(&self.scales.scaled(&turn.end), y[y.len() - 1]))
        };
        let there = carried(y)?;
        let beside = carried(&(y + tangent * CARRY))?;
        let along = (beside - &there).normalize();
        Ok((there, along))
    }
}

/// The share of the tangent that is carried along with a point.
const CARRY: f64 = 1e-6;

/// What a stretch at rest on a wall counts for as a place of the strobe.
const HELD: f64 = 0.2;

/// A touch within this share of the gap is one that may become an impact.
const CLOSE: f64 = 0.05;

/// The strobe lies at least this share of the longest flight away from events.
const ROOM: f64 = 0.15;
