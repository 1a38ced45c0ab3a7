//! Whether a motion has settled when the window of the statistics begins.
//!
//! Of n batch means xₖ the first is compared with the others, and the first half with the last:
//!
//! |x₁ − x̄′| > t s′ √(1 + 1/(n−1)),   |x̄₁ − x̄₂| > t s √(2/(n/2)),
//!
//! with the standard deviation s′ of the others, n − 2 degrees of freedom, and s pooled from both
//! halves. A motion that settles within a batch shows in the first, a drift in the second. Of
//! stationary motions whose batches are independent and normal, at most one in twenty is said to be
//! unsettled: the 5 % are divided among the tests of a run ([`TESTS`] of every mean; Bonferroni).
//! What is less than [`WORTH_SAYING`] of the mean is not said, however certain it is.

use super::batch::{BatchSums, Window};
use super::place::ContactPlace;
use super::student::{spread, student};
use serde::{Deserialize, Serialize};

/// The share of runs that have settled and are said not to have.
const LEVEL: f64 = 0.05;

/// Tests of each mean.
const TESTS: usize = 2;

/// A difference between parts of the window below this share of the mean is none.
const WORTH_SAYING: f64 = 0.01;

/// Student's t is larger for every level asked for: that of the normal distribution for 97.5 %.
const LEAST: f64 = 2.24;

/// The fewest batches that show whether a motion has settled.
const FEWEST: usize = 3;

/// A mean that differs between the beginning and the rest of the window by more than it scatters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Unsettled {
    /// The wall or support.
    pub place: ContactPlace,
    /// The mean force over the part of the window that differs, and over the rest, N; `None` where
    /// it is the work rate that differs.
    pub mean_force_n: Option<[f64; 2]>,
    /// The same of the work rate, W.
    pub work_rate_w: Option<[f64; 2]>,
    /// Where the window would have to begin, s; `None` unless half of it is alike.
    pub settled_from_s: Option<f64>,
}

/// The means of the beginning and of the rest of a window, and where that begins, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Beginning {
    pub first: f64,
    pub rest: f64,
    pub settled_from_s: Option<f64>,
}

impl Unsettled {
    /// Of the work rate or the mean force at `place`.
    pub(super) fn of(place: ContactPlace, is_work_rate: bool, found: Beginning) -> Self {
        let Beginning { first, rest, settled_from_s } = found;
        let of = |own: bool| own.then_some([first, rest]);
        Self { place, mean_force_n: of(!is_work_rate), work_rate_w: of(is_work_rate), settled_from_s }
    }

    /// What differs and its unit, with its means over the part of the window that differs and over
    /// the rest.
    pub(crate) fn means(&self) -> (&'static str, &'static str, [f64; 2]) {
        match (self.work_rate_w, self.mean_force_n) {
            (Some(means), _) => ("work rate", "W", means),
            (None, means) => ("mean force", "N", means.unwrap_or_default()),
        }
    }
}

impl Window {
    /// What has the sums `sums`, one of `means` means of a run, in the beginning of the window, if
    /// that differs from the rest.
    pub(super) fn beginning(&self, sums: &BatchSums, means: usize) -> Option<Beginning> {
        let batch = self.batch();
        let values: Vec<f64> = sums.iter().take(self.batches).map(|sum| sum / batch).collect();
        let level = 1.0 - LEVEL / (TESTS * means.max(1)) as f64;
        let differing = differing(&values, level)?;
        let after = |from: &usize| values.get(*from..).filter(|rest| rest.len() >= FEWEST);
        let settled = (1..values.len().div_ceil(2))
            .find(|from| after(from).is_some_and(|rest| self::differing(rest, level).is_none()));
        let (first, rest) = values.split_at(settled.unwrap_or(differing));
        let [(first, _), (rest, _)] = [first, rest].map(spread);
        Some(Beginning { first, rest, settled_from_s: settled.map(|from| self.start_of(from)) })
    }
}

/// How many of `values`, from the first, differ from the others; `None` where none do.
fn differing(values: &[f64], level: f64) -> Option<usize> {
    // Student's t, which takes a search, only of a difference that exceeds the least that it can
    // be.
    let beyond = |difference: f64, deviation: f64, freedom: usize, rest: f64| {
        let difference = difference.abs();
        difference > WORTH_SAYING * rest.abs()
            && difference > LEAST * deviation
            && difference > student(freedom as u64, level) * deviation
    };
    let (one, others) = values.split_first()?;
    let count = others.len() as f64;
    if values.len() >= FEWEST {
        let (rest, squares) = spread(others);
        let deviation = (squares / (count - 1.0) * (1.0 + 1.0 / count)).sqrt();
        if beyond(one - rest, deviation, others.len() - 1, rest) {
            return Some(1);
        }
    }
    let half = values.len() / 2;
    if half < 2 {
        return None;
    }
    let [(first, first_squares), (last, last_squares)] = [&values[..half], &values[values.len() - half..]].map(spread);
    let freedom = 2 * half - 2;
    let deviation = ((first_squares + last_squares) / freedom as f64 * 2.0 / half as f64).sqrt();
    beyond(first - last, deviation, freedom, last).then_some(half)
}

#[cfg(test)]
mod tests {
    use super::super::batch::NO_SUMS;
    use super::*;
    use crate::hash;
    use crate::scene::Scene;
    use std::f64::consts::TAU;

    /// Independent normal deviates of the stream `stream`.
    fn normal(stream: u64, k: u64) -> f64 {
        let draw = |which: u64| hash::unit(hash::mix(71, stream, 2 * k + which));
        (-2.0 * (1.0 - draw(0)).ln()).sqrt() * (TAU * draw(1)).cos()
    }

    /// The window of ten batches of a second, and the sums of `values`.
    fn window(values: impl Iterator<Item = f64>) -> (Window, BatchSums) {
        let mut sums = NO_SUMS;
        sums.iter_mut().zip(values.take(10)).for_each(|(sum, x)| *sum = x);
        (Window::new(&Scene::oscillator(1.0, 0.0, 1.0).with_duration(10.0), 0.0), sums)
    }

    #[test]
    fn of_a_thousand_stationary_series_one_in_twenty_at_most_is_said_to_be_unsettled() {
        // Normal batches, and batches of 20 values of an AR(1) process of φ = 0.8, whose
        // correlation lasts for 4.5 of them. Both tests together err in at most 5 % of the former,
        // less where they agree: of 1000 series in 50 ± 7; three times that are allowed, and a
        // tenth of the 50 is asked for, so that the tests do something. Correlated batches err a
        // little more often.
        let series = 1000;
        let count = |values: &dyn Fn(u64) -> Vec<f64>| {
            let said = |stream: &u64| {
                let (window, sums) = window(values(*stream).into_iter());
                window.beginning(&sums, 1).is_some()
            };
            (0..series).filter(said).count()
        };
        let white = count(&|stream| (0..10).map(|k| 10.0 + 2.0 * normal(stream, k)).collect());
        assert!((5..=71).contains(&white), "{white}");
        let correlated = count(&|stream| {
            let (mut x, mut sums) = (normal(stream, 9999) / 0.6, vec![0.0; 10]);
            for k in 0..200 {
                x = 0.8 * x + normal(stream, k);
                sums[k as usize / 20] += 10.0 + x;
            }
            sums
        });
        assert!((5..=90).contains(&correlated), "{correlated}");
    }

    #[test]
    fn eight_means_of_a_run_share_the_error_of_one() {
        // As above: the union of the tests of all means has 5 %.
        let said = |run: &u64| {
            (0..8).any(|mean| {
                let (window, sums) = window((0..10).map(|k| 10.0 + normal(8 * run + mean, k)));
                window.beginning(&sums, 8).is_some()
            })
        };
        let count = (0..1000).filter(said).count();
        assert!((5..=71).contains(&count), "{count}");
    }

    #[test]
    fn a_transient_is_seen_and_where_it_ends() {
        // Scatter of 1 %; batches that are too large by a half, a quarter and an eighth.
        let excess = [0.5, 0.25, 0.125];
        let value = |k: u64| 10.0 * (1.0 + excess.get(k as usize).unwrap_or(&0.0)) + 0.1 * normal(3, k);
        let (window, sums) = window((0..10).map(value));
        let found = window.beginning(&sums, 1).unwrap();
        assert_eq!(found.settled_from_s, Some(3.0));
        // 10 (1 + 0.875/3), with the scatter of the mean of three, and of seven; four times these.
        assert!((found.first - 12.917).abs() < 0.24 && (found.rest - 10.0).abs() < 0.16, "{found:?}");
    }

    #[test]
    fn a_drift_never_settles_and_what_is_less_than_a_hundredth_is_not_said() {
        let (drift, sums) = window((0..10).map(|k| 10.0 + f64::from(k)));
        assert_eq!(drift.beginning(&sums, 1).unwrap().settled_from_s, None);
        let (small, sums) = window((0..10).map(|k| if k == 0 { 10.09 } else { 10.0 }));
        assert_eq!(small.beginning(&sums, 1), None);
        let (large, sums) = window((0..10).map(|k| if k == 0 { 10.11 } else { 10.0 }));
        assert_eq!(large.beginning(&sums, 1).unwrap().settled_from_s, Some(1.0));
    }
}
