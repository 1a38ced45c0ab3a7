//! What a round hole did in a step.

/// The impulse of a round hole in one step, along its normal n and its tangent t = (−n_z, n_y).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct HoleStep {
    /// The outward unit normal n at the contact of the step; (0, 0) if the hole was out of reach.
    pub normal: [f64; 2],
    /// Magnitude p ≥ 0 of the normal impulse, N s; the structure gets −p n.
    pub impulse: f64,
    /// Friction impulse along t, N s, signed.
    pub friction: f64,
}

impl HoleStep {
    /// The impulse on the structure along y and z, normal and friction together, N s: −p n + f t.
    #[must_use]
    pub fn push(&self) -> [f64; 2] {
        let ([y, z], p, f) = (self.normal, self.impulse, self.friction);
        [-p * y - f * z, -p * z + f * y]
    }
}
