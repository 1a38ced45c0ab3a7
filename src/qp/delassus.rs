//! The programme condensed onto its rows.
//!
//! W = G A⁻¹ Gᵀ + diag(c) holds how far row i moves per unit of force on row j. In one time step of
//! a chain, a bar or a tube, the response to a force decays with distance from it, so only part of
//! each row is stored: from the first to the last column with |Wᵢⱼ| > 1e-17 √(Wᵢᵢ Wⱼⱼ). What is
//! left out is below a fifth of half an ulp of the motion that the same force causes at its own
//! row, and decays from there: less than the rounding error of W itself.

use super::{Failure, Problem, Rhs};
use crate::linear::{Factor, Rows};
use std::ops::Range;

/// Motion below this share of the motion that the same force causes at its own row is dropped
/// (dimensionless; see above).
const NOTHING: f64 = 1e-17;

/// Maximum number of entries of A⁻¹Gᵀ that are stored (32 MB); beyond it, x is found by solving
/// with A again.
const MOST_COLUMNS: usize = 1 << 22;

/// If, in every row, the couplings to the other rows add up to less than this share of the row's
/// own entry (dimensionless), pivoting starts from the rows that the free motion violates. It
/// affects only the starting active set.
const LOOSE: f64 = 0.1;

/// Sparse rows, each stored as one contiguous run of entries with the column that it begins at.
#[derive(Default)]
struct Runs {
    starts: Vec<usize>,
    first: Vec<usize>,
    values: Vec<f64>,
}

impl Runs {
    fn with_capacity(rows: usize) -> Self {
        Self { starts: vec![0], first: Vec::with_capacity(rows), values: Vec::new() }
    }

    /// Appends the run of `row` from the first to the last entry within `near` that is `wanted`; an
    /// empty run if none is.
    fn push(&mut self, row: &[f64], near: Range<usize>, wanted: impl Fn(usize, f64) -> bool) {
        let keep = |&i: &usize| wanted(i, row[i]);
        let first = near.clone().find(keep).unwrap_or(0);
        let end = (first..near.end).rev().find(keep).map_or(first, |last| last + 1);
        self.first.push(first);
        self.values.extend_from_slice(&row[first..end]);
        self.starts.push(self.values.len());
    }

    #[inline]
    fn row(&self, i: usize) -> (usize, &[f64]) {
        (self.first[i], &self.values[self.starts[i]..self.starts[i + 1]])
    }

    /// The entries of run i.
    fn span(&self, i: usize) -> Range<usize> {
        let (first, values) = self.row(i);
        first..first + values.len()
    }

    /// Adds `factor` times run i to `out`.
    #[inline]
    fn add(&self, i: usize, factor: f64, out: &mut [f64]) {
        let (first, values) = self.row(i);
        for (out, value) in out[first..first + values.len()].iter_mut().zip(values) {
            *out += factor * value;
        }
    }
}

/// The first and the last row that sees each unknown; (m, 0) where no row does.
struct Seen(Vec<(usize, usize)>);

impl Seen {
    fn new(n: usize, g: &Rows) -> Self {
        let mut of = vec![(g.count(), 0); n];
        for i in 0..g.count() {
            for &(column, _) in g.row(i) {
                let (first, last) = of[column];
                of[column] = (first.min(i), last.max(i));
            }
        }
        Self(of)
    }

    /// The rows from the first to the last that see one of `unknowns`, `own` among them.
    fn rows(&self, unknowns: Range<usize>, own: usize) -> Range<usize> {
        let ends = |(a, b): (usize, usize), &(first, last): &(usize, usize)| (a.min(first), b.max(last));
        let (first, last) = self.0[unknowns].iter().fold((own, own), ends);
        first..last + 1
    }
}

/// A factored once, and the Delassus operator W, in units of displacement per force.
pub(super) struct Delassus {
    factor: Factor,
    g: Rows,
    /// W by rows, m of them.
    w: Runs,
    /// A⁻¹Gᵀ by columns, m of them, each a run over the n unknowns; `None` above [`MOST_COLUMNS`]
    /// entries.
    columns: Option<Runs>,
    /// Cost of solving with A, in units of adding one entry of a column.
    solving: usize,
    /// √Wᵢᵢ, m entries, or 1 where Wᵢᵢ = 0: a row's displacement divided by it can be compared with
    /// that of any other row.
    pub(super) weight: Vec<f64>,
    /// True if every row moves almost only under its own force: the rows that the free motion
    /// violates are then the rows in play.
    pub(super) loose: bool,
    /// G x without any row, m entries; those of rows without a bound are from an earlier programme,
    /// until [`Self::complete`].
    pub(super) y: Vec<f64>,
}

impl Delassus {
    pub(super) fn new(problem: &Problem) -> Result<Self, Failure> {
        let (n, m) = (problem.a.size(), problem.g.count());
        let mut factor = Factor::new(&problem.a).map_err(|_| Failure::NotPositiveDefinite)?;
        let g = problem.g.clone();
        let unit: Vec<f64> = problem.a.diagonal_entries().iter().map(|d| d.sqrt()).collect();
        let mut response = vec![0.0; n];
        // Writes A⁻¹gⱼᵀ into zeros, and returns the range of unknowns outside which it is
        // negligible.
        let mut respond = |j: usize, response: &mut [f64]| {
            g.add_transposed(j, 1.0, response);
            let columns = || g.row(j).iter().map(|entry| entry.0);
            match (columns().min(), columns().max()) {
                (Some(first), Some(last)) => factor.solve_near(response, first..last + 1),
                _ => 0..0,
            }
        };
        // Wⱼⱼ of all rows come first, since the other entries are compared with them.
        let mut weight = vec![0.0; m];
        let mut columns = Some(Runs::with_capacity(m));
        for (j, weight) in weight.iter_mut().enumerate() {
            let near = respond(j, &mut response);
            let own = g.dot(j, &response) + problem.compliance[j];
            *weight = if own > 0.0 { own.sqrt() } else { 1.0 };
            if let Some(runs) = &mut columns {
                // √Aᵢᵢ is at most 1/√(A⁻¹)ᵢᵢ, so no unknown of small motion is cut too early.
                runs.push(&response, near.clone(), |i, v| v.abs() * unit[i] > NOTHING * *weight);
                if runs.values.len() > MOST_COLUMNS {
                    columns = None;
                }
            }
            response[near].fill(0.0);
        }
        let seen = Seen::new(n, &g);
        let mut w = Runs::with_capacity(m);
        let mut row = vec![0.0; m];
        for j in 0..m {
            let near = match &columns {
                Some(runs) => {
                    runs.add(j, 1.0, &mut response);
                    runs.span(j)
                }
                None => respond(j, &mut response),
            };
            let rows = seen.rows(near.clone(), j);
            rows.clone().for_each(|i| row[i] = g.dot(i, &response));
            row[j] += problem.compliance[j];
            w.push(&row, rows.clone(), |i, v| i == j || v.abs() > NOTHING * weight[i] * weight[j]);
            response[near].fill(0.0);
            row[rows].fill(0.0);
        }
        symmetrise(&mut w);
        let loose = (0..m).all(|i| {
            let (first, row) = w.row(i);
            let others: f64 = row.iter().enumerate().map(|(k, v)| v.abs() / weight[first + k]).sum();
            others - weight[i] <= LOOSE * weight[i]
        });
        let solving = factor.work();
        Ok(Self { factor, g, w, columns, solving, weight, loose, y: vec![0.0; m] })
    }

    /// m.
    pub(super) fn count(&self) -> usize {
        self.weight.len()
    }

    /// Row i of W: the column that it begins at, and its entries; all others are negligible.
    #[inline]
    pub(super) fn row(&self, i: usize) -> (usize, &[f64]) {
        self.w.row(i)
    }

    /// Wᵢⱼ.
    pub(super) fn entry(&self, i: usize, j: usize) -> f64 {
        let (first, row) = self.w.row(i);
        j.checked_sub(first).and_then(|k| row.get(k)).copied().unwrap_or(0.0)
    }

    /// Wᵢᵢ.
    #[inline]
    pub(super) fn own(&self, i: usize) -> f64 {
        let (first, row) = self.w.row(i);
        row[i - first]
    }

    /// Wᵢᵢ, or 1 where that is 0: the square of [`Self::weight`].
    #[inline]
    pub(super) fn square(&self, i: usize) -> f64 {
        self.weight[i] * self.weight[i]
    }

    /// Adds the motion that force r on row i causes to that of all rows.
    #[inline]
    pub(super) fn push(&self, i: usize, r: f64, y: &mut [f64]) {
        self.w.add(i, r, y);
    }

    /// Computes the free motion under b: x, without any force on rows.
    #[inline]
    pub(super) fn release(&mut self, b: &[f64], x: &mut [f64]) {
        x.copy_from_slice(b);
        self.factor.solve(x);
    }

    /// Computes y of the rows `bounded` for the free motion x. True if all of them are within their
    /// bounds.
    #[inline]
    pub(super) fn is_free(&mut self, rhs: &Rhs, bounded: &[usize], x: &[f64]) -> bool {
        let mut inside = true;
        for &row in bounded {
            let y = self.g.dot(row, x);
            self.y[row] = y;
            // A NaN fails every comparison.
            inside &= (rhs.lo[row] <= y) & (y <= rhs.hi[row]);
        }
        inside
    }

    /// Computes y of all rows for the free motion x.
    pub(super) fn complete(&mut self, x: &[f64]) {
        self.g.product(x, &mut self.y);
    }

    /// Turns the free motion x into x = A⁻¹(b + Gᵀ r), where r is 0 on all rows but `rows`.
    pub(super) fn respond(&mut self, b: &[f64], rows: &[usize], r: &[f64], x: &mut [f64]) {
        if let Some(columns) = &self.columns
            && rows.iter().map(|&i| columns.row(i).1.len()).sum::<usize>() <= self.solving
        {
            rows.iter().for_each(|&i| columns.add(i, r[i], x));
            return;
        }
        x.copy_from_slice(b);
        rows.iter().for_each(|&i| self.g.add_transposed(i, r[i], x));
        self.factor.solve(x);
    }
}

/// Makes W symmetric to the last bit, which rounding of its columns has spoilt.
fn symmetrise(w: &mut Runs) {
    for j in 0..w.first.len() {
        for i in w.first[j]..j {
            let at = w.starts[j] + i - w.first[j];
            let Some(offset) = j.checked_sub(w.first[i]).filter(|k| w.starts[i] + k < w.starts[i + 1]) else {
                continue;
            };
            let opposite = w.starts[i] + offset;
            let mean = 0.5 * (w.values[at] + w.values[opposite]);
            (w.values[at], w.values[opposite]) = (mean, mean);
        }
    }
}

#[cfg(test)]
mod tests;
