//! The sparse factor: QDLDL with an approximate-minimum-degree order, as Clarabel carries it.

use super::Symmetric;
use super::definite::NotDefinite;
use clarabel::algebra::CscMatrix;
use clarabel::qdldl::{QDLDLFactorisation, QDLDLSettings};

/// L D Lᵀ of a sparse positive definite matrix.
#[derive(Debug)]
pub(super) struct SparseFactor(QDLDLFactorisation<f64>);

impl SparseFactor {
    pub(super) fn new(matrix: &Symmetric) -> Result<Self, NotDefinite> {
        let factor = factorise(matrix).ok_or(NotDefinite { row: 0 })?;
        // Which row gives way is known in the order of the elimination only.
        match factor.D.iter().position(|d| d.is_nan() || *d <= 0.0) {
            Some(at) => Err(NotDefinite { row: factor.perm.get(at).copied().unwrap_or(at) }),
            None => Ok(Self(factor)),
        }
    }

    /// Number of entries of L below its diagonal.
    pub(super) fn stored(&self) -> usize {
        self.0.L.nnz()
    }

    pub(super) fn solve(&mut self, x: &mut [f64]) {
        self.0.solve(x);
    }
}

/// L D Lᵀ with D of any signs, without pivoting; none where a pivot vanishes.
fn factorise(matrix: &Symmetric) -> Option<QDLDLFactorisation<f64>> {
    let n = matrix.size();
    // The rows of the lower triangle are the columns of the upper one.
    let (mut starts, mut rows, mut values) = (Vec::with_capacity(n + 1), Vec::new(), Vec::new());
    starts.push(0);
    let mut column = 0;
    for (i, j, value) in matrix.entries() {
        if i > column {
            starts.push(rows.len());
            column = i;
        }
        rows.push(j);
        values.push(value);
    }
    starts.push(rows.len());
    let upper = CscMatrix::new(n, n, starts, rows, values);
    let settings = QDLDLSettings { regularize_enable: false, ..QDLDLSettings::default() };
    QDLDLFactorisation::new(&upper, Some(settings)).ok()
}

/// The number of negative eigenvalues of `matrix`, by Sylvester's law of inertia: that of the negative pivots of L D Lᵀ. None where a pivot vanishes.
#[must_use]
pub fn negative_pivots(matrix: &Symmetric) -> Option<usize> {
    if matrix.size() == 0 {
        return Some(0);
    }
    let factor = factorise(matrix)?;
    (!factor.D.iter().any(|d| d.is_nan())).then(|| factor.D.iter().filter(|d| **d < 0.0).count())
}
