//! The rows of the walls, as contact sees them: bounds, what is held, and what roundings are worth there.

use crate::flow::{SeriesBody, TERMS};
use crate::scene::{Scene, Side};
use crate::scheme::exact::noise;

/// The side of the structure on which a wall stands: the sign of its force.
pub(super) const SIGNS: [f64; 2] = [1.0, -1.0];

/// A row with rigid walls behind it. Index 0 is the lower side, 1 the upper.
#[derive(Debug, Clone, Copy)]
pub(super) struct WallRow {
    /// Where the nearest rigid wall of each side stands, m; infinite without one.
    pub bound: [f64; 2],
    /// The largest restitution of the walls that stand there.
    pub restitution: [f64; 2],
    /// How many share it: all that stand there in lasting contact, those of the largest restitution in an impact.
    pub carriers: [usize; 2],
    pub strikers: [usize; 2],
    /// The sign of the walls that hold the row at present; 0 if none does.
    pub held: f64,
    /// The furthest that it has moved on a stretch so far, m: what a low flight is low against.
    pub travel: f64,
    /// What has been decided at this instant about the coefficients of each side's gap.
    pub gap_zeros: [Option<Zeros>; 2],
    /// The same of the force that holds the row.
    pub force_zeros: Option<Zeros>,
}

impl WallRow {
    /// The row that the walls of these numbers share.
    pub fn new(scene: &Scene, walls: &[usize]) -> Self {
        let mut place = Self {
            bound: [f64::NEG_INFINITY, f64::INFINITY],
            restitution: [0.0; 2],
            carriers: [0; 2],
            strikers: [0; 2],
            held: 0.0,
            travel: 0.0,
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

/// Derivatives of the displacement whose sizes are kept: with the acceleration those that are asked about a row at rest.
pub(super) const DERIVATIVES: usize = 5;

/// Sizes of the terms of forces and derivatives, whose rounding limits what a row shows.
#[derive(Debug)]
pub(super) struct Sizes {
    /// Of the derivatives of q (m/sᵏ), n entries each. What a derivative is a sum of may be far larger than the derivative, and
    /// what follows from it errs by the rounding of those terms.
    pub derivative: [Vec<f64>; DERIVATIVES],
    /// Of the force (N) and of its rate (N/s) at the start of the series, n entries each.
    pub force: [Vec<f64>; 2],
    /// True once the sizes of `force` are those of the present series.
    pub known: bool,
    /// Of the force at the last event, N.
    pub instant: Vec<f64>,
    pub work: Vec<f64>,
}

impl Sizes {
    pub fn new(n: usize) -> Self {
        let zero = || vec![0.0; n];
        Self {
            derivative: std::array::from_fn(|_| zero()),
            force: [zero(), zero()],
            known: false,
            instant: zero(),
            work: zero(),
        }
    }
}

/// Σ |gⱼ| |xⱼ|.
pub(super) fn size(body: &SeriesBody, row: usize, x: &[f64]) -> f64 {
    body.rows.row(row).iter().map(|&(j, g)| (g * x[j]).abs()).sum()
}

/// A polynomial to be watched for its first root.
#[derive(Debug, Clone, Copy)]
pub(super) struct Watched {
    pub c: [f64; TERMS],
    pub terms: usize,
}

/// What the coefficients of a polynomial err by at its start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rounding {
    /// The first ones, each by itself.
    pub of: [f64; NOISES],
    /// How far below 0 its value may be for rounding, anywhere on the stretch.
    depth: f64,
}

impl Rounding {
    /// `terms` is the sum of the sizes of all further terms on the stretch.
    pub fn new(of: [f64; NOISES], terms: f64) -> Self {
        Self { of, depth: BELOW * (of.iter().sum::<f64>() + noise(terms)) }
    }

    /// The same with coefficients that must differ from 0 by `doubt` times as much.
    pub fn doubted(mut self, doubt: f64) -> Self {
        self.of.iter_mut().for_each(|noise| *noise *= doubt);
        self
    }

    /// The value below 0 at which a polynomial at 0 is found to be below it.
    pub fn below(&self) -> f64 {
        BELOW * self.depth
    }
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

/// What an event decides about a row that touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Zeros {
    /// That many leading coefficients are zero, and the next one is positive.
    Then(usize),
    /// That many are zero; which way the row goes is not known.
    Unknown(usize),
    /// All are: the row cannot move.
    All,
}

impl Watched {
    /// The first root up to `end`. Coefficients below their rounding at the start are taken for 0; `zeros` says which are 0 by what
    /// has been decided at this instant. A `force` below 0 is an event whatever follows, a gap only if it goes on falling.
    ///
    /// Where no known coefficient tells which way a polynomial at 0 goes — a push may have to come through many masses first — it is
    /// watched until it is below 0 by more than rounding.
    pub fn first(
        &self,
        zeros: Option<Zeros>,
        rounding: impl FnOnce() -> Rounding,
        near: bool,
        force: bool,
        end: f64,
    ) -> Seen {
        let c = &self.c[..self.terms];
        if zeros.is_none() && !near && c[0] > 0.0 {
            return root(c, end);
        }
        let (skip, rises_at) = match zeros {
            Some(Zeros::All) => return Seen::Nothing,
            Some(Zeros::Then(k)) if k >= NOISES && c.get(k).is_some_and(|c| *c > 0.0) => return root(&c[k..], end),
            Some(Zeros::Then(k)) => (k.min(self.terms), k),
            Some(Zeros::Unknown(k)) => (k.min(self.terms), usize::MAX),
            None => (0, usize::MAX),
        };
        let (rounding, slack) = (rounding(), if zeros.is_some() { DECIDED } else { 1.0 });
        for (k, (&c, &noise)) in c.iter().zip(&rounding.of).enumerate().skip(skip) {
            if c > if rises_at == k { 0.0 } else { noise } {
                return root(&self.c[k..self.terms], end);
            }
            if c < -slack * noise && (k > 0 || force) {
                return Seen::Now;
            }
        }
        if zeros.is_none() && c[0] < -rounding.depth {
            return Seen::Now;
        }
        let mut below = [0.0; TERMS];
        for (below, c) in below[skip..self.terms].iter_mut().zip(&c[skip..]) {
            *below = *c;
        }
        below[0] += rounding.below();
        if below[0] > 0.0 { root(&below[..self.terms], end) } else { Seen::Nothing }
    }
}

fn root(c: &[f64], end: f64) -> Seen {
    super::root::first_root(c, end).map_or(Seen::Nothing, Seen::Root)
}

/// Coefficients whose noise is known.
const NOISES: usize = 4;

/// How far beyond its rounding a coefficient may contradict what a programme has decided, whose signs are told more coarsely.
const DECIDED: f64 = 1e3;

/// A value below 0 by this many times its rounding is not 0; watching starts from as far above that.
const BELOW: f64 = 2.0;
