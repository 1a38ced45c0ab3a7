//! How far and how fast a run has moved.

use super::weights::Weights;
use crate::linear::largest;

/// The largest displacements and velocities so far.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Extent {
    /// Largest |q|, m, and its value in the metric of the mass, m √kg.
    pub reach: f64,
    pub normal_reach: f64,
    /// Largest velocity that a rigid wall sees, m/s.
    pub speed: f64,
}

impl Extent {
    /// Notes displacements (m) and velocities (m/s), n of each.
    #[inline(always)]
    pub fn observe(&mut self, q: &[f64], v: &[f64], weights: &Weights, n: usize) {
        let sizes = |[q, v, seen, root_mass]: [f64; 4]| [q.abs(), q.abs() * root_mass, (seen * v).abs()];
        let so_far = [self.reach, self.normal_reach, self.speed];
        let [reach, normal_reach, speed] = largest(so_far, n, [q, v, &weights.seen, &weights.root_mass], sizes);
        *self = Self { reach, normal_reach, speed };
    }
}
