//! Pseudo-random numbers, the same on every machine: as a hash of three numbers in any order, or
//! each from the one before.

/// 64 bits that depend on all of `seed`, `stream` and `index`: the finaliser of SplitMix64 (Steele,
/// Lea & Flood 2014, doi:10.1145/2660193.2660195) after each of them.
pub(crate) fn mix(seed: u64, stream: u64, index: u64) -> u64 {
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let step = |state: u64, x: u64| finish(state.wrapping_add(GOLDEN) ^ finish(x.wrapping_add(GOLDEN)));
    step(step(step(0, seed), stream), index)
}

fn finish(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A number from 0 to below 1, from the upper 53 bits.
pub(crate) fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1u64 << 53) as f64
}

/// The number from 0 to below 1 that follows `state`, which it moves on: a linear congruential
/// generator with Knuth's multiplier.
pub(crate) fn next_unit(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    unit(*state)
}

/// Numbers that look random, the same in every run, each from the one before.
#[cfg(test)]
pub(crate) struct Draws {
    seed: u64,
    stream: u64,
    count: u64,
}

#[cfg(test)]
impl Draws {
    pub(crate) fn new(seed: u64, stream: u64) -> Self {
        Self { seed, stream, count: 0 }
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.count += 1;
        low + (high - low) * unit(mix(self.seed, self.stream, self.count))
    }

    pub(crate) fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }

    /// From 2^−`octaves` to 2^`octaves`, as often in one octave as in another.
    pub(crate) fn size(&mut self, octaves: f64) -> f64 {
        self.between(-octaves, octaves).exp2()
    }

    /// A whole number from 0 to below `count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        self.between(0.0, count as f64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_even_and_neighbours_have_nothing_in_common() {
        // Mean 1/2 and variance 1/12 of 1e5 draws scatter by 1/√(12·1e5) = 9e-4; correlations of
        // neighbours by 1/√1e5 = 3e-3.
        let n = 100_000;
        let draw = |index, stream| unit(mix(7, stream, index)) - 0.5;
        let mean = |f: &dyn Fn(u64) -> f64| (0..n).map(f).sum::<f64>() / n as f64;
        assert!(mean(&|i| draw(i, 0)).abs() < 4e-3);
        assert!((mean(&|i| draw(i, 0).powi(2)) - 1.0 / 12.0).abs() < 2e-3);
        assert!((12.0 * mean(&|i| draw(i, 0) * draw(i + 1, 0))).abs() < 1.3e-2);
        assert!((12.0 * mean(&|i| draw(i, 0) * draw(i, 1))).abs() < 1.3e-2);
        assert!((12.0 * mean(&|i| draw(i, 0) * (unit(mix(8, 0, i)) - 0.5))).abs() < 1.3e-2);
        // The finaliser's published value: SplitMix64 of seed 0 begins with this.
        assert_eq!(finish(0x9e37_79b9_7f4a_7c15), 0xe220_a839_7b1d_cdaf);
    }
}
