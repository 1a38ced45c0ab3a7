//! The force of a wall over time: impulse, mean and root mean square, step by step.

use super::batch::{BATCHES, half_width};
use crate::scene::Scene;
use crate::step::{Path, Step};
use serde::Serialize;

/// Most stretches of a window; of a window that has more of them, they are longer. They cost time where a contact lasts.
const MOST_STRETCHES: f64 = 1e6;

/// Gauss's rule of two points on [0, 1].
const GAUSS: [f64; 2] = [0.211_324_865_405_187_13, 0.788_675_134_594_812_9];

/// The force of one wall over the window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ForceStatistics {
    /// Impulse of the wall on the body over the window, N s; signed as the force.
    pub impulse_n_s: f64,
    /// Half width of its 95 % interval by batch means, N s; this and the two below are none unless ten contacts began in the window, or
    /// the wall pushed in each of its ten batches.
    pub impulse_half_width_95_n_s: Option<f64>,
    /// Mean of |force| over time, Σ|p|/T, N.
    pub mean_n: f64,
    /// Half width of its 95 % interval by batch means, N.
    pub mean_half_width_95_n: Option<f64>,
    /// Root mean square of the force over time, N: of the force itself where the wall is elastic; of its mean over stretches of
    /// `rms_averaged_over_s` where it is rigid, since impacts have no finite force and the mean square of impulse/h has no limit as h → 0.
    pub rms_n: f64,
    /// Half width of its 95 % interval, N: that of the mean square by batch means, over twice the RMS.
    pub rms_half_width_95_n: Option<f64>,
    /// Those stretches, s: [`TimeOptions::force_averaging`](crate::TimeOptions::force_averaging) or a little less, so that each batch of the
    /// window holds a whole number of them; more where the window would hold more than 1e6. None where the force itself is squared.
    pub rms_averaged_over_s: Option<f64>,
}

/// What one wall did, by batches.
#[derive(Debug, Clone, Default)]
struct Tally {
    rigid: bool,
    /// Σ p, N s.
    impulse: f64,
    /// Σ|p|, N s, and ∫ of the square, N² s.
    pushed: [f64; BATCHES],
    square: [f64; BATCHES],
    /// The impulse of the stretch under way, N s.
    stretch: f64,
}

/// Watches the steps of a run for the forces of its walls.
#[derive(Debug, Clone)]
pub struct Forces {
    from: f64,
    /// Length of the window and of a stretch, s, and how many stretches there are.
    length: f64,
    bin: f64,
    bins: u64,
    /// The stretch under way.
    at: u64,
    walls: Vec<Tally>,
}

impl Forces {
    /// For the walls of `scene` (as the scheme sees it) from the time `from` (s) to its end, the forces of rigid walls averaged over stretches
    /// of `averaging` (s) at most.
    #[must_use]
    pub fn new(scene: &Scene, from: f64, averaging: f64) -> Self {
        let from = from.min(scene.duration);
        let length = scene.duration - from;
        let batches = BATCHES as f64;
        let stretches = (length / (batches * averaging) * (1.0 - 1e-9)).ceil().clamp(1.0, MOST_STRETCHES / batches);
        let bins = BATCHES as u64 * stretches as u64;
        let tally = |rigid| Tally { rigid, ..Tally::default() };
        let walls = scene.walls.iter().map(|wall| tally(wall.law.is_rigid())).collect();
        Self { from, length, bin: length / bins as f64, bins, at: 0, walls }
    }

    /// Takes in one step; steps must come in order. A step of a scene with other walls is passed over.
    pub fn see(&mut self, step: &Step<'_>) {
        let end = step.end.min(self.from + self.length);
        if step.impulse.len() != self.walls.len() || self.length <= 0.0 || step.end < self.from {
            return;
        }
        if step.impulse.iter().all(|&p| p == 0.0) {
            return;
        }
        // Where nothing but blows in the instant of its end push, there is no way to look along.
        let along = step.impulse.iter().zip(step.jump).any(|(p, jump)| p != jump);
        let mut from = if along { step.start.max(self.from) } else { end };
        while from < end {
            let edge = self.move_to(from);
            let to = edge.min(end);
            for wall in 0..self.walls.len() {
                if step.impulse[wall] != 0.0 {
                    let (p, square) = piece(step, wall, [from, to]);
                    self.add(wall, p, square);
                }
            }
            // The edge of a stretch may be the time itself, by rounding.
            from = if to > from { to } else { from.next_up() };
        }
        if step.jump.iter().any(|&p| p != 0.0) && end >= step.end {
            self.move_to(end);
            for (wall, &p) in step.jump.iter().enumerate() {
                self.add(wall, p, 0.0);
            }
        }
    }

    /// Goes to the stretch in which `t` (s) lies; returns its end, s.
    fn move_to(&mut self, t: f64) -> f64 {
        let at = (((t - self.from) / self.bin) as u64).min(self.bins - 1);
        if at > self.at {
            self.close();
            self.at = at;
        }
        if self.at + 1 >= self.bins { f64::INFINITY } else { self.from + (self.at + 1) as f64 * self.bin }
    }

    fn batch(&self) -> usize {
        ((self.at * BATCHES as u64 / self.bins) as usize).min(BATCHES - 1)
    }

    fn add(&mut self, wall: usize, p: f64, square: f64) {
        let batch = self.batch();
        if let Some(tally) = self.walls.get_mut(wall) {
            tally.impulse += p;
            tally.pushed[batch] += p.abs();
            tally.stretch += p;
            if !tally.rigid {
                tally.square[batch] += square;
            }
        }
    }

    /// Ends the stretch under way.
    fn close(&mut self) {
        let (batch, bin) = (self.batch(), self.bin);
        for tally in &mut self.walls {
            let p = std::mem::take(&mut tally.stretch);
            if tally.rigid {
                tally.square[batch] += p * p / bin;
            }
        }
    }

    /// What was seen of the wall number `wall`, at which `contacts` began in the window; none of a window without length.
    pub(super) fn statistics(&self, wall: usize, contacts: usize) -> Option<ForceStatistics> {
        let tally = self.walls.get(wall).filter(|_| self.length > 0.0)?;
        let batch = self.length / BATCHES as f64;
        let mut squares = tally.square;
        if tally.rigid {
            // The stretch under way ends with the window.
            squares[self.batch()] += tally.stretch * tally.stretch / self.bin;
        }
        let means = tally.pushed.map(|p| p / batch);
        let squares = squares.map(|s| s / batch);
        let mean = |x: &[f64; BATCHES]| x.iter().sum::<f64>() / BATCHES as f64;
        let rms = mean(&squares).sqrt();
        let enough = contacts >= BATCHES || tally.pushed.iter().all(|&p| p > 0.0);
        let told = |half_width: f64| enough.then_some(half_width);
        Some(ForceStatistics {
            impulse_n_s: tally.impulse,
            impulse_half_width_95_n_s: told(half_width(&means) * self.length),
            mean_n: mean(&means),
            mean_half_width_95_n: told(half_width(&means)),
            rms_n: rms,
            rms_half_width_95_n: told(if rms > 0.0 { half_width(&squares) / (2.0 * rms) } else { 0.0 }),
            rms_averaged_over_s: tally.rigid.then_some(self.bin),
        })
    }
}

/// Impulse (N s) of a wall over a piece of a step, without the jump at its end, and ∫ of the squared force, N² s.
fn piece(step: &Step<'_>, wall: usize, [from, to]: [f64; 2]) -> (f64, f64) {
    let rate = match step.path {
        Path::Exact(arc) => arc.fastest_motion(),
        Path::Series(series) => series.rate(),
        Path::Grid | Path::OneRestitution | Path::Handed { .. } => {
            // A force constant over the step.
            let force = step.impulse[wall] / (step.end - step.start);
            return (force * (to - from), force * force * (to - from));
        }
    };
    // Half a radian of the fastest motion each: the square turns by one.
    let parts = ((to - from) * rate * 2.0).ceil().clamp(1.0, 1e6);
    let span = (to - from) / parts;
    let force = |part: f64, node: f64| step.path.contact_force(wall, from + span * (part + node));
    let mut square = 0.0;
    let mut part = 0.0;
    while part < parts {
        square += GAUSS.iter().map(|&node| force(part, node).powi(2)).sum::<f64>() * 0.5 * span;
        part += 1.0;
    }
    (step.path.contact_impulse(wall, from, to), square)
}
