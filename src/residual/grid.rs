//! Checks of a step on a grid against its scheme's contract.

use super::Judge;
use super::step_motion::StepMotion;
use crate::step::{Path, Step};
use pulp::{Scalar, Simd, WithSimd};

/// What a step did, from the judge's own record of its start; borrows some of its fields.
macro_rules! moves {
    ($judge:expr, $step:expr, $per_h:expr, $beyond:expr) => {
        StepMotion::of(
            $step,
            ($judge.h, $per_h),
            (&$judge.q, if $beyond { &$judge.blows.arrived } else { $step.q }),
            (&$judge.load, &$judge.load_end),
            &$judge.blows.impulse,
        )
    };
}

/// A step of several degrees of freedom, checked with the widest vector instructions that the
/// machine has. Each number is computed as without them.
struct SeveralDegrees<'a, 'b> {
    judge: &'a mut Judge,
    step: &'a Step<'b>,
}

impl WithSimd for SeveralDegrees<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let n = self.judge.q.len();
        self.judge.observe_grid_of(simd, self.step, n);
    }
}

impl Judge {
    /// Checks a step between two instants of a grid.
    pub(super) fn observe_grid(&mut self, step: &Step<'_>) {
        match self.q.len() {
            // With n constant the compiler removes the loops.
            1 => self.observe_grid_of(Scalar, step, 1),
            _ => self.arch.dispatch(SeveralDegrees { judge: self, step }),
        }
    }

    #[inline(always)]
    fn observe_grid_of<S: Simd>(&mut self, simd: S, step: &Step<'_>, n: usize) {
        self.set_load_at_end(step);
        // A part of a step has its blows at its end.
        let within = self.loads.has_blows() && !matches!(step.path, Path::Part { .. });
        let beyond = within && self.find_beyond(step);
        let (h, per_h) = (self.h, 1.0 / self.h);
        self.noise.begin(h, step.end);
        let moves = moves!(self, step, per_h, beyond);
        let sizes = self.scratch.means(simd, self.contract.balance, &moves, &self.weights, n);
        self.noise.step(&sizes);
        self.noise.book(n as f64, 1.0);
        self.walls_on_grid(step, beyond);
        if self.supports.is_some() {
            self.supports_on_grid(simd, step, beyond);
        }
        let moves = moves!(self, step, per_h, beyond);
        self.balance.scale = self.scratch.products(simd, &self.matrices, &moves, &self.weights, n, self.balance.scale);
        for (wall, &p) in self.scene.walls.iter().zip(step.impulse) {
            if p != 0.0 {
                wall.row().add_transposed(-p, &mut self.scratch.residual);
            }
        }
        if within {
            self.feel_blows(step, beyond);
        }
        let worst;
        (self.balance.largest, worst) = self.scratch.open(simd, per_h, &self.weights, n, self.balance.largest);
        let moves = moves!(self, step, per_h, beyond);
        let rates = self.supports.as_ref().map_or(&[][..], |supports| &supports.rates);
        self.energy.observe_grid(simd, &moves, step, &self.scratch.load, rates, n);
        if within && self.blows.struck.iter().any(|v| *v != 0.0) {
            self.energy.answer(step, &self.blows.struck);
        }
        if beyond {
            self.energy.displace(h, step);
            self.sums.displace(&self.matrices, &self.blows.beyond, &mut self.scratch.mean_q);
        }
        self.balance.observe(&self.noise, worst, sizes.path);
        self.sum(simd, step, per_h, n);
        self.begin_next_step(simd, step, n);
    }
}
