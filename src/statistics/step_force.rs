//! What a wall gives over a piece of a step.

use crate::step::{Path, Step};

/// Gauss's rule of two points on [0, 1].
const GAUSS: [f64; 2] = [0.211_324_865_405_187_13, 0.788_675_134_594_812_9];

/// Impulse (N s) of a wall between two times in a step (s), without the jump at its end.
pub(super) fn impulse(step: &Step<'_>, wall: usize, [from, to]: [f64; 2]) -> f64 {
    match step.path {
        _ if step.impulse[wall] == 0.0 => 0.0,
        Path::Exact(_) | Path::Series(_) => step.path.contact_impulse(wall, from, to),
        _ => even_force(step, wall) * (to - from),
    }
}

/// The force (N) of a wall over a step on a grid, constant over it.
fn even_force(step: &Step<'_>, wall: usize) -> f64 {
    (step.impulse[wall] - step.jump[wall]) / (step.end - step.start)
}

/// The impulse of wall number `wall` between two times in a step (s), N s, and ∫ of its squared
/// force, N² s, without the jump at its end.
pub(super) fn impulse_and_square(step: &Step<'_>, wall: usize, [from, to]: [f64; 2]) -> (f64, f64) {
    let whole = impulse(step, wall, [from, to]);
    let Some(parts) = parts(step, [from, to]) else {
        let force = even_force(step, wall);
        return (whole, force * force * (to - from));
    };
    let span = (to - from) / parts;
    let force = |part: f64, node: f64| step.path.contact_force(wall, from + span * (part + node));
    let (mut square, mut part) = (0.0, 0.0);
    while part < parts {
        let forces = GAUSS.map(|node| force(part, node));
        square += (forces[0] * forces[0] + forces[1] * forces[1]) * 0.5 * span;
        part += 1.0;
    }
    (whole, square)
}

/// The number of parts of half a radian of the fastest exact motion, so of one radian of the
/// squared force, between two times in a step (s); `None` for a step on a grid.
fn parts(step: &Step<'_>, [from, to]: [f64; 2]) -> Option<f64> {
    let rate = match step.path {
        Path::Exact(arc) => arc.fastest_motion(),
        Path::Series(series) => series.rate(),
        Path::Grid | Path::OneRestitution | Path::Part { .. } | Path::Handed { .. } => return None,
    };
    Some(((to - from) * rate * 2.0).ceil().clamp(1.0, 1e6))
}

/// The largest |force| of wall number `wall` between two times in a step (s), N, without the jump
/// at its end. That of exact motion is the largest at instants half a radian apart, and at the
/// crest of the parabola through any three of them of which the middle one is the largest.
pub(super) fn largest_force(step: &Step<'_>, wall: usize, [from, to]: [f64; 2]) -> f64 {
    let Some(parts) = parts(step, [from, to]) else { return even_force(step, wall).abs() };
    let span = (to - from) / parts;
    let force = |part: f64| step.path.contact_force(wall, (from + span * part).min(to)).abs();
    let mut last = [force(0.0), force(0.5)];
    let (mut largest, mut part) = (last[0].max(last[1]), 1.0);
    while part <= parts {
        let next = force(part);
        largest = largest.max(next);
        let [before, middle] = last;
        let curve = before - 2.0 * middle + next;
        if middle >= before && middle >= next && curve < 0.0 {
            let crest = part - 0.5 + 0.25 * (before - next) / curve;
            largest = largest.max(force(crest));
        }
        (last, part) = ([middle, next], part + 0.5);
    }
    largest
}
