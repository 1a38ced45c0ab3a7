//! Pseudo-arclength (Keller 1977) for any curve: its steps, the tangent, the correction, and points
//! located between two steps.

use super::super::newton::{ACCEPTED, SOLVED};
use crate::error::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// One point: the unknowns, scaled, and after them the key's value over its scale.
pub(super) type Vector = DVector<f64>;

/// The first, the longest and the shortest step, in the scaled unknowns.
const STEPS: [f64; 3] = [3e-3, 5e-2, 1e-9];

/// Factor by which a step grows after one that succeeded.
pub(super) const GROWTH: f64 = 1.3;

/// Most iterations of the correction in a step that is accepted.
const QUICK: usize = 8;

/// Least cosine between the tangents at both ends of a step: 14°.
const TURN: f64 = 0.97;

/// Most iterations of a correction.
const ITERATIONS: usize = 12;

/// Most corrections that locate a point.
const LOCATED: usize = 60;

/// Steps below this hardly advance. After [`MOST_SHORT`] of them in a row the branch ends: it nears
/// a point at which it becomes singular, such as one where several contacts graze at once.
const SHORT: f64 = 1e-5;
const MOST_SHORT: usize = 100;

/// Amplitudes that are tried along the eigenvector, in the scaled unknowns.
const AMPLITUDES: [f64; 5] = [1e-2, 3e-3, 1e-3, 3e-4, 1e-4];

/// A new branch lies within this many amplitudes of the old one; otherwise Newton's method has
/// found another orbit.
const NEIGHBOURHOOD: f64 = 3.0;

/// The length of the steps along a branch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stride {
    pub length: f64,
    /// Number of short steps in a row.
    short: usize,
}

impl Stride {
    pub fn new() -> Self {
        Self { length: STEPS[0], short: 0 }
    }

    /// Lengthens the step after one that was accepted; `size` is the size of the point it led to.
    ///
    /// # Errors
    /// [`Error::NoOrbit`] where the steps have become too short for too long.
    pub fn grow(&mut self, size: f64) -> Result<()> {
        let size = size.max(1.0);
        self.short = if self.length < SHORT * size { self.short + 1 } else { 0 };
        if self.short > MOST_SHORT {
            return Err(Error::no_orbit(format!(
                "its steps have become so short that it hardly advances ({MOST_SHORT} steps below \
                 {SHORT:.0e}): it nears a point where several contacts graze at once, or nearly so"
            )));
        }
        self.length = (self.length * GROWTH).min(STEPS[1] * size);
        Ok(())
    }

    /// Halves the step after one that was rejected; false where no shorter one is tried.
    pub fn halve(&mut self) -> bool {
        self.length *= 0.5;
        self.length >= STEPS[2]
    }

    /// True if a step with these tangents at its ends, corrected in `iterations`, is accepted.
    pub fn keeps(iterations: usize, before: &Vector, after: &Vector) -> bool {
        iterations <= QUICK && turns_little(before, after)
    }
}

/// True where the tangents `before` and `after` a step differ by a small angle only.
pub(super) fn turns_little(before: &Vector, after: &Vector) -> bool {
    after.dot(before) >= TURN
}

/// `matrix` with the row `border` below it.
pub(super) fn bordered(matrix: &DMatrix<f64>, border: &Vector) -> DMatrix<f64> {
    let n = matrix.nrows();
    DMatrix::from_fn(n + 1, n + 1, |i, j| if i < n { matrix[(i, j)] } else { border[j] })
}

/// `vector` with one more entry.
pub(super) fn extended(vector: &Vector, last: f64) -> Vector {
    DVector::from_iterator(vector.len() + 1, vector.iter().copied().chain([last]))
}

/// The unit vector number `index` of `n`.
pub(super) fn unit(n: usize, index: usize) -> Vector {
    DVector::from_fn(n, |i, _| if i == index { 1.0 } else { 0.0 })
}

/// Refuses a `range` of a key that is none, and one that leaves out the `value` at the start.
pub(super) fn check_range([low, high]: [f64; 2], value: f64) -> Result<()> {
    if !(low.is_finite() && high.is_finite() && low < high) {
        return Err(Error::invalid("range", format!("{low:?} to {high:?}"), "two numbers, the first below the second"));
    }
    if !(low..=high).contains(&value) {
        return Err(Error::invalid("start", value, format!("a value of the key from {low:?} to {high:?}")));
    }
    Ok(())
}

/// The end of `range` that `value` lies beyond.
pub(super) fn beyond(range: [f64; 2], value: f64) -> Option<f64> {
    let [low, high] = range;
    if value < low { Some(low) } else { Some(high).filter(|high| value > *high) }
}

/// `bound`, an end of `range`, over `width`, so that its product with `width` does not leave the
/// range by rounding: the key may accept no value outside.
pub(super) fn scaled(bound: f64, width: f64, range: [f64; 2]) -> f64 {
    let scaled = bound / width;
    match beyond(range, scaled * width) {
        Some(low) if low == range[0] => scaled.next_up(),
        Some(_) => scaled.next_down(),
        None => scaled,
    }
}

/// The unit tangent at a point where the linearised equations are `matrix`, n × (n + 1), in the
/// direction of `along`.
///
/// # Errors
/// [`Error::NoOrbit`] where two branches cross.
pub(super) fn tangent(matrix: &DMatrix<f64>, along: &Vector) -> Result<Vector> {
    let right = unit(along.len(), along.len() - 1);
    let tangent = bordered(matrix, along).lu().solve(&right);
    let tangent = tangent.filter(|t| t.iter().all(|x| x.is_finite())).ok_or_else(singular)?;
    let norm = tangent.norm();
    Ok(tangent / norm)
}

/// The solution in the plane through `guess` with the normal `border`, by Newton's method; with its
/// linearised equations and the number of iterations. `linear` gives residual and derivatives, n ×
/// (n + 1), at a point, and whatever else belongs to them; `parts` takes the two out of it.
///
/// # Errors
/// [`Error::NoOrbit`] where it does not converge; those of `linear`.
pub(super) fn correct<L>(
    guess: &Vector,
    border: &Vector,
    mut linear: impl FnMut(&Vector) -> Result<L>,
    parts: impl Fn(&L) -> (&Vector, &DMatrix<f64>),
) -> Result<(Vector, L, usize)> {
    let mut y = guess.clone();
    let mut last = f64::INFINITY;
    for iteration in 0..ITERATIONS {
        let here = linear(&y)?;
        let (residual, matrix) = parts(&here);
        let size = if residual.is_empty() { 0.0 } else { residual.amax() };
        if !size.is_finite() {
            return Err(Error::no_orbit("in Newton's method the residual became NaN or infinite"));
        }
        if last <= SOLVED || (size >= 0.5 * last && size <= ACCEPTED) {
            return Ok((y, here, iteration));
        }
        let right = extended(residual, border.dot(&(&y - guess)));
        let step = bordered(matrix, border).lu().solve(&right).ok_or_else(singular)?;
        if !step.iter().all(|x| x.is_finite()) || step.norm() > 2.0 {
            return Err(Error::no_orbit("Newton's method led too far from the branch"));
        }
        y -= step;
        last = size;
    }
    Err(Error::no_orbit(format!("Newton's method did not converge: the residual is {last:.1e} of the gap")))
}

/// A point of the branch that leaves `origin` along `aside`, at a small amplitude, and the
/// direction to it; `correct` turns a guess into a point of that branch.
///
/// # Errors
/// [`Error::NoOrbit`] where no such point was found nearby.
pub(super) fn beside(
    origin: &Vector,
    aside: &Vector,
    correct: impl Fn(&Vector) -> Result<Vector>,
) -> Result<(Vector, Vector)> {
    for amplitude in AMPLITUDES {
        let Ok(y) = correct(&(origin + aside * amplitude)) else { continue };
        let away = &y - origin;
        if away.norm() <= NEIGHBOURHOOD * amplitude {
            let along = &away / away.norm();
            return Ok((y, along));
        }
    }
    Err(Error::no_orbit("no orbit was found beside the old branch"))
}

/// The arclength in `span` at which a test function vanishes, by the Illinois method. `ends` are
/// its values at both ends; `at` gives its value at an arclength and further data, which are
/// returned for the root.
///
/// # Errors
/// Those of `at`.
pub(super) fn locate<T>(
    span: [f64; 2],
    ends: [f64; 2],
    mut at: impl FnMut(f64) -> Result<(f64, T)>,
) -> Result<(f64, T)> {
    let [mut a, mut b] = span;
    let [mut fa, mut fb] = ends;
    let mut best: Option<(f64, f64, T)> = None;
    for _ in 0..LOCATED {
        let secant = b - fb * (b - a) / (fb - fa);
        let inside = secant.is_finite() && (secant - a) * (secant - b) < 0.0;
        let c = if inside { secant } else { 0.5 * (a + b) };
        let (fc, point) = at(c)?;
        if !fc.is_finite() {
            return Err(Error::no_orbit("its test function is NaN there"));
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

/// The unit vector x with the least |`matrix` x|.
pub(super) fn null(matrix: DMatrix<f64>) -> Result<Vector> {
    let svd = matrix.svd(false, true);
    let least = svd.singular_values.imin();
    svd.v_t.map(|v| DVector::from(v.row(least).transpose())).ok_or_else(no_eigenvector)
}

pub(super) fn no_eigenvector() -> Error {
    Error::no_orbit("no eigenvector")
}

fn singular() -> Error {
    Error::no_orbit("the equations are singular across the branch: two branches cross there")
}

/// The last arclength in `span`, and the data there, at which a test function that is `first` at
/// the begin of it was found with that sign, by bisection: beyond it the test has another sign, or
/// none, since `at` finds no point. `None` where it was found nowhere.
pub(super) fn last_before<T>(span: [f64; 2], first: f64, at: impl Fn(f64) -> Result<(f64, T)>) -> Option<(f64, T)> {
    let [mut low, mut high] = span;
    let mut last = None;
    for _ in 0..LOCATED {
        let middle = 0.5 * (low + high);
        match at(middle) {
            Ok((value, data)) if value * first > 0.0 => (low, last) = (middle, Some((middle, data))),
            _ => high = middle,
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::{MOST_SHORT, SHORT, Stride};

    /// Takes `count` steps of length `length`, and says whether all succeeded.
    fn taken(stride: &mut Stride, count: usize, length: f64) -> bool {
        (0..count).all(|_| {
            stride.length = length;
            stride.grow(1.0).is_ok()
        })
    }

    #[test]
    fn a_branch_that_hardly_advances_is_left() {
        let mut stride = Stride::new();
        assert!(taken(&mut stride, 10 * MOST_SHORT, 2.0 * SHORT));
        // After one longer step the count starts again.
        assert!(taken(&mut stride, MOST_SHORT, 0.5 * SHORT) && taken(&mut stride, 1, 2.0 * SHORT));
        assert!(taken(&mut stride, MOST_SHORT, 0.5 * SHORT) && !taken(&mut stride, 1, 0.5 * SHORT));
    }
}
