//! The factor L D Lᵀ of the Delassus operator W on independent rows in play.
//!
//! With the rows in increasing order, W_BB = L D Lᵀ row by row within its envelope (George and Liu
//! 1981, Computer Solution of Large Sparse Positive Definite Systems, ch. 4): row k of L begins
//! where row k of W_BB does. With the largest pivot first L is full.

use super::delassus::Delassus;
use super::sums::dot;

/// Rows with NᵀW N over NᵀD N below this are dependent (dimensionless, the square of an angle:
/// 1e-6, and 1e4 times its rounding error).
pub(super) const DEPENDENT: f64 = 1e-12;

/// The factor, and its rows.
pub(super) struct Envelope {
    /// Its rows, in its order.
    rows: Vec<usize>,
    /// L below its unit diagonal, row after row; row k begins at `starts[k]` with column `from[k]`.
    lower: Vec<f64>,
    starts: Vec<usize>,
    from: Vec<usize>,
    /// 1/D.
    inverse: Vec<f64>,
    /// True while its rows are in increasing order.
    ordered: bool,
    /// Work space of the factorisation with pivoting: L D of all rows in play, and the remainder of
    /// each Wᵢᵢ.
    panel: Vec<f64>,
    left: Vec<f64>,
}

/// The line of L of one more row, as long as it is not taken into the factor.
#[derive(Clone, Copy)]
pub(super) struct EnvelopeRow {
    /// Its first column.
    from: usize,
    /// What is left of Wₖₖ.
    pub pivot: f64,
}

impl Envelope {
    /// Of no row, with room for all.
    pub(super) fn new(system: &Delassus) -> Self {
        let m = system.count();
        let room = (0..m).map(|i| i - system.row(i).0.min(i)).sum();
        let mut starts = Vec::with_capacity(m + 1);
        starts.push(0);
        Self {
            rows: Vec::with_capacity(m),
            lower: Vec::with_capacity(room),
            starts,
            from: Vec::with_capacity(m),
            inverse: Vec::with_capacity(m),
            ordered: true,
            panel: Vec::new(),
            left: Vec::new(),
        }
    }

    /// Makes room for [`Envelope::refactor`] of `m` rows, as many of them independent as there are
    /// now.
    pub(super) fn reserve(&mut self, m: usize) {
        self.left.reserve(m);
        self.panel.reserve(m * self.rows.len());
        self.lower.reserve(m * self.rows.len());
    }

    /// Its rows, in its order.
    #[inline]
    pub(super) fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// True while its rows are in increasing order.
    pub(super) fn is_ordered(&self) -> bool {
        self.ordered
    }

    /// Keeps the first `count` rows, which must be in increasing order.
    pub(super) fn keep(&mut self, count: usize) {
        self.rows.truncate(count);
        self.from.truncate(count);
        self.inverse.truncate(count);
        self.starts.truncate(count + 1);
        self.drop_line();
        self.ordered = true;
    }

    /// Appends the line of one more row to L.
    pub(super) fn eliminate(&mut self, system: &Delassus, row: usize) -> EnvelopeRow {
        let (first, w) = system.row(row);
        let (k, at) = (self.rows.len(), self.lower.len());
        let mut from = if self.ordered { k } else { 0 };
        while from > 0 && self.rows[from - 1] >= first {
            from -= 1;
        }
        // v = L⁻¹ w first; l = D⁻¹ v when all of it is known.
        for p in from..k {
            let start = self.from[p].max(from);
            let above = &self.lower[self.starts[p] + start - self.from[p]..self.starts[p] + p - self.from[p]];
            let entry = self.rows[p].checked_sub(first).and_then(|j| w.get(j)).copied().unwrap_or(0.0);
            let v = entry - dot(above, &self.lower[at + start - from..at + p - from]);
            self.lower.push(v);
        }
        let mut pivot = system.own(row);
        for (v, inverse) in self.lower[at..].iter_mut().zip(&self.inverse[from..]) {
            let l = *v * inverse;
            pivot -= *v * l;
            *v = l;
        }
        EnvelopeRow { from, pivot }
    }

    /// Takes the last line of L, that of `row`, into the factor.
    pub(super) fn admit(&mut self, row: usize, line: EnvelopeRow) {
        self.rows.push(row);
        self.from.push(line.from);
        // Kept positive, whatever rounding did, so that nothing is divided by zero.
        self.inverse.push(1.0 / line.pivot.max(f64::MIN_POSITIVE));
        self.starts.push(self.lower.len());
    }

    /// Drops the last line of L, if it is not in the factor.
    pub(super) fn drop_line(&mut self) {
        self.lower.truncate(self.starts[self.rows.len()]);
    }

    /// Computes the combination c of the factor's rows, W_BB c = W_Bk, that the last line of L
    /// stands for.
    pub(super) fn combine(&self, line: EnvelopeRow, c: &mut Vec<f64>) {
        c.clear();
        c.resize(line.from, 0.0);
        c.extend_from_slice(&self.lower[self.starts[self.rows.len()]..]);
        self.backward(c);
    }

    /// NᵀD N of a row with the combination `c`.
    pub(super) fn size(&self, system: &Delassus, row: usize, c: &[f64]) -> f64 {
        c.iter().zip(&self.rows).fold(system.square(row), |sum, (c, &j)| sum + c * c * system.square(j))
    }

    /// Factors these rows anew, taking at each stage the row with the largest remaining share of
    /// its Wᵢᵢ (Higham 2002, Accuracy and Stability of Numerical Algorithms, §10.3). Calls
    /// `depends` with each row that is left over and its combination, which it computes in `c`.
    pub(super) fn refactor(
        &mut self,
        system: &Delassus,
        rows: &[usize],
        c: &mut Vec<f64>,
        mut depends: impl FnMut(usize, &[f64]),
    ) {
        self.keep(0);
        self.ordered = false;
        let (mut panel, mut left) = (std::mem::take(&mut self.panel), std::mem::take(&mut self.left));
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
            let (rank, pivot) = (self.rows.len(), left[p]);
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
            self.admit(rows[p], EnvelopeRow { from: 0, pivot });
        }
        for (i, &row) in rows.iter().enumerate() {
            if left[i] > f64::NEG_INFINITY {
                c.clear();
                c.extend((0..self.rows.len()).map(|q| panel[q * count + i] * self.inverse[q]));
                self.backward(c);
                depends(row, c);
            }
        }
        (self.panel, self.left) = (panel, left);
    }

    /// Solves W_BB r = b in place.
    pub(super) fn solve(&self, v: &mut [f64]) {
        for k in 0..v.len() {
            let line = &self.lower[self.starts[k]..self.starts[k + 1]];
            v[k] -= dot(line, &v[self.from[k]..k]);
        }
        for (v, inverse) in v.iter_mut().zip(&self.inverse) {
            *v *= inverse;
        }
        self.backward(v);
    }

    /// Solves Lᵀ v = v in place.
    #[inline]
    fn backward(&self, v: &mut [f64]) {
        for k in (0..v.len()).rev() {
            let line = &self.lower[self.starts[k]..self.starts[k + 1]];
            let (before, own) = v.split_at_mut(k);
            for (v, l) in before[self.from[k]..].iter_mut().zip(line) {
                *v -= l * own[0];
            }
        }
    }
}

#[cfg(test)]
mod tests;
