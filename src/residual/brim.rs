//! From which distance on a body touches a round hole at the start of a step, under the promise of
//! [`Turning`].

use crate::step::Turning;

/// The least share of γ from which on a contact lasts.
const LEAST: f64 = 0.5;

/// Distances from the centre of a hole, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Brim {
    /// From here on the body touches, whatever was before.
    touched: f64,
    /// From here on the contact of the step before lasts; infinite without one.
    lasting: f64,
}

impl Brim {
    /// Of a hole of this gap γ (m), with the velocity `rate` (m/s) in a step of `h` seconds.
    /// `turned` is the largest angle by which the normal turned in a step of the contact (rad), 0
    /// if the hole did not push in the step before.
    pub fn new(turning: &Turning, gap: f64, (rate, h): ([f64; 2], f64), turned: f64) -> Self {
        let arc = (h * rate[0].hypot(rate[1]) / gap).powi(2) / 8.0;
        let touched = gap * (1.0 - arc.max(turning.sagitta).min(turning.deepest));
        let lasting = if turned > 0.0 { gap * LEAST.max(1.0 - turned.powi(2) / 2.0) } else { f64::INFINITY };
        Self { touched, lasting }
    }

    /// By how much a body at this distance touches, m.
    pub fn passed(&self, distance: f64) -> f64 {
        distance - self.touched.min(self.lasting)
    }

    /// By how much a body at this distance, which is at `reach` where the promise takes the normal,
    /// keeps a hole in play by a contact that lasts, m; −∞ without one.
    pub fn keeps(&self, distance: f64, reach: f64) -> f64 {
        distance.min(reach) - self.lasting
    }
}
