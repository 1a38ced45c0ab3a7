//! All modes at once, with full matrices.

use super::definite::definite;
use crate::error::{Error, Result};
use crate::linear::Symmetric;
use crate::order::sort_by_number;
use crate::scene::Structure;
use nalgebra::{DMatrix, SymmetricEigen};

/// The full matrix.
pub(super) fn full(matrix: &Symmetric) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(matrix.size(), matrix.size());
    for (i, j, value) in matrix.entries() {
        (out[(i, j)], out[(j, i)]) = (value, value);
    }
    out
}

/// Eigenvalues of a full symmetric matrix, increasing, and their unit eigenvectors in the columns
/// of a matrix; `None` if the iteration does not converge.
pub(super) fn eigen(matrix: DMatrix<f64>) -> Option<(Vec<f64>, DMatrix<f64>)> {
    let n = matrix.nrows();
    // nalgebra would panic or iterate for ever on either.
    if n == 0 || matrix.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let solved = SymmetricEigen::try_new(matrix, f64::EPSILON, 100 * (n + 10))?;
    let mut order: Vec<usize> = (0..n).collect();
    sort_by_number(&mut order, |&a| solved.eigenvalues[a]);
    let values = order.iter().map(|&i| solved.eigenvalues[i]).collect();
    Some((values, solved.eigenvectors.select_columns(&order)))
}

/// L⁻¹ A L⁻ᵀ with M = L Lᵀ, and L.
pub(super) fn congruent(mass: &Symmetric, matrix: &Symmetric) -> Result<(DMatrix<f64>, DMatrix<f64>)> {
    definite(mass)?;
    let singular =
        || Error::invalid(("system", "mass matrix"), "without a Cholesky factor", "a positive definite matrix");
    let l = full(mass).cholesky().ok_or_else(singular)?.unpack();
    let half = l.solve_lower_triangular(&full(matrix)).ok_or_else(singular)?;
    let mut whole = l.solve_lower_triangular(&half.transpose()).ok_or_else(singular)?;
    // Made exactly symmetric, which rounding has prevented.
    whole = 0.5 * (&whole + whole.transpose());
    Ok((whole, l))
}

/// M-orthonormal shapes of the `count` slowest modes.
pub(super) fn lowest(structure: &Structure, count: usize) -> Result<Vec<Vec<f64>>> {
    let (matrix, l) = congruent(&structure.mass, &structure.stiffness)?;
    let failed = || Error::invalid("modes", count, "fewer: the eigenvalue iteration did not converge");
    let (_, vectors) = eigen(matrix).ok_or_else(failed)?;
    let shapes = l.transpose().solve_upper_triangular(&vectors.columns(0, count)).ok_or_else(failed)?;
    Ok(shapes.column_iter().map(|shape| shape.iter().copied().collect()).collect())
}
