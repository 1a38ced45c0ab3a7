//! A start whose velocities are known to a standard deviation only.

use crate::hash;
use std::f64::consts::TAU;

/// The stream of these draws, apart from those of random loads of the same seed.
const STREAM: u64 = 1 << 62;

/// Independent normal deviates of the velocities at the start: vᵢ = v̄ᵢ + σ zᵢ, with zᵢ of mean 0
/// and variance 1 (Box & Muller 1958, doi:10.1214/aoms/1177706645) from the seed and i. So the
/// first degrees of freedom have the same draws in scenes that have more of them, such as more
/// modes.
///
/// Where a motion is chaotic, starts that differ by less than anybody knows them give different
/// motions with the same statistics: these are realisations of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// Standard deviation σ, m/s; of a modal velocity in √kg m/s.
    pub deviation: f64,
    /// The same seed gives the same start.
    pub seed: u64,
}

impl Scatter {
    /// Adds the deviates to the velocities `v` of a start.
    pub(crate) fn add_to(self, v: &mut [f64]) {
        for (i, v) in (0..).zip(v) {
            let draw = |which: u64| hash::unit(hash::mix(self.seed, STREAM, 2 * i + which));
            *v += self.deviation * (-2.0 * (1.0 - draw(0)).ln()).sqrt() * (TAU * draw(1)).cos();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviates_are_normal_and_those_of_two_seeds_or_places_have_nothing_in_common() {
        // Of n = 1e5 draws the mean scatters by 1/√n = 3e-3, the variance by √(2/n) = 4e-3, the
        // fourth moment, 3, by √(96/n) = 3e-2, correlations by 3e-3: four times these are allowed.
        let n = 100_000;
        let draws = |seed: u64| {
            let mut v = vec![0.0; n];
            Scatter { deviation: 1.0, seed }.add_to(&mut v);
            v
        };
        let (one, two) = (draws(3), draws(4));
        let mean = |f: &dyn Fn(usize) -> f64| (0..n).map(f).sum::<f64>() / n as f64;
        assert!(mean(&|i| one[i]).abs() < 1.3e-2);
        assert!((mean(&|i| one[i].powi(2)) - 1.0).abs() < 1.8e-2);
        assert!((mean(&|i| one[i].powi(4)) - 3.0).abs() < 0.13);
        assert!(mean(&|i| one[i] * one[(i + 1) % n]).abs() < 1.3e-2);
        assert!(mean(&|i| one[i] * two[i]).abs() < 1.3e-2);
        // The start is shifted and scaled; fewer degrees of freedom have the same draws.
        let mut v = [1.0, -2.0];
        Scatter { deviation: 1e-3, seed: 3 }.add_to(&mut v);
        assert_eq!(v, [1.0 + 1e-3 * one[0], -2.0 + 1e-3 * one[1]]);
    }
}
