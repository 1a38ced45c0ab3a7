//! Pseudo-random numbers as a hash of three numbers: the same on every machine and in any order.

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
