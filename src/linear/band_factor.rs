//! The factor L D Lᵀ of a band matrix.
//!
//! Lᵢⱼ Dⱼ = Aᵢⱼ − Σ Lᵢₖ Dₖ Lⱼₖ,   Dᵢ = Aᵢᵢ − Σ Lᵢₖ² Dₖ,
//!
//! over k < j and k < i within the band. A tridiagonal matrix is eliminated from both ends at once
//! towards its middle (the twisted factorisation).

use super::Symmetric;
use super::definite::NotDefinite;
use super::update;
use std::ops::Range;

/// L D Lᵀ of a positive definite band matrix.
#[derive(Debug, Clone)]
pub(super) struct BandFactor {
    n: usize,
    width: usize,
    /// L below its unit diagonal, by rows: entry i·width + k is that of row i and column i −
    /// width + k. For a tridiagonal matrix, see [`twist`].
    lower: Vec<f64>,
    /// 1/D.
    inverse: Vec<f64>,
}

/// A pivot below this share of its diagonal entry is rounding: the matrix is not positive definite.
const LEAST_PIVOT: f64 = 1e-14;

/// Entries of a solution below this share of the largest are dropped: even if their effect should
/// grow by √cond A < 1e8 (the limit for a matrix that has a factor), it stays below rounding
/// (1e-16).
const NOTHING: f64 = 1e-26;

impl BandFactor {
    pub(super) fn new(matrix: &Symmetric) -> Result<Self, NotDefinite> {
        let mut factor = Self { n: 0, width: 0, lower: Vec::new(), inverse: Vec::new() };
        factor.renew(matrix)?;
        Ok(factor)
    }

    /// Makes it the factor of `matrix`. If that is not positive definite, it is the factor of
    /// nothing.
    pub(super) fn renew(&mut self, matrix: &Symmetric) -> Result<(), NotDefinite> {
        (self.n, self.width) = (matrix.size(), matrix.half_bandwidth());
        let Self { n, width, lower, inverse } = self;
        lower.clear();
        lower.resize(*n * *width, 0.0);
        inverse.clear();
        inverse.extend(matrix.diagonal_of_rows());
        if *width > 0 {
            for (i, j, value) in matrix.entries().filter(|&(i, j, value)| j < i && value != 0.0) {
                lower[i * *width + j + *width - i] = value;
            }
        }
        match *width {
            0 => inverse.iter().enumerate().try_for_each(|(row, &d)| definite(row, d, d))?,
            1 => twist(lower, inverse)?,
            width => eliminate(width, lower, inverse)?,
        }
        inverse.iter_mut().for_each(|d| *d = 1.0 / *d);
        Ok(())
    }

    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Solves A x = b in place.
    #[inline(always)]
    pub(super) fn solve(&self, x: &mut [f64]) {
        let x = &mut x[..self.n];
        if self.width == 0 { update(x, [&self.inverse], |x, [d]| x * d) } else { self.solve_wide(x) }
    }

    /// The same for a matrix that is not diagonal.
    #[inline(never)]
    fn solve_wide(&self, x: &mut [f64]) {
        match self.width {
            1 => self.solve_tridiagonal(x),
            width => {
                for i in 1..self.n {
                    let first = i.saturating_sub(width);
                    let row = &self.lower[i * width + first + width - i..(i + 1) * width];
                    let (known, rest) = x.split_at_mut(i);
                    let dot: f64 = row.iter().zip(&known[first..]).map(|(l, x)| l * x).sum();
                    rest[0] -= dot;
                }
                x.iter_mut().zip(&self.inverse).for_each(|(x, d)| *x *= d);
                for i in (1..self.n).rev() {
                    let first = i.saturating_sub(width);
                    let row = &self.lower[i * width + first + width - i..(i + 1) * width];
                    let (rest, known) = x.split_at_mut(i);
                    let xi = known[0];
                    for (l, x) in row.iter().zip(&mut rest[first..]) {
                        *x -= l * xi;
                    }
                }
            }
        }
    }

    /// Solves A x = b in place for a b that is zero outside `span`, dropping negligible entries:
    /// returns the rows outside of which x is zero.
    ///
    /// Both substitutions end where the entries are below [`NOTHING`] of the largest so far, in the
    /// metric of D. With y = L⁻¹b, the norm of the dropped part of y is in that metric the error of
    /// x in the norm of A, and what follows a row can outgrow it by at most √cond A.
    pub(super) fn solve_near(&self, x: &mut [f64], span: Range<usize>) -> Range<usize> {
        let (n, middle) = (self.n, self.n / 2);
        let x = &mut x[..n];
        let near = match self.width {
            0 => {
                span.clone().for_each(|i| x[i] *= self.inverse[i]);
                Some(span.clone())
            }
            // A tridiagonal matrix is eliminated from both ends: rows are counted from the nearer
            // end.
            1 if span.end <= middle => self.follow(x, span.clone(), middle, |i| i, |i| self.lower[i]),
            1 if span.start > middle => {
                let turned = n - span.end..n - span.start;
                let near = self.follow(x, turned, n - 1 - middle, |i| n - 1 - i, |i| self.lower[n - i]);
                near.map(|near| n - near.end..n - near.start)
            }
            1 => None,
            width => Some(self.solve_band_near(x, span.clone(), width)),
        };
        near.unwrap_or_else(|| {
            self.solve(x);
            0..n
        })
    }

    /// The same along one of the two halves of a tridiagonal matrix, whose row i is `at(i)` and
    /// whose entry of rows i and i − 1 is `lower(i)`, i < `limit`. `None`, with x unchanged, where
    /// the solution reaches the limit.
    fn follow(
        &self,
        x: &mut [f64],
        span: Range<usize>,
        limit: usize,
        at: impl Fn(usize) -> usize,
        lower: impl Fn(usize) -> f64,
    ) -> Option<Range<usize>> {
        let given: Vec<f64> = span.clone().map(|i| x[at(i)]).collect();
        let (mut largest, mut end) = (0.0_f64, span.start);
        loop {
            if end == limit {
                (span.start..end).for_each(|i| x[at(i)] = 0.0);
                span.zip(given).for_each(|(i, b)| x[at(i)] = b);
                return None;
            }
            if end > span.start {
                x[at(end)] -= lower(end) * x[at(end - 1)];
            }
            let size = x[at(end)].powi(2) * self.inverse[at(end)];
            largest = largest.max(size);
            end += 1;
            if end >= span.end && size <= NOTHING * NOTHING * largest {
                break;
            }
        }
        let mut first = end;
        largest = 0.0;
        while first > 0 {
            first -= 1;
            let above = if first + 1 < end { lower(first + 1) * x[at(first + 1)] } else { 0.0 };
            x[at(first)] = x[at(first)] * self.inverse[at(first)] - above;
            let size = x[at(first)].powi(2) / self.inverse[at(first)];
            largest = largest.max(size);
            if first <= span.start && size <= NOTHING * NOTHING * largest {
                break;
            }
        }
        Some(first..end)
    }

    fn solve_band_near(&self, x: &mut [f64], span: Range<usize>, width: usize) -> Range<usize> {
        let row = |i: usize| &self.lower[i * width + i.saturating_sub(width) + width - i..(i + 1) * width];
        // A substitution ends after as many negligible rows as the band is wide.
        let (mut largest, mut still, mut end) = (0.0_f64, 0, span.start);
        while end < self.n && (end < span.end || still < width) {
            let first = end.saturating_sub(width);
            let (known, rest) = x.split_at_mut(end);
            rest[0] -= row(end).iter().zip(&known[first..]).map(|(l, x)| l * x).sum::<f64>();
            let size = rest[0].powi(2) * self.inverse[end];
            largest = largest.max(size);
            still = if size <= NOTHING * NOTHING * largest { still + 1 } else { 0 };
            end += 1;
        }
        x[span.start..end].iter_mut().zip(&self.inverse[span.start..]).for_each(|(x, d)| *x *= d);
        let mut first = end;
        (largest, still) = (0.0, 0);
        while first > 0 && (first > span.start || still < width) {
            first -= 1;
            let (rest, known) = x.split_at_mut(first);
            let xi = known[0];
            for (l, x) in row(first).iter().zip(&mut rest[first.saturating_sub(width)..]) {
                *x -= l * xi;
            }
            let size = xi.powi(2) / self.inverse[first];
            largest = largest.max(size);
            still = if size <= NOTHING * NOTHING * largest { still + 1 } else { 0 };
        }
        x[first.saturating_sub(width)..first].fill(0.0);
        first..end
    }

    /// Eliminates from both ends at once: the two chains of operations are independent and overlap,
    /// while the cost of a single chain is all waiting for its own results.
    fn solve_tridiagonal(&self, x: &mut [f64]) {
        let (n, middle) = (self.n, self.n / 2);
        let (x, lower, inverse) = (&mut x[..n], &self.lower[..n], &self.inverse[..n]);
        let (mut top, mut bottom) = (x[0], x[n - 1]);
        for k in 1..n - middle - 1 {
            let j = n - 1 - k;
            top = x[k] - lower[k] * top;
            bottom = x[j] - lower[j + 1] * bottom;
            (x[k], x[j]) = (top, bottom);
        }
        // The upper half is longer by one row where n is even; with two unknowns the lower one is
        // the middle.
        for k in (n - middle - 1).max(1)..middle {
            top = x[k] - lower[k] * top;
            x[k] = top;
        }
        let mut own = x[middle] - lower[middle] * top;
        if middle + 1 < n {
            own -= lower[middle + 1] * bottom;
        }
        own *= inverse[middle];
        x[middle] = own;
        (top, bottom) = (own, own);
        for k in 1..n - middle {
            let (i, j) = (middle - k, middle + k);
            top = x[i] * inverse[i] - lower[i + 1] * top;
            bottom = x[j] * inverse[j] - lower[j] * bottom;
            (x[i], x[j]) = (top, bottom);
        }
        if n == 2 * middle {
            x[0] = x[0] * inverse[0] - lower[1] * top;
        }
    }
}

/// Refuses a `pivot` that is rounding beside the `diagonal` entry of its row.
fn definite(row: usize, pivot: f64, diagonal: f64) -> Result<(), NotDefinite> {
    if pivot.is_nan() || pivot <= LEAST_PIVOT * diagonal.abs() { Err(NotDefinite { row }) } else { Ok(()) }
}

/// The factor of a band matrix, row by row, from its entries below the diagonal and those on it.
fn eliminate(width: usize, lower: &mut [f64], pivots: &mut [f64]) -> Result<(), NotDefinite> {
    for i in 0..pivots.len() {
        let (before, row) = lower.split_at_mut(i * width);
        let first = i.saturating_sub(width);
        // Row i holds L D until it is divided.
        for j in first..i {
            let at = j + width - i;
            let from = first.max(j.saturating_sub(width));
            let (a, b) = (from + width - i, from + width - j);
            let above = &before[j * width + b..(j + 1) * width];
            let dot: f64 = row[a..at].iter().zip(above).map(|(x, y)| x * y).sum();
            row[at] -= dot;
        }
        let diagonal = pivots[i];
        let mut pivot = diagonal;
        for (entry, d) in row[first + width - i..].iter_mut().zip(&pivots[first..i]) {
            let l = *entry / d;
            pivot -= *entry * l;
            *entry = l;
        }
        definite(i, pivot, diagonal)?;
        pivots[i] = pivot;
    }
    Ok(())
}

/// The factor of a tridiagonal matrix that is eliminated from both ends at once towards row n/2
/// (the twisted factorisation): entry k of `lower` is that of rows k and k − 1, over the pivot of
/// the one further from the middle.
fn twist(lower: &mut [f64], pivots: &mut [f64]) -> Result<(), NotDefinite> {
    let (n, middle) = (pivots.len(), pivots.len() / 2);
    let (own, mut diagonal) = (pivots[middle], pivots[0]);
    for k in 1..=middle {
        definite(k - 1, pivots[k - 1], diagonal)?;
        diagonal = pivots[k];
        let l = lower[k] / pivots[k - 1];
        pivots[k] -= lower[k] * l;
        lower[k] = l;
    }
    diagonal = pivots[n - 1];
    for k in (middle + 1..n).rev() {
        definite(k, pivots[k], diagonal)?;
        diagonal = pivots[k - 1];
        let l = lower[k] / pivots[k];
        pivots[k - 1] -= lower[k] * l;
        lower[k] = l;
    }
    definite(middle, pivots[middle], own)
}
