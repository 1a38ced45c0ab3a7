//! Sums over slices.

use crate::linear::sum_of_terms;

/// a · b, of long slices in four independent sums.
#[inline]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    if a.len() < 8 {
        return a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b);
    }
    sum_of_terms(a, b, |term| term)
}

/// out += factor · x.
#[inline]
pub(super) fn add(factor: f64, x: &[f64], out: &mut [f64]) {
    for (out, x) in out.iter_mut().zip(x) {
        *out += factor * x;
    }
}

#[cfg(test)]
mod tests;
