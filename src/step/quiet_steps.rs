//! Steps of one degree of freedom between two contacts, collected so that recorder and judge can
//! process them together.

use super::{Path, Step};

/// Maximum number of steps: their numbers stay in the nearest cache.
const MOST: usize = 128;

/// Steps of one degree of freedom on a grid, one after another, in none of which a wall pushes, a
/// contact ends or an extra force acts.
///
/// Recorder and judge have little to do in such a step, and process many of them in one loop.
#[derive(Debug)]
pub struct QuietSteps {
    length: usize,
    /// Index of the first step and the time at its start, s.
    first: u64,
    start: f64,
    end: [f64; MOST],
    q: [f64; MOST],
    v: [f64; MOST],
    before: [f64; MOST],
    after: [f64; MOST],
    /// A zero for each wall.
    zeros: Vec<f64>,
}

impl QuietSteps {
    /// An empty collection for a scene with this number of walls.
    pub fn new(walls: usize) -> Self {
        let none = [0.0; MOST];
        let zeros = vec![0.0; walls];
        Self { length: 0, first: 0, start: 0.0, end: none, q: none, v: none, before: none, after: none, zeros }
    }

    /// The maximum number of steps.
    pub const fn capacity() -> usize {
        MOST
    }

    /// Takes the step that follows the last one taken, if there is room for it and it meets the
    /// conditions above. Returns whether it was taken.
    #[inline]
    pub fn take(&mut self, step: &Step<'_>) -> bool {
        let (&[q], &[v], &[extra]) = (step.q, step.v, step.extra) else { return false };
        let (&[before], &[after]) = (step.velocity_before, step.velocity_after) else { return false };
        let zero = |x: &[f64]| x.len() == self.zeros.len() && x.iter().all(|&x| x == 0.0);
        let quiet = matches!(step.path, Path::Grid) && extra == 0.0 && zero(step.impulse) && zero(step.force);
        if !quiet || !step.closed.is_empty() || !step.friction.is_empty() {
            return false;
        }
        if self.begin(step.index, step.start) == 0 {
            return false;
        }
        self.put(step.end, [q, v, before, after]);
        true
    }

    /// Prepares for the step of this index, which starts at `start` (s); returns the number of
    /// steps for which there is room.
    #[inline]
    pub fn begin(&mut self, index: u64, start: f64) -> u64 {
        if self.length == 0 {
            (self.first, self.start) = (index, start);
        }
        (MOST - self.length) as u64
    }

    /// Adds the next step by the time (s) and the state (m, m/s) at its end and the velocities that
    /// enter and leave its balance, m/s. Steps of several degrees of freedom are left out.
    #[inline]
    pub fn add(&mut self, end: f64, (q, v): (&[f64], &[f64]), (before, after): (&[f64], &[f64])) {
        if let (&[q], &[v], &[before], &[after]) = (q, v, before, after) {
            self.put(end, [q, v, before, after]);
        }
    }

    #[inline]
    fn put(&mut self, end: f64, [q, v, before, after]: [f64; 4]) {
        let at = self.length;
        if at < MOST {
            (self.end[at], self.q[at], self.v[at]) = (end, q, v);
            (self.before[at], self.after[at]) = (before, after);
            self.length = at + 1;
        }
    }

    /// Number of steps.
    pub fn len(&self) -> usize {
        self.length
    }

    /// True if there is no room for another step.
    pub fn is_full(&self) -> bool {
        self.length == MOST
    }

    /// Removes all steps.
    pub fn clear(&mut self) {
        self.length = 0;
    }

    /// Times at the ends of the steps, s.
    pub fn end(&self) -> &[f64] {
        &self.end[..self.length]
    }

    /// Time at the start of step `k`, s.
    pub fn start(&self, k: usize) -> f64 {
        if k == 0 { self.start } else { self.end[k - 1] }
    }

    /// Displacements at their ends, m.
    pub fn q(&self) -> &[f64] {
        &self.q[..self.length]
    }

    /// Velocities at their ends, m/s.
    pub fn v(&self) -> &[f64] {
        &self.v[..self.length]
    }

    /// Velocities that enter and leave the balance of each step, m/s.
    pub fn velocities(&self) -> (&[f64], &[f64]) {
        (&self.before[..self.length], &self.after[..self.length])
    }

    /// Step `k` by itself.
    pub fn step(&self, k: usize) -> Step<'_> {
        let one = k..k + 1;
        Step {
            index: self.first + k as u64,
            start: self.start(k),
            end: self.end[k],
            q: &self.q[one.clone()],
            v: &self.v[one.clone()],
            velocity_before: &self.before[one.clone()],
            velocity_after: &self.after[one],
            ..Step::still(&[0.0], &self.zeros)
        }
    }
}
