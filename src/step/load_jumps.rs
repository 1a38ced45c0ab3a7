//! Jumps of loads within the steps of a scheme on a grid.
//!
//! A load jumps where a table begins or ends at a force other than 0. A rule takes the loads at
//! both ends of a step, h[(1 − w) f + w f⁺] with f continuous from the right. Of a jump J at τ,
//! start < τ ≤ end, that makes the impulse h w J, wherever τ is; the load's own is (end − τ) J. The
//! difference acts as an extra force in this step,
//!
//! J [(end − τ)/h − w],
//!
//! so that a table that ends with a step acts in it by its last row, and one that begins there does
//! not act yet. w is θ in a balance of weights θ, and ½ in all others, whose sums over a run are
//! those of the trapezoid rule.

use super::Balance;
use crate::order::sort_by_number;
use crate::scene::{LoadKind, Row, Scene};

/// The number of steps up to which each is a double, 2^53.
const MOST_STEPS: f64 = 9_007_199_254_740_992.0;

/// The jumps of the loads of a scene.
#[derive(Debug, Clone)]
pub(crate) struct LoadJumps {
    /// τ (s), the place, and J (N), in order of time.
    all: Vec<(f64, Row, f64)>,
    weight: f64,
    step: f64,
    /// The extra force of the last step that was asked for, N.
    force: Vec<f64>,
}

impl LoadJumps {
    /// The jumps after t = 0, for steps of `step` seconds that keep this balance; `None` where
    /// there are none, and for exact motion, which ends its stretches at them.
    pub fn new(scene: &Scene, balance: Balance, step: f64) -> Option<Self> {
        let weight = match balance {
            Balance::Exact => return None,
            Balance::Theta(theta) => theta,
            Balance::Staggered(_) | Balance::GeneralizedAlpha { .. } => 0.5,
        };
        let mut all = Vec::new();
        for load in &scene.loads {
            let LoadKind::Table(table) = &load.kind else { continue };
            let row = |at: usize| table.time().get(at).copied().zip(table.force().get(at).copied());
            let last = table.time().len().saturating_sub(1);
            for ((time, force), sign) in row(0).map(|r| (r, 1.0)).into_iter().chain(row(last).map(|r| (r, -1.0))) {
                if force != 0.0 && time > 0.0 {
                    all.push((time, load.at.clone(), sign * force));
                }
            }
        }
        sort_by_number(&mut all, |a| a.0);
        let force = vec![0.0; scene.initial.q.len()];
        (!all.is_empty()).then_some(Self { all, weight, step, force })
    }

    /// The number of the first step from `index` on that a jump falls into; the largest number if
    /// there is none.
    pub fn due(&self, index: u64) -> u64 {
        let start = index as f64 * self.step;
        let Some(&(time, ..)) = self.all.get(self.all.partition_point(|jump| jump.0 <= start)) else {
            return u64::MAX;
        };
        // No run has so many steps, and beyond them not every number is one of doubles.
        if time / self.step >= MOST_STEPS {
            return u64::MAX;
        }
        // The quotient may be off by rounding: a step's ends are products k·h.
        let mut due = ((time / self.step) as u64).saturating_sub(1).max(index);
        while (due + 1) as f64 * self.step < time {
            due += 1;
        }
        due
    }

    /// The extra force (N) of step number `index`: that of the caller, and that of its jumps.
    pub fn force(&mut self, index: u64, extra: Option<&[f64]>) -> &[f64] {
        let [start, end] = [index, index + 1].map(|k| k as f64 * self.step);
        self.force_within((start, end), self.step, extra)
    }

    /// The instants of the jumps, s, in order.
    pub fn instants(&self) -> impl Iterator<Item = f64> + '_ {
        self.all.iter().map(|&(time, ..)| time)
    }

    /// The same of a step from `start` to `end` (s), `length` seconds long.
    pub fn force_within(&mut self, (start, end): (f64, f64), length: f64, extra: Option<&[f64]>) -> &[f64] {
        match extra {
            Some(extra) => self.force.copy_from_slice(extra),
            None => self.force.fill(0.0),
        }
        let first = self.all.partition_point(|jump| jump.0 <= start);
        let within = self.all.iter().skip(first).take_while(|jump| jump.0 <= end);
        for (time, at, jump) in within {
            let share = (end - time) / length - self.weight;
            for &(i, weight) in at.entries() {
                if let Some(force) = self.force.get_mut(i) {
                    *force += share * weight * jump;
                }
            }
        }
        &self.force
    }
}
