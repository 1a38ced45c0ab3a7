//! The programme condensed onto its rows.

use super::{Failure, Problem};
use crate::linear::{Factor, Rows};
use nalgebra::{DMatrix, DVector};

/// A factored once, and the Delassus operator W = G A⁻¹ Gᵀ + diag(c), m × m, in units of displacement per force.
pub(super) struct Delassus {
    factor: Factor,
    pub(super) g: Rows,
    /// W.
    pub(super) w: DMatrix<f64>,
    /// √Wᵢᵢ, m entries: a row's displacement over it is comparable with any other row's; 1 where Wᵢᵢ = 0.
    pub(super) weight: DVector<f64>,
    /// b of the present programme, n entries.
    load: Vec<f64>,
    /// x without any row, n entries.
    free: Vec<f64>,
    /// G x without any row, m entries.
    pub(super) y: DVector<f64>,
}

impl Delassus {
    pub(super) fn new(problem: &Problem) -> Result<Self, Failure> {
        let (n, m) = (problem.a.size(), problem.g.count());
        let mut factor = Factor::new(&problem.a).map_err(|_| Failure::NotPositiveDefinite)?;
        let mut w = DMatrix::zeros(m, m);
        let mut response = vec![0.0; n];
        for j in 0..m {
            response.fill(0.0);
            problem.g.add_transposed(j, 1.0, &mut response);
            factor.solve(&mut response);
            for i in 0..m {
                w[(i, j)] = problem.g.dot(i, &response);
            }
        }
        // Symmetric to the last bit, which the factor's rounding is not.
        for j in 0..m {
            for i in 0..j {
                let mean = 0.5 * (w[(i, j)] + w[(j, i)]);
                (w[(i, j)], w[(j, i)]) = (mean, mean);
            }
        }
        for (i, &c) in problem.compliance.iter().enumerate() {
            w[(i, i)] += c;
        }
        let weight = w.diagonal().map(|d| if d > 0.0 { d.sqrt() } else { 1.0 });
        let g = problem.g.clone();
        Ok(Self { factor, g, w, weight, load: vec![0.0; n], free: vec![0.0; n], y: DVector::zeros(m) })
    }

    /// The free motion under b: fills x and y as if there were no rows.
    pub(super) fn release(&mut self, b: &[f64]) -> Result<(), Failure> {
        self.load.copy_from_slice(b);
        self.free.copy_from_slice(b);
        self.factor.solve(&mut self.free);
        super::finite("free motion", &self.free, |v| v.is_finite())?;
        self.g.product(&self.free, self.y.as_mut_slice());
        super::finite("free displacement of row", self.y.as_slice(), |v| v.is_finite())
    }

    /// x = A⁻¹(b + Gᵀ r).
    pub(super) fn respond(&mut self, r: &[f64], x: &mut [f64]) {
        if r.iter().all(|&force| force == 0.0) {
            x.copy_from_slice(&self.free);
            return;
        }
        x.copy_from_slice(&self.load);
        for (i, &force) in r.iter().enumerate().filter(|(_, force)| **force != 0.0) {
            self.g.add_transposed(i, force, x);
        }
        self.factor.solve(x);
    }
}
