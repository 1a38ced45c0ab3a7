//! Where walls and holes push.

use crate::scene::{Row, Scene, Shape, heading};

/// Where a wall or hole pushes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seat {
    /// The rows of its place; twice the same for a wall that belongs to no support.
    pub rows: [usize; 2],
    /// Outward normal of a wall.
    pub normal: [f64; 2],
    pub friction: f64,
}

/// The seats of a scene, and the rows of their places: two of each support, one of each wall that
/// belongs to none.
pub(super) fn seats(scene: &Scene) -> (Vec<Seat>, Vec<&Row>) {
    let mut rows: Vec<&Row> = Vec::new();
    let mut walls: Vec<Option<Seat>> = vec![None; scene.walls.len()];
    let mut holes = Vec::new();
    for support in &scene.supports {
        let first = rows.len();
        rows.extend([&support.at.y, &support.at.z]);
        let seat = |normal| Seat { rows: [first, first + 1], normal, friction: support.friction };
        match &support.shape {
            Shape::Round { .. } => holes.push(seat([0.0; 2])),
            Shape::Flats(flats) => {
                for flat in flats {
                    if let Some(wall) = walls.get_mut(flat.wall) {
                        *wall = Some(seat(heading(flat.direction)));
                    }
                }
            }
        }
    }
    let mut seats: Vec<Seat> = Vec::with_capacity(walls.len() + holes.len());
    for (wall, seat) in scene.walls.iter().zip(walls) {
        seats.push(seat.unwrap_or_else(|| {
            rows.push(&wall.at);
            Seat { rows: [rows.len() - 1; 2], normal: [-wall.side.sign(), 0.0], friction: 0.0 }
        }));
    }
    seats.extend(holes);
    (seats, rows)
}
