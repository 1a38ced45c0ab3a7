//! The impulses of round holes and of friction in a step.

use crate::scene::{Row, Scene, Shape, Support, heading};
use crate::step::{HoleStep, Step};

/// What a support did in a step beside the normal impulses of its flats: the impulses along the
/// normal of a hole and along the tangent, N s in y and z, of one contact.
pub(super) fn pushes<'a>(
    scene: &'a Scene,
    step: &'a Step<'_>,
) -> impl Iterator<Item = (usize, &'a Support, [[f64; 2]; 2])> {
    let mut holes = step.holes.iter();
    scene.supports.iter().enumerate().flat_map(move |(index, support)| {
        let hole = match support.shape {
            Shape::Round { .. } => holes.next().map(of_hole),
            Shape::Flats(_) => None,
        };
        let flats = if let Shape::Flats(flats) = &support.shape { &flats[..] } else { &[] };
        let rubbed = flats.iter().filter_map(|flat| {
            let f = *step.friction.get(flat.wall)?;
            let [y, z] = heading(flat.direction);
            (f != 0.0).then_some([[0.0; 2], [-f * z, f * y]])
        });
        hole.into_iter().chain(rubbed).map(move |push| (index, support, push))
    })
}

fn of_hole(hole: &HoleStep) -> [[f64; 2]; 2] {
    let ([y, z], p, f) = (hole.normal, hole.impulse, hole.friction);
    [[-p * y, -p * z], [-f * z, f * y]]
}

/// Sum of the magnitudes of the terms of both rows of a place.
pub(super) fn terms(support: &Support, x: &[f64]) -> f64 {
    let row = |row: &Row| -> f64 {
        row.entries().iter().map(|&(i, weight)| (weight * x.get(i).copied().unwrap_or(0.0)).abs()).sum()
    };
    row(&support.at.y) + row(&support.at.z)
}
