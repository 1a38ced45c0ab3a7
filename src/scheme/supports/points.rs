//! The contact points: where walls push.

use crate::scene::{Face, FrictionCoefficients, PlaneRows, Row, Scene, heading};

/// Where a wall pushes, and how.
#[derive(Debug, Clone, Copy)]
pub(in crate::scheme) struct ContactPoint {
    /// The rows of its place; twice the same for a flat wall that belongs to no support.
    pub rows: [usize; 2],
    /// Outward normal of a flat wall.
    pub normal: [f64; 2],
    pub friction: FrictionCoefficients,
}

/// The contact points of all walls, and the rows of their places: two of each support and of each
/// round wall outside of supports, one of each flat wall that belongs to none.
pub(in crate::scheme) fn contact_points(scene: &Scene) -> (Vec<ContactPoint>, Vec<&Row>) {
    let mut rows: Vec<&Row> = Vec::new();
    let mut points: Vec<Option<ContactPoint>> = vec![None; scene.walls.len()];
    for support in &scene.supports {
        let rows = place(&mut rows, &support.at);
        for (index, wall) in support.members(&scene.walls) {
            let normal = match wall.face {
                Face::Flat { direction, .. } => heading(direction.unwrap_or_default()),
                Face::Round { .. } => [0.0; 2],
            };
            points[index] = Some(ContactPoint { rows, normal, friction: wall.friction });
        }
    }
    let mut all = Vec::with_capacity(points.len());
    for (wall, point) in scene.walls.iter().zip(points) {
        all.push(match (point, &wall.face) {
            (Some(point), _) => point,
            (None, Face::Flat { at, side, .. }) => {
                rows.push(at);
                ContactPoint { rows: [rows.len() - 1; 2], normal: [-side.sign(), 0.0], friction: 0.0.into() }
            }
            (None, Face::Round { at, .. }) => {
                ContactPoint { rows: place(&mut rows, at), normal: [0.0; 2], friction: wall.friction }
            }
        });
    }
    (all, rows)
}

/// Adds the two rows of a place; returns their indices.
fn place<'a>(rows: &mut Vec<&'a Row>, at: &'a PlaneRows) -> [usize; 2] {
    rows.extend([&at.y, &at.z]);
    [rows.len() - 2, rows.len() - 1]
}
