//! The programme on its rows, solved exactly by block principal pivoting from a guess of the rows
//! in play.
//!
//! Find r with lᵢ ≤ yᵢ ≤ uᵢ, y = y_free + W r, and rᵢ of the sign of the bound that row i stands
//! on. Every row is free (rᵢ = 0), at its lower or at its upper bound. A pass solves for the rows
//! that stand on a bound and looks for rows whose state is wrong: a force that pulls, a free row
//! beyond a bound. As long as their number falls, all of them are exchanged at once, with
//! [`PATIENCE`] passes in which it need not fall (Kostreva 1978, Linear Algebra Appl. 21, 207;
//! Júdice and Pires 1994, doi:10.1016/0305-0548(94)90106-6). After these only the last wrong row is
//! exchanged, until their number is below its least so far (Murty 1974, Opsearch 11, 123). Murty's
//! rule ends for every P-matrix: if the programme without row 0 is solved for each state of that
//! row in turn, y₀ increases with r₀, so row 0 changes its state at most twice; and so on for all
//! rows. A singular W counts as the limit of positive definite ones (see [`super::relations`]).

use super::block::Block;
use super::clamp::ordered_bounds;
use super::cycle::Cycle;
use super::delassus::Delassus;
use super::side::Side;
use super::{NOISE, ROUNDING, Rhs, ULPS};

/// Number of passes in which all wrong rows are exchanged although their number has not fallen.
const PATIENCE: u32 = 10;

/// Maximum number of searches for free rows that touch and must share a force; 1 is usual.
const JOINS: u32 = 10;

/// Fraction of the sign test's tolerance by which dependent rows may miss their bounds and still
/// count as met: below 1, so that a row which then gives way to the others is within the tolerance.
const MET: f64 = 0.9;

/// A violation above this share of the motions of the programme is not rounding (dimensionless):
/// rounding is 1e-16 over the least squared angle, 1e-12, and rows whose forces are of any use do
/// not reach that.
const SMALL: f64 = 1e-6;

/// The state of every row, kept from programme to programme.
pub(super) struct Pivoting {
    side: Vec<Option<Side>>,
    /// The rows with a bound in the last programme: no other is on a bound.
    bounded: Vec<usize>,
    block: Block,
    /// y under the forces of a pass.
    y: Vec<f64>,
    /// Rows whose state is wrong, in increasing order, with the states that they shall have.
    wrong: Vec<(usize, Option<Side>)>,
    /// Rows in play in the next pass.
    next: Vec<usize>,
}

/// Factor by which the sign test's tolerance grows when pivoting cycles. Only rounding can cause a
/// cycle, and that rounding then exceeds the tolerance, as it does where rows through one point are
/// nearly dependent.
const LOOSER: f64 = 10.0;

/// Maximum number of times that it grows.
const LOOSENINGS: u32 = 3;

/// Maximum number of passes for m rows. Most programmes take one or two; the most are taken where
/// many more rows than unknowns are violated at once.
pub(super) fn passes(m: usize) -> usize {
    100 + 10 * m
}

impl Pivoting {
    pub(super) fn new(system: &Delassus) -> Self {
        let m = system.count();
        Self {
            side: vec![None; m],
            bounded: Vec::with_capacity(m),
            block: Block::new(system),
            y: vec![0.0; m],
            wrong: Vec::with_capacity(m),
            next: Vec::with_capacity(m),
        }
    }

    /// Frees all rows.
    pub(super) fn clear(&mut self) {
        self.side.fill(None);
    }

    /// Puts a row on a bound.
    pub(super) fn call(&mut self, row: usize, side: Side) {
        self.side[row] = Some(side);
    }

    /// Rows on a bound, increasing.
    pub(super) fn called(&self) -> impl Iterator<Item = (usize, Side)> {
        self.side.iter().enumerate().filter_map(|(row, side)| side.map(|side| (row, side)))
    }

    /// Puts the rows that the free motion violates on the bounds they violate, and frees the
    /// others.
    pub(super) fn call_violated(&mut self, system: &Delassus, rhs: &Rhs, bounded: &[usize]) {
        self.bounded.drain(..).for_each(|row| self.side[row] = None);
        for &row in bounded {
            self.side[row] = Side::violated(system.y[row], rhs.lo[row], rhs.hi[row]);
        }
    }

    /// Number of linearly independent rows among all rows.
    pub(super) fn rank(&self) -> usize {
        self.block.rank()
    }

    /// Rows in play, increasing.
    pub(super) fn rows(&self) -> &[usize] {
        self.block.rows()
    }

    /// Lets the rows of `bounded` begin at the bounds at which they stood. Rows that had a bound in
    /// the last programme and have none in this one have none to stand on.
    fn stand(&mut self, rhs: &Rhs, bounded: &[usize]) {
        let stays = |row: usize, side: Side| if side == Side::Lower { rhs.lo[row] } else { rhs.hi[row] }.is_finite();
        for row in self.bounded.drain(..) {
            self.side[row] = self.side[row].filter(|&side| stays(row, side));
        }
        self.bounded.extend_from_slice(bounded);
        self.next.clear();
        for &row in bounded {
            self.side[row] = self.side[row].filter(|&side| stays(row, side));
            if self.side[row].is_some() {
                self.next.push(row);
            }
        }
    }

    /// Starts from the states of the rows and ends with the exact r (m entries). `bounded` are the
    /// rows with a bound, increasing. Signs of gaps are tested relative to `scale`, or to the row's
    /// free motion where that is larger. Returns the number of exchanges; `None` if it did not
    /// settle, or found no forces that meet all bounds, which another method then has to confirm.
    pub(super) fn solve(
        &mut self,
        system: &Delassus,
        rhs: &Rhs,
        bounded: &[usize],
        scale: f64,
        passes: usize,
        r: &mut [f64],
    ) -> Option<u64> {
        self.stand(rhs, bounded);
        r.fill(0.0);
        let (mut least, mut patience, mut pivots, mut joins) = (usize::MAX, PATIENCE, 0, 0);
        // Rounding of forces passed on between rows is allowed for only where pivoting fails
        // without that: it would accept active sets of needlessly large forces.
        let (mut tolerance, mut ulps, mut cycle) = (ROUNDING, 0.0, Cycle::default());
        for _ in 0..passes {
            self.block.set(system, &self.next);
            self.find_wrong(system, rhs, bounded, (scale, tolerance, ulps), r);
            if self.wrong.is_empty() && joins < JOINS {
                self.join(system, rhs, scale, tolerance, r);
                joins += 1;
            }
            if self.wrong.is_empty() {
                // Forces that grow without limit: rows that cannot be met together, because their
                // bounds cross or because they are so nearly dependent that rounding decides.
                let Some(escape) = self.block.escape() else { return Some(pivots) };
                if ulps == 0.0 && !self.crossing(rhs, escape) {
                    ulps = ULPS;
                    continue;
                }
                return None;
            }
            if self.wrong.len() < least {
                (least, patience) = (self.wrong.len(), PATIENCE);
            } else if patience > 0 {
                patience -= 1;
            } else {
                if cycle.closes(&self.wrong, self.block.rows()) {
                    if cycle.closed > LOOSENINGS {
                        break;
                    }
                    (tolerance, ulps) = (tolerance * LOOSER, ULPS);
                }
                let last = self.wrong.len() - 1;
                self.wrong.swap(0, last);
                self.wrong.truncate(1);
            }
            pivots += self.wrong.len() as u64;
            self.exchange(r);
        }
        None
    }

    /// One pass: forces r, the motion y they cause, and the rows whose state is wrong, increasing.
    fn find_wrong(
        &mut self,
        system: &Delassus,
        rhs: &Rhs,
        bounded: &[usize],
        (scale, tolerance, ulps): (f64, f64, f64),
        r: &mut [f64],
    ) {
        let side = &mut self.side;
        let bound = |row: usize, side: &[Option<Side>]| side[row].map_or(0.0, |side| side.bound(rhs, row));
        let length = |row: usize| scale.max(system.y[row].abs());
        let slack = |row: usize| MET * tolerance * length(row);
        self.block.forces(system, |row| bound(row, side) - system.y[row], slack, ulps, r);
        self.wrong.clear();
        self.y.copy_from_slice(&system.y);
        let mut reach = 0.0;
        for &row in self.block.rows() {
            system.push(row, r[row], &mut self.y);
            reach = f64::max(reach, r[row].abs() * system.weight[row]);
        }
        for &row in self.block.rows() {
            // A row in play stands exactly on its bound.
            self.y[row] = bound(row, side);
            let grows = self.block.escape().map_or(0.0, |escape| escape[row]);
            let force = if grows == 0.0 { r[row] } else { grows };
            if side[row].is_some_and(|side| side.sign() * force < 0.0) {
                if rhs.lo[row] >= rhs.hi[row] {
                    // Both bounds coincide: a force of either sign is allowed.
                    side[row] = Some(if force > 0.0 { Side::Lower } else { Side::Upper });
                } else {
                    self.wrong.push((row, None));
                }
            }
        }
        let pulling = self.wrong.len();
        for &row in bounded {
            let (y, lo, hi) = (self.y[row], rhs.lo[row], rhs.hi[row]);
            if (y < lo) | (y > hi) {
                // A force has 16 digits, so no row's motion is more accurate than ulps of the
                // motion that the largest force causes.
                let tolerance = f64::max(tolerance * length(row), ULPS * reach * system.weight[row]);
                let (lo, hi) = ordered_bounds(lo, hi);
                let excess = (lo - y).max(y - hi);
                if side[row].is_none() && excess > tolerance {
                    // Nearly dependent rows pass their rounding errors on to this row, amplified.
                    let small = ulps > 0.0
                        && reach > 0.0
                        && excess <= SMALL * f64::max(length(row), reach * system.weight[row]);
                    if small && self.block.singular() && excess <= self.block.rounding(system, row, reach) {
                        continue;
                    }
                    self.wrong.push((row, Some(if lo - y > y - hi { Side::Lower } else { Side::Upper })));
                }
            }
        }
        if pulling > 0 {
            self.wrong.sort_unstable_by_key(|wrong| wrong.0);
        }
    }

    /// Adds to the wrong rows the free rows that touch a bound and depend on rows in play: they
    /// must share the force.
    fn join(&mut self, system: &Delassus, rhs: &Rhs, scale: f64, tolerance: f64, r: &[f64]) {
        if !self.block.singular() || self.block.rows().is_empty() {
            return;
        }
        let slack = |row: usize| MET * tolerance * scale.max(system.y[row].abs());
        for row in 0..self.side.len() {
            if self.side[row].is_some() {
                continue;
            }
            let gap = |side: Side| (self.y[row] - side.bound(rhs, row)).abs();
            for (side, gap) in [Side::Lower, Side::Upper].map(|side| (side, gap(side))) {
                if gap <= slack(row)
                    && let Some(motion) = self.block.yielding(system, row, gap, slack, r)
                    && side.sign() * motion < 0.0
                {
                    self.wrong.push((row, Some(side)));
                    break;
                }
            }
        }
    }

    /// Changes the state of the wrong rows, and makes the list of those in play.
    fn exchange(&mut self, r: &mut [f64]) {
        self.next.clear();
        let mut stay = self.block.rows().iter().copied().peekable();
        for &(row, side) in &self.wrong {
            while let Some(other) = stay.next_if(|&other| other < row) {
                self.next.push(other);
            }
            self.side[row] = side;
            if side.is_some() {
                self.next.push(row);
            } else {
                stay.next_if_eq(&row);
                r[row] = 0.0;
            }
        }
        self.next.extend(stay);
    }

    /// True if the bounds cannot be met together, as forces that grow like `escape` show.
    ///
    /// By Farkas's lemma they cannot if Gᵀe = 0 and Σ eᵢ · boundᵢ > 0, with eᵢ of the sign of its
    /// bound: so never where all bounds contain 0. A sum within rounding of 0 proves nothing about
    /// the bounds.
    fn crossing(&self, rhs: &Rhs, escape: &[f64]) -> bool {
        let (mut sum, mut size) = (0.0, 0.0);
        for (row, side) in self.called() {
            let term = escape[row] * side.bound(rhs, row);
            sum += term;
            size += term.abs();
        }
        sum > NOISE * size
    }
}

#[cfg(test)]
mod tests;
