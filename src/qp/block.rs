//! The rows in play: W on them factored, and the forces that put each on its bound.
//!
//! With S the rows in play in increasing order, W_SS = L D Lᵀ row by row within its envelope (George and Liu 1981, Computer Solution of
//! Large Sparse Positive Definite Systems, ch. 4): row k of L begins where row k of W_SS does. A change of S keeps all rows before the
//! first one changed.
//!
//! **Dependent rows.** Walls that see the same motion make W_SS singular. A row k that follows from rows B before it, with
//! N = eₖ − Σ cⱼ eⱼ and NᵀW N ≤ 1e-12 NᵀD N, D = diag(Wᵢᵢ), stays out of L; W_BB c = W_Bk. Then W_SS r = q is taken for the limit δ → 0
//! of (W_SS + δ D) r = q, in which every matrix is positive definite and every solution unique:
//!
//! r = e/δ + r₀ + O(δ),   e = N z,  NᵀD N z = Nᵀq,   W r₀ = q − D e,  NᵀD r₀ = 0.
//!
//! Where the bounds can all be met, Nᵀq = 0, e is 0, and r₀ is the solution of least Σ Wᵢᵢ rᵢ²: equal walls at one place share equally.
//! Where they cannot, e is the escape: forces that grow without limit and move nothing.

use super::delassus::Delassus;
use super::{NOISE, ROUNDING};

/// NᵀW N over NᵀD N below which rows are dependent (dimensionless, the square of an angle: 1e-6, and 1e4 times its rounding error).
const DEPENDENT: f64 = 1e-12;

/// A pivot below this share of Wₖₖ has the quotient above computed. Rounding in a pivot is 1e-16 over the least pivot accepted.
const SUSPICIOUS: f64 = 1e-3;

/// A row of less than this share in a combination gives way to none of the others (dimensionless).
const PART: f64 = 1e-3;

/// An escape of this share of the largest one is its rounding (dimensionless).
const SPREAD: f64 = 1e-9;

/// Most room made beforehand for the relations of dependent rows among each other, 32 MB: more is made when it is needed.
const MOST_GRAM: usize = 1 << 22;

/// W on the rows in play.
pub(super) struct Block {
    /// Rows in play, increasing.
    rows: Vec<usize>,
    /// Those of them in the factor.
    basis: Vec<usize>,
    /// L below its unit diagonal, row after row; row k begins at `starts[k]` with column `from[k]`.
    lower: Vec<f64>,
    starts: Vec<usize>,
    from: Vec<usize>,
    /// 1/D of the factor.
    inverse: Vec<f64>,
    /// Those of them that follow from rows before, each with its c over the basis as far as it was then.
    dependent: Vec<usize>,
    combination: Vec<f64>,
    ends: Vec<usize>,
    /// Lower Cholesky factor of NᵀD N, row after row without gaps.
    gram: Vec<f64>,
    /// Forces of the basis, and of the dependent rows.
    force: Vec<f64>,
    share: Vec<f64>,
    /// e over all m rows; all 0 unless `escapes`.
    escape: Vec<f64>,
    escapes: bool,
}

impl Block {
    /// No row in play, and room for all of them.
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
            dependent: Vec::with_capacity(m),
            combination: Vec::new(),
            ends: Vec::with_capacity(m + 1),
            gram: Vec::new(),
            force: Vec::with_capacity(m),
            share: Vec::with_capacity(m),
            escape: vec![0.0; m],
            escapes: false,
        };
        block.keep(0);
        // All rows at once show how many may ever depend on others; room for those is made here, not in a step.
        for row in 0..m {
            block.rows.push(row);
            block.extend(system, row);
        }
        let dependent = block.dependent.len();
        if dependent > 0 {
            block.combination.reserve(m);
            block.gram.reserve((dependent * (dependent + 1) / 2).min(MOST_GRAM));
        }
        block.keep(0);
        block
    }

    /// Rows in play, increasing.
    #[inline]
    pub(super) fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// What grows without limit as δ → 0: rows that cannot be met together, if the programme was solved with them.
    pub(super) fn escape(&self) -> Option<&[f64]> {
        self.escapes.then_some(&self.escape)
    }

    /// Puts `rows`, increasing, in play instead of those that were.
    pub(super) fn set(&mut self, system: &Delassus, rows: &[usize]) {
        let same = self.rows.iter().zip(rows).take_while(|(a, b)| a == b).count();
        if same == self.rows.len() && same == rows.len() {
            return;
        }
        self.keep(same);
        for &row in &rows[same..] {
            self.rows.push(row);
            self.extend(system, row);
        }
        self.relate(system);
    }

    /// Drops all rows in play but the first `count`.
    fn keep(&mut self, count: usize) {
        self.rows.truncate(count);
        let last = self.rows.last().copied();
        let before = |rows: &[usize]| rows.partition_point(|&row| last.is_some_and(|last| row <= last));
        let (basis, dependent) = (before(&self.basis), before(&self.dependent));
        self.basis.truncate(basis);
        self.from.truncate(basis);
        self.inverse.truncate(basis);
        self.starts.truncate(basis + 1);
        self.lower.truncate(self.starts.last().copied().unwrap_or(0));
        self.dependent.truncate(dependent);
        self.ends.truncate(dependent + 1);
        self.combination.truncate(self.ends.last().copied().unwrap_or(0));
        if basis == 0 {
            self.starts.clear();
            self.starts.push(0);
        }
        if dependent == 0 {
            self.ends.clear();
            self.ends.push(0);
        }
    }

    /// Appends a row to the factor, or to the rows that depend on it.
    fn extend(&mut self, system: &Delassus, row: usize) {
        let (first, w) = system.row(row);
        let (k, at) = (self.basis.len(), self.lower.len());
        let mut from = k;
        while from > 0 && self.basis[from - 1] >= first {
            from -= 1;
        }
        let own = w[row - first];
        let mut pivot = own;
        // v = L⁻¹ w first; l = D⁻¹ v when all of it is known.
        for p in from..k {
            let start = self.from[p].max(from);
            let above = &self.lower[self.starts[p] + start - self.from[p]..self.starts[p] + p - self.from[p]];
            let v = w[self.basis[p] - first] - dot(above, &self.lower[at + start - from..at + p - from]);
            self.lower.push(v);
        }
        for (v, inverse) in self.lower[at..].iter_mut().zip(&self.inverse[from..]) {
            let l = *v * inverse;
            pivot -= *v * l;
            *v = l;
        }
        if pivot <= SUSPICIOUS * own && self.depends(system, row, from, pivot) {
            self.lower.truncate(at);
            return;
        }
        self.basis.push(row);
        self.from.push(from);
        // Positive whatever rounding did, so that nothing is divided by zero.
        self.inverse.push(1.0 / pivot.max(f64::MIN_POSITIVE));
        self.starts.push(self.lower.len());
    }

    /// True if the row whose line of L stands last depends on the basis; its combination is then kept.
    fn depends(&mut self, system: &Delassus, row: usize, from: usize, pivot: f64) -> bool {
        let (k, at) = (self.basis.len(), self.starts[self.basis.len()]);
        let mut all = std::mem::take(&mut self.combination);
        let begin = all.len();
        all.resize(begin + from, 0.0);
        all.extend_from_slice(&self.lower[at..]);
        let c = &mut all[begin..];
        self.backward(k, c);
        let square = |row: usize| system.weight[row] * system.weight[row];
        let size = c.iter().zip(&self.basis).fold(square(row), |sum, (c, &j)| sum + c * c * square(j));
        let depends = pivot <= DEPENDENT * size;
        if depends {
            self.dependent.push(row);
            self.ends.push(all.len());
        } else {
            all.truncate(begin);
        }
        self.combination = all;
        depends
    }

    /// c of dependent row `i` over the basis.
    fn combination(&self, i: usize) -> &[f64] {
        &self.combination[self.ends[i]..self.ends[i + 1]]
    }

    /// Factors NᵀD N.
    fn relate(&mut self, system: &Delassus) {
        let count = self.dependent.len();
        if count == 0 {
            return;
        }
        let mut gram = std::mem::take(&mut self.gram);
        gram.clear();
        let square = |row: usize| system.weight[row] * system.weight[row];
        for i in 0..count {
            let at = gram.len();
            for j in 0..=i {
                let common = self.combination(i).iter().zip(self.combination(j)).zip(&self.basis);
                let mut sum = if i == j { square(self.dependent[i]) } else { 0.0 };
                sum += common.map(|((a, b), &row)| a * b * square(row)).sum::<f64>();
                let start = j * (j + 1) / 2;
                let line = if i == j { &gram[at..at + j] } else { &gram[start..start + j] };
                sum -= dot(line, &gram[at..at + j]);
                // D is positive, and so is every pivot: no less than the square of the row's own weight.
                gram.push(if i == j { sum.sqrt() } else { sum / gram[start + j] });
            }
        }
        self.gram = gram;
    }

    /// Forces r of the rows in play that move each of them by `shift(row)` (entries of other rows are left alone), and the escape where
    /// that cannot be. What dependent rows may miss for rounding, of states and bounds, is `slack(row)`.
    pub(super) fn forces(
        &mut self,
        system: &Delassus,
        shift: impl Fn(usize) -> f64,
        slack: impl Fn(usize) -> f64,
        r: &mut [f64],
    ) {
        self.force.clear();
        self.force.extend(self.basis.iter().map(|&row| shift(row)));
        if self.escapes {
            self.escape.fill(0.0);
            self.escapes = false;
        }
        if self.dependent.is_empty() {
            self.invert();
        } else {
            self.reconcile(system, &shift, slack);
            self.invert();
            self.divide(system);
            for (&row, &force) in self.dependent.iter().zip(&self.share) {
                r[row] = force;
            }
        }
        for (&row, &force) in self.basis.iter().zip(&self.force) {
            r[row] = force;
        }
    }

    /// Takes from what the rows are asked to do what they cannot: e, and q − D e in the place of q.
    fn reconcile(&mut self, system: &Delassus, shift: impl Fn(usize) -> f64, slack: impl Fn(usize) -> f64) {
        let mut share = std::mem::take(&mut self.share);
        share.clear();
        for (i, &row) in self.dependent.iter().enumerate() {
            // Whichever row gives way to the others misses its own bound by the miss over its part in the combination.
            let (mut miss, mut allowed, mut rounding) = (shift(row), slack(row), 0.0);
            for ((&c, &q), &j) in self.combination(i).iter().zip(&self.force).zip(&self.basis) {
                miss -= c * q;
                rounding += c.abs() * (NOISE * q.abs() + f64::EPSILON / ROUNDING * slack(j));
                if c.abs() * system.weight[j] > PART * system.weight[row] {
                    allowed = f64::min(allowed, c.abs() * slack(j));
                }
            }
            let met = miss.abs() <= allowed + rounding;
            self.escapes |= !met;
            share.push(if met { 0.0 } else { miss });
        }
        self.share = share;
        if !self.escapes {
            return;
        }
        self.weigh();
        for i in 0..self.dependent.len() {
            let z = self.share[i];
            self.escape[self.dependent[i]] += z;
            for k in 0..self.combination(i).len() {
                self.escape[self.basis[k]] -= self.combination(i)[k] * z;
            }
        }
        let reach = |row: usize, e: f64| e.abs() * system.weight[row];
        let most = self.rows.iter().fold(0.0, |most, &row| f64::max(most, reach(row, self.escape[row])));
        for &row in &self.rows {
            if reach(row, self.escape[row]) <= SPREAD * most {
                self.escape[row] = 0.0;
            }
        }
        for (force, &row) in self.force.iter_mut().zip(&self.basis) {
            *force -= system.weight[row] * system.weight[row] * self.escape[row];
        }
    }

    /// Of all forces that do the same, those of least Σ Wᵢᵢ rᵢ²: `force` is changed and `share` written.
    fn divide(&mut self, system: &Delassus) {
        self.share.clear();
        for i in 0..self.dependent.len() {
            let terms = self.combination(i).iter().zip(&self.force).zip(&self.basis);
            let sum = terms.map(|((c, r), &row)| c * r * system.weight[row] * system.weight[row]).sum();
            self.share.push(sum);
        }
        self.weigh();
        for (i, &force) in self.share.iter().enumerate() {
            for (r, c) in self.force.iter_mut().zip(&self.combination[self.ends[i]..self.ends[i + 1]]) {
                *r -= c * force;
            }
        }
    }

    /// Solves NᵀD N z = `share` in place.
    fn weigh(&mut self) {
        let v = &mut self.share;
        for i in 0..v.len() {
            let line = &self.gram[i * (i + 1) / 2..];
            v[i] = (v[i] - dot(&line[..i], &v[..i])) / line[i];
        }
        for i in (0..v.len()).rev() {
            let line = &self.gram[i * (i + 1) / 2..];
            v[i] /= line[i];
            for j in 0..i {
                v[j] -= line[j] * v[i];
            }
        }
    }

    /// Solves W_BB r = `force` in place.
    fn invert(&mut self) {
        let mut v = std::mem::take(&mut self.force);
        for k in 0..v.len() {
            let line = &self.lower[self.starts[k]..self.starts[k + 1]];
            v[k] -= dot(line, &v[self.from[k]..k]);
        }
        for (v, inverse) in v.iter_mut().zip(&self.inverse) {
            *v *= inverse;
        }
        let count = v.len();
        self.backward(count, &mut v);
        self.force = v;
    }

    /// Solves Lᵀ v = v in place, for the first `count` rows of the basis.
    #[inline]
    fn backward(&self, count: usize, v: &mut [f64]) {
        for k in (0..count).rev() {
            let line = &self.lower[self.starts[k]..self.starts[k + 1]];
            let (before, own) = v.split_at_mut(k);
            for (v, l) in before[self.from[k]..].iter_mut().zip(line) {
                *v -= l * own[0];
            }
        }
    }
}

/// a · b, in four sums that do not wait for one another.
#[inline]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (left, right) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = left.remainder().iter().zip(right.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in left.zip(right) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}
