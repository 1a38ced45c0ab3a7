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

    /// The bound on the change of velocity at the row of an elastic wall over a part of `length`
    /// seconds with the weight θ, from the displacement `w` (m) and the velocity `rate` (m/s), and
    /// the compliance by which its impulse exceeds that bound, m/s per N s; `(0, 0)` for a rigid
    /// one.
    pub fn spring_bound(&self, w: f64, rate: f64, (length, theta): (f64, f64)) -> (f64, f64) {
        let Some(spring) = self.law.spring() else { return (0.0, 0.0) };
        let st = length * theta;
        let compliance = spring.compliance(st);
        (-length * spring.force(w + st * rate, self.g, self.plate(w), st) * compliance, compliance)
    }
}
