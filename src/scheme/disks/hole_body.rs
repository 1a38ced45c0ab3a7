//! What the schemes in round holes share: the structure with its holes, and the results of a step.

use super::super::body::Body;
use super::super::frame::Frame;
use super::super::matrices::Matrices;
use super::super::supports::TURNING;
use crate::error::Result;
use crate::linear::Rows;
use crate::qp::DiskBound;
use crate::scene::{Hole, Scene, WallLaw};

/// The entries of the two rows of a hole.
pub(super) fn pair(rows: &Rows, hole: usize, x: &[f64]) -> [f64; 2] {
    [rows.dot(2 * hole, x), rows.dot(2 * hole + 1, x)]
}

/// A hole.
#[derive(Debug, Clone, Copy)]
pub(super) struct Round {
    /// Its index among the walls.
    pub wall: usize,
    pub centre: [f64; 2],
    pub gap: f64,
    pub law: WallLaw,
}

/// What all rules share: the structure with its holes, and the results of a step.
#[derive(Debug)]
pub(super) struct HoleBody {
    pub body: Body<Matrices>,
    pub frame: Frame<Matrices>,
    /// The rows of the holes, two each.
    pub rows: Rows,
    pub rounds: Vec<Round>,
    /// The indices of the flat walls.
    pub flats: Vec<usize>,
}

impl HoleBody {
    /// The structure of `scene` at its start, in steps of `h` seconds.
    pub fn new(scene: &Scene, h: f64) -> Result<Self> {
        let mut body = Body::<Matrices>::new(scene, h)?;
        body.restart(0.0);
        let places = scene.holes().flat_map(|hole| [&hole.at.y, &hole.at.z]);
        let rows = Rows::new(body.n, places.map(|row| row.entries()));
        let round = |hole: Hole<'_>| Round { wall: hole.index, centre: hole.centre, gap: hole.gap, law: hole.law };
        let flats = (0..scene.walls.len()).filter(|&wall| !scene.walls[wall].is_round()).collect();
        let rounds: Vec<Round> = scene.holes().map(round).collect();
        Ok(Self { body, frame: Frame::new(scene)?, rows, rounds, flats })
    }

    /// The displacement (or velocity) of the place of a hole.
    pub fn seen(&self, hole: usize, x: &[f64]) -> [f64; 2] {
        pair(&self.rows, hole, x)
    }

    /// w of a hole at `q`.
    pub fn offset(&self, hole: usize, q: &[f64]) -> [f64; 2] {
        let ([y, z], [cy, cz]) = (self.seen(hole, q), self.rounds[hole].centre);
        [y - cy, z - cz]
    }

    /// The disk of a hole at the end of a step, as a bound on P Δ with w⁺ = `ahead` + P Δ; an
    /// elastic one, which must yield by 1/(k_a + c_a/h), at `now` at the step's start.
    pub fn disk(&self, hole: usize, now: [f64; 2], ahead: [f64; 2]) -> DiskBound {
        let Round { gap, law, .. } = self.rounds[hole];
        let radius = match law.spring() {
            Some(spring) => spring.freed_radius(gap, now, self.body.h),
            None => gap,
        };
        DiskBound::Disk { centre: ahead.map(|w| -w), radius }
    }

    /// The index of a hole among the walls.
    pub fn index(&self, hole: usize) -> usize {
        self.rounds[hole].wall
    }

    /// The number of a wall among the holes; `None` of a flat one.
    pub fn hole(&self, wall: usize) -> Option<usize> {
        self.rounds.iter().position(|round| round.wall == wall)
    }

    /// Writes the impulse of a hole, `scale` times the vector (y, z) on the structure, N s, and its
    /// normal, unless it is 0.
    pub fn push_hole(&mut self, hole: usize, scale: f64, [y, z]: [f64; 2]) {
        let (index, size) = (self.index(hole), y.hypot(z));
        if size > 0.0 {
            self.frame.push(index, scale * size, self.body.h);
            self.frame.normal[index] = [-y / size, -z / size];
        }
    }

    /// True if a rigid hole is touched at `q`.
    pub fn touches(&self, hole: usize, q: &[f64]) -> bool {
        let [y, z] = self.offset(hole, q);
        self.rounds[hole].law.is_rigid() && y.hypot(z) >= self.rounds[hole].gap * (1.0 - TURNING.touching)
    }
}
