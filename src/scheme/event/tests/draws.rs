//! Numbers that look random, the same in every run.

use crate::hash::{mix, unit};

pub(in crate::scheme::event) struct Draws {
    stream: u64,
    seed: u64,
    count: u64,
}

impl Draws {
    pub fn new(stream: u64, seed: u64) -> Self {
        Self { stream, seed, count: 0 }
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.count += 1;
        low + (high - low) * unit(mix(self.stream, self.seed, self.count))
    }

    /// From 2^−`octaves` to 2^`octaves`, as often in one octave as in another.
    pub fn size(&mut self, octaves: f64) -> f64 {
        self.between(-octaves, octaves).exp2()
    }
}
