//! The places at which walls see the structure, prepared for products, and a test whether the walls
//! of one are out of reach in a step.

use super::view::View;
use crate::scene::{Row, Scene, Side, distinct};
use crate::step::Step;

/// The motion of a row in a step: displacements at both ends, m, and velocities that enter and
/// leave the balance, m/s, with the sum of the impulses of its walls, N s, each counted as
/// positive.
#[derive(Debug, Clone, Copy)]
pub(super) struct RowMotion {
    pub start: f64,
    pub end: f64,
    pub before: f64,
    pub after: f64,
    pub impulses: f64,
}

/// The walls of one row.
#[derive(Debug, Clone)]
pub(super) struct RowWalls {
    pub row: View,
    /// The open interval, m, in which no wall is touched.
    clear: (f64, f64),
    /// Their indices.
    pub walls: Vec<usize>,
}

impl RowWalls {
    /// All of a scene: each flat wall is in one of them.
    pub fn all(scene: &Scene) -> Vec<Self> {
        let flats: Vec<usize> = (0..scene.walls.len()).filter(|&wall| !scene.walls[wall].is_round()).collect();
        let distinct = distinct(flats.iter().map(|&wall| scene.walls[wall].row()));
        let (touch, everywhere) = (scene.touching_distance(), (f64::NEG_INFINITY, f64::INFINITY));
        let new = |row: &&Row| Self { row: View::new(row), clear: everywhere, walls: Vec::new() };
        let mut row_walls: Vec<Self> = distinct.rows.iter().map(new).collect();
        for (&index, &row) in flats.iter().zip(&distinct.of) {
            let wall = &scene.walls[index];
            let (low, high) = &mut row_walls[row].clear;
            match wall.side() {
                Side::Lower => *low = low.max(wall.position() + touch),
                Side::Upper => *high = high.min(wall.position() - touch),
            }
            row_walls[row].walls.push(index);
        }
        row_walls
    }

    /// What the row does in a step that begins at the displacement `start` (m).
    #[inline(always)]
    pub fn seen(&self, step: &Step<'_>, start: &[f64]) -> RowMotion {
        let [start, end, before, after] = self.row.each([start, step.q, step.velocity_before, step.velocity_after]);
        let impulses = self.walls.iter().map(|&wall| step.impulse[wall].abs()).sum();
        RowMotion { start, end, before, after, impulses }
    }

    /// True if the row reaches several degrees of freedom and one of its walls is rigid.
    pub fn is_wide(&self, scene: &Scene) -> bool {
        let rigid = |&wall: &usize| scene.walls.get(wall).is_some_and(|wall| wall.law.is_rigid());
        !matches!(self.row, View::One(..)) && self.walls.iter().any(rigid)
    }

    /// True if no wall can matter in the step: the displacements `w0` and `w1` (m) at its ends are
    /// clear of them, and so is all that the body can reach from the first within `way` (m).
    #[inline(always)]
    pub fn is_clear(&self, (w0, w1): (f64, f64), way: f64) -> bool {
        let (low, high) = self.clear;
        low < w0 - way && w0 + way < high && low < w1 && w1 < high
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::Symmetric;
    use crate::scene::{Structure, Wall};

    /// Rows of every kind: one degree of freedom, some beside each other, and two far apart.
    fn rows() -> Vec<Row> {
        let row = |entries: &[(usize, f64)]| Row::new(entries.to_vec());
        let beside: Vec<(usize, f64)> = (1..8).map(|i| (i, 0.625 - 0.25 * i as f64)).collect();
        vec![
            row(&[(2, -0.5)]),
            row(&[(3, 2.0), (5, -1.0)]),
            row(&beside),
            row(&[(0, 1.0), (9, -2.0)]),
            row(&[(9, 1.0), (8, 0.25)]),
        ]
    }

    fn walls(rows: &[Row]) -> Scene {
        let one = |x: f64| Symmetric::diagonal(&[x; 10]);
        let mut scene = Scene::oscillator(1.0, 0.0, 1.0).with_initial(&[0.0; 10], &[0.0; 10]);
        scene.system = Structure { mass: one(1.0), damping: one(0.0), stiffness: one(1.0) }.into();
        for (k, row) in rows.iter().enumerate() {
            for wall in [Wall::upper(&format!("u{k}"), 2.0 + k as f64), Wall::lower(&format!("l{k}"), -1.0)] {
                scene = scene.with_wall(wall.at(row.clone()));
            }
        }
        scene
    }

    #[test]
    fn rows_are_products_with_the_structure_whatever_their_form() {
        let rows = rows();
        let row_walls = RowWalls::all(&walls(&rows));
        assert_eq!(
            row_walls.iter().map(|walls_of_row| walls_of_row.walls.clone()).collect::<Vec<_>>(),
            [[0, 1], [2, 3], [4, 5], [6, 7], [8, 9]]
        );
        let forms: Vec<bool> = row_walls.iter().map(|walls_of_row| matches!(walls_of_row.row, View::Wide(_))).collect();
        assert_eq!(forms, [false, false, false, true, false]);
        // Multiples of 1/32 of a few units: no product is rounded.
        let x: Vec<f64> = (0..10).map(|i| 1.25 - 0.75 * f64::from(i * i % 7)).collect();
        for (walls_of_row, row) in row_walls.iter().zip(&rows) {
            let terms: Vec<f64> = row.entries().iter().map(|&(i, weight)| weight * x[i]).collect();
            assert_eq!(walls_of_row.row.of(&x), terms.iter().sum::<f64>(), "{row:?}");
            assert_eq!(walls_of_row.row.size(&x), terms.iter().map(|term| term.abs()).sum::<f64>(), "{row:?}");
        }
        let scene = walls(&rows);
        let wide: Vec<bool> = row_walls.iter().map(|walls_of_row| walls_of_row.is_wide(&scene)).collect();
        assert_eq!(wide, [false, true, true, true, true]);
        let mut soft = scene.clone();
        soft.walls.iter_mut().for_each(|wall| *wall = wall.clone().with_elasticity(1.0, 0.0));
        assert!(!row_walls.iter().any(|walls_of_row| walls_of_row.is_wide(&soft)));
    }

    #[test]
    fn a_step_is_clear_of_its_walls_if_both_ends_and_the_way_from_the_first_are() {
        let scene = walls(&[Row::dof(0)]);
        let (row_walls, touch) = (RowWalls::all(&scene), scene.touching_distance());
        let clear = |w0: f64, w1: f64, way: f64| row_walls[0].is_clear((w0, w1), way);
        // The walls stand at −1 and 2 m.
        assert!(clear(0.0, 0.0, 0.0) && clear(-0.5, 1.5, 0.25) && clear(1.5, -0.5, 0.25));
        assert!(!clear(0.0, 2.5, 0.0) && !clear(0.0, -1.5, 0.0));
        assert!(!clear(1.5, 0.0, 1.0) && !clear(-0.5, 0.0, 1.0));
        // Within the touching distance a wall is in reach.
        for (edge, inward) in [(2.0, -1.0), (-1.0, 1.0)] {
            assert!(clear(0.0, edge + 2.0 * inward * touch, 0.0) && !clear(0.0, edge + 0.5 * inward * touch, 0.0));
        }
    }
}
