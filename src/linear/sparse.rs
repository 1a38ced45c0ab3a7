//! The sparse factor: QDLDL with an approximate-minimum-degree order, as Clarabel carries it.

use super::Symmetric;
use super::factor::NotDefinite;
use clarabel::algebra::CscMatrix;
use clarabel::qdldl::{QDLDLFactorisation, QDLDLSettings};

/// L D Lᵀ of a sparse positive definite matrix.
#[derive(Debug)]
pub(super) struct SparseFactor(QDLDLFactorisation<f64>);

impl SparseFactor {
    pub(super) fn new(matrix: &Symmetric) -> Result<Self, NotDefinite> {
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
        let factor = QDLDLFactorisation::new(&upper, Some(settings)).map_err(|_| NotDefinite { row: 0 })?;
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
