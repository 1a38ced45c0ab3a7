//! A symmetric matrix prepared for many products.

use super::Symmetric;
use super::band::{Band, is_band};

/// A symmetric matrix stored for products: by diagonals where it is a band (diagonal, tridiagonal,
/// a beam's, dense), else by rows.
#[derive(Debug, Clone)]
pub enum Operator {
    /// By diagonals.
    #[doc(hidden)]
    Band(Band),
    /// By rows of the lower triangle.
    #[doc(hidden)]
    Sparse(Symmetric),
}

impl Operator {
    /// Prepares `matrix`.
    #[must_use]
    pub fn new(matrix: &Symmetric) -> Self {
        if is_band(matrix) { Self::Band(Band::new(matrix)) } else { Self::Sparse(matrix.clone()) }
    }

    /// Adds `scale` · A x to `out`; both of length n, others are left as they are.
    #[inline]
    pub fn add_product(&self, scale: f64, x: &[f64], out: &mut [f64]) {
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
    pub(crate) fn as_diagonal(&self) -> Option<&[f64]> {
        match self {
            Self::Band(band) => band.as_diagonal(),
            Self::Sparse(_) => None,
        }
    }

    /// xᵀA x, for an x of length n; 0 for others.
    #[inline]
    pub(crate) fn form(&self, x: &[f64]) -> f64 {
        match self {
            Self::Band(band) if x.len() == band.size() => band.form(x),
            Self::Band(_) => 0.0,
            Self::Sparse(matrix) => matrix.form(x, x),
        }
    }
}
