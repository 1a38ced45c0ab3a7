//! The mirror symmetry of a scene: q → −q half a forcing period later.

use crate::scene::{LoadKind, Row, Scene};

/// Relative tolerance for a frequency to be an odd multiple of the fundamental.
const NEAR: f64 = 1e-9;

/// For each wall of `scene` the one that stands opposite to it, if the scene looks the same in the
/// mirror q → −q half a forcing period (s) later: sines of odd multiples of the fundamental alone,
/// and every wall with an equal one opposite.
pub(super) fn mirror(scene: &Scene, period: f64) -> Option<Vec<usize>> {
    // The sum of the constant loads at each place.
    let mut constants: Vec<(&Row, f64)> = Vec::new();
    let mut constant = |at, force: f64| match constants.iter_mut().find(|(place, _)| *place == at) {
        Some((_, sum)) => *sum += force,
        None => constants.push((at, force)),
    };
    for load in &scene.loads {
        match load.kind {
            LoadKind::Constant { force } => constant(&load.at, force),
            LoadKind::Harmonic { amplitude, frequency: 0.0, phase } => {
                constant(&load.at, amplitude * phase.sin());
            }
            LoadKind::Harmonic { frequency, amplitude, .. } => {
                let order = frequency * period;
                let odd = order.round().rem_euclid(2.0) == 1.0 && (order - order.round()).abs() <= NEAR * order;
                if !odd && amplitude != 0.0 {
                    return None;
                }
            }
            _ => return None,
        }
    }
    if constants.iter().any(|(_, sum)| *sum != 0.0) {
        return None;
    }
    let mut taken = vec![false; scene.walls.len()];
    let mut opposite = Vec::with_capacity(scene.walls.len());
    for wall in &scene.walls {
        let fits = |(index, other): (usize, &crate::scene::Wall)| {
            let opposite =
                other.side() != wall.side() && other.position() == -wall.position() && other.row() == wall.row();
            !taken[index] && opposite && other.law == wall.law
        };
        let index = scene.walls.iter().enumerate().position(fits)?;
        taken[index] = true;
        opposite.push(index);
    }
    Some(opposite)
}
