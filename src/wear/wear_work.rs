//! The work of wear at a support, by its sectors and walls.

use serde::{Deserialize, Serialize};

/// The share of the way to another work over which a slope is taken.
const SLOPE: f64 = 1e-5;

/// Work of wear at a support, J; as a rate, W.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub struct WearWork {
    /// All of it.
    pub total: f64,
    /// That of each of equal sectors, from +y towards +z.
    pub sectors: Vec<f64>,
    /// That of each wall of the support, in their order.
    pub walls: Vec<f64>,
}

impl WearWork {
    /// None, at a support of so many walls in so many sectors.
    #[must_use]
    pub fn none(sectors: usize, walls: usize) -> Self {
        Self { total: 0.0, sectors: vec![0.0; sectors], walls: vec![0.0; walls] }
    }

    /// The work after `time` (s) at the mean of two rates.
    #[must_use]
    pub fn advanced(&self, first: &Self, second: &Self, time: f64) -> Self {
        self.with(first, second, |work, first, second| work + time * (0.5 * (first + second)))
    }

    /// The work and, everywhere, what `time` (s) makes of the difference of two rates.
    #[must_use]
    pub(crate) fn plus_difference(&self, first: &Self, second: &Self, time: f64) -> Self {
        self.with(first, second, |work, first, second| work + time * (second - first).abs())
    }

    /// The straight way from here to `other`, at the share `share` of it.
    #[must_use]
    pub(crate) fn towards(&self, other: &Self, share: f64) -> Self {
        self.with(self, other, |_, from, to| from + share * (to - from))
    }

    /// The work, and its rate, at the share `share` of a step of `step` seconds that makes the work
    /// `after` of it, where the rate grows straight from `rate` on.
    #[must_use]
    pub(crate) fn within(&self, rate: &Self, after: &Self, step: f64, share: f64) -> (Self, Self) {
        let work = self.with(rate, after, |work, rate, after| {
            let even = step * rate;
            work + share * (even + share * (after - work - even))
        });
        let rates = self.with(rate, after, |work, rate, after| {
            let grown = if step > 0.0 { (after - work) / step - rate } else { 0.0 };
            rate + 2.0 * share * grown
        });
        (work, rates)
    }

    /// What `of` makes of the work and two rates, of all and of each part.
    fn with(&self, first: &Self, second: &Self, of: impl Fn(f64, f64, f64) -> f64) -> Self {
        let all = |work: &[f64], first: &[f64], second: &[f64]| {
            let each = work.iter().zip(first.iter().zip(second));
            each.map(|(work, (first, second))| of(*work, *first, *second)).collect()
        };
        Self {
            total: of(self.total, first.total, second.total),
            sectors: all(&self.sectors, &first.sectors, &second.sectors),
            walls: all(&self.walls, &first.walls, &second.walls),
        }
    }

    /// The same, `factor` times as large everywhere.
    #[must_use]
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let all = |work: &[f64]| work.iter().map(|work| factor * work).collect();
        Self { total: factor * self.total, sectors: all(&self.sectors), walls: all(&self.walls) }
    }

    /// ∫ E(θ) (cos θ, sin θ) dθ, J, with the work of each sector spread evenly over it.
    pub(super) fn first_harmonic(&self) -> [f64; 2] {
        let width = std::f64::consts::TAU / self.sectors.len() as f64;
        let parts = self.sectors.iter().enumerate().map(|(k, work)| {
            let (from, to) = (k as f64 * width, (k + 1) as f64 * width);
            [to.sin() - from.sin(), from.cos() - to.cos()].map(|part| work * part / width)
        });
        parts.fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
    }

    /// What `depths` makes of the mean of `works`, and about it of each: its mean and the slope
    /// towards that work. The mean of the values is that of the mean work.
    ///
    /// A scar grows about like the work to the power of 2/3: the mean of the depths that single
    /// windows would make in years is less than the depth by their mean work, which these years
    /// have, and far less where contact is rare.
    pub(crate) fn about_mean(works: &[Self], depths: impl Fn(&Self) -> Vec<f64>) -> Vec<Vec<f64>> {
        let [first, others @ ..] = works else { return Vec::new() };
        let sum = others.iter().fold(first.clone(), |sum, work| sum.with(work, work, |sum, work, _| sum + work));
        let mean = sum.scaled(1.0 / works.len() as f64);
        let of_mean = depths(&mean);
        let departure = |work: &Self| -> Vec<f64> {
            let near = depths(&mean.towards(work, SLOPE));
            near.iter().zip(&of_mean).map(|(near, depth)| (near - depth) / SLOPE).collect()
        };
        let departures: Vec<Vec<f64>> = works.iter().map(departure).collect();
        // The mean of the departures is 0 but for the curvature and rounding.
        let centre = |(part, depth): (usize, &f64)| {
            let all = departures.iter().filter_map(|departures| departures.get(part));
            depth - all.sum::<f64>() / works.len() as f64
        };
        let centres: Vec<f64> = of_mean.iter().enumerate().map(centre).collect();
        let about = |own: &Vec<f64>| centres.iter().zip(own).map(|(centre, departure)| centre + departure).collect();
        departures.iter().map(about).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_depths_about_the_mean_is_that_of_the_mean_work() {
        let work = |walls: [f64; 2]| WearWork { total: walls.iter().sum(), sectors: vec![], walls: walls.to_vec() };
        let works = [work([0.0, 3.0]), work([8.0, 5.0]), work([0.0, 1.0])];
        let root = |work: &WearWork| work.walls.iter().map(|work| work.sqrt()).collect::<Vec<_>>();
        let found = WearWork::about_mean(&works, root);
        for (part, mean) in [8.0_f64 / 3.0, 3.0].into_iter().enumerate() {
            let own: Vec<f64> = found.iter().map(|depths| depths[part]).collect();
            assert!((own.iter().sum::<f64>() / 3.0 / mean.sqrt() - 1.0).abs() < 1e-14, "{own:?}");
            for (depth, work) in own.iter().zip(&works) {
                // The slope of a root, to the share over which it is taken.
                let wanted = mean.sqrt() + 0.5 / mean.sqrt() * (work.walls[part] - mean);
                assert!((depth - wanted).abs() < 1e-4, "{own:?}");
            }
        }
        assert_eq!(WearWork::about_mean(&works[..1], root), [root(&works[0])]);
        assert!(WearWork::about_mean(&[], root).is_empty());
    }
}
