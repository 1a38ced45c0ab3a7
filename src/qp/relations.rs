//! Rows in play that depend linearly on others in play.
//!
//! Walls that see the same motion make W singular on the rows S in play. A row k that depends on
//! the rows B of the factor, W_BB c = W_Bk, gives the direction N = eₖ − Σ cⱼ eⱼ of forces that
//! cause no motion. W_SS r = q is then taken for the limit δ → 0 of (W_SS + δ D) r = q, D =
//! diag(Wᵢᵢ), in which every matrix is positive definite and every solution unique:
//!
//! r = e/δ + r₀ + O(δ),   e = N z,  NᵀD N z = Nᵀq,   W r₀ = q − D e,  NᵀD r₀ = 0.
//!
//! Where the bounds can all be met, Nᵀq = 0, e is 0, and r₀ is the solution of least Σ Wᵢᵢ rᵢ²:
//! equal walls at one place share equally. Where they cannot, e is the escape: forces that grow
//! without limit and cause no motion.

use super::delassus::Delassus;
use super::sums::dot;
use super::{NOISE, ROUNDING};

/// A row with less than this share in a combination is not moved to make room for the others
/// (dimensionless).
const PART: f64 = 1e-3;

/// An escape or a yielding below this share of the largest one is rounding (dimensionless).
pub(super) const SPREAD: f64 = 1e-9;

/// Maximum number of entries of NᵀD N for which room is made beforehand (32 MB): more is made when
/// it is needed.
const MOST_GRAM: usize = 1 << 22;

/// The dependent rows, and their combinations of the rows of the factor.
#[derive(Default)]
pub(super) struct Relations {
    /// The dependent rows, in the order in which they were found.
    rows: Vec<usize>,
    /// c of each, one after the other, each over the rows that the factor had when the row was
    /// found.
    combination: Vec<f64>,
    ends: Vec<usize>,
    /// D c of one of them.
    weighed: Vec<f64>,
    /// Lower Cholesky factor of NᵀD N, row after row without gaps.
    gram: Vec<f64>,
    /// z, or the forces of the dependent rows.
    share: Vec<f64>,
    /// e over all m rows; all 0 unless `escapes`.
    escape: Vec<f64>,
    escapes: bool,
}

impl Relations {
    pub(super) fn new(m: usize) -> Self {
        Self { ends: vec![0], escape: vec![0.0; m], ..Self::default() }
    }

    /// The dependent rows.
    pub(super) fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// Makes room for as many dependent rows as there are now, and for combinations as long as `m`
    /// rows can have.
    pub(super) fn reserve(&mut self, m: usize) {
        let count = self.rows.len();
        self.combination.reserve(m);
        self.weighed.reserve(m);
        self.gram.reserve((count * (count + 1) / 2).min(MOST_GRAM));
        self.share.reserve(count);
    }

    /// Keeps the first `count`.
    pub(super) fn truncate(&mut self, count: usize) {
        self.rows.truncate(count);
        self.ends.truncate(count + 1);
        self.combination.truncate(self.ends.last().copied().unwrap_or(0));
    }

    /// Adds a row with its combination.
    pub(super) fn push(&mut self, row: usize, combination: &[f64]) {
        self.rows.push(row);
        self.combination.extend_from_slice(combination);
        self.ends.push(self.combination.len());
    }

    /// c of dependent row `i`.
    fn combination(&self, i: usize) -> &[f64] {
        &self.combination[self.ends[i]..self.ends[i + 1]]
    }

    /// Factors NᵀD N.
    pub(super) fn factor(&mut self, system: &Delassus, basis: &[usize]) {
        let mut gram = std::mem::take(&mut self.gram);
        gram.clear();
        for i in 0..self.rows.len() {
            let at = gram.len();
            self.weighed.clear();
            let own = &self.combination[self.ends[i]..self.ends[i + 1]];
            self.weighed.extend(own.iter().zip(basis).map(|(c, &row)| c * system.square(row)));
            for j in 0..=i {
                let start = j * (j + 1) / 2;
                // A combination is as long as the factor was when the row was found.
                let other = self.combination(j);
                let common = other.len().min(self.weighed.len());
                let mut sum = dot(&other[..common], &self.weighed[..common]);
                sum -= dot(&gram[start..start + j], &gram[at..at + j]);
                // D of the row itself is a lower bound of the pivot.
                gram.push(if i == j {
                    (sum.max(0.0) + system.square(self.rows[i])).sqrt()
                } else {
                    sum / gram[start + j]
                });
            }
        }
        self.gram = gram;
    }

    /// Solves NᵀD N z = `share` in place.
    fn weigh(&mut self) {
        let v = &mut self.share;
        for i in 0..v.len() {
            let line = &self.gram[i * (i + 1) / 2..];
            let known: f64 = line[..i].iter().zip(&v[..i]).map(|(a, b)| a * b).sum();
            v[i] = (v[i] - known) / line[i];
        }
        for i in (0..v.len()).rev() {
            let line = &self.gram[i * (i + 1) / 2..];
            v[i] /= line[i];
            for j in 0..i {
                v[j] -= line[j] * v[i];
            }
        }
    }

    /// How far a row may miss its bound because of rounding of states and bounds, and still count
    /// as met together with the rows of its combination. Whichever of those gives way to the others
    /// misses its own bound by the miss over its coefficient.
    pub(super) fn allowed(
        system: &Delassus,
        row: usize,
        combination: &[f64],
        basis: &[usize],
        slack: impl Fn(usize) -> f64,
    ) -> f64 {
        combination.iter().zip(basis).fold(slack(row), |allowed, (&c, &j)| {
            let part = c.abs() * system.weight[j] > PART * system.weight[row];
            if part { f64::min(allowed, c.abs() * slack(j)) } else { allowed }
        })
    }

    /// Sets the escape to 0.
    pub(super) fn calm(&mut self) {
        if self.escapes {
            self.escape.fill(0.0);
            self.escapes = false;
        }
    }

    /// e, if it is not 0.
    pub(super) fn escape(&self) -> Option<&[f64]> {
        self.escapes.then_some(&self.escape)
    }

    /// True if the rows cannot all move by `shift`: `share` then holds the misses of the dependent
    /// rows. `force` holds W⁻¹q on the basis.
    pub(super) fn escapes(
        &mut self,
        system: &Delassus,
        basis: &[usize],
        force: &[f64],
        shift: impl Fn(usize) -> f64,
        slack: impl Fn(usize) -> f64,
        ulps: f64,
    ) -> bool {
        self.share.clear();
        let reach = basis.iter().zip(force).fold(0.0, |reach, (&j, r)| f64::max(reach, r.abs() * system.weight[j]));
        for (i, &row) in self.rows.iter().enumerate() {
            let combination = &self.combination[self.ends[i]..self.ends[i + 1]];
            // An entry of W has an error of some ulps, and the combination one of what that moves
            // the row under the forces of the basis.
            let (mut miss, mut rounding) = (shift(row), ulps * reach * system.weight[row]);
            for (&c, &j) in combination.iter().zip(basis) {
                let q = shift(j);
                miss -= c * q;
                rounding +=
                    c.abs() * (NOISE * q.abs() + f64::EPSILON / ROUNDING * slack(j) + ulps * reach * system.weight[j]);
            }
            let met = miss.abs() <= Self::allowed(system, row, combination, basis, &slack) + rounding;
            self.escapes |= !met;
            self.share.push(if met { 0.0 } else { miss });
        }
        self.escapes
    }

    /// Computes e from the misses, and replaces q, which `asked` holds over the basis, by q − D e.
    pub(super) fn escape_by(&mut self, system: &Delassus, basis: &[usize], asked: &mut [f64]) {
        self.weigh();
        for (i, &row) in self.rows.iter().enumerate() {
            self.escape[row] += self.share[i];
            for (&j, c) in basis.iter().zip(&self.combination[self.ends[i]..self.ends[i + 1]]) {
                self.escape[j] -= c * self.share[i];
            }
        }
        let reach = |row: usize, e: f64| e.abs() * system.weight[row];
        let all = || basis.iter().chain(&self.rows);
        let most = all().fold(0.0, |most, &row| f64::max(most, reach(row, self.escape[row])));
        for &row in basis.iter().chain(&self.rows) {
            if reach(row, self.escape[row]) <= SPREAD * most {
                self.escape[row] = 0.0;
            }
        }
        for (q, &row) in asked.iter_mut().zip(basis) {
            *q -= system.square(row) * self.escape[row];
        }
    }

    /// Replaces `force` on the basis by the forces of least Σ Wᵢᵢ rᵢ² among all that cause the same
    /// motion, and writes r of the dependent rows.
    pub(super) fn divide(&mut self, system: &Delassus, basis: &[usize], force: &mut [f64], r: &mut [f64]) {
        self.share.clear();
        for i in 0..self.rows.len() {
            let terms = self.combination(i).iter().zip(force.iter()).zip(basis);
            let sum = terms.map(|((c, r), &row)| c * r * system.square(row)).sum();
            self.share.push(sum);
        }
        self.weigh();
        for (i, &share) in self.share.iter().enumerate() {
            for (r, c) in force.iter_mut().zip(&self.combination[self.ends[i]..self.ends[i + 1]]) {
                *r -= c * share;
            }
            r[self.rows[i]] = share;
        }
    }
}

#[cfg(test)]
mod tests;
