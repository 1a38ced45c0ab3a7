//! A flat wall on its row, as the schemes on a grid use it.

use crate::scene::{Side, Wall, WallLaw};

/// A flat wall without its name and row; a round one is an upper wall with a row of zeros, which
/// never touches.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlatRow {
    /// Index of the wall in the scene.
    pub index: usize,
    pub upper: bool,
    /// +1 lower, −1 upper: the sign of its force.
    pub sign: f64,
    /// The position, m.
    pub g: f64,
    pub law: WallLaw,
}

impl FlatRow {
    pub fn new(index: usize, wall: &Wall) -> Self {
        Self { index, upper: wall.side() == Side::Upper, sign: wall.side().sign(), g: wall.position(), law: wall.law }
    }

    /// Depth behind the wall, m.
    #[inline]
    pub fn depth(&self, w: f64) -> f64 {
        self.sign * (self.g - w)
    }

    /// The coordinate of the plate of the wall's dashpot when the body is at `w`: `w` inside the
    /// wall, the wall's position outside.
    #[inline]
    pub fn plate(&self, w: f64) -> f64 {
        if self.upper { w.max(self.g) } else { w.min(self.g) }
    }
}
