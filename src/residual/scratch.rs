//! Work space of the judge for one step, and the terms of its momentum balance.

use super::largest_residual::running_max;
use super::matrices::{Matrices, Part};
use super::step_motion::StepMotion;
use super::weights::Weights;
use crate::step::Balance;

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
    pub fn means(&mut self, balance: Balance, h: f64, moves: &StepMotion<'_>, weights: &Weights, n: usize) -> f64 {
        let (q0, q1) = (&moves.from[..n], &moves.to[..n]);
        let (before, after, extra) = (&moves.before[..n], &moves.after[..n], &moves.extra[..n]);
        let (load_start, load_end, blow) = (&moves.load_start[..n], &moves.load_end[..n], &moves.blow[..n]);
        let (load, residual) = (&mut self.load[..n], &mut self.residual[..n]);
        let (mean_q, mean_v, gained) = (&mut self.mean_q[..n], &mut self.mean_v[..n], &mut self.gained[..n]);
        let root_mass = &weights.root_mass[..n];
        let mut path = 0.0;
        match balance {
            Balance::Theta(theta) => {
                let mean = |a: f64, b: f64| (1.0 - theta) * a + theta * b;
                for i in 0..n {
                    load[i] = mean(load_start[i], load_end[i]);
                    mean_q[i] = mean(q0[i], q1[i]);
                    mean_v[i] = mean(before[i], after[i]);
                    path = running_max(path, (q1[i] - q0[i] - h * mean_v[i]).abs() * root_mass[i]);
                }
            }
            Balance::Staggered(b) => {
                for i in 0..n {
                    let back = q0[i] - h * before[i];
                    load[i] = load_start[i];
                    mean_q[i] = b * back + (1.0 - 2.0 * b) * q0[i] + b * q1[i];
                    mean_v[i] = 0.5 * (before[i] + after[i]);
                    path = running_max(path, (q1[i] - q0[i] - h * after[i]).abs() * root_mass[i]);
                }
            }
            Balance::GeneralizedAlpha { .. } | Balance::Exact => {}
        }
        for i in 0..n {
            load[i] += extra[i];
            residual[i] = -h * load[i] - blow[i];
            gained[i] = after[i] - before[i];
        }
        path
    }

    /// Adds the terms of inertia, damping and stiffness to the balance of a step of `h` seconds
    /// (and 1/h). Returns the largest force in it so far, N/√kg: `scale` before.
    #[inline(always)]
    pub fn products(
        &mut self,
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
        let (inertia, damper, spring) = (&self.inertia[..n], &self.damper[..n], &self.spring[..n]);
        let (load, blow, residual) = (&self.load[..n], &blow[..n], &mut self.residual[..n]);
        let per_root_mass = &weights.per_root_mass[..n];
        for i in 0..n {
            residual[i] += inertia[i] + damper[i] + spring[i];
            let moved = running_max(
                running_max(inertia[i].abs(), damper[i].abs()),
                running_max(spring[i].abs(), blow[i].abs()),
            );
            scale = running_max(scale, running_max(load[i].abs(), moved * per_h) * per_root_mass[i]);
        }
        scale
    }

    /// The largest residual of the balance: so far, N, with `so_far` before; and of this step,
    /// N/√kg.
    #[inline(always)]
    pub fn open(&self, per_h: f64, weights: &Weights, n: usize, so_far: f64) -> (f64, f64) {
        let (mut balance, mut worst) = (so_far, 0.0);
        for (r, per_weight) in self.residual[..n].iter().zip(&weights.per_root_mass[..n]) {
            let open = r.abs() * per_h;
            balance = running_max(balance, open);
            worst = running_max(worst, open * per_weight);
        }
        (balance, worst)
    }
}
