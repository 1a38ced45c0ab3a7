//! One branch, followed by steps of pseudo-arclength (Keller 1977).

use super::super::signature::Kind;
use super::arclength::{Stride, beyond, locate, scaled, turns_little, unit};
use super::curve::{Curve, Linear, Vector};
use super::events::{Test, point, tests};
use super::label::Label;
use super::line::{End, Line, Passed};
use super::point::Point;
use crate::error::Result;

/// Least number of points after which a curve may be found closed.
const LEAST_LOOP: usize = 6;

/// The point at which a step begins.
struct Here {
    y: Vector,
    tangent: Vector,
    point: Point,
    tests: Vec<Test>,
}

fn here(curve: &Curve<'_>, y: Vector, linear: &Linear, along: &Vector) -> Result<Here> {
    let tangent = curve.tangent(linear, along)?;
    let point = point(curve, &linear.problem, &y)?;
    let tests = tests(curve, &linear.problem, &point, &y, &tangent);
    Ok(Here { y, tangent, point, tests })
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
    let mut now = here(curve, y, &linear, along)?;
    let start = (now.y.clone(), now.tangent.clone());
    let mut line = Line { points: vec![now.point.clone()], passed: Vec::new(), end: End::Points };
    let mut stride = Stride::new();
    while line.points.len() < most {
        let last = now.y.len() - 1;
        // A step that would leave the range is shortened to its end: the key may accept no value
        // outside.
        let slope = now.tangent[last] * curve.width;
        let bound = beyond(range, now.point.value + slope * stride.length);
        let step = bound.map_or(stride.length, |bound| (bound - now.point.value) / slope);
        // A branch that starts at an end of the range and leads out of it ends at once.
        if step <= 0.0 {
            line.end = End::Range;
            return Ok(line);
        }
        let (mut guess, mut border) = (&now.y + &now.tangent * step, now.tangent.clone());
        if let Some(bound) = bound {
            (guess[last], border) = (scaled(bound, curve.width, range), unit(last + 1, last));
        }
        let tried = curve.correct(&guess, &border).and_then(|(y, linear, iterations)| {
            let mut next = here(curve, y, &linear, &now.tangent)?;
            next.point.value = bound.unwrap_or(next.point.value);
            Ok((next, iterations))
        });
        let good = tried.as_ref().is_ok_and(|(next, iterations)| {
            Stride::keeps(*iterations, &now.tangent, &next.tangent) && next.point.value.is_finite()
        });
        let next = match tried {
            Ok((next, _)) if good => next,
            tried => {
                if !stride.halve() {
                    let why = tried
                        .err()
                        .map_or_else(|| "the branch turns too sharply".to_owned(), |error| error.to_string());
                    line.end = End::Stuck(why);
                    return Ok(line);
                }
                continue;
            }
        };
        // All special points within the step, in order, and the first end of the branch.
        let mut crossed = Vec::new();
        for (index, (before, after)) in now.tests.iter().zip(&next.tests).enumerate() {
            // A test function that is 0 at the beginning belongs to the point where the branch
            // begins.
            if before.value * after.value < 0.0 && before.value.abs() > ZERO {
                let found = locate([0.0, step], [before.value, after.value], |s| {
                    let (y, linear, _) = curve.correct(&(&now.y + &now.tangent * s), &now.tangent)?;
                    let tangent = curve.tangent(&linear, &now.tangent)?;
                    let point = point(curve, &linear.problem, &y)?;
                    let all = tests(curve, &linear.problem, &point, &y, &tangent);
                    Ok((all.get(index).map_or(f64::NAN, |test| test.value), y))
                });
                match found {
                    Ok(found) => crossed.push((found.0, before.label, before.event, found.1)),
                    Err(error) => {
                        line.end = End::Stuck(format!("a {} ahead was not located: {error}", before.label));
                        return Ok(line);
                    }
                }
            }
        }
        let mut limit = f64::INFINITY;
        if bound.is_some() {
            limit = step;
            line.points.push(next.point.clone());
        } else if let Some(bound) = beyond(range, next.point.value) {
            // Within the step the branch leaves the range.
            let ends = [now.point.value - bound, next.point.value - bound];
            let (s, y) = locate([0.0, step], ends, |s| {
                let (y, ..) = curve.correct(&(&now.y + &now.tangent * s), &now.tangent)?;
                Ok((curve.value(&y) - bound, y))
            })?;
            limit = s;
            crossed.retain(|(s, ..)| *s <= limit);
            let linear = curve.linear(&y)?;
            line.points.push(point(curve, &linear.problem, &y)?);
        }
        crossed.sort_by(|a, b| a.0.total_cmp(&b.0));
        forget_echoes(&mut crossed, &next.point, SAME_PLACE * step);
        let last = line.points.len() - usize::from(limit.is_finite());
        for (_, label, event, y) in crossed {
            let problem = curve.problem(&y)?;
            let point = point(curve, &problem, &y)?;
            let label = problem.halves(&point.orbit).filter(|_| label == Label::Fold).map_or(label, |half| half.1);
            let wall = label.wall(event, &point);
            let curve = curve.clone();
            line.passed.push(Passed { label, event, wall, point: point.clone(), curve, y, after: last, beyond: None });
            if label.ends() {
                line.points.truncate(last);
                line.points.push(point);
                line.end = End::Special(label);
                return Ok(line);
            }
        }
        if limit.is_finite() {
            line.end = End::Range;
            return Ok(line);
        }
        seen(&next.point);
        if let Some(reason) = next.point.admissible.reason(linear.problem.scene()) {
            line.end = End::Stuck(reason);
            return Ok(line);
        }
        let apart = (&next.y - &start.0).norm();
        let closed = line.points.len() >= LEAST_LOOP && apart <= step && turns_little(&start.1, &next.tangent);
        line.points.push(next.point.clone());
        if closed {
            line.end = End::Closed;
            return Ok(line);
        }
        now = next;
        if let Err(error) = stride.grow(1.0) {
            line.end = End::Stuck(error.to_string());
            return Ok(line);
        }
    }
    Ok(line)
}

/// A test function below this counts as zero: the branch begins at its special point.
const ZERO: f64 = 1e-9;

/// Special points closer to each other than this share of a step count as one.
const SAME_PLACE: f64 = 1e-4;

/// Where the duration of a contact with an elastic wall goes to 0, the equations themselves become
/// singular. The other test functions (determinants, and the key's part of the tangent) vanish
/// there too without meaning anything, and are left out.
fn forget_echoes(crossed: &mut Vec<(f64, Label, usize, Vector)>, point: &Point, near: f64) {
    let kind = |event: usize| point.orbit.signature.events.get(event).map(|event| event.kind);
    let elastic = |label: Label, event: usize| match label {
        Label::GrazingOut | Label::ContactEnds => matches!(kind(event), Some(Kind::Enter | Kind::Leave | Kind::Again)),
        _ => false,
    };
    let ends: Vec<f64> =
        crossed.iter().filter(|(_, label, event, _)| elastic(*label, *event)).map(|(s, ..)| *s).collect();
    crossed.retain(|(s, label, ..)| label.ends() || !ends.iter().any(|end| (end - s).abs() <= near));
    // Beyond an impact of speed 0 the motion turns back behind its wall: this is not a new contact.
    let gone: Vec<f64> =
        crossed.iter().filter(|(_, label, ..)| *label == Label::GrazingOut).map(|(s, ..)| *s).collect();
    crossed.retain(|(s, label, ..)| *label != Label::GrazingIn || !gone.iter().any(|end| (end - s).abs() <= near));
    // Where a contact vanishes, its entry and its exit coincide: the first of the two tests stands
    // for both.
    let enters =
        crossed.iter().any(|(_, label, event, _)| *label == Label::GrazingOut && kind(*event) == Some(Kind::Enter));
    crossed.retain(|(s, label, ..)| {
        !(enters && *label == Label::ContactEnds && ends.iter().any(|end| (end - s).abs() <= near))
    });
}
