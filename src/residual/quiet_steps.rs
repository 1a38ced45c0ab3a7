//! Checks of many steps of one degree of freedom at once.
//!
//! Of a step in which no wall is in reach only the balances remain to be checked. The passes that
//! do so over the degrees of freedom of one step do so here over the steps of one degree of
//! freedom.

use super::Judge;
use super::quiet_scratch::QuietScratch;
use super::step_motion::StepMotion;
use crate::step::QuietSteps;
use pulp::{Simd, WithSimd};
use std::ops::Range;

/// Steps in which no wall is in reach, checked with the widest vector instructions that the machine
/// has. Each number is computed as without them.
struct ClearSteps<'a> {
    judge: &'a mut Judge,
    scratch: &'a mut QuietScratch,
    quiet: &'a QuietSteps,
    steps: Range<usize>,
}

impl WithSimd for ClearSteps<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { judge, scratch, quiet, steps } = self;
        judge.observe_clear(simd, scratch, quiet, steps);
    }
}

impl Judge {
    /// True if [`Judge::observe_quiet`] is faster than [`Judge::observe`] step by step.
    pub(crate) fn batches_quiet_steps(&self) -> bool {
        self.quiet_scratch.is_some()
    }

    /// Checks the steps of `quiet`, which follow the last one seen, as [`Judge::observe`] checks
    /// each of them.
    pub(crate) fn observe_quiet(&mut self, quiet: &QuietSteps) {
        let Some(mut quiet_scratch) = self.quiet_scratch.take() else {
            return (0..quiet.len()).for_each(|k| self.observe(&quiet.step(k)));
        };
        let mut k = 0;
        while k < quiet.len() {
            let clear = k + self.clear(quiet, k);
            if clear > k {
                let scratch = &mut *quiet_scratch;
                self.arch.dispatch(ClearSteps { judge: self, scratch, quiet, steps: k..clear });
            }
            k = clear;
            if k < quiet.len() {
                self.observe(&quiet.step(k));
                k += 1;
            }
        }
        self.quiet_scratch = Some(quiet_scratch);
    }

    /// The number of steps from step `from` on in which no wall is in reach. The first step of a
    /// run, with which its sums begin, counts as one in which a wall is, and so does one before
    /// which a wall still pushed.
    fn clear(&self, quiet: &QuietSteps, from: usize) -> usize {
        if self.sums.steps == 0 || self.energy.walls_store() || self.walls.last_force.iter().any(|&force| force != 0.0)
        {
            return 0;
        }
        let (before, _) = quiet.velocities();
        let mut w0 = self.q.first().copied().unwrap_or(0.0);
        let in_reach = |(&w1, rate): (&f64, &f64)| {
            let ends = (std::mem::replace(&mut w0, w1), w1);
            // All walls have the one row that is the degree of freedom itself.
            !self.row_walls.iter().all(|walls_of_row| walls_of_row.is_clear(ends, self.h * rate.abs()))
        };
        let left = quiet.len() - from;
        quiet.q()[from..].iter().zip(&before[from..]).position(in_reach).unwrap_or(left)
    }

    /// Checks steps in which no wall is in reach.
    #[inline(always)]
    fn observe_clear<S: Simd>(
        &mut self,
        simd: S,
        quiet_scratch: &mut QuietScratch,
        quiet: &QuietSteps,
        steps: Range<usize>,
    ) {
        let n = steps.len();
        let (&mut [ref mut q], &mut [ref mut load], Some(forcing)) =
            (&mut self.q[..], &mut self.load[..], &mut self.grid_load)
        else {
            return;
        };
        let QuietScratch { weights, scratch, q: places, load: loads, zeros } = quiet_scratch;
        let (h, per_h) = (self.h, 1.0 / self.h);
        places[0] = *q;
        places[1..=n].copy_from_slice(&quiet.q()[steps.clone()]);
        loads[0] = *load;
        for (load, &end) in loads[1..=n].iter_mut().zip(&quiet.end()[steps.clone()]) {
            *load = forcing.at(end);
        }
        let (before, after) = quiet.velocities();
        let moves = StepMotion {
            h,
            per_h,
            from: &places[..n],
            to: &places[1..=n],
            shown: &places[1..=n],
            before: &before[steps.clone()],
            after: &after[steps.clone()],
            v: &quiet.v()[steps.clone()],
            load_start: &loads[..n],
            load_end: &loads[1..=n],
            extra: &zeros[..n],
            blow: &zeros[..n],
        };
        self.noise.begin(h, quiet.end()[steps.end - 1]);
        let sizes = scratch.means(simd, self.contract.balance, &moves, weights, n);
        self.noise.step(&sizes);
        self.balance.scale = scratch.products(simd, &self.matrices, &moves, weights, n, self.balance.scale);
        let (largest, worst) = scratch.open(simd, per_h, weights, n, self.balance.largest);
        if worst > self.noise.force() || sizes.path > self.noise.path() {
            // One of the steps will be accused: see them one by one to find out when.
            return steps.for_each(|k| self.observe(&quiet.step(k)));
        }
        self.noise.book(1.0, n as f64);
        self.balance.largest = largest;
        self.balance.observe(&self.noise, worst, sizes.path);
        self.energy.observe_quiet(simd, &moves, &scratch.load, n);
        if self.sums.whole {
            self.sums.add_all(&moves, scratch, n);
        }
        self.sums.steps += n as u64;
        self.extent.observe(simd, &places[1..=n], moves.after, weights, n);
        (*q, *load) = (places[n], loads[n]);
    }
}
