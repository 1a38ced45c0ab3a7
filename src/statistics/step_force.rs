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

/// What a wall gives over a piece of a step, without the jump at its end.
pub(super) struct Piece {
    /// N s.
    pub impulse: f64,
    /// ∫ of the squared force, N² s.
    pub square: f64,
    /// The largest |force|, N: of exact motion at instants a quarter of a radian apart or less.
    pub largest: f64,
}

/// What wall number `wall` gives between two times in a step (s).
pub(super) fn piece(step: &Step<'_>, wall: usize, [from, to]: [f64; 2]) -> Piece {
    let whole = impulse(step, wall, [from, to]);
    let rate = match step.path {
        Path::Exact(arc) => arc.fastest_motion(),
        Path::Series(series) => series.rate(),
        Path::Grid | Path::OneRestitution | Path::Part { .. } | Path::Handed { .. } => {
            let force = even_force(step, wall);
            return Piece { impulse: whole, square: force * force * (to - from), largest: force.abs() };
        }
    };
    // Each part is half a radian of the fastest motion, so one radian of the squared force.
    let parts = ((to - from) * rate * 2.0).ceil().clamp(1.0, 1e6);
    let span = (to - from) / parts;
    let force = |part: f64, node: f64| step.path.contact_force(wall, from + span * (part + node));
    let (mut square, mut largest) = (0.0, 0.0_f64);
    let mut part = 0.0;
    while part < parts {
        let forces = GAUSS.map(|node| force(part, node));
        square += (forces[0] * forces[0] + forces[1] * forces[1]) * 0.5 * span;
        largest = forces.iter().fold(largest, |largest, force| largest.max(force.abs()));
        part += 1.0;
    }
    Piece { impulse: whole, square, largest }
}
