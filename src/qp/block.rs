//! The Delassus operator W restricted to the rows in play, factored, and the forces that put each
//! of them on its bound.
//!
//! With S the rows in play in increasing order, W_SS is factored row by row (see
//! [`super::envelope`]); when S changes, the lines of all rows before the first change are kept. A
//! row k that depends on rows before it, NᵀW N ≤ 1e-12 NᵀD N with N = eₖ − Σ cⱼ eⱼ and D =
//! diag(Wᵢᵢ), stays out of L (see [`super::relations`]). Where a dependent row has large cⱼ
//! (neighbouring walls on a smooth motion), the increasing order amplifies rounding, and S is
//! factored again with the largest pivot first.

use super::ULPS;
use super::delassus::Delassus;
use super::envelope::{DEPENDENT, Envelope};
use super::relations::{Relations, SPREAD};

/// Only for a pivot below this share of Wₖₖ is NᵀW N over NᵀD N computed. The rounding error of a
/// pivot is 1e-16 over the least pivot accepted.
const SUSPICIOUS: f64 = 1e-3;

/// With NᵀD N over Wₖₖ above this, S is factored again in another order: the rounding error of a
/// dependent row's combination is 1e-16 of NᵀD N.
const SPREAD_OUT: f64 = 1e3;

/// W on the rows in play.
pub(super) struct Block {
    /// Rows in play, increasing.
    rows: Vec<usize>,
    /// The factor of the independent ones.
    factor: Envelope,
    relations: Relations,
    /// Number of linearly independent rows among all m; m where no set of rows can be dependent.
    rank: usize,
    /// m.
    count: usize,
    /// Forces of the factor's rows, or a combination of them.
    work: Vec<f64>,
}

impl Block {
    /// No row in play, with room for all of them.
    pub(super) fn new(system: &Delassus) -> Self {
        let m = system.count();
        let mut block = Self {
            rows: Vec::with_capacity(m),
            factor: Envelope::new(system),
            relations: Relations::new(m),
            rank: m,
            count: m,
            work: Vec::with_capacity(m),
        };
        // Putting all rows in play shows whether any can be dependent; room for those is made here,
        // not in a step.
        let well = (0..m).fold(true, |well, row| {
            block.rows.push(row);
            block.extend(system, row) & well
        });
        block.rank = m - block.relations.rows().len();
        if block.singular() {
            block.relations.reserve(m);
        }
        if !well {
            block.factor.reserve(m);
        }
        block.keep(0);
        block
    }

    /// Rows in play, increasing.
    #[inline]
    pub(super) fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// True if some rows, in play or not, are linearly dependent.
    pub(super) fn singular(&self) -> bool {
        self.rank < self.count
    }

    /// Number of linearly independent rows among all rows.
    pub(super) fn rank(&self) -> usize {
        self.rank
    }

    /// The forces that grow without limit as δ → 0: their rows cannot be met together. `None` if
    /// there are none.
    #[inline]
    pub(super) fn escape(&self) -> Option<&[f64]> {
        self.relations.escape()
    }

    /// Makes `rows`, in increasing order, the rows in play.
    pub(super) fn set(&mut self, system: &Delassus, rows: &[usize]) {
        let same = self.rows.iter().zip(rows).take_while(|(a, b)| a == b).count();
        if same == self.rows.len() && same == rows.len() {
            return;
        }
        self.keep(if self.factor.is_ordered() { same } else { 0 });
        let mut well = true;
        for &row in &rows[self.rows.len()..] {
            self.rows.push(row);
            well &= self.extend(system, row);
        }
        if !well {
            self.reorder(system);
        }
        if !self.relations.rows().is_empty() {
            self.relations.factor(system, self.factor.rows());
        }
    }

    /// Drops all rows in play but the first `count`.
    fn keep(&mut self, count: usize) {
        self.rows.truncate(count);
        let last = self.rows.last().copied();
        let before = |rows: &[usize]| match last {
            Some(last) => rows.partition_point(|&row| row <= last),
            None => 0,
        };
        self.relations.truncate(before(self.relations.rows()));
        self.factor.keep(before(self.factor.rows()));
    }

    /// Appends a row to the factor, or to the dependent rows. False if its combination is so large
    /// that the order must change.
    fn extend(&mut self, system: &Delassus, row: usize) -> bool {
        let own = system.own(row);
        let line = self.factor.eliminate(system, row);
        if line.pivot <= SUSPICIOUS * own {
            self.factor.combine(line, &mut self.work);
            let size = self.factor.size(system, row, &self.work);
            if line.pivot <= DEPENDENT * size {
                self.relations.push(row, &self.work);
                self.factor.drop_line();
                return size <= SPREAD_OUT * own;
            }
        }
        self.factor.admit(row, line);
        true
    }

    /// Factors the rows in play again with the largest pivot first.
    fn reorder(&mut self, system: &Delassus) {
        let Self { rows, factor, relations, work, .. } = self;
        relations.truncate(0);
        factor.refactor(system, rows, work, |row, combination| relations.push(row, combination));
    }

    /// Writes to `r` the forces that move each row in play by `shift(row)` (entries of other rows
    /// are not touched), and sets the escape where no forces can. A dependent row counts as met if
    /// it misses by no more than rounding: `slack(row)` for states and bounds, and `ulps` of the
    /// motion that the largest force causes.
    pub(super) fn forces(
        &mut self,
        system: &Delassus,
        shift: impl Fn(usize) -> f64,
        slack: impl Fn(usize) -> f64,
        ulps: f64,
        r: &mut [f64],
    ) {
        let Self { factor, relations, work, .. } = self;
        work.clear();
        work.extend(factor.rows().iter().map(|&row| shift(row)));
        relations.calm();
        factor.solve(work);
        if !relations.rows().is_empty() {
            if relations.escapes(system, factor.rows(), work, &shift, slack, ulps) {
                work.clear();
                work.extend(factor.rows().iter().map(|&row| shift(row)));
                relations.escape_by(system, factor.rows(), work);
                factor.solve(work);
            }
            relations.divide(system, factor.rows(), work, r);
        }
        for (&row, &force) in factor.rows().iter().zip(&*work) {
            r[row] = force;
        }
    }

    /// Rounding error of the motion of a row that is not in play, where the largest force moves its
    /// own row by `reach` √Wᵢᵢ: each row in play stands where it should to within ulps of that, and
    /// the combination c passes those errors on to this row.
    pub(super) fn rounding(&mut self, system: &Delassus, row: usize, reach: f64) -> f64 {
        let line = self.factor.eliminate(system, row);
        self.factor.combine(line, &mut self.work);
        self.factor.drop_line();
        let terms = self.work.iter().zip(self.factor.rows());
        let all = terms.fold(system.weight[row], |w, (c, &j)| w + c.abs() * system.weight[j]);
        ULPS * reach * all
    }

    /// Motion per δ of a row that is not in play, depends on those in play, and would be met
    /// together with them, its bound being `gap` away: the rows in play yield by δ D r, and this
    /// row moves with them. `None` for other rows, and where the motion is 0.
    pub(super) fn yielding(
        &mut self,
        system: &Delassus,
        row: usize,
        gap: f64,
        slack: impl Fn(usize) -> f64,
        r: &[f64],
    ) -> Option<f64> {
        let Self { factor, work, .. } = self;
        let line = factor.eliminate(system, row);
        let suspicious = line.pivot <= SUSPICIOUS * system.own(row);
        if suspicious {
            factor.combine(line, work);
        }
        factor.drop_line();
        let dependent = suspicious && line.pivot <= DEPENDENT * factor.size(system, row, work);
        if !dependent || gap > 0.5 * Relations::allowed(system, row, work, factor.rows(), slack) {
            return None;
        }
        let (mut motion, mut size) = (0.0, 0.0);
        for (c, &j) in work.iter().zip(factor.rows()) {
            motion -= c * system.square(j) * r[j];
            size += (c * system.square(j) * r[j]).abs();
        }
        (motion.abs() > SPREAD * size).then_some(motion)
    }
}

#[cfg(test)]
mod tests;
