//! One branch of orbits of a structure, followed by steps of pseudo-arclength (Keller 1977).

use super::Shots;
use super::here::{Here, Tests};
use crate::error::{Error, Result};
use crate::orbit::branch::arclength::{Stride, Vector, beyond, bordered, extended, locate, scaled, turns_little, unit};
use crate::orbit::branch::label::Label;
use crate::orbit::branch::line::{End, Line, Passed};
use crate::orbit::branch::point::Point;
use crate::orbit::newton::SOLVED;
use crate::orbit::turn::Look;

/// Least number of points after which a curve may be found closed.
const LEAST_LOOP: usize = 6;

/// A step has stayed on the branch if it ends within this many step lengths of its start.
const NEAR: f64 = 2.0;

/// Most iterations with the derivative of the point before, and the factor by which each must
/// reduce the residual.
const CHORDS: usize = 10;
const FAST: f64 = 0.3;

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
    let now = curve.here(y, linear, along)?;
    let mut line = Line { points: vec![now.point.clone()], passed: Vec::new(), end: End::Points };
    line.end = match curve.clone().go_on(now, range, most, &mut line, seen) {
        Ok(end) => end,
        Err(stopped @ Error::Stopped) => return Err(stopped),
        Err(error) => End::Stuck(error.to_string()),
    };
    Ok(line)
}

/// Adds the special points of a step after the last point of `line`.
fn note<'a>(curve: &Shots<'a>, line: &mut Line<Shots<'a>>, mut crossed: Crossed) -> Result<()> {
    crossed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let after = line.points.len();
    for (_, label, y) in crossed {
        let linear = curve.linear(&y, &mut None)?;
        let own = super::here::multipliers_of(&linear);
        let point = curve.point(&y, linear.posed.period, &linear.turn, own);
        // A branch of orbits over several periods has met the orbit of one of them.
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
    /// Follows the curve from `now` on; adds to `line`, and gives its end.
    fn go_on(
        mut self,
        mut now: Here,
        range: [f64; 2],
        most: usize,
        line: &mut Line<Self>,
        seen: &mut dyn FnMut(&Point),
    ) -> Result<End> {
        // The first point of the branch, at the present strobe; `None` where it could not be moved
        // there.
        let mut start = Some((now.y.clone(), now.tangent.clone()));
        let mut stride = Stride::new();
        // The point before, and how far along the branch it lies.
        let mut before: Option<(Here, f64)> = None;
        while line.points.len() < most {
            if let Some(strobe) = self.better_strobe(&now) {
                // Otherwise the strobe stays where it is.
                if let Ok((moved, there)) = self.moved(&now, strobe) {
                    start = start.and_then(|(y, tangent)| self.carried(&y, &tangent, strobe).ok());
                    (self, now, before) = (moved, there, None);
                }
            }
            let step = stride.length;
            let good = |(next, iterations): &(Here, usize)| {
                next.meets_as(&now)
                    && Stride::keeps(*iterations, &now.tangent, &next.tangent)
                    && next.point.value.is_finite()
            };
            // A step that would leave the range is shortened to its end: the key may accept no
            // value outside.
            let slope = now.tests.fold * self.width;
            let ahead = now.point.value + slope * step;
            if let Some(bound) = beyond(range, ahead) {
                let short = (bound - now.point.value) / slope;
                if short <= 0.0 {
                    return Ok(End::Range);
                }
                if let Ok(found) = self.at_bound(&now, bound, range, short)
                    && good(&found)
                    && let (crossed, true) = self.crossed(&now, &found.0.tests, short)?
                {
                    note(&self, line, crossed)?;
                    seen(&found.0.point);
                    line.points.push(found.0.point);
                    return Ok(End::Range);
                }
            }
            let tried = self.next(&now, step);
            if let Err(stopped @ Error::Stopped) = tried {
                return Err(stopped);
            }
            let change = match &tried {
                Ok(found) if good(found) => None,
                Ok((next, _)) => {
                    self.change(&now, before.as_ref(), step, Some(next).filter(|next| !next.meets_as(&now)))
                }
                Err(_) => self.change(&now, before.as_ref(), step, None),
            };
            if let Some(change) = change.filter(|change| (range[0]..=range[1]).contains(&change.point.value)) {
                let shorter = SHARE * change.step;
                let near = change.step <= LAST * now.size() || step <= CRAWL * change.step;
                if near {
                    let end = change.passed(&self, line.points.len());
                    seen(&end.point);
                    line.points.push(end.point.clone());
                    let label = end.label;
                    line.passed.push(end);
                    return Ok(End::Special(label));
                }
                if stride.length > shorter {
                    // No other special point may lie within this step.
                    stride.length = shorter;
                    continue;
                }
            }
            let crossed = match &tried {
                Ok(found) if good(found) => Some(self.crossed(&now, &found.0.tests, step)?),
                _ => None,
            };
            let (next, crossed) = match (tried, crossed) {
                (Ok((next, _)), Some((crossed, true))) => (next, crossed),
                (tried, _) => {
                    if stride.halve() {
                        continue;
                    }
                    let sharp = || Error::no_orbit("the branch turns too sharply, or other walls are met beyond");
                    return Err(tried.err().unwrap_or_else(sharp));
                }
            };
            let value = next.point.value;
            if let Some(bound) = beyond(range, value) {
                let ends = [now.point.value - bound, value - bound];
                // A branch that starts at an end of the range and leads out of it ends at once.
                if ends[0] * ends[1] < 0.0 {
                    let (limit, mut last) = locate([0.0, step], ends, |s| {
                        let (here, _) = self.next(&now, s)?;
                        Ok((here.point.value - bound, here.point))
                    })?;
                    last.value = bound;
                    let inside = crossed.into_iter().filter(|(s, ..)| *s <= limit).collect();
                    note(&self, line, inside)?;
                    line.points.push(last);
                }
                return Ok(End::Range);
            }
            note(&self, line, crossed)?;
            seen(&next.point);
            let back = line.points.len() >= LEAST_LOOP
                && start
                    .as_ref()
                    .is_some_and(|(y, tangent)| (&next.y - y).norm() <= step && turns_little(tangent, &next.tangent));
            line.points.push(next.point.clone());
            if back {
                return Ok(End::Closed);
            }
            before = Some((std::mem::replace(&mut now, next), step));
            stride.grow(now.size())?;
        }
        Ok(End::Points)
    }

    /// The point one step from `now`, and the number of iterations of its correction.
    ///
    /// # Errors
    /// [`Error::NoOrbit`] where there is none nearby.
    pub(super) fn next(&self, now: &Here, step: f64) -> Result<(Here, usize)> {
        self.corrected(now, &(&now.y + &now.tangent * step), &now.tangent, step)
    }

    /// The same at the key's value `bound`, about a step from `now`.
    fn at_bound(&self, now: &Here, bound: f64, range: [f64; 2], step: f64) -> Result<(Here, usize)> {
        let mut guess = &now.y + &now.tangent * step;
        let last = guess.len() - 1;
        guess[last] = scaled(bound, self.width, range);
        let (mut there, iterations) = self.corrected(now, &guess, &unit(last + 1, last), step)?;
        there.point.value = bound;
        Ok((there, iterations))
    }

    /// The point in the plane through `guess` with the normal `border`, one step from `now`.
    fn corrected(&self, now: &Here, guess: &Vector, border: &Vector, step: f64) -> Result<(Here, usize)> {
        let (y, linear, iterations) = match self.chord(now, guess, border)? {
            Some(y) => (y.clone(), self.linear(&y, &mut None)?, 0),
            None => self.correct(guess, border, Some(now.column.clone()))?,
        };
        if (&y - &now.y).norm() > NEAR * step.abs() {
            return Err(Error::no_orbit("Newton's method led too far from the branch"));
        }
        Ok((self.here(y, linear, &now.tangent)?, iterations))
    }

    /// The same point, by Newton's method with the derivative of `now` kept: an iteration then
    /// takes one run, while a new derivative takes as many as the state has entries. `None` where
    /// this does not converge fast.
    fn chord(&self, now: &Here, guess: &Vector, border: &Vector) -> Result<Option<Vector>> {
        let solver = bordered(&now.matrix, border).lu();
        let mut y = guess.clone();
        let mut last = f64::INFINITY;
        for _ in 0..CHORDS {
            let x = self.state(&y);
            let turn = self.turn(&self.posed(self.value(&y))?, &x, Look::Events)?;
            let residual = self.scales.scaled(&(&turn.end * self.sign() - &x));
            let size = residual.amax();
            if last <= SOLVED {
                return Ok(Some(y));
            }
            if size.is_nan() || size > FAST * last {
                return Ok(None);
            }
            let Some(step) = solver.solve(&extended(&residual, border.dot(&(&y - guess)))) else { return Ok(None) };
            y -= step;
            last = size;
        }
        Ok(None)
    }

    /// The special points within a step from `now` to a point with the tests `after`; false if they
    /// could not be separated.
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
}
