//! A symmetric matrix by the rows of its lower triangle.

use crate::order::sort_by_number;
use serde::{Deserialize, Serialize};

/// A symmetric n × n matrix; entries below the diagonal stand for both triangles. The diagonal is
/// always stored.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct Symmetric {
    /// Where each row starts in the two arrays below; n + 1 entries.
    starts: Vec<usize>,
    /// Columns of a row, increasing; the last is the diagonal.
    columns: Vec<usize>,
    values: Vec<f64>,
}

/// A matrix as it was serialised, perhaps by another program.
#[derive(Deserialize)]
struct Stored {
    starts: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl TryFrom<Stored> for Symmetric {
    type Error = &'static str;

    fn try_from(Stored { starts, columns, values }: Stored) -> Result<Self, Self::Error> {
        let rows = starts.windows(2).enumerate();
        let increasing = |row: &[usize]| row.windows(2).all(|pair| pair[0] < pair[1]);
        let mut sound = rows.map(|(i, span)| {
            columns.get(span[0]..span[1]).is_some_and(|row| row.last() == Some(&i) && increasing(row))
        });
        let ends = starts.first() == Some(&0) && starts.last() == Some(&columns.len());
        if ends && columns.len() == values.len() && sound.all(|row| row) {
            Ok(Self { starts, columns, values })
        } else {
            Err("rows that are not a lower triangle with its diagonal")
        }
    }
}

impl Default for Symmetric {
    /// The 0 × 0 matrix.
    fn default() -> Self {
        Self::zeros(0)
    }
}

impl Symmetric {
    /// The n × n matrix whose entries are sums of `entries` (row, column, value). An off-diagonal
    /// entry is given once, in either triangle, and stands for both: for all entries of a matrix,
    /// of which both triangles would be added up, there is [`Symmetric::from_rows`]. Entries beyond
    /// n are left out, and a debug build panics.
    #[must_use]
    pub fn from_entries(n: usize, entries: impl IntoIterator<Item = (usize, usize, f64)>) -> Self {
        let mut rows: Vec<Vec<(usize, f64)>> = (0..n).map(|i| vec![(i, 0.0)]).collect();
        for (i, j, value) in entries {
            debug_assert!(i.max(j) < n, "the entry of row {i}, column {j} of a matrix of {n} × {n}");
            if let Some(row) = rows.get_mut(i.max(j)) {
                row.push((i.min(j), value));
            }
        }
        let mut matrix = Self { starts: vec![0], columns: Vec::new(), values: Vec::new() };
        for mut row in rows {
            sort_by_number(&mut row, |entry| entry.0 as f64);
            let start = matrix.columns.len();
            for (column, value) in row {
                match matrix.columns.last() {
                    Some(&last) if matrix.columns.len() > start && last == column => {
                        if let Some(sum) = matrix.values.last_mut() {
                            *sum += value;
                        }
                    }
                    _ => {
                        matrix.columns.push(column);
                        matrix.values.push(value);
                    }
                }
            }
            matrix.starts.push(matrix.columns.len());
        }
        matrix
    }

    /// The matrix with `values` on its diagonal and nothing else.
    #[must_use]
    pub fn diagonal(values: &[f64]) -> Self {
        Self::from_entries(values.len(), values.iter().enumerate().map(|(i, &v)| (i, i, v)))
    }

    /// The n × n matrix of zeros.
    #[must_use]
    pub fn zeros(n: usize) -> Self {
        Self::from_entries(n, [])
    }

    /// n.
    #[must_use]
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of stored entries: the lower triangle with the diagonal.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.columns.len()
    }

    /// The stored entries (row, column ≤ row, value), row by row.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        (0..self.size()).flat_map(move |i| self.row(i).map(move |(j, value)| (i, j, value)))
    }

    /// The stored values, row by row.
    pub(super) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// The same.
    pub(super) fn into_values(self) -> Vec<f64> {
        self.values
    }

    /// The entries (column, value) of row `i` up to the diagonal.
    fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let span = self.starts[i]..self.starts[i + 1];
        self.columns[span.clone()].iter().copied().zip(self.values[span].iter().copied())
    }

    /// The entry of row `i` and column `j`; 0 where none is stored.
    #[must_use]
    pub fn get(&self, i: usize, j: usize) -> f64 {
        let (i, j) = (i.max(j), i.min(j));
        if i >= self.size() {
            return 0.0;
        }
        self.row(i).find(|entry| entry.0 == j).map_or(0.0, |entry| entry.1)
    }

    /// The diagonal, n entries.
    #[must_use]
    pub fn diagonal_entries(&self) -> Vec<f64> {
        self.diagonal_of_rows().collect()
    }

    /// The same, row by row.
    pub(super) fn diagonal_of_rows(&self) -> impl Iterator<Item = f64> + '_ {
        self.starts.iter().skip(1).map(|&end| self.values[end - 1])
    }

    /// The largest distance of an entry that is not 0 from the diagonal: 0 for a diagonal matrix, 1
    /// for a tridiagonal one.
    #[must_use]
    pub fn half_bandwidth(&self) -> usize {
        if self.stored() == self.size() {
            return 0;
        }
        self.entries().filter(|e| e.2 != 0.0).map(|(i, j, _)| i - j).max().unwrap_or(0)
    }

    /// The first entry that is not finite, as (row, column, value).
    #[must_use]
    pub fn not_finite(&self) -> Option<(usize, usize, f64)> {
        self.entries().find(|entry| !entry.2.is_finite())
    }

    /// Σ factor · matrix; where sizes differ, the result has the largest.
    #[must_use]
    pub fn sum(terms: &[(f64, &Self)]) -> Self {
        let n = terms.iter().map(|term| term.1.size()).max().unwrap_or(0);
        let stored = terms.iter().map(|term| term.1.stored()).max().unwrap_or(0).max(n);
        let (mut columns, mut values) = (Vec::with_capacity(stored), Vec::with_capacity(stored));
        let mut starts = Vec::with_capacity(n + 1);
        starts.push(0);
        // Where each term's row goes on: rows are merged, in the order of their columns.
        let mut at = vec![0; terms.len()];
        for i in 0..n {
            loop {
                let ahead = |(&at, (_, matrix)): (&usize, &(f64, &Self))| {
                    matrix.columns.get(at).copied().filter(|_| i < matrix.size() && at + 1 < matrix.starts[i + 1])
                };
                let Some(column) = at.iter().zip(terms).filter_map(ahead).min() else { break };
                let mut sum = None;
                for (at, (factor, matrix)) in at.iter_mut().zip(terms) {
                    let is_here = i < matrix.size() && *at + 1 < matrix.starts[i + 1];
                    if is_here && matrix.columns[*at] == column {
                        let value = factor * matrix.values[*at];
                        sum = Some(sum.map_or(value, |sum: f64| sum + value));
                        *at += 1;
                    }
                }
                columns.push(column);
                values.push(sum.unwrap_or(0.0));
            }
            // The diagonal ends a row.
            let mut sum = 0.0;
            for (at, (factor, matrix)) in at.iter_mut().zip(terms).filter(|(_, (_, matrix))| i < matrix.size()) {
                sum += factor * matrix.values[*at];
                *at += 1;
            }
            columns.push(i);
            values.push(sum);
            starts.push(columns.len());
        }
        Self { starts, columns, values }
    }

    /// Adds `scale` · A x to `out`; both of length n. Others are left as they are, and a debug
    /// build panics.
    pub fn add_product(&self, scale: f64, x: &[f64], out: &mut [f64]) {
        let n = self.size();
        debug_assert_eq!((x.len(), out.len()), (n, n));
        if x.len() != n || out.len() != n {
            return;
        }
        for i in 0..n {
            let (mut sum, xi) = (0.0, scale * x[i]);
            for (j, value) in self.row(i) {
                sum += value * x[j];
                if j < i {
                    out[j] += value * xi;
                }
            }
            out[i] += scale * sum;
        }
    }

    /// aᵀ A b.
    #[must_use]
    pub fn form(&self, a: &[f64], b: &[f64]) -> f64 {
        let mut sum = 0.0;
        for i in 0..self.size().min(a.len()).min(b.len()) {
            for (j, value) in self.row(i) {
                sum += if j < i { value * (a[i] * b[j] + a[j] * b[i]) } else { value * a[i] * b[i] };
            }
        }
        sum
    }
}
