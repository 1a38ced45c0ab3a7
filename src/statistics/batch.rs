//! Batch means: how much a mean scatters from one part of the window to the next.
//!
//! The window is cut into ten equal batches. A mean over time has the 95 % interval of the mean of
//! its ten batch means, by Student's t with nine degrees of freedom (Schmeiser, Batch size effects
//! in the analysis of simulation output, Operations Research 30(3), 1982,
//! doi:10.1287/opre.30.3.556: ten to thirty batches, more bring no gain). A mean over episodes is a
//! ratio, Σ of a quantity over the number of episodes; both scatter, and its interval is that of
//! the ratio estimator (see [`Window::ratio_half_width`]).
//!
//! Where all loads repeat themselves after one period, a batch is a whole number of periods: a
//! batch that cut a period would have scatter where the motion has none. The batches, three to ten
//! of them, then end with the window; what of it lies before the first counts in the mean, by which
//! the half width is larger than that of the batches.

use super::student::{spread, student_95};
use crate::scene::{Scene, forcing_period};

/// The most batches of a window; so many where the loads have no common period.
pub(super) const BATCHES: usize = 10;

/// The fewest batches of whole periods where the window has more periods than batches.
const FEWEST: u64 = 5;

/// The fewest batches that have an interval; a window of fewer periods has two, its halves.
const FEWEST_OF_ALL: usize = 3;

/// Student's t for 95 %, two-sided, with nine degrees of freedom.
const STUDENT: f64 = 2.262_157_162_798_205;

/// Relative rounding of the number of periods in a window.
const ROUNDING: f64 = 1e-9;

/// More periods than this in the window cannot be counted in doubles, 1/ε.
const COUNTED: f64 = 1.0 / f64::EPSILON;

/// A sum for each batch, and last one for what of the window lies before the first batch.
pub(super) type BatchSums = [f64; BATCHES + 1];

/// No sums yet.
pub(super) const NO_SUMS: BatchSums = [0.0; BATCHES + 1];

/// The window of the statistics, and its batches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    /// Its start, s.
    pub from: f64,
    /// Its length, s.
    pub length: f64,
    /// Start of the first batch, s.
    pub first: f64,
    /// Number of batches, from 2.
    pub batches: usize,
    /// Forcing periods in each batch; `None` where the loads have no common period.
    pub periods: Option<u64>,
    student: f64,
}

impl Window {
    /// From the time `from` (s) to the end of `scene`.
    pub fn new(scene: &Scene, from: f64) -> Self {
        let from = from.min(scene.duration).max(0.0);
        let length = scene.duration - from;
        let whole = Self { from, length, first: from, batches: BATCHES, periods: None, student: STUDENT };
        match forcing_period(scene) {
            Ok(period) if length > 0.0 => whole.of_periods(period),
            _ => whole,
        }
    }

    /// The same with batches of whole periods of `period` seconds.
    fn of_periods(self, period: f64) -> Self {
        let all = self.length / period * (1.0 + ROUNDING);
        if all > COUNTED {
            return self;
        }
        let (all, most) = (all as u64, BATCHES as u64);
        // The number of batches that leaves the fewest periods before the first.
        let of = |batches: u64| batches * (all / batches);
        let batches = if all < most { all } else { (FEWEST..=most).max_by_key(|&n| of(n)).unwrap_or(most) };
        if batches < FEWEST_OF_ALL as u64 {
            return Self { batches: 2, ..self };
        }
        let rest = self.length - of(batches) as f64 * period;
        let first = if rest > ROUNDING * self.length { self.from + rest } else { self.from };
        let student = student_95(batches - 1);
        Self { first, batches: batches as usize, periods: Some(all / batches), student, ..self }
    }

    /// Length of a batch, s.
    pub fn batch(&self) -> f64 {
        (self.from + self.length - self.first) / self.batches as f64
    }

    /// The index among [`BatchSums`] of what happens at `time` (s).
    pub fn index(&self, time: f64) -> usize {
        let span = self.from + self.length - self.first;
        let after = (time - self.first) / span * self.batches as f64;
        if after >= 0.0 { (after as usize).min(self.batches - 1) } else { BATCHES }
    }

    /// Start of batch number `batch`, s; the end of the window for the number of them.
    pub fn start_of(&self, batch: usize) -> f64 {
        self.first + self.batch() * batch as f64
    }

    /// The end of the batch in which `time` (s) lies, s; infinite for the last.
    pub fn end_at(&self, time: f64) -> f64 {
        match self.index(time) {
            BATCHES => self.first,
            index if index + 1 < self.batches => self.start_of(index + 1),
            _ => f64::INFINITY,
        }
    }

    /// The mean over the window of what has the sums `sums`, per second.
    pub fn mean(&self, sums: &BatchSums) -> f64 {
        if self.first > self.from {
            return sums.iter().sum::<f64>() / self.length;
        }
        let batch = self.batch();
        sums.iter().take(self.batches).map(|sum| sum / batch).sum::<f64>() / self.batches as f64
    }

    /// Half width of the 95 % interval of that mean; `None` of fewer than three batches.
    pub fn half_width(&self, sums: &BatchSums) -> Option<f64> {
        let batch = self.batch();
        self.half_width_of(&sums.map(|sum| sum / batch), self.mean(sums))
    }

    /// Half width of the 95 % interval of `mean`, the mean over the window of what has these values
    /// in the batches; `None` of fewer than three.
    pub fn half_width_of(&self, values: &BatchSums, mean: f64) -> Option<f64> {
        let values = values.get(..self.batches).filter(|values| values.len() >= FEWEST_OF_ALL)?;
        let count = values.len() as f64;
        let (own, squares) = spread(values);
        let before = if self.first > self.from { (mean - own).abs() } else { 0.0 };
        Some(self.student * (squares / (count - 1.0) / count).sqrt() + before)
    }

    /// Half width of the 95 % interval of the ratio R = Σxₖ/Σnₖ, from the sums xₖ and the numbers
    /// nₖ of the batches.
    ///
    /// The ratio estimator: to first order the error of R is the mean of zₖ = xₖ − R nₖ over the
    /// mean of nₖ, so that the half width is t √(s_z²/N) / n̄ with s_z² = Σzₖ²/(N − 1) (Crane &
    /// Iglehart, Simulating stable stochastic systems III, Operations Research 23(1), 1975,
    /// doi:10.1287/opre.23.1.33, with N batches in the place of regenerative cycles). `None` where
    /// nothing was counted.
    pub fn ratio_half_width(&self, sums: &BatchSums, numbers: &BatchSums) -> Option<f64> {
        let ratio = sums.iter().sum::<f64>() / numbers.iter().sum::<f64>();
        let all: f64 = numbers.iter().take(self.batches).sum();
        if all <= 0.0 {
            return None;
        }
        let mut open = *sums;
        open.iter_mut().zip(numbers).for_each(|(z, n)| *z -= ratio * n);
        // The zₖ of the whole window sum to 0 up to rounding.
        Some(self.half_width_of(&open, 0.0)? * self.batches as f64 / all)
    }

    /// The means over time, per second, of the first and of the last half of the batches.
    pub fn means_of_halves(&self, sums: &BatchSums) -> [f64; 2] {
        let half = self.batches / 2;
        let mean = |batches: &[f64]| batches.iter().sum::<f64>() / (half as f64 * self.batch());
        let last = sums.get(self.batches - half..self.batches).unwrap_or_default();
        [mean(&sums[..half]), mean(last)]
    }

    /// Whether a mean has an interval: ten `contacts` began in the window, or what pushed (Σ|p| of
    /// each batch, `pushed`) did so in all batches.
    pub fn has_interval(&self, pushed: &BatchSums, contacts: usize) -> bool {
        let all = pushed.iter().take(self.batches).all(|&p| p > 0.0);
        self.batches >= FEWEST_OF_ALL && (contacts >= BATCHES || all)
    }

    /// The root of the mean over time of what has the sums `squares`, and the half width of its
    /// interval: that of the mean divided by twice the root; `None` without one.
    pub fn root_mean(&self, squares: &BatchSums, interval: bool) -> (f64, Option<f64>) {
        let root = self.mean(squares).sqrt();
        let half = self.half_width(squares).filter(|_| interval);
        (root, half.map(|half| if root > 0.0 { half / (2.0 * root) } else { 0.0 }))
    }
}
