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
