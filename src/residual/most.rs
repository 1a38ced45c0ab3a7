//! The larger of two numbers, for running maxima.

/// The larger of two numbers. A NaN is ignored, as by [`f64::max`], but in one instruction.
#[inline(always)]
pub(super) fn most(so_far: f64, x: f64) -> f64 {
    if x > so_far { x } else { so_far }
}
