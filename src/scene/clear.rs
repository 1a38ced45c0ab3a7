//! Moves a state that lies behind rigid walls and holes to them, and finds the walls that leave no
//! room to move.

use super::{Face, Row, Scene, Side, Wall};

/// Most passes over the walls and holes behind which the state lies.
const PASSES: usize = 50;

/// Weights of rows that differ by less are the same: sines and cosines of opposite directions.
const SAME_WEIGHT: f64 = 1e-12;

impl Scene {
    /// Moves an initial state that lies behind rigid walls and holes to them, by the smallest
    /// moves, so that it is valid; velocities stay.
    pub(crate) fn step_out_of_walls(&mut self) {
        let touch = self.touching_distance();
        let Self { walls, initial, .. } = self;
        // Several walls may require different moves: each is applied in turn, in several passes.
        for _ in 0..PASSES {
            let mut moved = false;
            for wall in walls.iter() {
                if wall.is_before(&initial.q, touch) || wall.holds_out(&initial.q) {
                    move_onto(wall, &mut initial.q);
                    moved = true;
                }
            }
            if !moved {
                break;
            }
        }
    }

    /// For each wall, whether a flat one opposite to it stands at the same place, so that a body
    /// between the two has no room to move there.
    pub(crate) fn snug(&self) -> Vec<bool> {
        let mut snug = vec![false; self.walls.len()];
        // Each bounds its outward coordinate from above.
        let outward = |wall: &Wall| if wall.side() == Side::Upper { 1.0 } else { -1.0 };
        let opposite = |one: &Wall, other: &Wall| {
            let (a, b) = (one.row().entries(), other.row().entries());
            let sign = -outward(one) * outward(other);
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.0 == b.0 && (a.1 - sign * b.1).abs() <= SAME_WEIGHT)
        };
        let first_dof = |wall: &Wall| wall.row().entries().first().map(|entry| entry.0);
        let mut flats: Vec<(usize, &Wall)> =
            self.walls.iter().enumerate().filter(|(_, wall)| !wall.is_round()).collect();
        flats.sort_by_key(|(_, wall)| first_dof(wall));
        // Of many walls only those at one place are compared.
        for place in flats.chunk_by(|(_, one), (_, other)| first_dof(one) == first_dof(other)) {
            for (k, (index, one)) in place.iter().enumerate() {
                for (other, two) in place.iter().skip(k + 1) {
                    let room = outward(one) * one.position() + outward(two) * two.position();
                    let rounding = 1e-12 * one.position().abs().max(two.position().abs());
                    if room <= rounding && opposite(one, two) {
                        (snug[*index], snug[*other]) = (true, true);
                    }
                }
            }
        }
        snug
    }

    /// Moves an initial state that touches the rigid walls `pressed`, up to rounding, exactly onto
    /// all of them.
    pub(crate) fn press_onto(&mut self, pressed: &[usize]) {
        let Self { walls, initial, .. } = self;
        for _ in 0..PASSES {
            for wall in pressed.iter().filter_map(|&index| walls.get(index)).filter(|wall| wall.law.is_rigid()) {
                move_onto(wall, &mut initial.q);
            }
        }
    }
}

/// Moves `q` onto a wall by the smallest move.
fn move_onto(wall: &Wall, q: &mut [f64]) {
    match &wall.face {
        Face::Flat { at, position, .. } => match at.entries() {
            // To the bit, where a degree of freedom stands at the wall.
            [(index, 1.0)] => q.iter_mut().skip(*index).take(1).for_each(|q| *q = *position),
            _ => move_along(at, at.dot(q) - position, q),
        },
        Face::Round { at, centre, gap } => {
            let [y, z] = [0, 1].map(|axis: usize| at.dot(q)[axis] - centre[axis]);
            let distance = y.hypot(z);
            if distance > 0.0 {
                move_along(&at.towards([y / distance, z / distance]), distance - gap, q);
            }
        }
    }
}

/// Moves `q` by the smallest move that takes g · q back by `by`. A row may name a degree of freedom
/// twice.
fn move_along(at: &Row, by: f64, q: &mut [f64]) {
    let mut row = vec![0.0; q.len()];
    at.add_transposed(1.0, &mut row);
    let square: f64 = row.iter().map(|weight| weight * weight).sum();
    if square > 0.0 {
        q.iter_mut().zip(&row).for_each(|(q, weight)| *q -= by * weight / square);
    }
}
