//! The impulses of a round hole in a step.

/// The impulse of a round hole in one step, along its normal n and its tangent t = (−n_z, n_y).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct HoleStep {
    /// The outward unit normal n at the contact of the step, in exact motion at its end; (0, 0) if
    /// the hole was out of reach.
    pub normal: [f64; 2],
    /// Magnitude p ≥ 0 of the normal impulse, N s; the structure gets −p n. In exact motion ∫ of
    /// the magnitude of the force over the step, with `jump`.
    pub impulse: f64,
    /// Friction impulse along t, N s, signed.
    pub friction: f64,
    /// The part of `impulse` that acted at the instant of the step's end, along the normal there,
    /// N s; 0 for schemes on a grid.
    pub jump: f64,
    /// The impulse on the structure in addition to −p n + f t, since the normal turned in the step,
    /// N s along y and z; 0 for schemes on a grid, which use one normal per step.
    pub turned: [f64; 2],
}

impl HoleStep {
    /// The impulse on the structure along y and z, normal and friction together, N s: −p n + f t,
    /// and the part that the turning of the normal adds.
    #[must_use]
    pub fn push(&self) -> [f64; 2] {
        let ([y, z], p, f) = (self.normal, self.impulse, self.friction);
        [-p * y - f * z + self.turned[0], -p * z + f * y + self.turned[1]]
    }
}
