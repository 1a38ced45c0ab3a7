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
        if let [(0, own), (d, off)] = self.diagonals.as_slice()
            && self.n >= 2 * d
        {
            return add_two_diagonals(scale, own, (*d, off), x, out);
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

    pub(super) fn side_by_side(&self, times: usize) -> Self {
        let repeated = |values: &Vec<f64>| values.iter().flat_map(|&x| std::iter::repeat_n(x, times)).collect();
        let diagonals = self.diagonals.iter().map(|(d, values)| (d * times, repeated(values)));
        Self { n: self.n * times, diagonals: diagonals.collect() }
    }

    #[inline(always)]
    pub(super) fn as_diagonal(&self) -> Option<&[f64]> {
        match self.diagonals.as_slice() {
            [(0, values)] => Some(values),
            _ => None,
        }
    }

    /// xᵀA x, for an x of length n.
    #[inline(always)]
    pub(super) fn form(&self, x: &[f64]) -> f64 {
        match self.as_diagonal() {
            Some(values) => sum_of_products(values, x, x),
            None => self.form_of(x),
        }
    }

    /// The same for any band.
    #[inline(never)]
    fn form_of(&self, x: &[f64]) -> f64 {
        let along = |(d, values): &(usize, Vec<f64>)| {
            // `values` has n − d entries.
            let sum = sum_of_products(values, &x[..values.len()], &x[*d..]);
            if *d == 0 { sum } else { 2.0 * sum }
        };
        self.diagonals.iter().map(along).sum()
    }
}

/// Σ aᵢxᵢyᵢ in four independent sums, so that their additions overlap.
#[inline(always)]
pub(crate) fn sum_of_products(a: &[f64], x: &[f64], y: &[f64]) -> f64 {
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

/// [`Band::add_product`] for a matrix of n ≥ 2d rows with entries on the diagonal and at the
/// distance d from it (tridiagonal for d = 1), in one pass over `out`: the same operations on each
/// entry in the same order.
#[inline]
fn add_two_diagonals(scale: f64, own: &[f64], (d, off): (usize, &[f64]), x: &[f64], out: &mut [f64]) {
    let n = out.len();
    let (own, off, x) = (&own[..n], &off[..n - d], &x[..n]);
    for i in 0..d {
        out[i] = out[i] + scale * own[i] * x[i] + scale * off[i] * x[i + d];
    }
    let inside = own[d..].iter().zip(&off[d..]).zip(off).zip(&x[d..]).zip(x).zip(&x[2 * d..]);
    for (y, (((((own, above), below), x), before), after)) in out[d..].iter_mut().zip(inside) {
        *y = *y + scale * own * x + scale * below * before + scale * above * after;
    }
    for i in n - d..n {
        out[i] = out[i] + scale * own[i] * x[i] + scale * off[i - d] * x[i - d];
    }
}
