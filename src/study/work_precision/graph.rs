//! A distance between two motions with jumps that tends to zero as the motions approach one
//! another.
//!
//! At an impact the velocity jumps, so sup|Δv| remains as large as the jump for every step, however
//! small: the two jumps never fall on the same instant. What converges is the distance between the
//! *completed graphs*: the curves (t, u, v) with every jump filled in by the segment from the
//! velocity before to the velocity after. With t over the duration, u over the gap scale and v over
//! the reference's largest speed, it is the Hausdorff distance: the largest distance of a point of
//! either curve from the other curve.

use crate::order::sort_by_number;
use crate::scene::{Row, Scene, Wall};
use crate::trajectory::Trajectory;
use std::collections::BTreeSet;

/// Longest piece into which a segment is cut for the distance; the segment of a jump is as long as
/// the whole range of velocities.
const LONGEST_PIECE: f64 = 1.0 / 32.0;
const MOST_PIECES: f64 = 64.0;
/// One segment in this many is looked at first.
const FEW: usize = 29;

/// Reference scales that make time, displacement and velocity comparable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Duration compared, s.
    pub duration: f64,
    /// Gap scale, m.
    pub length: f64,
    /// Largest speed of the reference, m/s.
    pub speed: f64,
}

/// A completed graph as a polyline.
#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    /// (t, u, v), dimensionless, in order of time.
    vertices: Vec<[f64; 3]>,
}

impl Graph {
    /// The graph of probe number `probe` in every `stride`-th row of `trajectory` up to the
    /// duration compared, with the jumps at those walls that are rigid in `scene` and stand on the
    /// probe's row. The effect of other walls shows in the rows only, to within their spacing.
    ///
    /// A contact shorter than the spacing of these rows is drawn between two corners at the wall,
    /// (start, −approach) and (end, departure); a longer one is drawn by its rows, except for its
    /// first corner. Rows within a `step` (s) of a contact at a wall that shares a degree of
    /// freedom with the probe are left out, since a scheme on positions has no velocity there. At
    /// walls that are springs the velocity is continuous, and the rows show it.
    #[must_use]
    pub fn of(trajectory: &Trajectory, probe: usize, stride: usize, step: f64, scene: &Scene, scales: &Scales) -> Self {
        let point = |t: f64, u: f64, v: f64| [t / scales.duration, u / scales.length, v / scales.speed];
        let stride = stride.max(1);
        let spacing = trajectory.time().get(stride).copied().unwrap_or(scales.duration);
        let until = scales.duration * (1.0 + 1e-12);
        let contacts = trajectory.contacts();
        let place = scene.probes.get(probe).map(|p| &p.at);
        let shares = |wall: &Wall| {
            let dofs = |row: &Row| row.entries().iter().map(|entry| entry.0).collect::<Vec<_>>();
            place.is_some_and(|place| dofs(place).iter().any(|i| dofs(wall.row()).contains(i)))
        };
        let near_probe: Vec<bool> = scene.walls.iter().map(|w| w.law.is_rigid() && shares(w)).collect();
        let mut vertices = Vec::with_capacity(trajectory.time().len() / stride + 1 + 2 * contacts.len());
        let mut blurred = BTreeSet::new();
        for contact in contacts.iter().filter(|c| c.start <= until) {
            let seen = near_probe.get(contact.wall).copied().unwrap_or(false);
            let Some(wall) = scene.walls.get(contact.wall).filter(|_| seen) else { continue };
            let sign = wall.side().sign();
            let before = (contact.start / spacing).floor();
            let near = |row: &f64| (row * spacing - contact.start).abs() <= step * (1.0 + 1e-9);
            blurred.extend([before, before + 1.0].into_iter().filter(near).map(|row| row as usize));
            if place != Some(wall.row()) {
                continue;
            }
            vertices.push(point(contact.start, wall.position(), -sign * contact.approach_speed));
            let short = contact.end.filter(|end| end - contact.start <= spacing);
            if let (Some(end), Some(departure)) = (short, contact.departure_speed) {
                vertices.push(point(end, wall.position(), sign * departure));
            }
        }
        let displacement = trajectory.displacements().get(probe).into_iter().flatten();
        let velocity = trajectory.velocities().get(probe).into_iter().flatten();
        let motion = trajectory.time().iter().zip(displacement).zip(velocity);
        let rows = motion.step_by(stride).map(|((&t, &u), &v)| (t, u, v)).take_while(|row| row.0 <= until);
        let clear = rows.enumerate().filter(|(row, _)| !blurred.contains(row));
        vertices.extend(clear.map(|(_, (t, u, v))| point(t, u, v)));
        // A stable sort: a row holds the state after a jump at its time, so the corners of the jump
        // come before it.
        sort_by_number(&mut vertices, |a| a[0]);
        Self { vertices }
    }

    /// The Hausdorff distance between two graphs.
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        other.excess(self, self.excess(other, 0.0))
    }

    /// The larger of `least` and the distance from `other` to the farthest point of this graph.
    fn excess(&self, other: &Self, least: f64) -> f64 {
        let mut farthest = least;
        let mut near = 0;
        // A few segments first: with their distance known, most others need not be searched
        // completely.
        for stride in [FEW, 1] {
            near = 0;
            for pair in self.vertices.windows(2).step_by(stride) {
                let [a, b] = pair else { continue };
                let pieces = (length(*a, *b) / LONGEST_PIECE).ceil().clamp(1.0, MOST_PIECES);
                for piece in 0..pieces as u32 {
                    let point = between(*a, *b, f64::from(piece) / pieces);
                    farthest = farthest.max(other.reach(point, &mut near, farthest));
                }
            }
        }
        match self.vertices.last() {
            Some(last) => farthest.max(other.reach(*last, &mut near, farthest)),
            None => farthest,
        }
    }

    /// Distance from `point` to this polyline. The search stops once the distance is known to be at
    /// most `enough`, since it cannot be the largest then (Taha & Hanbury 2015,
    /// doi:10.1109/TPAMI.2015.2408351). It begins at `near`, the last segment that starts before
    /// the point.
    fn reach(&self, point: [f64; 3], near: &mut usize, enough: f64) -> f64 {
        let time = |i: usize| self.vertices.get(i).map(|v| v[0]);
        while time(*near + 1).is_some_and(|t| t <= point[0]) {
            *near += 1;
        }
        let segment = |i: usize| {
            let a = self.vertices.get(i)?;
            Some(to_segment(point, *a, *self.vertices.get(i + 1).unwrap_or(a)))
        };
        let mut best = segment(*near).unwrap_or(f64::INFINITY);
        // Outwards in time, until the difference in time alone exceeds the best distance.
        let (mut before, mut after) = (*near, *near + 1);
        loop {
            let left = before.checked_sub(1).filter(|_| time(before).is_some_and(|t| point[0] - t < best));
            let right = time(after).filter(|t| t - point[0] < best).map(|_| after);
            if best <= enough || (left.is_none() && right.is_none()) {
                return best;
            }
            if let Some(i) = left {
                best = best.min(segment(i).unwrap_or(f64::INFINITY));
                before = i;
            }
            if let Some(i) = right {
                best = best.min(segment(i).unwrap_or(f64::INFINITY));
                after = i + 1;
            }
        }
    }
}

fn between(a: [f64; 3], b: [f64; 3], share: f64) -> [f64; 3] {
    [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])]
}

fn length(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

/// Distance from a point to the segment from `a` to `b`.
fn to_segment(point: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    let along: f64 = (0..3).map(|i| (b[i] - a[i]) * (point[i] - a[i])).sum();
    let square: f64 = (0..3).map(|i| (b[i] - a[i]) * (b[i] - a[i])).sum();
    let share = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
    length(point, between(a, b, share))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step_at(t: f64) -> Graph {
        Graph { vertices: vec![[0.0, 0.0, -1.0], [t, 0.0, -1.0], [t, 0.0, 1.0], [1.0, 0.0, 1.0]] }
    }

    #[test]
    fn two_jumps_a_little_apart_are_a_little_apart() {
        // sup|Δv| is 2 for both.
        assert!((step_at(0.5).distance(&step_at(0.51)) - 0.01).abs() < 1e-15);
        assert!((step_at(0.5).distance(&step_at(0.500_001)) - 1e-6).abs() < 1e-15);
        assert_eq!(step_at(0.5).distance(&step_at(0.5)), 0.0);
    }

    #[test]
    fn a_jump_that_one_of_them_lacks_counts_in_full() {
        let flat = Graph { vertices: vec![[0.0, 0.0, -1.0], [0.5, 0.0, -1.0], [1.0, 0.0, -1.0]] };
        assert_eq!(step_at(0.5).distance(&flat), 2.0);
        assert_eq!(flat.distance(&step_at(0.5)), 2.0);
    }
}
