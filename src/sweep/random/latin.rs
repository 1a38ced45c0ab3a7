//! Latin hypercubes without a table: the slice of a point is a permutation of its number, which is
//! computed directly.

use crate::hash::{mix, unit};

/// Coordinate of point `point` of `points` in `dimension`: McKay, Beckman & Conover 1979
/// (doi:10.1080/00401706.1979.10489755).
pub(super) fn share(seed: u64, points: u64, point: u64, dimension: u64) -> f64 {
    let slice = permuted(point, points, mix(seed, dimension, u64::MAX));
    let within = unit(mix(seed, dimension, point));
    // Rounding must not carry a point into the next slice.
    ((slice as f64 + within) / points as f64).min(((slice + 1) as f64 / points as f64).next_down())
}

/// The image of `index` under the permutation number `key` of 0, …, `count` − 1.
///
/// A Feistel network of four rounds permutes the least square of a power of two that holds `count`;
/// it is applied again until the result is below `count` (Black & Rogaway 2002,
/// doi:10.1007/3-540-45760-7_9: cycle walking).
fn permuted(index: u64, count: u64, key: u64) -> u64 {
    if count < 2 {
        return 0;
    }
    let bits = 64 - (count - 1).leading_zeros();
    let half = bits.div_ceil(2).max(1);
    let mask = (1u64 << half) - 1;
    let mut at = index;
    loop {
        let (mut left, mut right) = (at >> half, at & mask);
        for round in 0..4 {
            (left, right) = (right, left ^ (mix(key, round, right) & mask));
        }
        at = (left << half) | right;
        if at < count {
            return at;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_slice_has_one_point_in_every_dimension() {
        for points in [1, 2, 3, 10, 64, 1000] {
            for dimension in 0..3 {
                let mut seen = vec![0; points as usize];
                (0..points).for_each(|i| seen[(share(5, points, i, dimension) * points as f64) as usize] += 1);
                assert!(seen.iter().all(|&n| n == 1), "{points} points, dimension {dimension}");
            }
        }
    }

    #[test]
    fn dimensions_and_seeds_are_permuted_apart() {
        let slices =
            |seed, dimension| (0..100).map(|i| (share(seed, 100, i, dimension) * 100.0) as u64).collect::<Vec<_>>();
        assert_ne!(slices(1, 0), slices(1, 1));
        assert_ne!(slices(1, 0), slices(2, 0));
        // A correlation of two permutations of a hundred scatters by 1/√99 = 0.1.
        let pairs = slices(1, 0).into_iter().zip(slices(1, 1));
        let sum: f64 = pairs.map(|(a, b)| (a as f64 - 49.5) * (b as f64 - 49.5)).sum();
        assert!((sum / (100.0 * 833.25)).abs() < 0.4, "{sum}");
    }
}
