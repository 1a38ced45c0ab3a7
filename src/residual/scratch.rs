//! Work space of the judge for one step, and the terms of its momentum balance.

use super::matrices::{Matrices, Part};
use super::step_motion::StepMotion;
use super::weights::Weights;
use crate::linear::{Lanes, Pass, pass};
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
        let [load, mean_q, mean_v, gained, residual, inertia, damper, spring] = std::array::from_fn(|_| vec![0.0; n]);
        Self { load, mean_q, mean_v, gained, residual, inertia, damper, spring }
    }

    /// Computes the mean load, displacement and velocity of a step, and starts its balance with
    /// what is given. Returns the sizes of what it did.
    #[inline(always)]
    pub fn means<S: Simd>(
        &mut self,
        simd: S,
        balance: Balance,
        moves: &StepMotion<'_>,
        weights: &Weights,
        n: usize,
    ) -> StepSizes {
        let &StepMotion { h, per_h, from, to, shown, before, after, load_start, load_end, extra, blow, .. } = moves;
        let Self { load, mean_q, mean_v, gained, residual, .. } = self;
        let theta = if let Balance::Theta(theta) = balance { theta } else { 0.0 };
        let forces = ([load_start, load_end, extra, blow, &weights.per_root_mass], [&mut load[..], residual]);
        let [force] = pass(simd, n, forces, &MeanLoad { theta, h, per_h });
        let [mass, spring, dashpot] = &weights.roots;
        let moved = [from, to, shown, before, after, mass, spring, dashpot];
        let motion = (moved, [&mut mean_q[..], mean_v, gained]);
        let [path, speed, reach, strain, rub] = match balance {
            Balance::Staggered(b) => pass(simd, n, motion, &StaggeredMeans { b, h }),
            _ => pass(simd, n, motion, &ThetaMeans { theta, h }),
        };
        // Exact motion and the rule that predicts and corrects have another path.
        let known = matches!(balance, Balance::Theta(_) | Balance::Staggered(_));
        StepSizes {
            path: if known { path.largest(0.0) } else { 0.0 },
            speed: speed.largest(0.0),
            reach: reach.largest(0.0),
            strain: strain.largest(0.0),
            rub: rub.largest(0.0),
            force: force.largest(0.0),
        }
    }

    /// Adds the terms of inertia, damping and stiffness to the balance of a step. Returns the
    /// largest force in it so far, N/√kg: `scale` before.
    #[inline(always)]
    pub fn products<S: Simd>(
        &mut self,
        simd: S,
        matrices: &Matrices,
        moves: &StepMotion<'_>,
        weights: &Weights,
        n: usize,
        scale: f64,
    ) -> f64 {
        let &StepMotion { h, per_h, blow, .. } = moves;
        matrices.product(Part::Mass, 1.0, &self.gained[..n], &mut self.inertia[..n]);
        matrices.product(Part::Damping, h, &self.mean_v[..n], &mut self.damper[..n]);
        matrices.product(Part::Stiffness, h, &self.mean_q[..n], &mut self.spring[..n]);
        let forces = [&self.inertia[..], &self.damper, &self.spring, &self.load, blow, &weights.per_root_mass];
        let [largest] = pass(simd, n, (forces, [&mut self.residual]), &Balanced { per_h });
        largest.largest(scale)
    }

    /// The largest residual of the balance: so far, N, with `so_far` before; and of this step,
    /// N/√kg.
    #[inline(always)]
    pub fn open<S: Simd>(&self, simd: S, per_h: f64, weights: &Weights, n: usize, so_far: f64) -> (f64, f64) {
        let [open, worst] = pass(simd, n, ([&self.residual, &weights.per_root_mass], []), &Open { per_h });
        (open.largest(so_far), worst.largest(0.0))
    }
}

/// The largest sizes of what a step did, in the metric of the mass, m√kg, √J and N/√kg.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StepSizes {
    /// The difference of the displacement and the one that follows from the velocities.
    pub path: f64,
    /// |v|√m, and |q|√m, |q|√k and |v|√c, where the velocity moves the body for the whole step.
    pub speed: f64,
    pub reach: f64,
    pub strain: f64,
    pub rub: f64,
    /// The mean load, the load at the end with the extra force, and the force of the blow.
    pub force: f64,
}

/// From the loads at the start and at the end of a step of h seconds, the extra force, N, the blow,
/// N s, and 1/√m: the mean load with the extra force, the balance with what is given, N s, and the
/// largest of these forces, N/√kg.
struct MeanLoad {
    theta: f64,
    h: f64,
    per_h: f64,
}

impl Pass<5, 2, 1> for MeanLoad {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [start, end, extra, blow, per_root]: [Lanes<S>; 5],
        _: [Lanes<S>; 2],
        [largest]: [Lanes<S>; 1],
    ) -> ([Lanes<S>; 2], [Lanes<S>; 1]) {
        let load = start * (1.0 - self.theta) + end * self.theta + extra;
        let force = load.abs().max(blow.abs() * self.per_h).max(extra.abs() + end.abs()) * per_root;
        ([load, load * -self.h - blow], [largest.max(force)])
    }
}

/// From q₀, q₁, the displacement shown at the end, the velocities before and after a step of h
/// seconds, √m, √k and √c: mean displacement and velocity, the change of velocity, and of
/// [`StepSizes`] all that move.
struct ThetaMeans {
    theta: f64,
    h: f64,
}

impl Pass<8, 3, 5> for ThetaMeans {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [from, to, shown, before, after, mass, spring, dashpot]: [Lanes<S>; 8],
        _: [Lanes<S>; 3],
        so_far: [Lanes<S>; 5],
    ) -> ([Lanes<S>; 3], [Lanes<S>; 5]) {
        let rest = 1.0 - self.theta;
        let (place, rate) = (from * rest + to * self.theta, before * rest + after * self.theta);
        let miss = (to - from - rate * self.h).abs();
        let sizes = moved_sizes(self.h, [miss, shown, before, after], [mass, spring, dashpot], so_far);
        ([place, rate, after - before], sizes)
    }
}

/// The sizes so far with those of a step of `h` seconds.
#[inline(always)]
fn moved_sizes<S: Simd>(
    h: f64,
    [miss, q, before, after]: [Lanes<S>; 4],
    [mass, spring, dashpot]: [Lanes<S>; 3],
    [path, speed, reach, strain, rub]: [Lanes<S>; 5],
) -> [Lanes<S>; 5] {
    let v = before.abs().max(after.abs());
    let q = q.abs() + v * h;
    [path.max(miss * mass), speed.max(v * mass), reach.max(q * mass), strain.max(q * spring), rub.max(v * dashpot)]
}

/// As [`ThetaMeans`] of a staggered rule, whose displacement follows from the velocity after the
/// step.
struct StaggeredMeans {
    b: f64,
    h: f64,
}

impl Pass<8, 3, 5> for StaggeredMeans {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [from, to, shown, before, after, mass, spring, dashpot]: [Lanes<S>; 8],
        _: [Lanes<S>; 3],
        so_far: [Lanes<S>; 5],
    ) -> ([Lanes<S>; 3], [Lanes<S>; 5]) {
        let mean = (from - before * self.h) * self.b + from * (1.0 - 2.0 * self.b) + to * self.b;
        let miss = (to - from - after * self.h).abs();
        let sizes = moved_sizes(self.h, [miss, shown, before, after], [mass, spring, dashpot], so_far);
        ([mean, (before + after) * 0.5, after - before], sizes)
    }
}

/// From the terms of inertia, damper and spring, N s, the load, N, the blow, N s, and 1/√m: the
/// balance with these terms, N s, and the largest force in it, N/√kg.
struct Balanced {
    per_h: f64,
}

impl Pass<6, 1, 1> for Balanced {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [inertia, damper, spring, load, blow, per_root]: [Lanes<S>; 6],
        [open]: [Lanes<S>; 1],
        [largest]: [Lanes<S>; 1],
    ) -> ([Lanes<S>; 1], [Lanes<S>; 1]) {
        let moved = inertia.abs().max(damper.abs()).max(spring.abs().max(blow.abs()));
        let force = load.abs().max(moved * self.per_h) * per_root;
        ([open + (inertia + damper + spring)], [largest.max(force)])
    }
}

/// The residual of a balance, N and N/√kg: from that in N s and 1/√m.
struct Open {
    per_h: f64,
}

impl Pass<2, 0, 2> for Open {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [residual, per_root]: [Lanes<S>; 2],
        _: [Lanes<S>; 0],
        [largest, worst]: [Lanes<S>; 2],
    ) -> ([Lanes<S>; 0], [Lanes<S>; 2]) {
        let open = residual.abs() * self.per_h;
        ([], [largest.max(open), worst.max(open * per_root)])
    }
}
