//! Phases that look random, from numbers that count.

/// A number from 0 to below 1 for line `line` of the signal `stream` of `seed`: the upper 53 bits
/// of the finaliser of SplitMix64 (Steele, Lea & Flood 2014, doi:10.1145/2660193.2660195) after
/// each of them. It is the same on every machine and does not depend on the other lines.
pub(super) fn unit(seed: u64, stream: u64, line: u64) -> f64 {
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let step = |state: u64, x: u64| finish(state.wrapping_add(GOLDEN) ^ finish(x.wrapping_add(GOLDEN)));
    (step(step(step(0, seed), stream), line) >> 11) as f64 / (1u64 << 53) as f64
}

fn finish(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_are_even_and_signals_have_nothing_in_common() {
        // The finaliser's published value: SplitMix64 of seed 0 begins with this.
        assert_eq!(finish(0x9e37_79b9_7f4a_7c15), 0xe220_a839_7b1d_cdaf);
        // Means of 1e5 draws scatter by 1/√(12·1e5) = 9e-4, their correlations by 3e-3.
        let n = 100_000;
        let draw = |seed, stream, line| unit(seed, stream, line) - 0.5;
        let mean = |f: &dyn Fn(u64) -> f64| (0..n).map(f).sum::<f64>() / n as f64;
        assert!(mean(&|i| draw(1, 0, i)).abs() < 4e-3);
        assert!((12.0 * mean(&|i| draw(1, 0, i).powi(2)) - 1.0).abs() < 1e-2);
        for (seed, stream, ahead) in [(1, 0, 1), (1, 1, 0), (2, 0, 0)] {
            let both = mean(&|i| draw(1, 0, i) * draw(seed, stream, i + ahead));
            assert!((12.0 * both).abs() < 1.3e-2, "{seed} {stream} {ahead}: {both}");
        }
    }
}
