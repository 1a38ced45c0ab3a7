//! A special point between two points of a branch.

use super::curve::{Curve, Linear, Vector};
use crate::error::{Error, Result};

/// Most corrections.
const STEPS: usize = 60;

/// The point on the arc from `y` along `tangent`, between the arclengths `span`, where `test`
/// vanishes, whose values at both ends are `ends`; with its arclength. By the Illinois method, each
/// value at a point of the branch itself.
///
/// # Errors
/// Those of a correction.
pub(super) fn locate(
    curve: &Curve<'_>,
    y: &Vector,
    tangent: &Vector,
    span: [f64; 2],
    ends: [f64; 2],
    test: impl Fn(&Curve<'_>, &Vector, &Linear) -> Result<f64>,
) -> Result<(f64, Vector)> {
    let [mut a, mut b] = span;
    let [mut fa, mut fb] = ends;
    let mut best: Option<(f64, f64, Vector)> = None;
    for _ in 0..STEPS {
        let secant = b - fb * (b - a) / (fb - fa);
        let inside = secant.is_finite() && (secant - a) * (secant - b) < 0.0;
        let c = if inside { secant } else { 0.5 * (a + b) };
        let (point, linear, _) = curve.correct(&(y + tangent * c), tangent)?;
        let fc = test(curve, &point, &linear)?;
        if !fc.is_finite() {
            return Err(Error::no_orbit("its test function is no number there"));
        }
        let better = best.as_ref().is_none_or(|(size, ..)| fc.abs() < *size);
        let settled = !better && (b - a).abs() <= 1e-13 * span[1].abs();
        if better {
            best = Some((fc.abs(), c, point));
        }
        if fc == 0.0 || settled || (b - a).abs() <= 1e-15 * span[1].abs() {
            break;
        }
        if fc * fb < 0.0 {
            (a, fa) = (b, fb);
        } else {
            fa *= 0.5;
        }
        (b, fb) = (c, fc);
    }
    best.map(|(_, s, point)| (s, point)).ok_or_else(|| Error::no_orbit("it was not located"))
}
