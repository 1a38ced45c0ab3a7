//! Parts of Newton's method on the map from period to period: states as vectors, their scales, the
//! step, and the multipliers of the map's derivative.

use crate::scene::State;
use nalgebra::{Complex, DMatrix, DVector};
use std::cmp::Ordering;
use std::f64::consts::TAU;

/// A state of a periodic orbit of a structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Strobe {
    /// Cycles of the forcing period from t = 0: an instant at which nothing happens.
    pub phase: f64,
    /// The state then.
    pub state: State,
}

/// The scales of a state: m and m/s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scales {
    pub length: f64,
    pub speed: f64,
}

impl Scales {
    /// The scales of motions of size `length` (m) under loads of period `period` (s).
    pub fn new(length: f64, period: f64) -> Self {
        Self { length, speed: length * TAU / period }
    }

    /// A state or a difference of states without dimension.
    pub fn scaled(self, x: &DVector<f64>) -> DVector<f64> {
        let n = x.len() / 2;
        DVector::from_fn(x.len(), |i, _| x[i] / self.of(i, n))
    }

    /// The state, with dimension, of a scaled one.
    pub fn unscaled(self, x: &DVector<f64>) -> DVector<f64> {
        let n = x.len() / 2;
        DVector::from_fn(x.len(), |i, _| x[i] * self.of(i, n))
    }

    /// The derivative of scaled states with respect to scaled states.
    pub fn similar(self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let n = matrix.nrows() / 2;
        DMatrix::from_fn(2 * n, 2 * n, |i, j| matrix[(i, j)] * (self.of(j, n) / self.of(i, n)))
    }

    /// The scale of entry `i` of a state of `n` degrees of freedom.
    pub fn of(self, i: usize, n: usize) -> f64 {
        if i < n { self.length } else { self.speed }
    }

    /// The largest scaled entry of a difference of states; NaN if an entry is NaN.
    pub fn size(self, difference: &DVector<f64>) -> f64 {
        let n = difference.len() / 2;
        let scaled = |(i, x): (usize, &f64)| x.abs() / self.of(i, n);
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
    all.sort_by(|a, b| largest_first([a.re, a.im], [b.re, b.im]));
    all
}

/// The order of multipliers, real and imaginary part: the largest first, of a conjugate pair the
/// one with the positive imaginary part.
pub(super) fn largest_first([a, ai]: [f64; 2], [b, bi]: [f64; 2]) -> Ordering {
    b.hypot(bi).total_cmp(&a.hypot(ai)).then(bi.total_cmp(&ai))
}

/// A multiplier nearer to the unit circle than this lies on it: more than the rounding of an orbit
/// of some dozen events, and less than any damping that a run can show.
const ON_THE_CIRCLE: f64 = 1e-10;

/// True if all multipliers, real and imaginary part, lie inside the unit circle.
pub(crate) fn is_stable(multipliers: &[[f64; 2]]) -> bool {
    multipliers.iter().all(|[re, im]| re.hypot(*im) < 1.0 - ON_THE_CIRCLE)
}

/// True if a multiplier of this modulus lies on the unit circle.
#[cfg(feature = "cli")]
pub(crate) fn is_on_the_circle(modulus: f64) -> bool {
    (modulus - 1.0).abs() <= ON_THE_CIRCLE
}

/// `stable`, `unstable`, or `neutral` for an orbit whose largest multiplier lies on the unit
/// circle, as without damping at restitution 1: runs neither settle on it nor leave it, as far as
/// the linear part of their motion tells.
#[cfg(feature = "cli")]
pub(crate) fn stability_in_words(multipliers: &[[f64; 2]]) -> &'static str {
    let largest = multipliers.iter().map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max);
    match (is_stable(multipliers), is_on_the_circle(largest)) {
        (true, _) => "stable",
        (false, true) => "neutral",
        (false, false) => "unstable",
    }
}

/// The square of a multiplier.
pub(super) fn square([re, im]: [f64; 2]) -> [f64; 2] {
    [re * re - im * im, 2.0 * re * im]
}
