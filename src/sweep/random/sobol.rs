//! Sobol's sequence, plain or scrambled.

use crate::hash::mix;
use std::sync::LazyLock;

/// Maximum number of dimensions.
pub const MOST_DIMENSIONS: usize = 32;

/// Bits of a coordinate.
const BITS: usize = 32;

/// The direction numbers of Joe & Kuo (SIAM J. Sci. Comput. 30, 2008, doi:10.1137/070709359):
/// `new-joe-kuo-6`, with their licence.
const JOE_KUO: &str = include_str!("joe-kuo.txt");

/// Direction numbers v₁, v₂, … of each dimension, the first bit on top.
static DIRECTIONS: LazyLock<Vec<[u32; BITS]>> = LazyLock::new(|| {
    // The first dimension is van der Corput's sequence.
    let mut first = [0; BITS];
    first.iter_mut().enumerate().for_each(|(k, v)| *v = 1 << (BITS - 1 - k));
    let lines = JOE_KUO.lines().filter(|line| !line.starts_with('#'));
    let further = lines.map(|line| {
        let numbers: Vec<u32> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        directions(numbers.get(2).copied().unwrap_or(0), numbers.get(3..).unwrap_or_default())
    });
    std::iter::once(first).chain(further).collect()
});

/// Direction numbers from the coefficients `a` of a primitive polynomial of degree `m.len()` and
/// the first of them, by the recurrence of Bratley & Fox (1988, doi:10.1145/42288.214372).
fn directions(a: u32, m: &[u32]) -> [u32; BITS] {
    let degree = m.len();
    let mut v = [0; BITS];
    for k in 0..BITS {
        v[k] = match (m.get(k), k.checked_sub(degree)) {
            (Some(first), _) => first << (BITS - 1 - k),
            (None, Some(back)) => {
                let terms = (1..degree).filter(|i| (a >> (degree - 1 - i)) & 1 == 1);
                terms.fold(v[back] ^ (v[back] >> degree), |sum, i| sum ^ v[k - i])
            }
            (None, None) => 0,
        };
    }
    v
}

/// Coordinate `dimension` of point `point`: in the order of Gray's code (Antonov & Saleev 1979) and
/// plain without a seed, as in most programs; with a seed scrambled, which keeps its uniformity.
pub(super) fn share(seed: Option<u64>, point: u64, dimension: usize) -> f64 {
    let gray = point ^ (point >> 1);
    let numbers = DIRECTIONS.get(dimension % MOST_DIMENSIONS).into_iter().flatten().enumerate();
    let bits = numbers.filter(|(k, _)| (gray >> k) & 1 == 1).fold(0u32, |sum, (_, v)| sum ^ v);
    let bits = seed.map_or(bits, |seed| scrambled(bits, mix(seed, dimension as u64, u64::MAX) as u32));
    f64::from(bits) / 2.0_f64.powi(BITS as i32)
}

/// Owen's nested scrambling by a hash in which every bit depends only on those above it (Burley,
/// Practical hash-based Owen scrambling, JCGT 9(4), 2020, after Laine & Karras 2011).
fn scrambled(bits: u32, seed: u32) -> u32 {
    let mut x = bits.reverse_bits();
    x = x.wrapping_add(seed);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^= x.wrapping_mul(0x8d22_f6e6);
    x.reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_points_are_the_published_ones() {
        // The first ten points in three dimensions, as printed by the program that Joe & Kuo
        // publish with their numbers.
        let published = [
            [0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25],
            [0.25, 0.75, 0.75],
            [0.375, 0.375, 0.625],
            [0.875, 0.875, 0.125],
            [0.625, 0.125, 0.875],
            [0.125, 0.625, 0.375],
            [0.1875, 0.3125, 0.9375],
            [0.6875, 0.8125, 0.4375],
        ];
        for (point, expected) in published.iter().enumerate() {
            let found = [0, 1, 2].map(|dimension| share(None, point as u64, dimension));
            assert_eq!(found, *expected, "point {point}");
        }
    }

    #[test]
    fn every_dimension_is_a_net_plain_and_scrambled() {
        assert_eq!(DIRECTIONS.len(), MOST_DIMENSIONS);
        for seed in [None, Some(7)] {
            for dimension in 0..MOST_DIMENSIONS {
                // Of 2ᵏ points every interval of 2⁻ᵏ has one.
                let mut seen = [0; 256];
                (0..256).for_each(|point| seen[(share(seed, point, dimension) * 256.0) as usize] += 1);
                assert!(seen.iter().all(|&n| n == 1), "dimension {dimension}, seed {seed:?}");
            }
        }
    }

    #[test]
    fn the_first_two_dimensions_are_even_in_every_shape_of_box() {
        for seed in [None, Some(3)] {
            for wide in 0..=8 {
                let (across, up) = (1 << wide, 1 << (8 - wide));
                let mut seen = vec![0; 256];
                for point in 0..256 {
                    let [x, y] = [0, 1].map(|dimension| share(seed, point, dimension));
                    seen[(x * f64::from(across)) as usize + across as usize * (y * f64::from(up)) as usize] += 1;
                }
                assert!(seen.iter().all(|&n| n == 1), "{across} by {up}, seed {seed:?}");
            }
        }
    }

    #[test]
    fn a_seed_gives_other_points_and_always_the_same() {
        let points = |seed| (0..16).map(|point| share(seed, point, 4)).collect::<Vec<_>>();
        assert_ne!(points(Some(1)), points(Some(2)));
        assert_ne!(points(Some(1)), points(None));
        assert_eq!(points(Some(1)), points(Some(1)));
    }
}
