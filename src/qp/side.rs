//! Which bound a row stands on.

use super::Rhs;
use super::clamp::ordered_bounds;

/// Which bound a row stands on. Its force is sign · (a number ≥ 0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Side {
    Lower,
    Upper,
}

/// State of a row that is below its lower bound (entry 1), above its upper one (entry 2), neither
/// or both.
const STATES: [Option<Side>; 4] = [None, Some(Side::Lower), Some(Side::Upper), Some(Side::Lower)];

impl Side {
    /// The bound that a row at `y` violates.
    #[inline]
    pub(super) fn violated(y: f64, lo: f64, hi: f64) -> Option<Self> {
        // Looked up rather than branched on: which rows are violated cannot be predicted.
        STATES[usize::from(y < lo) + 2 * usize::from(y > hi)]
    }

    #[inline]
    pub(super) const fn sign(self) -> f64 {
        match self {
            Self::Lower => 1.0,
            Self::Upper => -1.0,
        }
    }

    /// The bound of a row on this side.
    #[inline]
    pub(super) fn bound(self, rhs: &Rhs, row: usize) -> f64 {
        let (lo, hi) = ordered_bounds(rhs.lo[row], rhs.hi[row]);
        if self == Self::Lower { lo } else { hi }
    }
}

#[cfg(test)]
mod tests;
