//! The force of a wall over time: impulse, mean and root mean square, step by step.

use super::batch::{BATCHES, BatchSums, NO_SUMS, Window};
use super::largest_force::{LargestForce, LargestStretch};
use super::settling::Beginning;
use super::step_force::{impulse, impulse_and_square, largest_force};
use super::support::{SupportForce, SupportTally};
use crate::scene::Scene;
use crate::step::{Contact, Path, Step};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Maximum number of averaging intervals in a window; they are longer where a window would hold
/// more. They cost time where a contact lasts.
const MOST_STRETCHES: f64 = 1e6;

/// The force of one wall over the window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ForceStatistics {
    /// Impulse of the wall on the body over the window, N s; signed as the force.
    pub impulse_n_s: f64,
    /// Half width of its 95 % interval by batch means, N s. This and the two below are `None`
    /// unless ten contacts began in the window, or the wall pushed in each of its batches.
    pub impulse_half_width_95_n_s: Option<f64>,
    /// Mean of |force| over time, Σ|p|/T, N.
    pub mean_n: f64,
    /// Half width of its 95 % interval by batch means, N.
    pub mean_half_width_95_n: Option<f64>,
    /// That mean over the first and over the last half of the batches, N.
    #[serde(default)]
    pub mean_of_halves_n: [f64; 2],
    /// Root mean square of the force over time, N: for an elastic wall of the force itself, for a
    /// rigid wall of its mean over intervals of `rms_averaged_over_s`, since impacts have no finite
    /// force and the mean square of impulse/h has no limit as h → 0.
    pub rms_n: f64,
    /// Half width of its 95 % interval, N: that of the mean square by batch means, divided by twice
    /// the RMS.
    pub rms_half_width_95_n: Option<f64>,
    /// That root over the first and over the last half of the batches, N.
    #[serde(default)]
    pub rms_of_halves_n: [f64; 2],
    /// Length of those intervals, s:
    /// [`TimeOptions::force_averaging`](crate::TimeOptions::force_averaging) or a little less, so
    /// that each batch of the window holds a whole number of them; more where the window would hold
    /// more than 1e6. `None` for an elastic wall.
    pub rms_averaged_over_s: Option<f64>,
    /// The largest mean of |force| over any stretch of such a length; `None` where nothing pushed.
    #[serde(default)]
    pub largest: Option<LargestForce>,
}

/// The impulses and squared forces of one wall, by batches.
#[derive(Debug, Clone)]
struct Tally {
    rigid: bool,
    /// Σ p, N s.
    impulse: f64,
    /// Σ|p|, N s, and ∫ of the square, N² s.
    pushed: BatchSums,
    square: BatchSums,
    /// The impulse in the current interval, N s.
    stretch: f64,
    carried: Carried,
}

/// Rounding of the times at which steps and intervals end and begin, as a share of them.
const ROUNDING: f64 = 1e-14;

/// The part in the window of a contact that began before.
#[derive(Debug, Clone, Copy)]
struct Carried {
    /// Up to when the wall has pushed without a pause since the start of the window, s.
    until: f64,
    /// Its largest |force| in that time, N.
    largest: f64,
}

impl Carried {
    /// True if what the wall gives from `from` (s) on follows without a pause longer than rounding.
    fn goes_on(&self, from: f64) -> bool {
        from <= self.until * (1.0 + ROUNDING)
    }

    /// Adds the force up to `to` (s), at most `force` (N).
    fn add(&mut self, to: f64, force: f64) {
        (self.until, self.largest) = (to, self.largest.max(force));
    }
}

/// Sums up the forces of the walls over the steps of a run.
#[derive(Debug, Clone)]
pub struct Forces {
    window: Window,
    /// Length of an averaging interval, s, the number of those before the first batch, and of all.
    bin: f64,
    before: u64,
    bins: u64,
    /// Index of the current interval.
    at: u64,
    walls: Vec<Tally>,
    supports: Vec<SupportTally>,
    /// The largest forces of the walls, and then of the supports.
    largest: Vec<LargestStretch>,
    /// |p| of each wall over a piece of a step, N s.
    pushed: Vec<f64>,
    /// True if a wall is round.
    round: bool,
}

impl Forces {
    /// For the walls of `scene` (as the scheme sees it), from the time `from` (s) to the end, with
    /// the forces of rigid walls averaged over intervals of at most `averaging` (s); over a batch
    /// of the window, where that is no length above 0.
    #[must_use]
    pub fn new(scene: &Scene, from: f64, averaging: f64) -> Self {
        let window = Window::new(scene, from);
        let batches = window.batches as f64;
        let span = window.from + window.length - window.first;
        let stretches = (span / (batches * averaging) * (1.0 - 1e-9)).ceil().min(MOST_STRETCHES / batches).max(1.0);
        let inner = window.batches as u64 * stretches as u64;
        let bin = span / inner as f64;
        // The first interval may begin before the window.
        let before = ((window.first - window.from) / bin).ceil() as u64;
        let carried = Carried { until: window.from, largest: 0.0 };
        let tally = |rigid| Tally { rigid, impulse: 0.0, pushed: NO_SUMS, square: NO_SUMS, stretch: 0.0, carried };
        let walls = scene.walls.iter().map(|wall| tally(wall.law.is_rigid())).collect();
        Self {
            window,
            bin,
            before,
            bins: before + inner,
            at: 0,
            largest: vec![LargestStretch::new(bin); scene.walls.len() + scene.supports.len()],
            pushed: vec![0.0; scene.walls.len()],
            walls,
            supports: SupportTally::all(scene),
            round: scene.holes().next().is_some(),
        }
    }

    /// Adds one step; steps must come in order. A step of a scene with another number of walls is
    /// ignored.
    pub fn observe(&mut self, step: &Step<'_>) {
        let Window { from, length, .. } = self.window;
        let end = step.end.min(from + length);
        if step.impulse.len() != self.walls.len() || length <= 0.0 || step.end < from {
            return;
        }
        if step.impulse.iter().all(|&p| p == 0.0) {
            return;
        }
        // Where all impulses are jumps at the end of the step, there is no force to integrate over
        // it.
        let along = self.round || step.impulse.iter().zip(step.jump).any(|(p, jump)| p != jump);
        let mut from = if along { step.start.max(from) } else { end };
        while from < end {
            let edge = self.move_to(from);
            let to = edge.min(end);
            for wall in 0..self.walls.len() {
                if step.impulse[wall] != 0.0 {
                    let (impulse, square) = impulse_and_square(step, wall, [from, to]);
                    self.add(wall, impulse, square);
                    let Tally { rigid, carried, .. } = &mut self.walls[wall];
                    if !*rigid && carried.goes_on(from) {
                        carried.add(to, largest_force(step, wall, [from, to]));
                    }
                }
            }
            self.stretch(step, [from, to]);
            if !self.supports.is_empty() {
                self.supports.iter_mut().for_each(|support| support.add(step, [from, to]));
            }
            // By rounding, the edge of an interval may coincide with the time itself.
            from = if to > from { to } else { from.next_up() };
        }
        if step.jump.iter().any(|&p| p != 0.0) && end >= step.end {
            self.move_to(end);
            for (wall, &p) in step.jump.iter().enumerate() {
                self.add(wall, p, 0.0);
            }
            self.pushed.iter_mut().zip(step.jump).for_each(|(pushed, p)| *pushed = p.abs());
            self.push_stretches(|largest, p| largest.jump(end, p));
            self.supports.iter_mut().for_each(|support| support.jump(step));
        }
    }

    /// Adds what the walls gave between two times in a step (s), without the jump at its end, to
    /// their largest stretches: exact motion in quarters, between which the force counts as even.
    fn stretch(&mut self, step: &Step<'_>, [from, to]: [f64; 2]) {
        let parts = if matches!(step.path, Path::Exact(_) | Path::Series(_)) { 4 } else { 1 };
        let at = |k: u32| if k == parts { to } else { from + f64::from(k) * (to - from) / f64::from(parts) };
        for ends in (0..parts).map(|k| [at(k), at(k + 1)]).filter(|ends| ends[1] > ends[0]) {
            for (wall, pushed) in self.pushed.iter_mut().enumerate() {
                *pushed = impulse(step, wall, ends).abs();
            }
            self.push_stretches(|largest, p| largest.add(ends, p));
        }
    }

    /// Does `push` with the largest force of each wall and support, and with what it pushed.
    fn push_stretches(&mut self, push: impl Fn(&mut LargestStretch, f64)) {
        let Self { largest, supports, pushed, .. } = self;
        let of_support = |support: &SupportTally| support.walls().filter_map(|wall| pushed.get(wall)).sum();
        let all = pushed.iter().copied().chain(supports.iter().map(of_support));
        largest.iter_mut().zip(all).for_each(|(largest, p)| push(largest, p));
    }

    /// Moves on to the interval that contains `t` (s); returns its end, s.
    fn move_to(&mut self, t: f64) -> f64 {
        let first = self.window.first - self.before as f64 * self.bin;
        let at = (((t - first) / self.bin) as u64).min(self.bins - 1);
        if at > self.at {
            self.close();
            self.at = at;
        }
        if self.at + 1 >= self.bins { f64::INFINITY } else { first + (self.at + 1) as f64 * self.bin }
    }

    /// The index among [`BatchSums`] of the current interval, and its length, s.
    fn interval(&self) -> (usize, f64) {
        match self.at.checked_sub(self.before) {
            Some(at) => ((at * self.window.batches as u64 / (self.bins - self.before)) as usize, self.bin),
            None if self.at > 0 => (BATCHES, self.bin),
            None => {
                let first = self.window.first - (self.before - 1) as f64 * self.bin;
                (BATCHES, first - self.window.from)
            }
        }
    }

    fn add(&mut self, wall: usize, p: f64, square: f64) {
        let (batch, _) = self.interval();
        if let Some(tally) = self.walls.get_mut(wall) {
            tally.impulse += p;
            tally.pushed[batch] += p.abs();
            tally.stretch += p;
            if !tally.rigid {
                tally.square[batch] += square;
            }
        }
    }

    /// Ends the current interval.
    fn close(&mut self) {
        let (batch, length) = self.interval();
        self.close_supports();
        for tally in &mut self.walls {
            let p = std::mem::take(&mut tally.stretch);
            if tally.rigid {
                tally.square[batch] += p * p / length;
            }
        }
    }

    /// Adds the current interval to the supports.
    fn close_supports(&mut self) {
        let (batch, length) = self.interval();
        let Self { walls, supports, .. } = self;
        let impulse = |wall: usize| walls.get(wall).map_or(0.0, |tally| tally.stretch);
        supports.iter_mut().for_each(|support| support.close(batch, length, impulse));
    }

    /// The `contacts`, each of which at an elastic wall that began before the window and lasts into
    /// it with its largest force in the window. At a rigid wall that force would be one of the
    /// impacts elsewhere, which a contact tells from its own.
    pub(crate) fn in_window<'a>(&self, contacts: &'a [Contact]) -> Cow<'a, [Contact]> {
        let from = self.window.from;
        let largest = |contact: &Contact| {
            let lasts = contact.start < from && contact.end.is_none_or(|end| end > from);
            let tally = self.walls.get(contact.wall).filter(|tally| lasts && !tally.rigid)?;
            (tally.carried.largest > 0.0).then_some(tally.carried.largest)
        };
        if contacts.iter().all(|contact| largest(contact).is_none()) {
            return Cow::Borrowed(contacts);
        }
        let trimmed = |contact: &Contact| Contact { peak_force: largest(contact).or(contact.peak_force), ..*contact };
        contacts.iter().map(trimmed).collect()
    }

    /// Statistics of wall number `wall`, at which `contacts` began in the window; `None` for a
    /// window of length 0.
    pub(super) fn statistics(&self, wall: usize, contacts: usize) -> Option<ForceStatistics> {
        let (tally, window) = (self.walls.get(wall)?, &self.window);
        if window.length <= 0.0 {
            return None;
        }
        let mut squares = tally.square;
        if tally.rigid {
            // The current interval ends with the window.
            let (batch, length) = self.interval();
            squares[batch] += tally.stretch * tally.stretch / length;
        }
        let interval = window.has_interval(&tally.pushed, contacts);
        let mean_half = window.half_width(&tally.pushed).filter(|_| interval);
        let (rms, rms_half) = window.root_mean(&squares, interval);
        Some(ForceStatistics {
            impulse_n_s: tally.impulse,
            impulse_half_width_95_n_s: mean_half.map(|half| half * window.length),
            mean_n: window.mean(&tally.pushed),
            mean_half_width_95_n: mean_half,
            mean_of_halves_n: window.means_of_halves(&tally.pushed),
            rms_n: rms,
            rms_half_width_95_n: rms_half,
            rms_of_halves_n: window.means_of_halves(&squares).map(f64::sqrt),
            rms_averaged_over_s: tally.rigid.then_some(self.bin),
            largest: self.largest.get(wall).and_then(LargestStretch::largest),
        })
    }

    /// The mean force of wall number `wall`, one of `means` means, in the beginning of the window,
    /// if that differs from the rest.
    pub(super) fn beginning(&self, wall: usize, means: usize) -> Option<Beginning> {
        self.window.beginning(&self.walls.get(wall)?.pushed, means)
    }

    /// Statistics of each support, where `contacts(i)` began at support i in the window; empty for
    /// a window of length 0.
    pub(super) fn of_supports(&self, contacts: impl Fn(usize) -> usize) -> Vec<SupportForce> {
        if self.window.length <= 0.0 {
            return Vec::new();
        }
        // The current interval ends with the window.
        let mut closed = self.clone();
        closed.close_supports();
        let pushed = |wall: usize| self.walls.get(wall).map_or(NO_SUMS, |tally| tally.pushed);
        let largest = self.largest.iter().skip(self.walls.len()).map(LargestStretch::largest);
        let all = closed.supports.iter().zip(largest).enumerate();
        all.map(|(i, (support, largest))| support.statistics((&self.window, self.bin), contacts(i), pushed, largest))
            .collect()
    }
}

#[cfg(test)]
mod tests;
