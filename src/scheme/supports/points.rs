//! The contact points: where walls and holes push.

use crate::scene::{Row, Scene, Shape, heading};

/// Where a wall or hole pushes, and how.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactPoint {
    /// The rows of its place; twice the same for a wall that belongs to no support.
    pub rows: [usize; 2],
    /// Outward normal of a wall.
    pub normal: [f64; 2],
    pub friction: f64,
}

/// The contact points of all walls, then of all holes, and the rows of their places: two of each
/// support, one of each wall that belongs to none.
pub(super) fn contact_points(scene: &Scene) -> (Vec<ContactPoint>, Vec<&Row>) {
    let mut rows: Vec<&Row> = Vec::new();
    let mut walls: Vec<Option<ContactPoint>> = vec![None; scene.walls.len()];
    let mut holes = Vec::new();
    for support in &scene.supports {
        let first = rows.len();
        rows.extend([&support.at.y, &support.at.z]);
        let point = |normal| ContactPoint { rows: [first, first + 1], normal, friction: support.friction };
        match &support.shape {
            Shape::Round { .. } => holes.push(point([0.0; 2])),
            Shape::Flats(flats) => {
                for flat in flats {
                    if let Some(wall) = walls.get_mut(flat.wall) {
                        *wall = Some(point(heading(flat.direction)));
                    }
                }
            }
        }
    }
    let mut points: Vec<ContactPoint> = Vec::with_capacity(walls.len() + holes.len());
    for (wall, point) in scene.walls.iter().zip(walls) {
        points.push(point.unwrap_or_else(|| {
            rows.push(&wall.at);
            ContactPoint { rows: [rows.len() - 1; 2], normal: [-wall.side.sign(), 0.0], friction: 0.0 }
        }));
    }
    points.extend(holes);
    (points, rows)
}
