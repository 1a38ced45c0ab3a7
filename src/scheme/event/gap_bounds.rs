//! The room between the walls in which a body flies.

use crate::flow::Jet;
use crate::scene::Side;
use crate::scheme::exact::{ExactWall, Phase};

/// The nearest wall on either side of the body: its position (m, infinite without a wall) and
/// index.
#[derive(Debug, Clone, Copy)]
pub(super) struct GapBounds {
    low: (f64, Option<usize>),
    high: (f64, Option<usize>),
}

impl GapBounds {
    /// Between `barriers`; `None` if the body is behind the face of an elastic one.
    pub fn between(barriers: &[ExactWall]) -> Option<Self> {
        let mut room = Self { low: (f64::NEG_INFINITY, None), high: (f64::INFINITY, None) };
        for (index, b) in barriers.iter().enumerate() {
            match (b.phase, b.side) {
                (Phase::Touching | Phase::Detached, _) => return None,
                (_, Side::Lower) if b.position > room.low.0 => room.low = (b.position, Some(index)),
                (_, Side::Upper) if b.position < room.high.0 => room.high = (b.position, Some(index)),
                _ => {}
            }
        }
        Some(room)
    }

    /// True if both walls are in front of `q` (m) by more than `by`.
    #[inline]
    pub fn holds(&self, q: f64, by: f64) -> bool {
        q + by < self.high.0 && q - by > self.low.0
    }

    /// The wall that a body with this jet has passed, or else moves to.
    #[inline]
    pub fn ahead(&self, jet: &Jet) -> (f64, Option<usize>) {
        let upper = jet[0] > self.high.0 || (jet[0] >= self.low.0 && jet[1] > 0.0);
        if upper { self.high } else { self.low }
    }
}

#[cfg(test)]
mod tests;
