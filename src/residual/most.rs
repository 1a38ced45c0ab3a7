//! The larger of two numbers, as running maxima take it.

/// The larger of two; what is not a number is passed over, as by [`f64::max`], but in one instruction.
#[inline(always)]
pub(super) fn most(so_far: f64, x: f64) -> f64 {
    if x > so_far { x } else { so_far }
}
