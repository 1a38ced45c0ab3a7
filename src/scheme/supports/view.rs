//! The motion as the stepper drives it: its steps, and what is shown after each.

use super::super::Counters;
use super::super::motion::Motion;
use super::Supports;
use crate::error::Result;
use crate::scene::Scene;
use crate::step::{Contact, Step};
use pulp::{Simd, WithSimd};

/// A step, made with the widest vector instructions that the machine has. Each number is computed
/// as without them.
struct Advance<'a> {
    supports: &'a mut Supports,
    step: u64,
    extra: Option<&'a [f64]>,
}

impl WithSimd for Advance<'_> {
    type Output = Result<()>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Result<()> {
        self.supports.make(simd, self.step, self.extra)
    }
}

impl Motion for Supports {
    fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()> {
        self.arch.dispatch(Advance { supports: self, step, extra })
    }

    fn flush(&mut self, tiny: f64) {
        self.frame.flush(tiny, self.body.h, [None, None]);
    }

    fn step(&self, index: u64) -> Step<'_> {
        Step {
            wedged: &self.sweeps.wedged,
            resting: &self.reach.resting,
            ..self.frame.step(index, self.episodes.closed())
        }
    }

    fn restart(&mut self, scene: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        self.take_back_impulses();
        self.frame.restart(time, q, v);
        self.body.restart(time);
        self.frame.normal.fill([0.0; 2]);
        self.episodes.forget();
        self.memory.begin(scene, q, v);
        Ok(())
    }

    fn open_contacts(&self) -> Vec<Contact> {
        self.episodes.still_open()
    }

    fn count(&self, counters: &mut Counters) {
        counters.qp_solves += self.sweeps.solves;
        counters.qp_unsettled = self.sweeps.unsettled;
        counters.wedged_steps = self.sweeps.gave_up;
        counters.frozen_steps = self.memory.frozen;
        counters.largest_turn_rad = self.memory.turned;
    }
}
