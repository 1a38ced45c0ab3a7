//! The sparse factor: QDLDL with an approximate-minimum-degree order, as bundled with Clarabel.

use super::Symmetric;
use super::definite::NotDefinite;
use clarabel::algebra::CscMatrix;
use clarabel::qdldl::{QDLDLFactorisation, QDLDLSettings};

/// L D Lᵀ of a sparse positive definite matrix, of which row `order[i]` is eliminated in place i.
#[derive(Debug)]
pub(super) struct SparseFactor {
    order: Vec<usize>,
    /// L below its unit diagonal, by columns.
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
    /// 1/D.
    inverse: Vec<f64>,
}

impl SparseFactor {
    pub(super) fn new(matrix: &Symmetric) -> Result<Self, NotDefinite> {
        let factor = factorise(matrix).ok_or(NotDefinite { row: 0 })?;
        // The failing row is known by its place in the elimination only.
        match factor.D.iter().position(|d| d.is_nan() || *d <= 0.0) {
            Some(at) => Err(NotDefinite { row: factor.perm.get(at).copied().unwrap_or(at) }),
            None => Ok(Self {
                order: factor.perm,
                starts: factor.L.colptr,
                rows: factor.L.rowval,
                values: factor.L.nzval,
                inverse: factor.Dinv,
            }),
        }
    }

    /// Number of entries of L below its diagonal.
    pub(super) fn stored(&self) -> usize {
        self.values.len()
    }

    /// Solves A x = b in place, with `room` for as many numbers.
    pub(super) fn solve(&self, x: &mut [f64], room: &mut [f64]) {
        room.iter_mut().zip(&self.order).for_each(|(y, &i)| *y = x[i]);
        let column = |i: usize| {
            let span = self.starts[i]..self.starts[i + 1];
            self.rows[span.clone()].iter().zip(&self.values[span])
        };
        for i in 0..room.len() {
            let known = room[i];
            for (&row, l) in column(i) {
                room[row] -= l * known;
            }
        }
        for i in (0..room.len()).rev() {
            let sum: f64 = column(i).map(|(&row, l)| l * room[row]).sum();
            room[i] = room[i] * self.inverse[i] - sum;
        }
        room.iter().zip(&self.order).for_each(|(y, &i)| x[i] = *y);
    }
}

/// L D Lᵀ with D of any signs, without pivoting; `None` where a pivot vanishes.
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

/// The number of negative eigenvalues of `matrix`, which by Sylvester's law of inertia is the
/// number of negative pivots of L D Lᵀ. `None` where a pivot vanishes.
#[must_use]
pub fn negative_pivots(matrix: &Symmetric) -> Option<usize> {
    if matrix.size() == 0 {
        return Some(0);
    }
    let factor = factorise(matrix)?;
    (!factor.D.iter().any(|d| d.is_nan())).then(|| factor.D.iter().filter(|d| **d < 0.0).count())
}
