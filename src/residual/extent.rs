//! How far and how fast a run has moved.

use super::largest_residual::running_max;
use super::weights::Weights;

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
        let (q, v, seen, root_mass) = (&q[..n], &v[..n], &weights.seen[..n], &weights.root_mass[..n]);
        let Self { mut reach, mut normal_reach, mut speed } = *self;
        for i in 0..n {
            speed = running_max(speed, (seen[i] * v[i]).abs());
            reach = running_max(reach, q[i].abs());
            normal_reach = running_max(normal_reach, q[i].abs() * root_mass[i]);
        }
        *self = Self { reach, normal_reach, speed };
    }
}
