//! Pairs of a slack and a pressure that should be complementary: at least one of the two is 0.

use super::largest_residual::{LargestResidual, Residual, over};

/// Maximum number of pairs that are kept.
const PAIRS: usize = 64;

/// Pairs (γ, |r|) that should be complementary, kept because their scales are known only at the end
/// of the run: of the pairs with both values positive, those that no other pair exceeds in both. A
/// run is accused by the pairs less their rounding errors.
#[derive(Debug, Clone, Default)]
pub(super) struct ComplementarityFront {
    /// Largest −γ and largest −|r| (a pull).
    pub outside: Residual,
    pub pull: Residual,
    pairs: Vec<(f64, f64)>,
    /// The pairs less their rounding errors, with their places.
    excess: Vec<(f64, f64, LargestResidual)>,
}

impl ComplementarityFront {
    /// Adds a pair of `slack` and `pressure`, each with its rounding error, of a wall in the step
    /// that ends at `time` (s).
    pub fn add(&mut self, (slack, gap_noise): (f64, f64), (pressure, force_noise): (f64, f64), time: f64, wall: usize) {
        self.outside.observe(-slack, gap_noise, time, Some(wall));
        self.pull.observe(-pressure, force_noise, time, Some(wall));
        self.add_pair(slack, pressure);
        let (slack, pressure) = (slack - gap_noise, pressure - force_noise);
        if slack <= 0.0 || pressure <= 0.0 || self.excess.iter().any(|s| s.0 >= slack && s.1 >= pressure) {
            return;
        }
        self.excess.retain(|s| s.0 > slack || s.1 > pressure);
        // A run with more such pairs violates complementarity in any case.
        if self.excess.len() < PAIRS {
            self.excess.push((slack, pressure, LargestResidual { value: 0.0, time, wall: Some(wall) }));
        }
    }

    fn add_pair(&mut self, slack: f64, pressure: f64) {
        if slack <= 0.0 || pressure <= 0.0 || self.pairs.iter().any(|&(s, p)| s >= slack && p >= pressure) {
            return;
        }
        self.pairs.retain(|&(s, p)| s > slack || p > pressure);
        // Of too many, two are replaced by one that is at least as large as both.
        let last = if self.pairs.len() == PAIRS { self.pairs.pop() } else { None };
        let (s, p) = last.unwrap_or((slack, pressure));
        self.pairs.push((s.max(slack), p.max(pressure)));
    }

    /// Largest |min(γ/γ₀, r/r₀)|.
    pub fn worst(&self, gap_scale: f64, force_scale: f64) -> f64 {
        let both = |&(s, p): &(f64, f64)| over(s, gap_scale).min(over(p, force_scale));
        let pairs = self.pairs.iter().map(both).fold(0.0, f64::max);
        pairs.max(over(self.outside.value, gap_scale)).max(over(self.pull.value, force_scale))
    }

    /// The largest min(γ/γ₀, r/r₀) of the pairs less their rounding errors, with its place.
    pub fn worst_excess(&self, gap_scale: f64, force_scale: f64) -> LargestResidual {
        let mut worst = LargestResidual::default();
        for (slack, pressure, at) in &self.excess {
            worst.observe((slack / gap_scale).min(pressure / force_scale), at.time, at.wall);
        }
        worst
    }
}

#[cfg(test)]
mod tests;
