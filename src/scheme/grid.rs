//! A scheme on a grid: its rule, the frame that the rule fills, and the contact episodes of its
//! steps.

use super::Counters;
use super::frame::{Frame, Stretch};
use super::motion::Motion;
use super::rule::Rule;
use super::space::Space;
use crate::contact::{Episodes, PartRates, Rates};
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::Scene;
use crate::step::{Contact, Contract, QuietSteps, Step};

/// One scheme on one scene, with its state.
#[derive(Debug)]
pub(super) struct Grid<S: Space> {
    rule: Box<dyn Rule<S>>,
    frame: Frame<S>,
    episodes: Episodes,
    rows: S::Rows,
    h: f64,
    /// True if the rule divides steps.
    divides: bool,
}

impl<S: Space> Grid<S> {
    /// The start of `scene`, whose walls feel `masses` (kg), by `rule`, whose steps of `h` seconds
    /// satisfy `contract`.
    pub fn new(scene: &Scene, masses: &[f64], mut rule: Box<dyn Rule<S>>, contract: Contract, h: f64) -> Result<Self> {
        let frame = Frame::new(scene)?;
        rule.restart(scene, 0.0, &frame)?;
        let rows = S::rows(scene.initial.q.len(), scene.walls.iter().map(|wall| wall.row()));
        let divides = contract.divides;
        let episodes = Episodes::new(scene, masses, contract);
        Ok(Self { rule, frame, episodes, rows, h, divides })
    }

    /// Passes the last step to the contact episodes. Not inlined: most steps touch no wall.
    #[inline(never)]
    fn record_episodes(&mut self) {
        let Self { frame, rows, episodes, h, .. } = self;
        if self.divides {
            let rates = |wall: usize| {
                let met = if frame.blown { &frame.struck } else { &frame.after };
                let all = [&frame.before, &frame.after, met, &frame.v].map(|v| S::dot(rows, wall, v));
                let [before, arrived, struck, after] = all;
                PartRates { before, arrived, struck, after }
            };
            let length = match frame.stretch {
                Stretch::Part(length) | Stretch::Other(length, _) => length,
                Stretch::Grid | Stretch::OneRestitution => *h,
            };
            return episodes.observe_part(
                [frame.start, frame.end],
                length,
                (&frame.impulse, &frame.jump),
                &frame.pushing,
                rates,
            );
        }
        let rates = |wall: usize| Rates {
            before: S::dot(rows, wall, &frame.before),
            struck: S::dot(rows, wall, frame.struck()),
            after: S::dot(rows, wall, &frame.after),
        };
        episodes.observe(frame.start, *h, &frame.impulse, &frame.pushing, rates);
    }
}

impl<S: Space> Motion for Grid<S> {
    #[inline]
    fn is_divided(&self) -> bool {
        self.frame.unfinished
    }

    #[inline]
    fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()> {
        self.frame.force(extra);
        self.rule.advance(step, &mut self.frame)?;
        self.frame.check(step)?;
        if !self.frame.pushing.is_empty() || !self.episodes.idle() {
            self.record_episodes();
        }
        Ok(())
    }

    fn advance_quiet(&mut self, step: u64, until: u64, quiet: Option<&mut QuietSteps>) -> Result<u64> {
        if self.frame.forced || !self.frame.pushing.is_empty() || !self.episodes.idle() {
            return Ok(step);
        }
        let reached = self.rule.advance_quiet(step, until, &mut self.frame, quiet)?;
        if reached > step {
            self.frame.check(reached - 1)?;
        }
        Ok(reached)
    }

    fn flush(&mut self, tiny: f64) {
        self.frame.flush(tiny, self.h, self.rule.carried());
    }

    #[inline(always)]
    fn step(&self, index: u64) -> Step<'_> {
        self.frame.step(index, self.episodes.closed())
    }

    fn restart(&mut self, scene: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        self.frame.restart(time, q, v);
        self.episodes.forget();
        self.rule.restart(scene, time, &self.frame)
    }

    fn open_contacts(&self) -> Vec<Contact> {
        self.episodes.still_open()
    }

    fn count(&self, counters: &mut Counters) {
        self.rule.count(counters);
    }

    fn backend(&self) -> Option<Backend> {
        self.rule.backend()
    }
}
