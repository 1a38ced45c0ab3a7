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

/// Impulse (N s) of a wall over a piece of a step, without the jump at its end, and ∫ of the
/// squared force, N² s.
pub(super) fn piece(step: &Step<'_>, wall: usize, [from, to]: [f64; 2]) -> (f64, f64) {
    let rate = match step.path {
        Path::Exact(arc) => arc.fastest_motion(),
        Path::Series(series) => series.rate(),
        Path::Grid | Path::OneRestitution | Path::Part { .. } | Path::Handed { .. } => {
            let force = even_force(step, wall);
            return (impulse(step, wall, [from, to]), force * force * (to - from));
        }
    };
    // Each part is half a radian of the fastest motion, so one radian of the squared force.
    let parts = ((to - from) * rate * 2.0).ceil().clamp(1.0, 1e6);
    let span = (to - from) / parts;
    let force = |part: f64, node: f64| step.path.contact_force(wall, from + span * (part + node));
    let mut square = 0.0;
    let mut part = 0.0;
    while part < parts {
        square += GAUSS.iter().map(|&node| force(part, node).powi(2)).sum::<f64>() * 0.5 * span;
        part += 1.0;
    }
    (impulse(step, wall, [from, to]), square)
}
