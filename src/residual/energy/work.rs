//! The work of loads in a step on a grid.

use crate::linear::{Lanes, Pass};
use pulp::Simd;

/// From the displacements and velocities at both ends of a step, its load, N, and its blow, N s:
/// the displacement by which the load moves in it, m, and the work of both, J, and its size. With
/// `by_rate`, the length of the step, s, the load moves at the mean velocity.
pub(super) struct Work {
    pub by_rate: Option<f64>,
}

impl Pass<6, 3, 0> for Work {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [from, to, before, after, load, blow]: [Lanes<S>; 6],
        _: [Lanes<S>; 3],
        _: [Lanes<S>; 0],
    ) -> ([Lanes<S>; 3], [Lanes<S>; 0]) {
        let rate = (before + after) * 0.5;
        let shift = match self.by_rate {
            Some(h) => rate * h,
            None => to - from,
        };
        let (pulled, struck) = (load * shift, blow * rate);
        ([shift, pulled + struck, pulled.abs() + struck.abs()], [])
    }
}
