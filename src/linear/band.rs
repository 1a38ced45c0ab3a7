//! Band matrices: products by diagonals, and the factor L D Lᵀ.

use super::Symmetric;
use super::factor::NotDefinite;

/// A symmetric band matrix by diagonals.
#[derive(Debug, Clone)]
pub struct Band {
    n: usize,
    /// Diagonals that are not all 0, each with its distance d from the main one; entry i is that of row i + d and column i.
    diagonals: Vec<(usize, Vec<f64>)>,
}

impl Band {
    pub(super) fn new(matrix: &Symmetric) -> Self {
        let n = matrix.size();
        let mut diagonals: Vec<(usize, Vec<f64>)> =
            (0..=matrix.half_bandwidth()).map(|d| (d, vec![0.0; n - d.min(n)])).collect();
        for (i, j, value) in matrix.entries() {
            if let Some((_, diagonal)) = diagonals.get_mut(i - j) {
                diagonal[j] = value;
            }
        }
        diagonals.retain(|(_, values)| values.iter().any(|&v| v != 0.0));
        Self { n, diagonals }
    }

    /// Adds `scale` · A x to `out`; both of length n.
    #[inline]
    pub(super) fn add_product(&self, scale: f64, x: &[f64], out: &mut [f64]) {
        let (x, out) = (&x[..self.n], &mut out[..self.n]);
        for (d, values) in &self.diagonals {
            if *d == 0 {
                for ((y, a), x) in out.iter_mut().zip(values).zip(x) {
                    *y += scale * a * x;
                }
                continue;
            }
            for ((y, a), x) in out[*d..].iter_mut().zip(values).zip(x) {
                *y += scale * a * x;
            }
            for ((y, a), x) in out.iter_mut().zip(values).zip(&x[*d..]) {
                *y += scale * a * x;
            }
        }
    }
}

/// L D Lᵀ of a positive definite band matrix.
#[derive(Debug, Clone)]
pub(super) struct BandFactor {
    n: usize,
    width: usize,
    /// L below its unit diagonal, by rows: entry i·width + k is that of row i and column i − width + k.
    lower: Vec<f64>,
    /// 1/D.
    inverse: Vec<f64>,
}

/// A pivot below this share of its diagonal entry is rounding: the matrix is not positive definite.
const LEAST_PIVOT: f64 = 1e-14;

impl BandFactor {
    pub(super) fn new(matrix: &Symmetric) -> Result<Self, NotDefinite> {
        let (n, width) = (matrix.size(), matrix.half_bandwidth());
        let mut lower = vec![0.0; n * width];
        let diagonal = matrix.diagonal_entries();
        let mut pivots = vec![0.0; n];
        for (i, j, value) in matrix.entries() {
            if j < i && value != 0.0 {
                lower[i * width + j + width - i] = value;
            }
        }
        for i in 0..n {
            let (before, row) = lower.split_at_mut(i * width);
            let first = i.saturating_sub(width);
            let mut pivot = diagonal[i];
            // Row i holds L D until it is divided.
            for j in first..i {
                let at = j + width - i;
                let from = first.max(j.saturating_sub(width));
                let (a, b) = (from + width - i, from + width - j);
                let above = &before[j * width + b..(j + 1) * width];
                let dot: f64 = row[a..at].iter().zip(above).map(|(x, y)| x * y).sum();
                row[at] -= dot;
            }
            for j in first..i {
                let at = j + width - i;
                let l = row[at] / pivots[j];
                pivot -= row[at] * l;
                row[at] = l;
            }
            if pivot.is_nan() || pivot <= LEAST_PIVOT * diagonal[i].abs() {
                return Err(NotDefinite { row: i });
            }
            pivots[i] = pivot;
        }
        let inverse = pivots.iter().map(|d| 1.0 / d).collect();
        Ok(Self { n, width, lower, inverse })
    }

    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Solves A x = b in place.
    #[inline]
    pub(super) fn solve(&self, x: &mut [f64]) {
        let x = &mut x[..self.n];
        match self.width {
            0 => x.iter_mut().zip(&self.inverse).for_each(|(x, d)| *x *= d),
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

    /// One unknown after the other, with nothing between: the chains of additions are all there is to wait for.
    fn solve_tridiagonal(&self, x: &mut [f64]) {
        let mut last = 0.0;
        for (x, l) in x.iter_mut().zip(&self.lower) {
            last = *x - l * last;
            *x = last;
        }
        // Backwards the entry of the row below couples.
        let (mut last, mut coupling) = (0.0, 0.0);
        for ((x, l), d) in x.iter_mut().zip(&self.lower).zip(&self.inverse).rev() {
            last = *x * d - coupling * last;
            *x = last;
            coupling = *l;
        }
    }
}
