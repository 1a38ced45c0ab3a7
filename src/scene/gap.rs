//! The length of a scene in which its residuals are told: the gap of its walls.
//!
//! A wall that stands much farther away than another one bounds nothing that the other one lets
//! happen, such as a wall at −1000 m for a side that has none. It has no part in the length: an
//! error of a whole gap at 0.5 mm would be told as a millionth of 500 m.

use super::{Scene, Side, Wall, distinct};

/// A start closer to a wall than this share of the displacements there is on it: more than the
/// rounding of a static equilibrium on a wall.
const ON_WALL: f64 = 1e-9;
/// A wall that is this many times as far away as the nearest one is far.
const FAR: f64 = 100.0;
/// A wall nearer to 0 than this share of how far the loads move the structure stands at 0.
const SNUG: f64 = 1e-3;

fn positive(x: &f64) -> bool {
    x.is_finite() && *x > 0.0
}

impl Scene {
    /// The reference length γ₀ of the scene, m: the smallest of half the distances between an upper
    /// and a lower wall on one row and of the gaps of round supports; else the largest distance of
    /// a wall from the initial position; else the largest |position| of a wall; else the initial
    /// displacement; else the length over which the initial velocity and the loads move the
    /// structure; else 1 m. Residuals and solvers are made dimensionless by it. Zero gaps are
    /// ignored, and walls more than 100 times as far from the start and from zero as the nearest.
    #[must_use]
    pub fn gap_scale(&self) -> f64 {
        let near = self.near_walls(&self.initial.q);
        gap_of(&near)
            .or_else(|| largest(near.iter().map(|(wall, _)| wall.position().abs())))
            .or_else(|| largest(self.initial.q.iter().map(|q| q.abs())))
            .or_else(|| Some(self.length_of_motion()).filter(positive))
            .unwrap_or(1.0)
    }

    /// The scene with a start from which its gap scale is `length` (m), where that follows from the
    /// motion: for a part of a run, whose loads and duration are others.
    pub(crate) fn with_gap_scale(mut self, length: f64) -> Self {
        if self.gap_scale() == length {
            return self;
        }
        let entries = || self.walls.iter().flat_map(|wall| wall.row().entries());
        let Some(&(dof, _)) = entries().next() else { return self };
        let weights = entries().filter(|(i, _)| *i == dof).map(|(_, weight)| weight.abs());
        let weight = largest(weights).unwrap_or(1.0);
        self.initial.q.iter_mut().enumerate().for_each(|(i, q)| *q = if i == dof { length / weight } else { 0.0 });
        self
    }

    /// The gap of the scene, m: the smallest of half the distances between an upper and a lower
    /// wall on one row and of the gaps of round supports; else the largest distance of a wall from
    /// the initial position, unless the start is on it. `None` where there is none above 0. Walls
    /// that are far have no part in it.
    pub(crate) fn gap(&self) -> Option<f64> {
        gap_of(&self.near_walls(&self.initial.q))
    }

    /// The gap by which periodic motions are measured, m, of which the start is no part: as
    /// [`Scene::gap`] of a start at 0, to which springs draw the structure. `None` where there is
    /// none, or where the loads move the structure a thousand times as far.
    pub(crate) fn orbit_gap(&self) -> Option<f64> {
        let near = self.near_walls(&vec![0.0; self.initial.q.len()]);
        let held = |wall: &Wall| {
            let mut row = vec![0.0; self.initial.q.len()];
            wall.row().add_transposed(1.0, &mut row);
            self.system.stiffness_form(&row, &row) > 0.0
        };
        let alone = || largest(near.iter().filter(|(wall, _)| held(wall)).map(|(_, start)| *start));
        gap_between(&near).or_else(|| alone().filter(|gap| *gap >= SNUG * self.length_of_vibration()))
    }

    /// A length of periodic motions, m: [`Scene::orbit_gap`], else how far the loads that change
    /// move the structure, else [`Scene::gap_scale`].
    pub(crate) fn orbit_length(&self) -> f64 {
        let moved = || Some(self.length_of_vibration()).filter(positive);
        self.orbit_gap().or_else(moved).unwrap_or_else(|| self.gap_scale())
    }

    /// Distance within which a wall counts as in contact, m: 1e-12 of [`Scene::gap_scale`].
    #[must_use]
    pub fn touching_distance(&self) -> f64 {
        1e-12 * self.gap_scale()
    }

    /// The largest |position| of a flat wall that is not far, m; 0 without one. A far wall, one at
    /// 1e10 m in place of none, has no part in the rounding of gaps at the others.
    pub(crate) fn farthest_near_wall(&self) -> f64 {
        largest(self.near_walls(&self.initial.q).iter().map(|(wall, _)| wall.position().abs())).unwrap_or(0.0)
    }

    /// The walls that are not far, with their distance from the displacement `q` (m), which is 0
    /// where it is on the wall.
    fn near_walls(&self, q: &[f64]) -> Vec<(&Wall, f64)> {
        let size = q.iter().fold(0.0, |largest: f64, q| largest.max(q.abs()));
        let start = |wall: &Wall| {
            let gap = wall.gap(wall.row().dot(q)).abs();
            let weights: f64 = wall.row().entries().iter().map(|(_, weight)| weight.abs()).sum();
            // A start on a wall is off it by rounding.
            if gap > ON_WALL * (wall.position().abs() + weights * size) { gap } else { 0.0 }
        };
        let away = |(wall, start): &(&Wall, f64)| start.max(wall.position().abs());
        let mut walls: Vec<_> = self.walls.iter().map(|wall| (wall, start(wall))).collect();
        let most = FAR * walls.iter().map(away).filter(positive).fold(f64::INFINITY, f64::min);
        walls.retain(|wall| away(wall) <= most);
        walls
    }
}

fn largest(lengths: impl Iterator<Item = f64>) -> Option<f64> {
    lengths.filter(positive).reduce(f64::max)
}

/// The gap of these walls, each with its distance from the start.
fn gap_of(near: &[(&Wall, f64)]) -> Option<f64> {
    gap_between(near).or_else(|| largest(near.iter().map(|(_, start)| *start)))
}

/// The smallest of half the distances between an upper and a lower wall on one row and of the gaps
/// of round supports.
fn gap_between(near: &[(&Wall, f64)]) -> Option<f64> {
    let rows = distinct(near.iter().map(|(wall, _)| wall.row()));
    let mut lower = vec![Vec::new(); rows.rows.len()];
    let flat = |side| {
        let walls = near.iter().zip(&rows.of);
        walls
            .filter(move |((wall, _), _)| wall.side() == side && !wall.is_round())
            .map(|((wall, _), row)| (wall.position(), *row))
    };
    for (position, row) in flat(Side::Lower) {
        lower[row].push(position);
    }
    let spans = flat(Side::Upper).flat_map(|(upper, row)| lower[row].iter().map(move |lower| 0.5 * (upper - lower)));
    let gaps = near.iter().filter(|(wall, _)| wall.is_round()).map(|(wall, _)| wall.position());
    spans.chain(gaps).filter(positive).reduce(f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Row;

    fn scene(walls: impl IntoIterator<Item = Wall>) -> Scene {
        walls.into_iter().fold(Scene::oscillator(1.0, 0.0, 100.0), Scene::with_wall)
    }

    #[test]
    fn a_wall_far_away_has_no_part_in_the_gap() {
        let near = Wall::upper("upper", 5e-4);
        let far = [
            Wall::lower("lower", -1e3),
            Wall::upper("far", 1e2),
            Wall::lower("far", -1e2).at(Row::new(vec![(0, 2.0)])),
        ];
        for far in far {
            assert_eq!(scene([near.clone(), far.clone()]).gap(), Some(5e-4));
            assert_eq!(scene([far, near.clone()]).gap_scale(), 5e-4);
        }
        // 50 times as far is near: half the distance of the pair.
        assert_eq!(scene([near, Wall::lower("lower", -2.5e-2)]).gap(), Some(0.5 * (5e-4 + 2.5e-2)));
    }

    #[test]
    fn a_part_of_a_run_has_the_gap_scale_of_the_run() {
        let snug = scene([Wall::upper("upper", 0.0), Wall::lower("lower", 0.0).at(Row::new(vec![(0, -0.5)]))]);
        let run = snug.with_initial(&[0.0], &[0.3]).with_duration(7.0);
        let part = run.clone().with_duration(1e-3).with_gap_scale(run.gap_scale());
        assert_eq!((run.gap_scale(), part.gap_scale()), (0.03, 0.03));
        // Walls with a gap give it themselves.
        let gap = scene([Wall::upper("upper", 5e-3)]);
        assert_eq!(gap.clone().with_gap_scale(5e-3), gap);
    }

    #[test]
    fn a_start_close_to_a_wall_makes_no_other_wall_far() {
        let walls = [Wall::upper("upper", 5e-3), Wall::upper("second", 8e-3)];
        assert_eq!(scene(walls).with_initial(&[5e-3 - 1e-8], &[0.0]).gap(), Some(8e-3 - (5e-3 - 1e-8)));
    }
}
