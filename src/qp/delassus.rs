//! The programme condensed onto its rows.
//!
//! W = G A⁻¹ Gᵀ + diag(c) says how far row i moves per unit of force on row j. In a chain, a bar or a tube that is stepped through
//! time the answer to a force dies away from it, so only the entries of a row that matter are kept: from the first to the
//! last column with |Wᵢⱼ| > 1e-17 √(Wᵢᵢ Wⱼⱼ). What is left out is below a fifth of half an ulp of the motion that the same force causes at
//! its own row, and dies away from there: less than the rounding of W itself.

use super::{Failure, Problem, Rhs};
use crate::linear::{Factor, Rows};
use std::ops::Range;

/// Share of a force's own motion below which its motion elsewhere is nothing (dimensionless; see above).
const NOTHING: f64 = 1e-17;

/// Most entries of A⁻¹Gᵀ that are kept, 32 MB of them: beyond, x is found by solving with A again.
const MOST_COLUMNS: usize = 1 << 22;

/// A row takes what others push it by for rounding of its own if they add up to less than this share (dimensionless). It only chooses
/// the guess that pivoting starts from.
const LOOSE: f64 = 0.1;

/// Slices of different lengths, each a run of entries of a longer row that begins at its first column.
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

    /// Adds the run of `row` from its first to its last entry within `near` that is wanted; empty where none is.
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

/// The first and the last row that sees each unknown; (m, 0) where none does.
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
    /// Column and value of each row where every row has one entry, as walls on degrees of freedom have: read without searching.
    single: Option<Vec<(usize, f64)>>,
    /// W by rows, m of them.
    w: Runs,
    /// A⁻¹Gᵀ by columns, m of them, each a run over the n unknowns; `None` where they would be too many.
    columns: Option<Runs>,
    /// Multiplications and additions that solving with A costs, against those of adding one entry of a column.
    solving: usize,
    /// √Wᵢᵢ, m entries: a row's displacement over it is comparable with any other row's; 1 where Wᵢᵢ = 0.
    pub(super) weight: Vec<f64>,
    /// True if every row answers to its own force almost alone: rows that the free motion violates are then the rows in play.
    pub(super) loose: bool,
    /// G x without any row, m entries.
    pub(super) y: Vec<f64>,
}

impl Delassus {
    pub(super) fn new(problem: &Problem) -> Result<Self, Failure> {
        let (n, m) = (problem.a.size(), problem.g.count());
        let mut factor = Factor::new(&problem.a).map_err(|_| Failure::NotPositiveDefinite)?;
        let g = problem.g.clone();
        let unit: Vec<f64> = problem.a.diagonal_entries().iter().map(|d| d.sqrt()).collect();
        let mut response = vec![0.0; n];
        // Writes A⁻¹gⱼᵀ into zeros, and returns the unknowns outside of which it is nothing.
        let mut respond = |j: usize, response: &mut [f64]| {
            g.add_transposed(j, 1.0, response);
            let columns = || g.row(j).iter().map(|entry| entry.0);
            match (columns().min(), columns().max()) {
                (Some(first), Some(last)) => factor.solve_near(response, first..last + 1),
                _ => 0..0,
            }
        };
        // Wⱼⱼ of all rows come first, since the others are measured by them.
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
        let single = (0..m).all(|i| g.row(i).len() == 1).then(|| (0..m).map(|i| g.row(i)[0]).collect());
        let solving = factor.work();
        Ok(Self { factor, g, single, w, columns, solving, weight, loose, y: vec![0.0; m] })
    }

    /// m.
    pub(super) fn count(&self) -> usize {
        self.weight.len()
    }

    /// Row i of W: the column that it begins at, and its entries; all others are nothing.
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

    /// Wᵢᵢ, or 1 where that is 0: the square of a row's weight.
    #[inline]
    pub(super) fn square(&self, i: usize) -> f64 {
        self.weight[i] * self.weight[i]
    }

    /// Adds the motion that force r on row i causes to that of all rows.
    #[inline]
    pub(super) fn push(&self, i: usize, r: f64, y: &mut [f64]) {
        self.w.add(i, r, y);
    }

    /// The free motion under b: fills x and y as if there were no rows. True if all of it is finite and within bounds.
    #[inline]
    pub(super) fn release(&mut self, rhs: &Rhs, x: &mut [f64]) -> bool {
        x.copy_from_slice(rhs.b);
        self.factor.solve(x);
        match &self.single {
            Some(rows) => {
                for (y, &(column, value)) in self.y.iter_mut().zip(rows) {
                    *y = value * x[column];
                }
            }
            None => self.g.product(x, &mut self.y),
        }
        // Without branches, so that several are looked at at once; a NaN is within nothing.
        let mut inside = true;
        for ((&y, &lo), &hi) in self.y.iter().zip(rhs.lo).zip(rhs.hi) {
            inside &= (lo <= y) & (y <= hi);
        }
        for value in x.iter() {
            inside &= value.abs() < f64::INFINITY;
        }
        inside
    }

    /// Turns the free motion x into x = A⁻¹(b + Gᵀ r), r being 0 on all rows but `rows`.
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

/// Makes W symmetric to the last bit, which the rounding of its columns is not.
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
