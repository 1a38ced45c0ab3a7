//! How far and how fast a run has moved.

use super::weights::Weights;
use crate::linear::{Lanes, Pass, pass};
use pulp::Simd;

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
    pub fn observe<S: Simd>(&mut self, simd: S, q: &[f64], v: &[f64], weights: &Weights, n: usize) {
        let state = [q, v, &weights.seen, &weights.root_mass];
        let [reach, normal_reach, speed] = pass(simd, n, (state, []), &StateSizes);
        self.reach = reach.largest(self.reach);
        self.normal_reach = normal_reach.largest(self.normal_reach);
        self.speed = speed.largest(self.speed);
    }
}

/// |q|, |q|√m and the velocity that a wall sees, from q, v, the wall's weight and √m.
struct StateSizes;

impl Pass<4, 0, 3> for StateSizes {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [q, v, seen, root_mass]: [Lanes<S>; 4],
        _: [Lanes<S>; 0],
        [reach, normal_reach, speed]: [Lanes<S>; 3],
    ) -> ([Lanes<S>; 0], [Lanes<S>; 3]) {
        ([], [reach.max(q.abs()), normal_reach.max(q.abs() * root_mass), speed.max((seen * v).abs())])
    }
}
