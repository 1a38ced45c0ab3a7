//! The scenes over which branches are followed.

use crate::error::Result;
use crate::scene::Scene;
use crate::variation::SceneTangent;

/// Relative distance of the scenes from whose numbers those of the derivative of the scene are
/// taken.
pub(super) const DIFFERENCE: f64 = 1e-6;

/// A scene for each value of a key.
///
/// # Errors
/// [`Error::Invalid`](crate::Error::Invalid) or [`Error::Case`](crate::Error::Case) for a value
/// that the key does not accept.
pub type Family<'a> = dyn Fn(f64) -> Result<Scene> + 'a;

/// The derivative of the scene `base` of `family` at `value` with respect to the key, whose range
/// has the width `width`: one-sided where the key accepts no more values on one side.
///
/// # Errors
/// Those of the family where it accepts values on neither side; as [`SceneTangent::between`].
pub(super) fn tangent(family: &Family<'_>, value: f64, width: f64, base: &Scene) -> Result<SceneTangent> {
    let step = DIFFERENCE * value.abs().max(1e-3 * width);
    let end = |value: f64| Ok((value, family(value)?));
    let here = || (value, base.clone());
    let ends = match (end(value - step), end(value + step)) {
        (Ok(below), Ok(above)) => [below, above],
        (Ok(below), Err(_)) => [below, here()],
        (Err(_), Ok(above)) => [here(), above],
        (Err(error), Err(_)) => return Err(error),
    };
    SceneTangent::between("key", value, base.clone(), ends)
}
