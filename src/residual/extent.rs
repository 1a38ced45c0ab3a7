//! How far and how fast a run has moved.

use super::weights::Weights;
use super::worst::most;

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
    pub fn see(&mut self, q: &[f64], v: &[f64], weights: &Weights, n: usize) {
        let (q, v, seen, root_mass) = (&q[..n], &v[..n], &weights.seen[..n], &weights.root_mass[..n]);
        let Self { mut reach, mut normal_reach, mut speed } = *self;
        for i in 0..n {
            speed = most(speed, (seen[i] * v[i]).abs());
            reach = most(reach, q[i].abs());
            normal_reach = most(normal_reach, q[i].abs() * root_mass[i]);
        }
        *self = Self { reach, normal_reach, speed };
    }
}
