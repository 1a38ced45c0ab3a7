//! Steps are judged by the functions that they are steps of: by many of their values, or by the
//! roots and minima from which they are made.

mod first;
mod steps;
mod touch;

use super::*;
use crate::hash::Draws;

/// Rounding of a sum of five terms, in shares of the sum of their magnitudes.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Draws {
    /// Of either sign, and 0 in a third of the cases.
    fn number(&mut self, octaves: f64) -> f64 {
        self.between(-1.5, 1.5).round() * self.size(octaves)
    }

    /// c₀ > 0, c₁, c₂, c₃, a bound and a window.
    fn polynomial(&mut self) -> ([f64; 4], f64, f64) {
        let c = [self.size(3.0), self.number(8.0), self.number(10.0), self.number(12.0)];
        (c, self.number(12.0).abs(), self.size(6.0))
    }

    /// The derivatives at 0 of a polynomial whose first root above 0 is known, and single: the
    /// second is a quarter of it behind, or farther.
    fn known(&mut self, degree: usize) -> ([f64; 5], f64) {
        let root = self.size(10.0);
        let mut c = [self.size(10.0), 0.0, 0.0, 0.0, 0.0];
        c[1] = -c[0] / root;
        let mut left = degree - 1;
        while left > 0 {
            let dip = (self.number(3.0), self.size(3.0));
            let square = dip.0 * dip.0 + dip.1 * dip.1;
            // Times 1 + au + bu², u in units of the root: a root behind it, one below 0, and a
            // minimum that misses 0.
            let (a, b) = match self.between(0.0, left.min(2) as f64 + 1.0) {
                x if x < 1.0 => (-1.0 / (1.25 + self.size(10.0)), 0.0),
                x if x < 2.0 => (self.size(10.0), 0.0),
                _ => (-2.0 * dip.0 / square, 1.0 / square),
            };
            for n in (1..5).rev() {
                c[n] += a / root * c[n - 1] + if n > 1 { b / (root * root) * c[n - 2] } else { 0.0 };
            }
            left -= if b == 0.0 { 1 } else { 2 };
        }
        (std::array::from_fn(|n| c[n] * factorial(n)), root)
    }

    /// Such a polynomial of degree 3 or 4, and a noise that the value 0 at the root has by rounding
    /// or more, yet small.
    fn noisy(&mut self) -> ([f64; 5], f64, f64) {
        loop {
            let degree = if self.chance(0.5) { 3 } else { 4 };
            let (c, root) = self.known(degree);
            let noise = value(&c, root).1 * self.between(-44.0, -20.0).exp2();
            if noise < 0.01 * c[0] {
                return (c, root, noise);
            }
        }
    }
}

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

/// Σ cₙuⁿ/n!, and the sum of the magnitudes of its terms.
fn value(c: &[f64], u: f64) -> (f64, f64) {
    let term = |n: usize| c[n] * u.powi(n as i32) / factorial(n);
    ((0..c.len()).map(term).sum(), (0..c.len()).map(|n| term(n).abs()).sum())
}

/// The derivatives `by` later, or earlier.
fn later(c: &[f64; 5], by: f64) -> [f64; 5] {
    std::array::from_fn(|n| value(&c[n..], by).0)
}

/// What is known of a function with these derivatives, which |g⁗| ≤ `bound`.
fn below(c: &[f64; 5], bound: f64, noise: f64) -> Below {
    Below { c: [c[0], c[1], c[2], c[3]], fourth: c[4], bound, noise: [noise, 0.0, 0.0, 0.0], passes_touch: false }
}

/// The lowest function with these derivatives and |g⁗| ≤ b: if it stays above 0, all do.
fn lowest([c0, c1, c2, c3]: [f64; 4], b: f64) -> [f64; 5] {
    [c0, c1, c2, c3, -b]
}

/// How far rounding may move a root: by the rounding of the value there and here over the slope.
fn late(c: &[f64; 5], root: f64) -> f64 {
    2.0 * ROUNDING * value(c, root).1 / value(&c[1..], root).0.abs()
}

/// Asserts that the polynomial does not fall below 0 before `s`, within rounding.
fn assert_above(c: &[f64; 5], s: f64) {
    for part in 0..300 {
        // Both ends are looked at closely.
        let x = part as f64 / 300.0;
        let u = s * x * x * (3.0 - 2.0 * x);
        let (g, size) = value(c, u);
        assert!(g >= -ROUNDING * size, "{c:?} is {g:e} at {u:e} of {s:e}");
    }
}
