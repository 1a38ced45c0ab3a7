//! A symmetric matrix prepared for many products.

use super::Symmetric;
use super::band::{Band, is_band};
use super::update;

/// A symmetric matrix stored for products: by diagonals where it is a band (diagonal, tridiagonal,
/// a beam's, dense), else by rows.
#[derive(Debug, Clone)]
pub enum Operator {
    Band(Band),
    /// By rows of the lower triangle.
    Sparse(Symmetric),
}

impl Operator {
    /// Prepares `matrix`.
    #[must_use]
    pub fn new(matrix: &Symmetric) -> Self {
        if is_band(matrix) { Self::Band(Band::new(matrix)) } else { Self::Sparse(matrix.clone()) }
    }

    /// Writes `scale` · A x to `out`; both of length n, others are left as they are.
    #[inline(always)]
    pub(crate) fn product(&self, scale: f64, x: &[f64], out: &mut [f64]) {
        match self.as_diagonal() {
            Some(diagonal) if x.len() == diagonal.len() && out.len() == diagonal.len() => {
                update(out, [diagonal, x], |_, [a, x]| scale * a * x);
            }
            _ => {
                out.fill(0.0);
                self.add_product(scale, x, out);
            }
        }
    }

    /// Adds `scale` · A x to `out`; both of length n, others are left as they are.
    #[inline(always)]
    pub fn add_product(&self, scale: f64, x: &[f64], out: &mut [f64]) {
        match self.as_diagonal() {
            Some(diagonal) if x.len() == diagonal.len() && out.len() == diagonal.len() => {
                update(out, [diagonal, x], |sum, [a, x]| sum + scale * a * x);
            }
            _ => self.add_product_of(scale, x, out),
        }
    }

    /// The same for any matrix.
    #[inline(never)]
    fn add_product_of(&self, scale: f64, x: &[f64], out: &mut [f64]) {
        match self {
            Self::Band(band) if x.len() == band.size() && out.len() == band.size() => band.add_product(scale, x, out),
            Self::Band(_) => {}
            Self::Sparse(matrix) => matrix.add_product(scale, x, out),
        }
    }

    /// The operator of `times` vectors side by side, entry i of vector k at i · `times` + k: A ⊗ I.
    pub(crate) fn side_by_side(&self, times: usize) -> Self {
        match self {
            Self::Band(band) => Self::Band(band.side_by_side(times)),
            Self::Sparse(matrix) => {
                let entries = matrix.entries();
                let all = entries.flat_map(|(i, j, x)| (0..times).map(move |k| (i * times + k, j * times + k, x)));
                Self::Sparse(Symmetric::from_entries(matrix.size() * times, all.collect::<Vec<_>>()))
            }
        }
    }

    /// The diagonal of a matrix that has no other entries.
    #[inline(always)]
    pub(crate) fn as_diagonal(&self) -> Option<&[f64]> {
        match self {
            Self::Band(band) => band.as_diagonal(),
            Self::Sparse(_) => None,
        }
    }

    /// xᵀA x, for an x of length n; 0 for others.
    #[inline(always)]
    pub(crate) fn form(&self, x: &[f64]) -> f64 {
        match self {
            Self::Band(band) if x.len() == band.size() => band.form(x),
            Self::Band(_) => 0.0,
            Self::Sparse(matrix) => matrix.form(x, x),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A band of two diagonals, one of three, a diagonal, and a matrix that is no band.
    #[test]
    fn products_side_by_side_are_those_of_each_vector() {
        let far = (0..20).map(|i| (i, i, 4.0 + i as f64)).chain((9..20).map(|i| (i, i - 9, -1.0 - 0.1 * i as f64)));
        let near = |width: usize| {
            let entries = (0_usize..6)
                .flat_map(move |i| (i.saturating_sub(width)..=i).map(move |j| (i, j, 1.0 + (i * j) as f64)));
            Symmetric::from_entries(6, entries.collect::<Vec<_>>())
        };
        for matrix in [near(0), near(1), near(2), Symmetric::from_entries(20, far.collect::<Vec<_>>())] {
            let (n, times, operator) = (matrix.size(), 3, Operator::new(&matrix));
            let x: Vec<f64> = (0..n * times).map(|i| f64::sin(0.7 * i as f64)).collect();
            let mut out = vec![1.0; n * times];
            operator.side_by_side(times).add_product(-2.0, &x, &mut out);
            for k in 0..times {
                let own: Vec<f64> = x.iter().skip(k).step_by(times).copied().collect();
                let mut expected = vec![1.0; n];
                matrix.add_product(-2.0, &own, &mut expected);
                let found = out.iter().skip(k).step_by(times);
                // Rounding of a few products of numbers up to 1e2.
                assert!(found.zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12), "{n} {k}");
            }
        }
        assert_eq!(Operator::new(&near(0)).as_diagonal().map(<[f64]>::len), Some(6));
    }
}
