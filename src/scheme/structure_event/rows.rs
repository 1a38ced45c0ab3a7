//! The rows of the walls, as contact sees them: bounds, what is held, and what roundings are worth there.

use crate::flow::{Body, TERMS};
use crate::scene::{Scene, Side};

/// The side of the structure on which a wall stands: the sign of its force.
pub(super) const SIGNS: [f64; 2] = [1.0, -1.0];

/// A row with rigid walls behind it. Index 0 is the lower side, 1 the upper.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Where the nearest rigid wall of each side stands, m; infinite without one.
    pub bound: [f64; 2],
    /// The largest restitution of the walls that stand there.
    pub restitution: [f64; 2],
    /// How many share it: all that stand there in lasting contact, those of the largest restitution in an impact.
    pub carriers: [usize; 2],
    pub strikers: [usize; 2],
    /// The sign of the walls that hold the row at present; 0 if none does.
    pub held: f64,
    /// Leading coefficients of each side's gap that are zero by what has been decided at this instant.
    pub gap_zeros: [Option<usize>; 2],
    /// The same of the force that holds the row.
    pub force_zeros: Option<usize>,
}

impl Place {
    /// The row that the walls of these numbers share.
    pub fn new(scene: &Scene, walls: &[usize]) -> Self {
        let mut place = Self {
            bound: [f64::NEG_INFINITY, f64::INFINITY],
            restitution: [0.0; 2],
            carriers: [0; 2],
            strikers: [0; 2],
            held: 0.0,
            gap_zeros: [None; 2],
            force_zeros: None,
        };
        for wall in walls.iter().filter_map(|&i| scene.walls.get(i)) {
            let (Some(e), side) = (wall.law.restitution(), usize::from(wall.side == Side::Upper)) else { continue };
            let nearer = SIGNS[side] * (wall.position - place.bound[side]);
            if nearer > 0.0 {
                place.bound[side] = wall.position;
                (place.restitution[side], place.carriers[side], place.strikers[side]) = (e, 1, 1);
            } else if nearer == 0.0 {
                place.carriers[side] += 1;
                if e > place.restitution[side] {
                    (place.restitution[side], place.strikers[side]) = (e, 1);
                } else if e == place.restitution[side] {
                    place.strikers[side] += 1;
                }
            }
        }
        place
    }

    /// Gap of a side at displacement `w`, m; infinite without a wall.
    #[inline]
    pub fn gap(&self, side: usize, w: f64) -> f64 {
        SIGNS[side] * (w - self.bound[side])
    }

    /// Forgets what was decided at an instant.
    pub fn forget(&mut self) {
        self.gap_zeros = [None; 2];
        self.force_zeros = None;
    }
}

/// Sizes whose rounding limits what a row shows, computed at most once for an instant.
#[derive(Debug)]
pub(super) struct Sizes {
    /// Sizes of the terms of the force (N) and of its rate (N/s), n entries each.
    pub force: [Vec<f64>; 2],
    pub known: bool,
    /// Sizes of the terms of the force at the last event, N.
    pub instant: Vec<f64>,
    pub work: Vec<f64>,
}

impl Sizes {
    pub fn new(n: usize) -> Self {
        Self { force: [vec![0.0; n], vec![0.0; n]], known: false, instant: vec![0.0; n], work: vec![0.0; n] }
    }
}

/// Σ |gⱼ| |xⱼ|.
pub(super) fn size(body: &Body, row: usize, x: &[f64]) -> f64 {
    body.rows.row(row).iter().map(|&(j, g)| (g * x[j]).abs()).sum()
}

/// A polynomial to be watched for its first root.
#[derive(Debug, Clone, Copy)]
pub(super) struct Watched {
    pub c: [f64; TERMS],
    pub terms: usize,
}

/// What watching says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Seen {
    /// It is at 0, within rounding, and goes below it at once.
    Now,
    /// The first root, in the stretch's x.
    Root(f64),
    Nothing,
}

impl Watched {
    /// The first root up to `end`. Coefficients below their `noise` at the start are none; `zeros` says how many are none whatever they
    /// show. A `force` below 0 is an event whatever follows, a gap only if it goes on falling.
    pub fn first(
        &self,
        zeros: Option<usize>,
        noise: impl FnOnce() -> [f64; 4],
        near: bool,
        force: bool,
        end: f64,
    ) -> Seen {
        let c = &self.c[..self.terms];
        let known = NOISES.min(self.terms);
        let from = match zeros {
            // What has been decided at this instant is not decided again by rounding.
            Some(zeros) if zeros >= NOISES => (zeros..self.terms).find(|&k| c[k] > 0.0),
            None if !near && c[0] > 0.0 => Some(0),
            _ => {
                let (noise, slack) = (noise(), if zeros.is_some() { DECIDED } else { 1.0 });
                let falls = |k: usize| c[k] < -slack * noise[k] && (k > 0 || force);
                let rises = |k: usize| c[k] > if zeros == Some(k) { 0.0 } else { noise[k] };
                match (zeros.unwrap_or(0)..known).find(|&k| rises(k) || falls(k)) {
                    Some(k) if falls(k) => return Seen::Now,
                    None if zeros.is_none() && c[0] < -2.0 * noise[0] => return Seen::Now,
                    found => found,
                }
            }
        };
        let Some(from) = from else { return Seen::Nothing };
        super::root::first_root(&c[from..], end).map_or(Seen::Nothing, Seen::Root)
    }
}

/// Coefficients whose noise is known.
const NOISES: usize = 4;

/// How far beyond its rounding a coefficient may contradict what a programme has decided, whose signs are told more coarsely.
const DECIDED: f64 = 1e3;
