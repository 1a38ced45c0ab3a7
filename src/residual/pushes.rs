//! The impulses of round holes and of friction in a step.

use crate::scene::{Face, PlaneRows, Scene, heading};
use crate::step::Step;

/// What the walls that push did in a step beside the normal impulses of flats: the index of each,
/// its place, and the impulses along the normal of a round wall and along the tangent, N s in y and
/// z.
pub(super) fn pushes<'a>(
    scene: &'a Scene,
    step: &'a Step<'_>,
) -> impl Iterator<Item = (usize, &'a PlaneRows, [[f64; 2]; 2])> {
    scene.walls.iter().enumerate().filter_map(move |(index, wall)| match &wall.face {
        Face::Round { at, .. } => {
            let ([y, z], p, f) = (*step.normal.get(index)?, step.impulse.get(index)?, step.friction.get(index)?);
            if *p == 0.0 && *f == 0.0 {
                return None;
            }
            Some((index, at, [[-p * y, -p * z], [-f * z, f * y]]))
        }
        Face::Flat { direction, .. } => {
            let f = *step.friction.get(index).filter(|f| **f != 0.0)?;
            let [y, z] = heading((*direction)?);
            Some((index, &scene.support_of(index)?.at, [[0.0; 2], [-f * z, f * y]]))
        }
    })
}

/// The place of a wall in two planes; `None` in one.
pub(super) fn place_of(scene: &Scene, wall: usize) -> Option<&PlaneRows> {
    match &scene.walls.get(wall)?.face {
        Face::Round { at, .. } => Some(at),
        Face::Flat { .. } => Some(&scene.support_of(wall)?.at),
    }
}
