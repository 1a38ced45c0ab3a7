//! The programme on its unknowns, where A is a narrow band and every row sees one unknown of its
//! own.
//!
//! A row that stands on its bound then takes its unknown out of A x = b (cᵢ = 0: xⱼ = boundᵢ/gᵢ) or
//! stiffens it (cᵢ > 0: gᵢ²/cᵢ is added to Aⱼⱼ and gᵢ boundᵢ/cᵢ to bⱼ), and the remaining matrix is
//! still a band: a pass costs n(w+1)(w+4) operations, however far the response to a force reaches.
//! The condensed matrix W is wide where the time step is long compared with the structure's own
//! periods, and a pass over it costs the square of the number of rows in play.
//!
//! All rows whose state is wrong are exchanged at once, as a semismooth Newton method does (the
//! primal-dual active set: Hintermüller, Ito and Kunisch 2002, doi:10.1137/S1052623401383558). For
//! an M-matrix, as chains and bars have, that ends in finitely many passes; for others it may
//! cycle, and what has not settled after [`PASSES`] is left to pivoting.

use super::clamp::ordered_bounds;
use super::delassus::Delassus;
use super::pivoting::Pivoting;
use super::side::Side;
use super::{Problem, ROUNDING, Rhs};

/// Maximum number of passes before the programme is left to pivoting. A warm start takes one or
/// two, a cold one of 500 rows up to a dozen.
const PASSES: usize = 30;

/// Expected number of passes, when the work of the two ways is compared.
const EXPECTED: usize = 2;

/// Largest half bandwidth for which this method is used.
const WIDEST: usize = 16;

/// The band of A by rows, and the row of G on each unknown.
pub(super) struct Elimination {
    width: usize,
    /// Entry i·w + k is A of row i and column i − w + k; those before column 0 are 0.
    band: Vec<f64>,
    diagonal: Vec<f64>,
    /// Unknown and factor g of each row, and its compliance.
    rows: Vec<(usize, f64, f64)>,
    side: Vec<Option<Side>>,
    /// Multiplications of a pass over W with the rows in play last, which start the next programme.
    condensed: usize,
    /// Unknowns taken out by a rigid row.
    fixed: Vec<bool>,
    /// L below its unit diagonal, stored as `band`, D and 1/D.
    lower: Vec<f64>,
    pivot: Vec<f64>,
    inverse: Vec<f64>,
    x: Vec<f64>,
}

impl Elimination {
    /// `None` where A is not a narrow band, or a row sees several unknowns or shares one with
    /// another row.
    pub(super) fn new(problem: &Problem) -> Option<Self> {
        let (n, width) = (problem.a.size(), problem.a.half_bandwidth());
        let mut taken = vec![false; n];
        let mut rows = Vec::with_capacity(problem.g.count());
        for (i, &compliance) in problem.compliance.iter().enumerate() {
            let &[(column, value)] = problem.g.row(i) else { return None };
            if value == 0.0 || std::mem::replace(taken.get_mut(column)?, true) {
                return None;
            }
            rows.push((column, value, compliance));
        }
        if width > WIDEST || rows.is_empty() {
            return None;
        }
        let mut band = vec![0.0; n * width];
        for (i, j, value) in problem.a.entries().filter(|&(i, j, value)| j < i && value != 0.0) {
            band[i * width + j + width - i] = value;
        }
        Some(Self {
            width,
            lower: band.clone(),
            band,
            diagonal: problem.a.diagonal_entries(),
            side: vec![None; rows.len()],
            condensed: 0,
            rows,
            fixed: vec![false; n],
            pivot: vec![0.0; n],
            inverse: vec![0.0; n],
            x: vec![0.0; n],
        })
    }

    /// Notes the rows in play, from which the next programme is likely to start.
    pub(super) fn note(&mut self, system: &Delassus, rows: impl Iterator<Item = usize>) {
        // Each row in play moves every row within its reach, and its line of the factor is used
        // twice.
        self.condensed = rows.map(|row| 2 * system.row(row).1.len()).sum();
    }

    /// True if a pass over W with the rows noted last costs more than the passes expected here.
    #[inline]
    pub(super) fn pays(&self) -> bool {
        let (n, w) = (self.diagonal.len(), self.width);
        self.condensed > EXPECTED * n * (w + 1) * (w + 4)
    }

    /// Solves for the free motion held in `system`, starting from the active set of `pivoting`: x
    /// (n entries), r (m entries), and the new active set in `pivoting`. Returns how many rows
    /// changed their state; `None` if it did not settle, with nothing changed.
    pub(super) fn solve(
        &mut self,
        system: &Delassus,
        pivoting: &mut Pivoting,
        rhs: &Rhs,
        scale: f64,
        (x, r): (&mut [f64], &mut [f64]),
    ) -> Option<u64> {
        self.side.fill(None);
        for (row, side) in pivoting.called().filter(|&(row, side)| side.bound(rhs, row).is_finite()) {
            self.side[row] = Some(side);
        }
        let mut pivots = 0;
        for _ in 0..PASSES {
            self.pass(rhs)?;
            let changes = self.exchange(system, rhs, scale);
            if changes == 0 {
                x.copy_from_slice(&self.x);
                pivoting.clear();
                for (row, force) in r.iter_mut().enumerate() {
                    *force = self.force(row, rhs);
                    if let Some(side) = self.side[row] {
                        pivoting.call(row, side);
                    }
                }
                self.note(system, pivoting.called().map(|(row, _)| row));
                return Some(pivots);
            }
            pivots += changes;
        }
        None
    }

    /// Computes x for the current states of the rows; `None` if the remaining matrix is not
    /// positive definite to rounding.
    fn pass(&mut self, rhs: &Rhs) -> Option<()> {
        self.x.copy_from_slice(rhs.b);
        self.pivot.copy_from_slice(&self.diagonal);
        self.fixed.fill(false);
        self.apply_rows(rhs);
        for i in 0..self.diagonal.len() {
            self.eliminate(i)?;
        }
        self.x.iter_mut().zip(&self.inverse).for_each(|(x, inverse)| *x *= inverse);
        self.substitute_back();
        Some(())
    }

    /// Stiffens the unknowns of elastic rows and takes those of rigid rows out of the equations.
    fn apply_rows(&mut self, rhs: &Rhs) {
        let (n, w) = (self.diagonal.len(), self.width);
        for (row, &(column, g, compliance)) in self.rows.iter().enumerate().filter(|(_, row)| row.2 > 0.0) {
            let Some(side) = self.side[row] else { continue };
            self.pivot[column] += g * g / compliance;
            self.x[column] += g * side.bound(rhs, row) / compliance;
        }
        let rigid = self.rows.iter().zip(&self.side).enumerate().filter(|(_, (row, _))| row.2 == 0.0);
        let known = rigid.filter_map(|(row, (&(column, g, _), side))| Some((column, (*side)?.bound(rhs, row) / g)));
        // Known unknowns move to the right-hand side before anything is eliminated.
        for (column, known) in known.clone() {
            for i in column.saturating_sub(w)..column {
                self.x[i] -= self.band[column * w + i + w - column] * known;
            }
            for i in column + 1..(column + w + 1).min(n) {
                self.x[i] -= self.band[i * w + column + w - i] * known;
            }
        }
        for (column, known) in known {
            self.x[column] = known;
            self.fixed[column] = true;
        }
    }

    /// Row `i` of L, of D and of L⁻¹ b; `None` where the pivot is not positive.
    fn eliminate(&mut self, i: usize) -> Option<()> {
        let w = self.width;
        let first = i.saturating_sub(w);
        let (before, line) = self.lower.split_at_mut(i * w);
        let line = &mut line[..w];
        if self.fixed[i] {
            line.fill(0.0);
            self.inverse[i] = 1.0;
            return Some(());
        }
        line.copy_from_slice(&self.band[i * w..(i + 1) * w]);
        // The line holds L D until it is divided.
        for j in first..i {
            let at = j + w - i;
            if self.fixed[j] {
                line[at] = 0.0;
                continue;
            }
            let from = first.max(j.saturating_sub(w));
            let above = &before[j * w + from + w - j..(j + 1) * w];
            let dot: f64 = line[from + w - i..at].iter().zip(above).map(|(a, b)| a * b).sum();
            line[at] -= dot;
        }
        for (j, entry) in (first..i).zip(&mut line[first + w - i..]) {
            let l = *entry * self.inverse[j];
            self.pivot[i] -= *entry * l;
            self.x[i] -= l * self.x[j];
            *entry = l;
        }
        if self.pivot[i].is_nan() || self.pivot[i] <= 0.0 {
            return None;
        }
        self.inverse[i] = 1.0 / self.pivot[i];
        Some(())
    }

    /// Solves Lᵀ x = D⁻¹ L⁻¹ b, from the last unknown to the first.
    fn substitute_back(&mut self) {
        let w = self.width;
        for i in (0..self.diagonal.len()).rev().filter(|&i| !self.fixed[i]) {
            let first = i.saturating_sub(w);
            let (rest, known) = self.x.split_at_mut(i);
            for (l, x) in self.lower[i * w + first + w - i..(i + 1) * w].iter().zip(&mut rest[first..]) {
                *x -= l * known[0];
            }
        }
    }

    /// The force of a row: for a rigid row the residual of its unknown's equation in A x = b + Gᵀ
    /// r, for an elastic one its force law.
    fn force(&self, row: usize, rhs: &Rhs) -> f64 {
        let Some(side) = self.side[row] else { return 0.0 };
        let (column, g, compliance) = self.rows[row];
        if compliance > 0.0 {
            return (side.bound(rhs, row) - g * self.x[column]) / compliance;
        }
        let (n, w) = (self.diagonal.len(), self.width);
        let first = column.saturating_sub(w);
        let left = &self.band[column * w + first + w - column..(column + 1) * w];
        let mut sum = self.diagonal[column] * self.x[column] - rhs.b[column];
        sum += left.iter().zip(&self.x[first..]).map(|(a, x)| a * x).sum::<f64>();
        sum +=
            (column + 1..(column + w + 1).min(n)).map(|i| self.band[i * w + column + w - i] * self.x[i]).sum::<f64>();
        sum / g
    }

    /// Changes the state of every row whose force pulls and of every free row beyond a bound, and
    /// counts the changes.
    fn exchange(&mut self, system: &Delassus, rhs: &Rhs, scale: f64) -> u64 {
        let mut changes = 0;
        for row in 0..self.rows.len() {
            let state = self.side[row];
            let (lo, hi) = ordered_bounds(rhs.lo[row], rhs.hi[row]);
            let wanted = match state {
                Some(side) => {
                    let force = self.force(row, rhs);
                    let pulls = side.sign() * force < 0.0;
                    if !pulls {
                        continue;
                    }
                    // Where both bounds coincide, a force of either sign is allowed.
                    (lo >= hi).then_some(if force > 0.0 { Side::Lower } else { Side::Upper })
                }
                None => {
                    let (column, g, _) = self.rows[row];
                    let y = g * self.x[column];
                    let excess = (lo - y).max(y - hi);
                    if excess.is_nan() || excess <= ROUNDING * scale.max(system.y[row].abs()) {
                        continue;
                    }
                    Some(if lo - y > y - hi { Side::Lower } else { Side::Upper })
                }
            };
            self.side[row] = wanted;
            // Where both bounds coincide, a change of side changes no motion and is not counted.
            changes += u64::from(state.is_none() || wanted.is_none());
        }
        changes
    }
}

#[cfg(test)]
mod tests;
