//! How a positive quantity of contact episodes is distributed.

use serde::Serialize;

/// Number of classes of exceedance.
const CLASSES: usize = 20;

/// Classes in a decade.
const A_DECADE: f64 = 5.0;

/// The quantiles that are given.
const QUANTILES: [f64; 3] = [0.5, 0.9, 0.99];

/// A positive quantity over a set of episodes, one value each.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Distribution {
    /// Arithmetic mean over the episodes.
    pub mean: f64,
    /// Largest.
    pub max: f64,
    /// The values below which 50, 90 and 99 % of the episodes lie: with the sorted values x₀ …
    /// x_{n−1}, x at the place p(n − 1), straight between neighbours (definition 7 of Hyndman & Fan
    /// 1996, doi:10.1080/00031305.1996.10473566).
    pub quantiles: [f64; 3],
    /// Twenty thresholds, five a decade, 10^(j/5) with whole j: the last twenty that the largest
    /// value reaches. They are the same in every run, so that the counts of runs can be added.
    pub thresholds: Vec<f64>,
    /// How many episodes reach each threshold.
    pub exceedances: Vec<usize>,
}

impl Distribution {
    /// That of `values`, 0 or more each; `None` if there are none.
    #[must_use]
    pub fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let max = *values.last()?;
        let thresholds = thresholds(max);
        let reached = |threshold: &f64| values.len() - values.partition_point(|x| x < threshold);
        Some(Self {
            mean: values.iter().sum::<f64>() / values.len() as f64,
            max,
            quantiles: QUANTILES.map(|p| quantile(&values, p)),
            exceedances: thresholds.iter().map(reached).collect(),
            thresholds,
        })
    }
}

/// The quantile p of sorted values.
fn quantile(sorted: &[f64], p: f64) -> f64 {
    let place = p * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let at = |index: usize| sorted.get(index).or(sorted.last()).copied().unwrap_or(0.0);
    at(below) + (place - place.floor()) * (at(below + 1) - at(below))
}

/// The thresholds up to `max`; none where that is 0.
fn thresholds(max: f64) -> Vec<f64> {
    let threshold = |j: f64| 10_f64.powf(j / A_DECADE);
    let mut last = (max.log10() * A_DECADE).floor();
    if !last.is_finite() {
        return Vec::new();
    }
    // The logarithm is rounded: the largest value decides.
    if threshold(last) > max {
        last -= 1.0;
    } else if threshold(last + 1.0) <= max {
        last += 1.0;
    }
    (0..CLASSES).map(|k| threshold(last - (CLASSES - 1 - k) as f64)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_and_classes_are_those_of_the_definition() {
        // 1, 2, …, 101: the place p·100 is the value 1 + 100 p.
        let one = Distribution::of((1..=101).rev().map(f64::from).collect()).unwrap();
        assert_eq!((one.mean, one.max), (51.0, 101.0));
        assert!(one.quantiles.iter().zip([51.0, 91.0, 100.0]).all(|(x, y)| (x - y).abs() < 1e-12), "{one:?}");
        // The last threshold that 101 reaches is 100; 63.1 is reached by 64 … 101.
        assert_eq!(one.thresholds.len(), 20);
        assert!((one.thresholds[19] / 100.0 - 1.0).abs() < 1e-15);
        assert!((one.thresholds[0] / 10_f64.powf(-1.8) - 1.0).abs() < 1e-14);
        assert_eq!(one.exceedances[17..], [101 - 39, 101 - 63, 2]);
        assert_eq!(one.exceedances[0], 101);
    }

    #[test]
    fn quantiles_lie_straight_between_neighbours() {
        // The places 1, 1.8 and 1.98 of three values.
        let one = Distribution::of(vec![7.0, 1.0, 2.0]).unwrap();
        assert!(one.quantiles.iter().zip([2.0, 6.0, 6.9]).all(|(x, y)| (x - y).abs() < 1e-14), "{one:?}");
    }

    #[test]
    fn a_largest_value_just_below_a_threshold_does_not_reach_it() {
        // Its logarithm rounds to that of the threshold, or not.
        for j in -40..40 {
            let (edge, below) = (10_f64.powf(f64::from(j) / 5.0), 10_f64.powf(f64::from(j - 1) / 5.0));
            let one = Distribution::of(vec![edge.next_down()]).unwrap();
            assert_eq!((one.thresholds[19], one.exceedances[19]), (below, 1), "{j}");
        }
    }

    #[test]
    fn a_largest_value_on_a_threshold_reaches_it() {
        for j in -40..40 {
            let max = 10_f64.powf(f64::from(j) / 5.0);
            let one = Distribution::of(vec![max]).unwrap();
            assert_eq!((one.thresholds[19], one.exceedances[19]), (max, 1), "{j}");
            assert_eq!(one.quantiles, [max; 3]);
        }
        assert!(Distribution::of(Vec::new()).is_none());
        assert!(Distribution::of(vec![0.0, 0.0]).unwrap().thresholds.is_empty());
    }
}
