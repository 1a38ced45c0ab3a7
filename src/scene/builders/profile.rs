//! A field along a structure, given at points (position m, value): linear between them, or the
//! cubic spline.

use crate::error::{Error, Result, Subject};

/// Checks that the positions increase from 0 to `length` (m) and that all numbers are finite.
pub(super) fn check(subject: &Subject, points: &[(f64, f64)], length: f64) -> Result<()> {
    let expected = || format!("two points or more (position, value), positions increasing from 0 to {length:?} m");
    let (Some(first), Some(last), true) = (points.first(), points.last(), points.len() >= 2) else {
        return Err(Error::invalid(subject.clone(), format!("{} points", points.len()), expected()));
    };
    if let Some(point) = points.iter().find(|p| !p.0.is_finite() || !p.1.is_finite()) {
        return Err(Error::invalid(subject.clone(), format!("{point:?}"), "finite numbers"));
    }
    if let Some(pair) = points.windows(2).find(|pair| pair[1].0 <= pair[0].0) {
        let value = format!("{:?} after {:?} m", pair[1].0, pair[0].0);
        return Err(Error::invalid(subject.clone(), value, expected()));
    }
    if first.0.abs() > 1e-9 * length || (last.0 - length).abs() > 1e-9 * length {
        return Err(Error::invalid(
            subject.clone(),
            format!("positions from {:?} to {:?} m", first.0, last.0),
            expected(),
        ));
    }
    Ok(())
}

/// Index of the interval that contains `x`; `points` has at least two entries.
fn interval(points: &[(f64, f64)], x: f64) -> usize {
    points.partition_point(|p| p.0 <= x).clamp(1, points.len() - 1) - 1
}

/// The value at `x`, linear between checked `points`.
pub(super) fn linear(points: &[(f64, f64)], x: f64) -> f64 {
    let i = interval(points, x);
    let ((x0, y0), (x1, y1)) = (points[i], points[i + 1]);
    let t = (x - x0) / (x1 - x0);
    y0 * (1.0 - t) + y1 * t
}

/// Slopes of the cubic spline at checked `points`: its second derivative is continuous, and 0 at an
/// end that is not clamped; a clamped end has slope 0.
pub(super) fn slopes(points: &[(f64, f64)], clamped: [bool; 2]) -> Vec<f64> {
    let n = points.len();
    let secant = |i: usize| (points[i + 1].1 - points[i].1) / (points[i + 1].0 - points[i].0);
    let width = |i: usize| points[i + 1].0 - points[i].0;
    // Row i: below s(i−1) + diagonal s(i) + above s(i+1) = right, by elimination from the top.
    let (mut above, mut right) = (vec![0.0; n], vec![0.0; n]);
    for i in 0..n {
        let (below, diagonal, next, value) = match i {
            0 if clamped[0] => (0.0, 1.0, 0.0, 0.0),
            0 => (0.0, 2.0, 1.0, 3.0 * secant(0)),
            _ if i + 1 == n && clamped[1] => (0.0, 1.0, 0.0, 0.0),
            _ if i + 1 == n => (1.0, 2.0, 0.0, 3.0 * secant(n - 2)),
            _ => {
                let (a, b) = (1.0 / width(i - 1), 1.0 / width(i));
                (a, 2.0 * (a + b), b, 3.0 * (a * secant(i - 1) + b * secant(i)))
            }
        };
        let (last_above, last_right) = if i == 0 { (0.0, 0.0) } else { (above[i - 1], right[i - 1]) };
        let pivot = diagonal - below * last_above;
        above[i] = next / pivot;
        right[i] = (value - below * last_right) / pivot;
    }
    for i in (0..n - 1).rev() {
        right[i] -= above[i] * right[i + 1];
    }
    right
}

/// Value and slope at `x` of the cubic through checked `points` with the `slopes` there.
pub(super) fn cubic(points: &[(f64, f64)], slopes: &[f64], x: f64) -> [f64; 2] {
    let i = interval(points, x);
    let ((x0, y0), (x1, y1)) = (points[i], points[i + 1]);
    let h = x1 - x0;
    let (t, secant) = ((x - x0) / h, (y1 - y0) / h);
    // y = y0 + t h (s0 + t (a + t b)).
    let (a, b) = (3.0 * secant - 2.0 * slopes[i] - slopes[i + 1], slopes[i] + slopes[i + 1] - 2.0 * secant);
    [y0 + t * h * (slopes[i] + t * (a + t * b)), slopes[i] + t * (2.0 * a + 3.0 * t * b)]
}
