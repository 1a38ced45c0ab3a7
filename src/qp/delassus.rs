//! The programme condensed onto its rows.

use super::{Failure, Problem};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// A factored once, and the Delassus operator W = G A⁻¹ Gᵀ + diag(c), m × m, in units of displacement per force.
pub(super) struct Delassus {
    factor: Cholesky<f64, Dyn>,
    g: DMatrix<f64>,
    /// A⁻¹ Gᵀ, n × m.
    response: DMatrix<f64>,
    /// W.
    pub(super) w: DMatrix<f64>,
    /// √Wᵢᵢ, m entries: a row's displacement over it is comparable with any other row's; 1 where Wᵢᵢ = 0.
    pub(super) weight: DVector<f64>,
    /// x without any row, n entries.
    free: DVector<f64>,
    /// G x without any row, m entries.
    pub(super) y: DVector<f64>,
}

impl Delassus {
    pub(super) fn new(problem: &Problem) -> Result<Self, Failure> {
        let a = &problem.a;
        let n = a.ncols();
        for j in 0..n {
            for i in 0..j {
                // Symmetric to rounding of an assembled matrix, relative to its diagonal.
                if (a[(i, j)] - a[(j, i)]).abs() > 1e-12 * (a[(i, i)] * a[(j, j)]).abs().sqrt() {
                    return Err(Failure::NotPositiveDefinite);
                }
            }
        }
        let factor = Cholesky::new(a.clone()).ok_or(Failure::NotPositiveDefinite)?;
        let response = factor.solve(&problem.g.transpose());
        // W = VᵀV with V = L⁻¹Gᵀ is symmetric to the last bit, which G times the response is not.
        let mut half = problem.g.transpose();
        if !factor.l_dirty().solve_lower_triangular_mut(&mut half) {
            return Err(Failure::NotPositiveDefinite);
        }
        let mut w = half.tr_mul(&half);
        for (i, &c) in problem.compliance.iter().enumerate() {
            w[(i, i)] += c;
        }
        let weight = w.diagonal().map(|d| if d > 0.0 { d.sqrt() } else { 1.0 });
        let y = DVector::zeros(problem.g.nrows());
        Ok(Self { factor, g: problem.g.clone(), response, w, weight, free: DVector::zeros(n), y })
    }

    /// The free motion under b: fills x and y as if there were no rows.
    pub(super) fn release(&mut self, b: &[f64]) -> Result<(), Failure> {
        self.free.copy_from_slice(b);
        self.factor.solve_mut(&mut self.free);
        super::finite("free motion", self.free.as_slice(), |v| v.is_finite())?;
        self.y.gemv(1.0, &self.g, &self.free, 0.0);
        super::finite("free displacement of row", self.y.as_slice(), |v| v.is_finite())
    }

    /// x = x_free + A⁻¹ Gᵀ r.
    pub(super) fn respond(&self, r: &[f64], x: &mut [f64]) {
        x.copy_from_slice(self.free.as_slice());
        for (column, &force) in self.response.column_iter().zip(r) {
            if force != 0.0 {
                for (x, response) in x.iter_mut().zip(column.iter()) {
                    *x += response * force;
                }
            }
        }
    }
}
