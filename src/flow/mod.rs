//! The closed-form motion of one degree of freedom between two events.

/// A stretch of exact motion on which the set of touching walls does not change.
///
/// Either the body flows, m q̈ + (c + Σc_a) q̇ + (k + Σk_a) q = f(t) + Σk_a g over the touching elastic walls a, or it
/// rests against a rigid wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Arc {}

impl Arc {
    /// Displacement (m) and velocity (m/s) at `t`, from the right at the start and from the left at the end.
    #[must_use]
    pub fn state(&self, _t: f64) -> (f64, f64) {
        todo!()
    }
    /// Acceleration (m/s²) at `t`.
    #[must_use]
    pub fn acceleration(&self, _t: f64) -> f64 {
        todo!()
    }
    /// Force of wall `wall` on the body at `t`, N, signed: 0 if it does not touch.
    #[must_use]
    pub fn contact_force(&self, _wall: usize, _t: f64) -> f64 {
        todo!()
    }
    /// Impulse of wall `wall` on the body over [from, to] within the arc, N s, in closed form.
    #[must_use]
    pub fn contact_impulse(&self, _wall: usize, _from: f64, _to: f64) -> f64 {
        todo!()
    }
}
