//! The Delassus operator W restricted to the rows in play, factored, and the forces that put each
//! of them on its bound.
//!
//! With S the rows in play in increasing order, W_SS = L D Lᵀ row by row within its envelope
//! (George and Liu 1981, Computer Solution of Large Sparse Positive Definite Systems, ch. 4): row k
//! of L begins where row k of W_SS does. When S changes, the lines of all rows before the first
//! change are kept. A row k that depends on rows before it, NᵀW N ≤ 1e-12 NᵀD N with N = eₖ − Σ cⱼ
//! eⱼ and D = diag(Wᵢᵢ), stays out of L (see [`super::relations`]). Where a dependent row has large
//! cⱼ (neighbouring walls on a smooth motion), the increasing order amplifies rounding, and S is
//! factored again with the largest pivot first.

use super::ULPS;
use super::delassus::Delassus;
use super::relations::{Relations, SPREAD};
use super::sums::dot;

/// Rows with NᵀW N over NᵀD N below this are dependent (dimensionless, the square of an angle:
/// 1e-6, and 1e4 times its rounding error).
const DEPENDENT: f64 = 1e-12;

/// Only for a pivot below this share of Wₖₖ is the quotient above computed. The rounding error of a
/// pivot is 1e-16 over the least pivot accepted.
const SUSPICIOUS: f64 = 1e-3;

/// With NᵀD N over Wₖₖ above this, S is factored again in another order: the rounding error of a
/// dependent row's combination is 1e-16 of NᵀD N.
const SPREAD_OUT: f64 = 1e3;

/// W on the rows in play.
pub(super) struct Block {
    /// Rows in play, increasing.
    rows: Vec<usize>,
    /// The independent ones, which make up the factor, in its order.
    basis: Vec<usize>,
    /// L below its unit diagonal, row after row; row k begins at `starts[k]` with column `from[k]`.
    lower: Vec<f64>,
    starts: Vec<usize>,
    from: Vec<usize>,
    /// 1/D of the factor.
    inverse: Vec<f64>,
    /// True while the factor is in the order of rows.
    ordered: bool,
    relations: Relations,
    /// Number of linearly independent rows among all m; m where no set of rows can be dependent.
    rank: usize,
    /// m.
    count: usize,
    /// Forces of the basis, or a combination.
    work: Vec<f64>,
    /// Work space of the factorisation with pivoting: L D of all rows in play, and the remainder of
    /// each Wᵢᵢ.
    panel: Vec<f64>,
    left: Vec<f64>,
}

impl Block {
    /// No row in play, with room for all of them.
    pub(super) fn new(system: &Delassus) -> Self {
        let m = system.count();
        let room = (0..m).map(|i| i - system.row(i).0.min(i)).sum();
        let mut block = Self {
            rows: Vec::with_capacity(m),
            basis: Vec::with_capacity(m),
            lower: Vec::with_capacity(room),
            starts: Vec::with_capacity(m + 1),
            from: Vec::with_capacity(m),
            inverse: Vec::with_capacity(m),
            ordered: true,
            relations: Relations::new(m),
            rank: m,
            count: m,
            work: Vec::with_capacity(m),
            panel: Vec::new(),
            left: Vec::new(),
        };
        block.starts.push(0);
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
            block.left.reserve(m);
            block.panel.reserve(m * block.basis.len());
            block.lower.reserve(m * block.basis.len());
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
        self.keep(if self.ordered { same } else { 0 });
        let mut well = true;
        for &row in &rows[self.rows.len()..] {
            self.rows.push(row);
            well &= self.extend(system, row);
        }
        if !well {
            self.reorder(system);
        }
        if !self.relations.rows().is_empty() {
            self.relations.factor(system, &self.basis);
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
        let basis = before(&self.basis);
        self.basis.truncate(basis);
        self.from.truncate(basis);
        self.inverse.truncate(basis);
        self.starts.truncate(basis + 1);
        self.lower.truncate(self.starts[basis]);
        self.ordered = true;
    }

    /// Appends a row to the factor, or to the dependent rows. False if its combination is so large
    /// that the order must change.
    fn extend(&mut self, system: &Delassus, row: usize) -> bool {
        let own = system.own(row);
        let (from, pivot) = self.eliminate(system, row);
        if pivot <= SUSPICIOUS * own {
            self.combine(from);
            let size = self.size(system, row);
            if pivot <= DEPENDENT * size {
                self.relations.push(row, &self.work);
                self.lower.truncate(self.starts[self.basis.len()]);
                return size <= SPREAD_OUT * own;
            }
        }
        self.admit(row, from, pivot);
        true
    }

    /// Appends the line of L for one more row to `lower`; returns its first column and the pivot.
    fn eliminate(&mut self, system: &Delassus, row: usize) -> (usize, f64) {
        let (first, w) = system.row(row);
        let (k, at) = (self.basis.len(), self.lower.len());
        let mut from = if self.ordered { k } else { 0 };
        while from > 0 && self.basis[from - 1] >= first {
            from -= 1;
        }
        // v = L⁻¹ w first; l = D⁻¹ v when all of it is known.
        for p in from..k {
            let start = self.from[p].max(from);
            let above = &self.lower[self.starts[p] + start - self.from[p]..self.starts[p] + p - self.from[p]];
            let entry = self.basis[p].checked_sub(first).and_then(|j| w.get(j)).copied().unwrap_or(0.0);
            let v = entry - dot(above, &self.lower[at + start - from..at + p - from]);
            self.lower.push(v);
        }
        let mut pivot = system.own(row);
        for (v, inverse) in self.lower[at..].iter_mut().zip(&self.inverse[from..]) {
            let l = *v * inverse;
            pivot -= *v * l;
            *v = l;
        }
        (from, pivot)
    }

    /// Takes the last line of `lower`, which begins at column `from`, into the factor.
    fn admit(&mut self, row: usize, from: usize, pivot: f64) {
        self.basis.push(row);
        self.from.push(from);
        // Kept positive, whatever rounding did, so that nothing is divided by zero.
        self.inverse.push(1.0 / pivot.max(f64::MIN_POSITIVE));
        self.starts.push(self.lower.len());
    }

    /// Computes into `work` the combination c of the row whose line stands last in `lower` and
    /// begins at column `from`.
    fn combine(&mut self, from: usize) {
        self.work.clear();
        self.work.resize(from, 0.0);
        self.work.extend_from_slice(&self.lower[self.starts[self.basis.len()]..]);
        self.backward();
    }

    /// NᵀD N of a row whose combination is in `work`.
    fn size(&self, system: &Delassus, row: usize) -> f64 {
        self.work.iter().zip(&self.basis).fold(system.square(row), |sum, (c, &j)| sum + c * c * system.square(j))
    }

    /// Factors the rows in play again, taking at each stage the row with the largest remaining
    /// share of its Wᵢᵢ (Higham 2002, Accuracy and Stability of Numerical Algorithms, §10.3).
    fn reorder(&mut self, system: &Delassus) {
        let rows = std::mem::take(&mut self.rows);
        let (mut panel, mut left) = (std::mem::take(&mut self.panel), std::mem::take(&mut self.left));
        self.keep(0);
        self.ordered = false;
        panel.clear();
        left.clear();
        left.extend(rows.iter().map(|&row| system.own(row)));
        let count = rows.len();
        loop {
            let share = |i: usize| left[i] / system.square(rows[i]);
            let Some(p) = (0..count).max_by(|&i, &j| share(i).total_cmp(&share(j))) else { break };
            if share(p).is_nan() || share(p) <= DEPENDENT {
                break;
            }
            // `panel` is stored by columns: entry i of column q is L D of row i there.
            let (rank, pivot) = (self.basis.len(), left[p]);
            let line = |q: usize| panel[q * count + p] * self.inverse[q];
            self.lower.extend((0..rank).map(line));
            let l = &self.lower[self.starts[rank]..];
            let (first, w) = system.row(rows[p]);
            panel.extend(rows.iter().map(|row| row.checked_sub(first).and_then(|j| w.get(j)).copied().unwrap_or(0.0)));
            let (before, column) = panel.split_at_mut(rank * count);
            for (l, before) in l.iter().zip(before.chunks_exact(count)) {
                for (v, other) in column.iter_mut().zip(before) {
                    *v -= l * other;
                }
            }
            for (left, v) in left.iter_mut().zip(column.iter()) {
                *left -= v * v / pivot;
            }
            left[p] = f64::NEG_INFINITY;
            self.admit(rows[p], 0, pivot);
        }
        for (i, &row) in rows.iter().enumerate() {
            if left[i] > f64::NEG_INFINITY {
                self.work.clear();
                self.work.extend((0..self.basis.len()).map(|q| panel[q * count + i] * self.inverse[q]));
                self.backward();
                self.relations.push(row, &self.work);
            }
        }
        (self.rows, self.panel, self.left) = (rows, panel, left);
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
        self.work.clear();
        self.work.extend(self.basis.iter().map(|&row| shift(row)));
        self.relations.calm();
        if self.relations.rows().is_empty() {
            self.invert();
        } else {
            self.invert();
            if self.relations.escapes(system, &self.basis, &self.work, &shift, slack, ulps) {
                self.work.clear();
                self.work.extend(self.basis.iter().map(|&row| shift(row)));
                self.relations.escape_by(system, &self.basis, &mut self.work);
                self.invert();
            }
            self.relations.divide(system, &self.basis, &mut self.work, r);
        }
        for (&row, &force) in self.basis.iter().zip(&self.work) {
            r[row] = force;
        }
    }

    /// Rounding error of the motion of a row that is not in play, where the largest force moves its
    /// own row by `reach` √Wᵢᵢ: each row in play stands where it should to within ulps of that, and
    /// the combination c passes those errors on to this row.
    pub(super) fn rounding(&mut self, system: &Delassus, row: usize, reach: f64) -> f64 {
        let (from, _) = self.eliminate(system, row);
        self.combine(from);
        self.lower.truncate(self.starts[self.basis.len()]);
        let all =
            self.work.iter().zip(&self.basis).fold(system.weight[row], |w, (c, &j)| w + c.abs() * system.weight[j]);
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
        let (from, pivot) = self.eliminate(system, row);
        if pivot <= SUSPICIOUS * system.own(row) {
            self.combine(from);
        }
        self.lower.truncate(self.starts[self.basis.len()]);
        let dependent = pivot <= SUSPICIOUS * system.own(row) && pivot <= DEPENDENT * self.size(system, row);
        if !dependent || gap > 0.5 * Relations::allowed(system, row, &self.work, &self.basis, slack) {
            return None;
        }
        let (mut motion, mut size) = (0.0, 0.0);
        for (c, &j) in self.work.iter().zip(&self.basis) {
            motion -= c * system.square(j) * r[j];
            size += (c * system.square(j) * r[j]).abs();
        }
        (motion.abs() > SPREAD * size).then_some(motion)
    }

    /// Solves W_BB r = `work` in place.
    fn invert(&mut self) {
        let v = &mut self.work;
        for k in 0..v.len() {
            let line = &self.lower[self.starts[k]..self.starts[k + 1]];
            v[k] -= dot(line, &v[self.from[k]..k]);
        }
        for (v, inverse) in v.iter_mut().zip(&self.inverse) {
            *v *= inverse;
        }
        self.backward();
    }

    /// Solves Lᵀ v = v in place for v in `work`.
    #[inline]
    fn backward(&mut self) {
        let v = &mut self.work;
        for k in (0..v.len()).rev() {
            let line = &self.lower[self.starts[k]..self.starts[k + 1]];
            let (before, own) = v.split_at_mut(k);
            for (v, l) in before[self.from[k]..].iter_mut().zip(line) {
                *v -= l * own[0];
            }
        }
    }
}
