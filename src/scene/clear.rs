//! Moves a state that lies behind rigid walls to them.

use super::{Scene, Side, System};

/// Most passes over the walls behind which the state lies.
const PASSES: usize = 50;

impl Scene {
    /// Moves an initial state that lies behind rigid walls to them, by the smallest moves, so that
    /// it is valid; velocities stay.
    pub(crate) fn step_out_of_walls(&mut self) {
        // Several walls may require different moves: each is applied in turn, in several passes.
        for _ in 0..PASSES {
            let mut moved = false;
            for wall in self.walls.iter().filter(|wall| wall.law.is_rigid()) {
                let w = wall.at.dot(&self.initial.q);
                let beyond = match wall.side {
                    Side::Upper => (w - wall.position).max(0.0),
                    Side::Lower => (w - wall.position).min(0.0),
                };
                if beyond == 0.0 {
                    continue;
                }
                moved = true;
                if let (System::Oscillator(_), [(0, 1.0)]) = (&self.system, wall.at.entries()) {
                    self.initial.q = vec![wall.position];
                    continue;
                }
                // The smallest move that brings w = g · q to the wall, and its rounding on the free
                // side.
                let square: f64 = wall.at.entries().iter().map(|(_, weight)| weight * weight).sum();
                let size = self.initial.q.iter().fold(wall.position.abs(), |most, q| most.max(q.abs()));
                let by = beyond + (4.0 * f64::EPSILON * size).copysign(beyond);
                for &(index, weight) in wall.at.entries() {
                    if let Some(q) = self.initial.q.get_mut(index) {
                        *q -= by * weight / square;
                    }
                }
            }
            if !moved {
                break;
            }
        }
    }
}
