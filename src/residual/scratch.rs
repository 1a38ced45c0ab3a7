//! Work space of the judge for one step, and the terms of its momentum balance.

use super::matrices::{Matrices, Part};
use super::step_motion::StepMotion;
use super::weights::Weights;
use crate::linear::{Lanes, Sizes, largest, update};
use crate::step::Balance;
use pulp::Simd;

/// Vectors that a step needs, one entry per degree of freedom; for several steps of one degree of
/// freedom, one entry per step.
#[derive(Debug, Clone)]
pub(super) struct Scratch {
    pub load: Vec<f64>,
    pub mean_q: Vec<f64>,
    pub mean_v: Vec<f64>,
    /// Change of velocity, m/s.
    pub gained: Vec<f64>,
    pub residual: Vec<f64>,
    pub inertia: Vec<f64>,
    pub damper: Vec<f64>,
    pub spring: Vec<f64>,
}

impl Scratch {
    /// Zeros, n of each.
    pub fn new(n: usize) -> Self {
        let zero = || vec![0.0; n];
        Self {
            load: zero(),
            mean_q: zero(),
            mean_v: zero(),
            gained: zero(),
            residual: zero(),
            inertia: zero(),
            damper: zero(),
            spring: zero(),
        }
    }

    /// Computes the mean load, displacement and velocity of a step of `h` seconds, and starts its
    /// balance with what is given. Returns the difference of the displacement and the one that
    /// follows from the velocities, m√kg.
    #[inline(always)]
    pub fn means<S: Simd>(
        &mut self,
        simd: S,
        balance: Balance,
        h: f64,
        moves: &StepMotion<'_>,
        weights: &Weights,
        n: usize,
    ) -> f64 {
        let &StepMotion { from, to, before, after, load_start, load_end, extra, blow, .. } = moves;
        let (load, residual) = (&mut self.load[..n], &mut self.residual[..n]);
        let (mean_q, mean_v, gained) = (&mut self.mean_q[..n], &mut self.mean_v[..n], &mut self.gained[..n]);
        let [path] = match balance {
            Balance::Theta(theta) => {
                let mean = |a: f64, b: f64| (1.0 - theta) * a + theta * b;
                update(load, [load_start, load_end, extra], |_, [start, end, extra]| mean(start, end) + extra);
                update(mean_q, [from, to], |_, [q0, q1]| mean(q0, q1));
                update(mean_v, [before, after], |_, [before, after]| mean(before, after));
                largest(simd, [0.0], n, [from, to, mean_v, &weights.root_mass], &Miss { h })
            }
            Balance::Staggered(b) => {
                let mean = |[q0, q1, before]: [f64; 3]| b * (q0 - h * before) + (1.0 - 2.0 * b) * q0 + b * q1;
                update(load, [load_start, extra], |_, [start, extra]| start + extra);
                update(mean_q, [from, to, before], |_, x| mean(x));
                update(mean_v, [before, after], |_, [before, after]| 0.5 * (before + after));
                largest(simd, [0.0], n, [from, to, after, &weights.root_mass], &Miss { h })
            }
            Balance::GeneralizedAlpha { .. } | Balance::Exact => {
                update(load, [extra], |load, [extra]| load + extra);
                [0.0]
            }
        };
        update(residual, [load, blow], |_, [load, blow]| -h * load - blow);
        update(gained, [after, before], |_, [after, before]| after - before);
        path
    }

    /// Adds the terms of inertia, damping and stiffness to the balance of a step of `h` seconds
    /// (and 1/h). Returns the largest force in it so far, N/√kg: `scale` before.
    #[allow(clippy::too_many_arguments)]
    #[inline(always)]
    pub fn products<S: Simd>(
        &mut self,
        simd: S,
        matrices: &Matrices,
        (h, per_h): (f64, f64),
        blow: &[f64],
        weights: &Weights,
        n: usize,
        mut scale: f64,
    ) -> f64 {
        matrices.product(Part::Mass, 1.0, &self.gained[..n], &mut self.inertia[..n]);
        matrices.product(Part::Damping, h, &self.mean_v[..n], &mut self.damper[..n]);
        matrices.product(Part::Stiffness, h, &self.mean_q[..n], &mut self.spring[..n]);
        let terms = [&self.inertia[..], &self.damper, &self.spring];
        update(&mut self.residual[..n], terms, |open, [inertia, damper, spring]| open + (inertia + damper + spring));
        let forces = [&self.inertia[..], &self.damper, &self.spring, &self.load, blow, &weights.per_root_mass];
        [scale] = largest(simd, [scale], n, forces, &ForceOverRoot { per_h });
        scale
    }

    /// The largest residual of the balance: so far, N, with `so_far` before; and of this step,
    /// N/√kg.
    #[inline(always)]
    pub fn open<S: Simd>(&self, simd: S, per_h: f64, weights: &Weights, n: usize, so_far: f64) -> (f64, f64) {
        let vectors = [&self.residual[..], &weights.per_root_mass];
        let [balance, worst] = largest(simd, [so_far, 0.0], n, vectors, &Open { per_h });
        (balance, worst)
    }
}

/// By how much the displacement misses the way at the mean rate over a step of h seconds, m√kg:
/// from q₀, q₁, the rate and √m.
struct Miss {
    h: f64,
}

impl Sizes<4, 1> for Miss {
    #[inline(always)]
    fn of<S: Simd>(&self, [from, to, rate, root_mass]: [Lanes<S>; 4]) -> [Lanes<S>; 1] {
        [(to - from - rate * self.h).abs() * root_mass]
    }
}

/// The largest force in a balance, N/√kg: from the terms of inertia, damper and spring, N s, the
/// load, N, the blow, N s, and 1/√m.
struct ForceOverRoot {
    per_h: f64,
}

impl Sizes<6, 1> for ForceOverRoot {
    #[inline(always)]
    fn of<S: Simd>(&self, [inertia, damper, spring, load, blow, per_root]: [Lanes<S>; 6]) -> [Lanes<S>; 1] {
        let moved = inertia.abs().max(damper.abs()).max(spring.abs().max(blow.abs()));
        [load.abs().max(moved * self.per_h) * per_root]
    }
}

/// The residual of a balance, N and N/√kg: from that in N s and 1/√m.
struct Open {
    per_h: f64,
}

impl Sizes<2, 2> for Open {
    #[inline(always)]
    fn of<S: Simd>(&self, [residual, per_root]: [Lanes<S>; 2]) -> [Lanes<S>; 2] {
        let open = residual.abs() * self.per_h;
        [open, open * per_root]
    }
}
