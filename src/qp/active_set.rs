//! The programme on its rows, solved exactly from a guess of the rows in play.
//!
//! Find r with lᵢ ≤ yᵢ ≤ uᵢ, y = y_free + W r, and rᵢ of the sign of the bound that row i stands
//! on. This is a dual active-set method (Goldfarb and Idnani 1983, doi:10.1007/BF02591962) written
//! on W: the multipliers always have the right sign and each pivot raises the dual objective, so no
//! active set occurs twice and the method ends for any positive semidefinite W. That includes rows
//! that see the same motion (duplicate walls): a row that depends on those in play is left out if
//! they already satisfy it, exchanged for one of them if not, and reported as infeasible if none
//! can be dropped for it. It changes one row at a time and stores the factor of W in full. It
//! serves where there are more rows than the motion has degrees of freedom (see [`super::crowd`]),
//! and as the last resort after [`super::pivoting`], for rows so nearly dependent that rounding
//! decides the signs there.

use super::clamp::ordered_bounds;
use super::delassus::Delassus;
use super::envelope::DEPENDENT;
use super::side::Side;
use super::sums::dot;
use super::{Failure, NOISE, ROUNDING, Rhs, ULPS};

/// The rows in play, the factor of W on them, and work space for all m rows.
pub(super) struct ActiveSet {
    m: usize,
    rows: Vec<usize>,
    sides: Vec<Side>,
    /// Lower Cholesky factor of W on `rows`, row by row with stride m.
    factor: Vec<f64>,
    /// Forces of `rows`, and their change per unit of force on an entering row.
    force: Vec<f64>,
    change: Vec<f64>,
    /// y of all rows under these forces.
    y: Vec<f64>,
}

impl ActiveSet {
    pub(super) fn new(m: usize) -> Self {
        Self {
            m,
            rows: Vec::with_capacity(m),
            sides: Vec::with_capacity(m),
            factor: vec![0.0; m * m],
            force: vec![0.0; m],
            change: vec![0.0; m],
            y: vec![0.0; m],
        }
    }

    /// Rows in play, in no particular order.
    pub(super) fn rows(&self) -> impl Iterator<Item = (usize, Side)> {
        self.rows.iter().copied().zip(self.sides.iter().copied())
    }

    /// Puts a row in play, unless it depends on those already there: W restricted to the rows in
    /// play stays positive definite.
    pub(super) fn push(&mut self, system: &Delassus, row: usize, side: Side) {
        if self.rows.len() < self.m && !self.rows.contains(&row) && self.extend_factor(system, self.rows.len(), row) {
            self.rows.push(row);
            self.sides.push(side);
        }
    }

    /// Starts from the rows in play and ends with the exact r (m entries). Signs of gaps are tested
    /// relative to `scale`, or to the row's free motion where that is larger. Fails after `limit`
    /// pivots. Returns their number.
    pub(super) fn solve(
        &mut self,
        system: &Delassus,
        rhs: &Rhs,
        scale: f64,
        limit: u64,
        r: &mut [f64],
    ) -> Result<u64, Failure> {
        let mut pivots = 0;
        // A bound of the last active set may be infinite in this programme.
        self.keep(system, |row, side, _| side.bound(rhs, row).is_finite());
        // The start is valid once no force has the wrong sign; each round removes a row, so this
        // ends.
        loop {
            self.balance(system, rhs);
            let before = self.rows.len();
            self.keep(system, |_, side, force| side.sign() * force >= 0.0);
            if self.rows.len() == before {
                break;
            }
            pivots += (before - self.rows.len()) as u64;
        }
        loop {
            r.fill(0.0);
            for (&row, &force) in self.rows.iter().zip(&self.force) {
                r[row] = force;
            }
            let Some(entering) = self.worst(system, rhs, scale, r) else { return Ok(pivots) };
            pivots += self.enter(system, rhs, entering, limit.saturating_sub(pivots), r)?;
            self.balance(system, rhs);
            // Only rounding gives a wrong sign here, to a force that is zero: set it to 0.
            for (force, side) in self.force.iter_mut().zip(&self.sides) {
                if side.sign() * *force < 0.0 {
                    *force = 0.0;
                }
            }
        }
    }

    /// The row not in play with the largest violation in units of √Wᵢᵢ, if any is violated by more
    /// than rounding.
    fn worst(&mut self, system: &Delassus, rhs: &Rhs, scale: f64, r: &[f64]) -> Option<(usize, Side)> {
        let mut worst = (0.0, None);
        self.y.copy_from_slice(&system.y);
        self.rows.iter().for_each(|&row| system.push(row, r[row], &mut self.y));
        let reach = self.rows.iter().fold(0.0, |reach, &j| f64::max(reach, r[j].abs() * system.weight[j]));
        for row in 0..self.m {
            if self.rows.contains(&row) {
                continue;
            }
            let y = self.y[row];
            let (lo, hi) = ordered_bounds(rhs.lo[row], rhs.hi[row]);
            let (excess, side) = if y < lo { (lo - y, Side::Lower) } else { (y - hi, Side::Upper) };
            if excess > ROUNDING * scale.max(system.y[row].abs())
                && excess / system.weight[row] > worst.0
                && excess > self.rounding(system, row, reach)
            {
                worst = (excess / system.weight[row], Some((row, side)));
            }
        }
        worst.1
    }

    /// Rounding error of the motion of `row`: each row in play stands on its bound to within some
    /// ulps of the largest motion that a force causes at its own row, `reach` √Wᵢᵢ for row i.
    fn rounding(&mut self, system: &Delassus, row: usize, reach: f64) -> f64 {
        for (change, &j) in self.change.iter_mut().zip(&self.rows) {
            *change = system.entry(j, row);
        }
        triangular(&self.factor, self.m, self.rows.len(), &mut self.change);
        let parts = self.change.iter().zip(&self.rows).map(|(c, &j)| c.abs() * system.weight[j]);
        ULPS * reach * (system.weight[row] + parts.sum::<f64>())
    }

    /// The largest push before a force in play would change sign, and which would.
    fn blocking(&self) -> (f64, Option<usize>) {
        let mut blocking = (f64::INFINITY, None);
        for (i, ((side, change), force)) in self.sides.iter().zip(&self.change).zip(&self.force).enumerate() {
            let rate = side.sign() * change;
            if rate < 0.0 && force.abs() / -rate < blocking.0 {
                blocking = (force.abs() / -rate, Some(i));
            }
        }
        blocking
    }

    /// Brings a violated row into play, dropping rows whose force falls to zero on the way. Returns
    /// the number of pivots; fails after `limit`.
    fn enter(
        &mut self,
        system: &Delassus,
        rhs: &Rhs,
        (row, side): (usize, Side),
        limit: u64,
        r: &mut [f64],
    ) -> Result<u64, Failure> {
        for pivots in 1..=limit {
            let k = self.rows.len();
            let independent = self.extend_factor(system, k, row);
            // W_SS d = −W_Sp σ keeps the rows in play where they are while row p is pushed with σ.
            for (change, &j) in self.change.iter_mut().zip(&self.rows) {
                *change = -system.entry(j, row) * side.sign();
            }
            triangular(&self.factor, self.m, k, &mut self.change);
            let blocking = self.blocking();
            // Push that brings the row onto its bound: its violation over the Schur complement of
            // W.
            let y = self.rows.iter().zip(&self.force).fold(system.y[row], |y, (&j, f)| y + system.entry(row, j) * f)
                + system.entry(row, row) * r[row];
            let pivot = self.factor[k * self.m + k].powi(2);
            let reaching = (side.sign() * (side.bound(rhs, row) - y)).max(0.0) / pivot;
            let mut full = if independent { reaching } else { f64::INFINITY };
            if full.min(blocking.0).is_infinite() {
                self.check_crossing(system, rhs, (row, side))?;
                // The bounds do not cross: a row that is not parallel to one in play is brought
                // onto its own by what is left of its pivot.
                if pivot <= DEPENDENT * system.entry(row, row) {
                    return Err(Failure::NotSolved { status: "rows too nearly dependent" });
                }
                full = reaching;
            }
            let push = full.min(blocking.0);
            for (force, change) in self.force.iter_mut().zip(&self.change[..k]) {
                *force += push * change;
            }
            r[row] += side.sign() * push;
            if full <= blocking.0 {
                self.rows.push(row);
                self.sides.push(side);
                return Ok(pivots);
            }
            if let Some(i) = blocking.1 {
                self.rows.remove(i);
                self.sides.remove(i);
                self.force.copy_within(i + 1.., i);
                self.refactor(system, i);
            }
        }
        Err(Failure::NotSolved { status: "the active set did not settle" })
    }

    /// An error if the bounds of the rows in play and that of `row`, which depends on them, cross:
    /// by Farkas's lemma, as in `pivoting`.
    fn check_crossing(&self, system: &Delassus, rhs: &Rhs, (row, side): (usize, Side)) -> Result<(), Failure> {
        let own = side.sign() * side.bound(rhs, row);
        let (sum, size) = (0..self.rows.len()).fold((own, own.abs()), |(sum, size), i| {
            let term = self.change[i] * self.sides[i].bound(rhs, self.rows[i]);
            (sum + term, size + term.abs())
        });
        if sum <= NOISE * size {
            return Ok(());
        }
        let Some(i) = self.strongest(system) else { return Err(Failure::Infeasible { row, against: row }) };
        let against = self.rows[i];
        Err(match (side, self.sides[i]) {
            (Side::Upper, Side::Lower) => Failure::Infeasible { row: against, against: row },
            _ => Failure::Infeasible { row, against },
        })
    }

    /// Which of the rows in play reacts most to an impossible push.
    fn strongest(&self, system: &Delassus) -> Option<usize> {
        let resistance = |i: usize| self.change[i].abs() * system.weight[self.rows[i]];
        (0..self.rows.len()).filter(|&i| self.change[i] != 0.0).max_by(|&i, &j| resistance(i).total_cmp(&resistance(j)))
    }

    /// Forces that put every row in play exactly on its bound: W_SS r = bound − y_free.
    fn balance(&mut self, system: &Delassus, rhs: &Rhs) {
        for (i, (&row, side)) in self.rows.iter().zip(&self.sides).enumerate() {
            self.force[i] = side.bound(rhs, row) - system.y[row];
        }
        triangular(&self.factor, self.m, self.rows.len(), &mut self.force);
    }

    fn keep(&mut self, system: &Delassus, wanted: impl Fn(usize, Side, f64) -> bool) {
        let (mut kept, mut same) = (0, 0);
        for i in 0..self.rows.len() {
            if wanted(self.rows[i], self.sides[i], self.force[i]) {
                same += usize::from(kept == i);
                (self.rows[kept], self.sides[kept]) = (self.rows[i], self.sides[i]);
                kept += 1;
            }
        }
        if kept < self.rows.len() {
            self.rows.truncate(kept);
            self.sides.truncate(kept);
            self.refactor(system, same);
        }
    }

    /// Factors W on the rows in play again, from row number `from` on.
    fn refactor(&mut self, system: &Delassus, from: usize) {
        for k in from..self.rows.len() {
            // A subset of independent rows is independent.
            self.extend_factor(system, k, self.rows[k]);
        }
    }

    /// Computes row k of the Cholesky factor, for `row` behind the first k rows in play. False
    /// where it depends on them.
    fn extend_factor(&mut self, system: &Delassus, k: usize, row: usize) -> bool {
        let m = self.m;
        let (done, line) = self.factor.split_at_mut(k * m);
        let mut pivot = system.entry(row, row);
        for j in 0..k {
            let above = &done[j * m..=j * m + j];
            line[j] = (system.entry(row, self.rows[j]) - dot(&above[..j], &line[..j])) / above[j];
            pivot -= line[j] * line[j];
        }
        // N = eₖ − Σ cⱼ eⱼ of the combination c of the rows in play that comes nearest to the row:
        // the rounding error of the pivot NᵀW N is 1e-16 of NᵀD N, D = diag(Wᵢᵢ).
        let c = &mut self.change[..k];
        c.copy_from_slice(&line[..k]);
        backward(done, m, c);
        let size = c.iter().zip(&self.rows).fold(system.square(row), |sum, (c, &j)| sum + c * c * system.square(j));
        let independent = pivot > DEPENDENT * size;
        // Kept positive so that nothing is ever divided by zero, whatever rounding did.
        line[k] = pivot.max(f64::MIN_POSITIVE).sqrt();
        independent
    }
}

/// Solves L Lᵀ v = v in place for the leading k × k part of a factor stored by rows with stride m.
fn triangular(factor: &[f64], m: usize, k: usize, v: &mut [f64]) {
    for i in 0..k {
        let line = &factor[i * m..=i * m + i];
        v[i] = (v[i] - dot(&line[..i], &v[..i])) / line[i];
    }
    backward(factor, m, &mut v[..k]);
}

/// Solves Lᵀ v = v in place for the leading rows of a factor stored with stride m.
fn backward(factor: &[f64], m: usize, v: &mut [f64]) {
    for i in (0..v.len()).rev() {
        v[i] /= factor[i * m + i];
        for j in 0..i {
            v[j] -= factor[i * m + j] * v[i];
        }
    }
}

#[cfg(test)]
mod tests;
