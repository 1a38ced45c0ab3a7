//! The first root of a polynomial on an interval, never skipped: by its Bernstein coefficients.
//!
//! On [0, X] a polynomial lies within the convex hull of its Bernstein coefficients: if all are
//! above 0, it has no root. De Casteljau's subdivision halves the interval, the left half first,
//! until one change of sign is left, which is one root (Descartes' rule); Newton's method, kept
//! inside the interval, finds it to rounding. Where a minimum is 0 to rounding the subdivision ends
//! at it: a touch counts as a root.

use crate::flow::{TERMS, value};

/// Maximum number of halvings: then an interval is one point of the stretch to rounding.
const DEPTH: usize = 52;

/// Maximum number of steps of the final search; at least every second one halves the interval.
const REFINEMENTS: usize = 120;

/// Number of terms of the quick test; the rest of the polynomial is bounded by the sum of its
/// magnitudes.
const QUICK: usize = 8;

/// The smallest x in [0, `end`] at which p(x) = Σ cₖ xᵏ ≤ 0, for p(0) > 0; `None` if there is none.
pub(super) fn first_root(c: &[f64], end: f64) -> Option<f64> {
    let count = c.len().min(TERMS);
    let mut p = [0.0; TERMS];
    let (mut power, mut fall) = (1.0, 0.0);
    for (p, c) in p.iter_mut().zip(&c[..count]) {
        *p = c * power;
        power *= end;
        fall += p.min(0.0);
    }
    // The first coefficient is positive, so `fall` does not include it.
    if p[0] + fall > 0.0 {
        return None;
    }
    if count > QUICK {
        let tail: f64 = p[QUICK..count].iter().map(|c| c.abs()).sum();
        let mut b = [0.0; QUICK];
        b.copy_from_slice(&p[..QUICK]);
        to_bernstein(&mut b);
        if b.iter().all(|b| *b > tail) {
            return None;
        }
    }
    let mut b = p;
    to_bernstein(&mut b[..count]);
    descend(&p[..count], b, count).map(|x| x * end)
}

/// Power coefficients to Bernstein coefficients on [0, 1]: bⱼ = Σ C(j,k)/C(N,k) cₖ, every weight at
/// most 1.
fn to_bernstein(b: &mut [f64]) {
    let top = b.len() - 1;
    let mut binomial = 1.0;
    for (k, c) in b.iter_mut().enumerate() {
        *c /= binomial;
        binomial *= (top - k) as f64 / (k + 1) as f64;
    }
    for level in 0..top {
        for j in (level + 1..=top).rev() {
            b[j] += b[j - 1];
        }
    }
}

/// Subdivides, the left half first.
fn descend(p: &[f64], b: [f64; TERMS], count: usize) -> Option<f64> {
    // The right halves still to be examined: one for each level of the subdivision.
    let mut waiting = [(0.0, 0.0); DEPTH + 2];
    let mut depth = 0;
    let (mut low, mut high, mut b) = (0.0, 1.0, b);
    loop {
        let negative = b[..count].iter().any(|b| *b <= 0.0);
        if negative {
            if b[0] <= 0.0 {
                return Some(low);
            }
            let changes = b[..count].windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count();
            if changes == 1 && b[count - 1] <= 0.0 {
                return Some(refine(p, low, high));
            }
            if depth >= DEPTH {
                return Some(low);
            }
            let middle = 0.5 * (low + high);
            waiting[depth] = (middle, high);
            depth += 1;
            high = middle;
            left_half(&mut b[..count]);
            continue;
        }
        if depth == 0 {
            return None;
        }
        depth -= 1;
        (low, high) = waiting[depth];
        b = over(p, low, high, count);
    }
}

/// Bernstein coefficients on the left half of the interval, by de Casteljau's algorithm.
fn left_half(b: &mut [f64]) {
    for level in 1..b.len() {
        for j in (level..b.len()).rev() {
            b[j] = 0.5 * (b[j - 1] + b[j]);
        }
    }
}

/// Bernstein coefficients of p on [`low`, `high`]: p shifted to `low` and scaled, by Horner's
/// scheme.
fn over(p: &[f64], low: f64, high: f64, count: usize) -> [f64; TERMS] {
    let mut shifted = [0.0; TERMS];
    shifted[..count].copy_from_slice(p);
    for level in 0..count {
        for k in (level..count - 1).rev() {
            shifted[k] += low * shifted[k + 1];
        }
    }
    let mut power = 1.0;
    for c in &mut shifted[..count] {
        *c *= power;
        power *= high - low;
    }
    to_bernstein(&mut shifted[..count]);
    shifted
}

/// The single root between `low`, where p is above 0, and `high`.
fn refine(p: &[f64], mut low: f64, mut high: f64) -> f64 {
    let mut x = 0.5 * (low + high);
    for _ in 0..REFINEMENTS {
        let (mut at, mut rate) = (0.0, 0.0);
        for c in p.iter().rev() {
            rate = rate * x + at;
            at = at * x + c;
        }
        if at > 0.0 {
            low = x;
        } else {
            high = x;
        }
        let newton = x - at / rate;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if next == x || at == 0.0 || (next - x).abs() <= 0.5 * f64::EPSILON * x {
            return if at == 0.0 { x } else { next };
        }
        x = next;
    }
    x
}

/// The largest value of a polynomial on [0, `end`], located by bisection of its derivative.
pub(super) fn highest(c: &[f64], sign: f64, end: f64) -> f64 {
    let rate = |x: f64| sign * c.iter().enumerate().skip(1).rev().fold(0.0, |sum, (k, c)| sum * x + k as f64 * c);
    let mut best = (sign * value(c, 0.0)).max(sign * value(c, end));
    let (mut left, mut before) = (0.0, rate(0.0));
    for part in 1..=PARTS {
        let right = end * part as f64 / PARTS as f64;
        let after = rate(right);
        // A peak may be at the border of two parts.
        if before > 0.0 && after <= 0.0 {
            let (mut low, mut high) = (left, right);
            // The polynomial is flat at its peak: 2⁻³⁰ of the interval is 2⁻⁶⁰ of its variation.
            for _ in 0..30 {
                let middle = 0.5 * (low + high);
                if rate(middle) > 0.0 { low = middle } else { high = middle }
            }
            best = best.max(sign * value(c, low));
        }
        (left, before) = (right, after);
    }
    best
}

/// Number of parts of a stretch; a force has at most one peak in each: a quarter of a radian of its
/// fastest motion.
const PARTS: usize = 8;

#[cfg(test)]
mod tests;
