//! The rows of the walls: bounds, which are held, and the rounding errors there.

use crate::flow::TERMS;
use crate::scene::{Scene, Side};
use crate::scheme::exact::noise;

/// The sign of a wall's force, for lower and upper walls.
pub(super) const SIGNS: [f64; 2] = [1.0, -1.0];

/// A row with rigid walls behind it; that of a round wall along its normal is that of an upper one.
/// Index 0 is the lower side, 1 the upper.
#[derive(Debug, Clone, Copy)]
pub(super) struct WallRow {
    /// Position of the nearest rigid wall of each side, m; infinite without one.
    pub bound: [f64; 2],
    /// The largest restitution of the walls at that position.
    pub restitution: [f64; 2],
    /// Numbers of walls that share the force: all at that position in lasting contact, those with
    /// the largest restitution in an impact.
    pub carriers: [usize; 2],
    pub strikers: [usize; 2],
    /// The sign of the walls that hold the row at present; 0 if none does.
    pub held: f64,
    /// The furthest that the row has moved on a stretch so far, m: the scale for the height of a
    /// flight.
    pub travel: f64,
    /// The time of its last impact, s.
    pub struck: f64,
    /// True once its gap has fallen from 0 within rounding, until a flight far too high for the
    /// tail of an accumulation: its impacts may be the rounding error of whole stretches.
    pub drifts: bool,
    /// What has been decided at this instant about the leading coefficients of each side's gap.
    pub gap_zeros: [Option<LeadingZeros>; 2],
    /// The same for the force that holds the row.
    pub force_zeros: Option<LeadingZeros>,
}

impl WallRow {
    /// The row that the walls with these indices share.
    pub fn new(scene: &Scene, walls: &[usize]) -> Self {
        let mut place = Self {
            bound: [f64::NEG_INFINITY, f64::INFINITY],
            restitution: [0.0; 2],
            carriers: [0; 2],
            strikers: [0; 2],
            held: 0.0,
            travel: 0.0,
            struck: f64::NEG_INFINITY,
            drifts: false,
            gap_zeros: [None; 2],
            force_zeros: None,
        };
        for wall in walls.iter().filter_map(|&i| scene.walls.get(i)) {
            let (Some(e), side) = (wall.law.restitution(), usize::from(wall.side() == Side::Upper)) else { continue };
            let nearer = SIGNS[side] * (wall.position() - place.bound[side]);
            if nearer > 0.0 {
                place.bound[side] = wall.position();
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

    /// Discards what was decided at an instant.
    pub fn forget(&mut self) {
        self.gap_zeros = [None; 2];
        self.force_zeros = None;
    }
}

/// Number of derivatives of the displacement whose sizes are kept: up to the last that `rest.rs`
/// examines.
pub(super) const DERIVATIVES: usize = 5;

/// Sizes of the terms of forces and derivatives, whose rounding errors limit what is known of a
/// row.
#[derive(Debug)]
pub(super) struct Sizes {
    /// Of the derivatives of q (m/sᵏ), n entries each. The terms that add up to a derivative may be
    /// far larger than the derivative, and what follows from it has the rounding error of those
    /// terms.
    pub derivative: [Vec<f64>; DERIVATIVES],
    /// Of the force (N) and of its rate (N/s) at the start of the series, n entries each.
    pub force: [Vec<f64>; 2],
    /// True once `force` holds the sizes of the present series.
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

/// A polynomial whose first root is sought.
#[derive(Debug, Clone, Copy)]
pub(super) struct RowPolynomial {
    pub c: [f64; TERMS],
    pub terms: usize,
}

/// Rounding errors of the coefficients of a polynomial at its start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rounding {
    /// Of the first coefficients.
    pub of: [f64; NOISES],
    /// How far below 0 its value may be by rounding, anywhere on the stretch.
    depth: f64,
}

impl Rounding {
    /// `terms` is the sum of the sizes of all further terms on the stretch.
    pub fn new(of: [f64; NOISES], terms: f64) -> Self {
        Self { of, depth: BELOW * (of.iter().sum::<f64>() + noise(terms)) }
    }

    /// The same with the errors of the coefficients multiplied by `doubt`.
    pub fn doubted(mut self, doubt: f64) -> Self {
        self.of.iter_mut().for_each(|noise| *noise *= doubt);
        self
    }

    /// The distance below 0 at which a polynomial that starts at 0 is found to be negative.
    pub fn below(&self) -> f64 {
        BELOW * self.depth
    }
}

/// The result of the search for a first root.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum FirstRoot {
    /// The polynomial is 0, within rounding, and goes below 0 at once.
    Now,
    /// The first root, in the stretch's x.
    Root(f64),
    /// The polynomial is 0, within rounding, and is below 0 by more than rounding from here on.
    Below(f64),
    Nothing,
}

/// What an event has decided about a row that touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LeadingZeros {
    /// That many leading coefficients are zero, and the next one is positive.
    Then(usize),
    /// That many are zero; which way the row goes is undecided.
    Unknown(usize),
    /// All are: the row cannot move.
    All,
}

impl RowPolynomial {
    /// The first root up to `end`. Coefficients below their rounding error at the start count as 0;
    /// `zeros` says which are 0 because of what has been decided at this instant. A `force` below 0
    /// is an event in any case, a gap below 0 only if it goes on falling.
    ///
    /// Where no known coefficient shows which way a polynomial at 0 goes (a force may have to
    /// travel through many masses first), the search is for the point where it is below 0 by more
    /// than rounding.
    pub fn first(
        &self,
        zeros: Option<LeadingZeros>,
        rounding: impl FnOnce() -> Rounding,
        near: bool,
        force: bool,
        end: f64,
    ) -> FirstRoot {
        let c = &self.c[..self.terms];
        if zeros.is_none() && !near && c[0] > 0.0 {
            return root(c, end);
        }
        let (skip, rises_at) = match zeros {
            Some(LeadingZeros::All) => return FirstRoot::Nothing,
            Some(LeadingZeros::Then(k)) if k >= NOISES && c.get(k).is_some_and(|c| *c > 0.0) => {
                return root(&c[k..], end);
            }
            Some(LeadingZeros::Then(k)) => (k.min(self.terms), k),
            Some(LeadingZeros::Unknown(k)) => (k.min(self.terms), usize::MAX),
            None => (0, usize::MAX),
        };
        let (rounding, slack) = (rounding(), if zeros.is_some() { DECIDED } else { 1.0 });
        for (k, (&c, &noise)) in c.iter().zip(&rounding.of).enumerate().skip(skip) {
            if c > if rises_at == k { 0.0 } else { noise } {
                return root(&self.c[k..self.terms], end);
            }
            if c < -slack * noise && (k > 0 || force) {
                return FirstRoot::Now;
            }
        }
        if zeros.is_none() && c[0] < -rounding.depth {
            return FirstRoot::Now;
        }
        let mut below = [0.0; TERMS];
        for (below, c) in below[skip..self.terms].iter_mut().zip(&c[skip..]) {
            *below = *c;
        }
        below[0] += rounding.below();
        let found = if below[0] > 0.0 { root(&below[..self.terms], end) } else { FirstRoot::Nothing };
        if let FirstRoot::Root(x) = found { FirstRoot::Below(x) } else { found }
    }
}

fn root(c: &[f64], end: f64) -> FirstRoot {
    super::root::first_root(c, end).map_or(FirstRoot::Nothing, FirstRoot::Root)
}

/// Number of coefficients whose rounding error is known.
const NOISES: usize = 4;

/// Factor on its rounding error by which a coefficient may contradict what a programme has decided,
/// since the programme's signs have a coarser tolerance.
const DECIDED: f64 = 1e3;

/// A value below 0 by this many times its rounding error is not 0; the search starts from as far
/// above that.
const BELOW: f64 = 2.0;

#[cfg(test)]
mod tests;
