//! Realisations that fall into two groups: two attractors, of which each seed chooses one.
//!
//! A mean over two groups lies where no realisation is, and Student's interval, which takes values
//! for normal, says nothing of either. Two groups are told where the sorted values leave a hole,
//! two or more on either side, of more than c(N) s. Here s is the standard deviation within the
//! groups, of both together with N − 2 degrees of freedom: that of the larger group alone is
//! undefined for two of three values each, and three values lie close together by chance. For many
//! values c = 3; of few, normal ones leave such holes often (of six, 13 in 100 samples do), and
//! c = 60/(N − 2), which at most one sample of normal values in a thousand exceeds, for N = 6 … 22
//! (counted over 200 000 samples each): every support of every study is judged. A single value
//! apart is no group: it may be the end of a long tail.

use super::estimate::judged;
use super::measure::{Figure, Measure};
use super::realisation::Realisation;
use crate::error::amount;
use crate::statistics::{ContactPlace, PlaceKind, spread};
use serde::Serialize;
use std::fmt;

/// Fewest values that are judged.
const FEWEST: usize = 6;

/// Fewest values of a group.
const GROUP: usize = 2;

/// A hole of so many standard deviations within the groups parts them, of many values.
const HOLE: f64 = 3.0;

/// Of few values it takes this, over the degrees of freedom.
const HOLE_OF_FEW: f64 = 60.0;

/// Of a wider hole the number tells nothing: the values within the groups differ by rounding.
const WIDE: f64 = 100.0;

/// A hole below this share of the values is rounding.
const ROUNDING: f64 = 1e-9;

/// Two groups of values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Groups {
    /// How many are in the lower and in the upper one.
    pub counts: [usize; 2],
    /// Their means.
    pub means: [f64; 2],
    /// The hole between them in standard deviations within the groups; infinite where each is one
    /// value.
    pub hole: f64,
}

impl Groups {
    /// The two groups that `values` fall into; `None` where they do not.
    ///
    /// ```
    /// use signorini::study::realisations::Groups;
    ///
    /// let groups = Groups::of(&[1.0, 5.0, 1.1, 5.2, 0.9, 5.1, 1.0]).expect("about 1 and about 5");
    /// assert_eq!(groups.counts, [4, 3]);
    /// assert_eq!(Groups::of(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), None);
    /// ```
    #[must_use]
    pub fn of(values: &[f64]) -> Option<Self> {
        let count = values.len();
        if count < FEWEST || values.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let splits = (GROUP..=count - GROUP).map(|at| sorted.split_at(at));
        let (low, high) = splits.max_by(|a, b| between(*a).total_cmp(&between(*b)))?;
        let [(low_mean, low_sum), (high_mean, high_sum)] = [low, high].map(spread);
        let freedom = (count - 2) as f64;
        let gap = between((low, high));
        let hole = gap / ((low_sum + high_sum) / freedom).sqrt();
        let largest = sorted.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let wide = gap > ROUNDING * largest && hole > HOLE.max(HOLE_OF_FEW / freedom);
        wide.then_some(Self { counts: [low.len(), high.len()], means: [low_mean, high_mean], hole })
    }

    /// The groups in words that follow a place, of values called `what` in `unit`, of which one is
    /// `factor` in their own.
    pub(crate) fn words(&self, what: &str, unit: &str, factor: f64) -> String {
        let [(few, low), (many, high)] = [0, 1].map(|at| (self.counts[at], amount(factor * self.means[at], 3)));
        let hole = match self.hole {
            f64::INFINITY => "nothing".to_owned(),
            hole if hole > WIDE => format!("a hole of more than {WIDE} standard deviations within the groups"),
            hole => format!("a hole of {} standard deviations within the groups", amount(hole, 2)),
        };
        format!(
            "{few} with a {what} of {low} {unit} in the mean and {many} with {high} {unit}, and {hole} between them: \
             two attractors, unless it is chance, as in one sample of a thousand of one attractor; of two the mean \
             lies where none is, and its interval says nothing of either"
        )
    }
}

/// From the last of the lower values to the first of the upper ones.
fn between((low, high): (&[f64], &[f64])) -> f64 {
    low.last().zip(high.first()).map_or(0.0, |(low, high)| high - low)
}

/// Realisations that fall into two groups at a place.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PlaceGroups {
    /// Where.
    #[serde(flatten)]
    pub place: ContactPlace,
    /// By what: the work rate of a support, the mean force of a wall.
    pub measure: Measure,
    /// The groups.
    #[serde(flatten)]
    pub groups: Groups,
}

impl fmt::Display for PlaceGroups {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { place, measure, groups } = self;
        let words = groups.words(measure.words(), measure.unit(), 1.0);
        write!(f, "the realisations fall into two groups at {} {:?}: {words}", place.kind.word(), place.name)
    }
}

/// The places at which `members` fall into two groups: supports by their work rates, and where
/// there are none, walls by their mean forces.
pub(super) fn groups(members: &[Realisation]) -> Vec<PlaceGroups> {
    let figures = members.first().map_or(&[][..], |member| &member.figures);
    let supports = figures.iter().any(|figure| figure.place.kind == PlaceKind::Support);
    let measure = if supports { Measure::WorkRate } else { Measure::ForceMean };
    let groups = |(figure, values): (&Figure, Vec<f64>)| {
        Some(PlaceGroups { place: figure.place.clone(), measure, groups: Groups::of(&values)? })
    };
    judged(members, measure).filter_map(groups).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::{mix, unit};

    /// Number `k` of normal values of mean 0 and deviation 1, by Box and Muller.
    fn normal(sample: u64, k: u64) -> f64 {
        let [u, v] = [0, 1].map(|part| unit(mix(sample, part, k)));
        (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * v).cos()
    }

    #[test]
    fn two_groups_are_told_with_their_sizes_and_means() {
        for count in [6, 7, 12, 22, 50] {
            let missed = (0..200).filter(|sample| {
                // A third about 20, of few about 50, the others about 0.
                let far = if count < 10 { 50.0 } else { 20.0 };
                let value = |k: u64| normal(*sample, k) + if k.is_multiple_of(3) { far } else { 0.0 };
                let values: Vec<f64> = (0..count).map(value).collect();
                let upper = count.div_ceil(3) as usize;
                let told = Groups::of(&values);
                told.is_none_or(|found| {
                    assert_eq!(found.counts, [count as usize - upper, upper]);
                    (found.means[0] - 0.0).abs() > 3.0 || (found.means[1] - far).abs() > 3.0
                })
            });
            let missed = missed.count();
            assert!(missed <= 4, "{missed} of 200 samples of {count} values");
        }
    }

    #[test]
    fn normal_values_fall_into_two_groups_in_one_sample_of_a_thousand_at_most() {
        for count in [6, 7, 8, 10, 12, 13, 14, 18, 22, 30, 50] {
            let told = (0..20_000).filter(|sample| {
                let values: Vec<f64> = (0..count).map(|k| normal(*sample, k)).collect();
                Groups::of(&values).is_some()
            });
            let told = told.count();
            // 20 are one in a thousand; of so many the count scatters by 4.5.
            assert!(told <= 20 + 13, "{told} of 20000 samples of {count} values");
        }
    }

    #[test]
    fn equal_values_single_ones_and_few_are_no_groups() {
        assert_eq!(Groups::of(&[3.0; 12]), None);
        let rounded = [1.0, 1.0, 1.0, 1.0 + f64::EPSILON, 1.0 + f64::EPSILON, 1.0 + f64::EPSILON];
        assert_eq!(Groups::of(&rounded), None);
        assert_eq!(Groups::of(&[0.0, 0.1, 0.2, 0.1, 0.0, 50.0]), None, "one value apart");
        assert_eq!(Groups::of(&[0.0, 0.0, 0.0, 5.0, 5.0]), None, "five values");
        assert_eq!(Groups::of(&[0.0, 0.1, 0.2, f64::NAN, 5.0, 5.1]), None);
        let exact = Groups::of(&[2.0, 1.0, 2.0, 1.0, 2.0, 1.0]).unwrap();
        assert_eq!((exact.counts, exact.means, exact.hole), ([3, 3], [1.0, 2.0], f64::INFINITY));
        assert!(exact.words("work rate", "W", 1.0).contains("and nothing between them"));
    }
}
