//! What Newton's method on a map from period to period needs: states as vectors, their scales, its
//! step, and the multipliers of the map's derivative.

use crate::scene::State;
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::TAU;

/// The scales of a state: m and m/s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scales {
    pub length: f64,
    pub speed: f64,
}

impl Scales {
    /// Those of motions of that length (m) under loads of that period (s).
    pub fn new(length: f64, period: f64) -> Self {
        Self { length, speed: length * TAU / period }
    }

    /// The largest entry of a difference of states; NaN if one is.
    pub fn size(self, difference: &DVector<f64>) -> f64 {
        let n = difference.len() / 2;
        let scaled = |(i, x): (usize, &f64)| x.abs() / if i < n { self.length } else { self.speed };
        difference.iter().enumerate().map(scaled).fold(0.0, |most, x| if x.is_nan() { f64::NAN } else { x.max(most) })
    }
}

/// A state as one vector: displacements, then velocities.
pub(crate) fn vector(q: &[f64], v: &[f64]) -> DVector<f64> {
    DVector::from_iterator(q.len() + v.len(), q.iter().chain(v).copied())
}

/// The state that a vector holds.
pub(crate) fn state(x: &DVector<f64>) -> State {
    let (q, v) = x.as_slice().split_at(x.len() / 2);
    State { q: q.to_vec(), v: v.to_vec() }
}

/// Newton's step (1 − P′)⁻¹ (P(x) − x) towards x = P(x); `None` where a multiplier is 1.
pub(crate) fn newton_step(derivative: &DMatrix<f64>, gap: &DVector<f64>) -> Option<DVector<f64>> {
    (DMatrix::identity(gap.len(), gap.len()) - derivative).lu().solve(gap)
}

/// The eigenvalues of a map's derivative, the largest first.
pub(crate) fn multipliers(derivative: &DMatrix<f64>) -> Vec<Complex<f64>> {
    let mut all: Vec<Complex<f64>> = derivative.complex_eigenvalues().iter().copied().collect();
    all.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
    all
}
