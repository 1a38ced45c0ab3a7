//! Band matrices by diagonals, and their products.

use super::Symmetric;

/// A band is stored by diagonals if that takes at most this many times the room of its entries …
const FILL: usize = 4;
/// … or if it is this narrow.
const NARROW: usize = 8;

/// True if `matrix` is best stored and factored as a band.
pub(super) fn is_band(matrix: &Symmetric) -> bool {
    let width = matrix.half_bandwidth();
    width <= NARROW || (width + 1) * matrix.size() <= FILL * matrix.stored()
}

/// A symmetric band matrix by diagonals.
#[derive(Debug, Clone)]
pub struct Band {
    n: usize,
    /// Diagonals that are not all 0, each with its distance d from the main one; entry i is that of
    /// row i + d and column i.
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

    pub(super) fn size(&self) -> usize {
        self.n
    }

    /// Adds `scale` · A x to `out`; both of length n.
    #[inline]
    pub(super) fn add_product(&self, scale: f64, x: &[f64], out: &mut [f64]) {
        let (x, out) = (&x[..self.n], &mut out[..self.n]);
        if let [(0, own), (1, off)] = self.diagonals.as_slice()
            && self.n > 1
        {
            return add_tridiagonal(scale, own, off, x, out);
        }
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

    /// xᵀA x, for an x of length n.
    #[inline]
    pub(super) fn form(&self, x: &[f64]) -> f64 {
        let along = |(d, values): &(usize, Vec<f64>)| {
            // `values` has n − d entries.
            let sum = sum_of_products(values, &x[..values.len()], &x[*d..]);
            if *d == 0 { sum } else { 2.0 * sum }
        };
        self.diagonals.iter().map(along).sum()
    }
}

/// Σ aᵢxᵢyᵢ in four independent sums, so that their additions overlap.
#[inline]
fn sum_of_products(a: &[f64], x: &[f64], y: &[f64]) -> f64 {
    let (mut a, mut x, mut y) = (a.chunks_exact(4), x.chunks_exact(4), y.chunks_exact(4));
    let mut sums = [0.0; 4];
    for ((a, x), y) in a.by_ref().zip(x.by_ref()).zip(y.by_ref()) {
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum += a[k] * x[k] * y[k];
        }
    }
    let rest = a.remainder().iter().zip(x.remainder()).zip(y.remainder());
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest.map(|((a, x), y)| a * x * y).sum::<f64>()
}

/// [`Band::add_product`] for a tridiagonal matrix of n > 1 rows, in one pass over `out`: the same
/// operations on each entry in the same order.
#[inline]
fn add_tridiagonal(scale: f64, own: &[f64], off: &[f64], x: &[f64], out: &mut [f64]) {
    let n = out.len();
    let (own, off, x) = (&own[..n], &off[..n - 1], &x[..n]);
    out[0] = out[0] + scale * own[0] * x[0] + scale * off[0] * x[1];
    let inside = own[1..].iter().zip(off.windows(2)).zip(x.windows(3));
    for (y, ((own, off), x)) in out[1..].iter_mut().zip(inside) {
        *y = *y + scale * own * x[1] + scale * off[0] * x[0] + scale * off[1] * x[2];
    }
    out[n - 1] = out[n - 1] + scale * own[n - 1] * x[n - 1] + scale * off[n - 2] * x[n - 2];
}
