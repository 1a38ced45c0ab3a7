//! What histories of wear found.

use super::super::realisations::{Deepest, mean_of};
use crate::residual::Finding;
use crate::run::Cautioned;
use serde::Serialize;

/// A support at one time of a history.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WearState {
    /// The gap, m: of flats the least.
    pub gap_m: f64,
    /// Where the centre has moved since the start, along y and z, m.
    pub shift_m: [f64; 2],
    /// The work of wear since the start, J.
    pub work_j: f64,
    /// The work rate at this gap, W.
    pub work_rate_w: f64,
    /// The depth worn off the tube where it is deepest, m: in a sector of a round support, or at
    /// one of the flats, and no deeper than `depth_one_scar_m`; NaN where that would cut the tube
    /// in two. Of one history under random loads it is an upper figure: the part that is the
    /// deepest by chance counts. [`mean`] has less of that.
    pub depth_deepest_m: f64,
    /// The depth worn off the tube, evenly all round, m.
    pub depth_all_round_m: f64,
    /// The depth if all that is worn off the tube comes off one scar in the first gap, m; NaN where
    /// that would cut the tube in two.
    pub depth_one_scar_m: f64,
}

/// A quantity of a support that changes over the years.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum WearQuantity {
    /// The gap, m.
    Gap,
    /// The depth worn off the tube where it is deepest, m.
    DepthDeepest,
    /// The depth worn off the tube, evenly all round, m.
    DepthAllRound,
    /// The depth if all that is worn off the tube comes off one scar, m.
    DepthOneScar,
    /// The work rate, W.
    WorkRate,
}

impl WearQuantity {
    /// Its value in a state.
    #[must_use]
    pub fn of(self, state: &WearState) -> f64 {
        match self {
            Self::Gap => state.gap_m,
            Self::DepthDeepest => state.depth_deepest_m,
            Self::DepthAllRound => state.depth_all_round_m,
            Self::DepthOneScar => state.depth_one_scar_m,
            Self::WorkRate => state.work_rate_w,
        }
    }
}

/// All histories at one time.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WearPoint {
    /// Time in service, s.
    pub time_s: f64,
    /// Each history, with a state for each support.
    pub histories: Vec<Vec<WearState>>,
    /// Of a single history each support as it would be if the work rate of every window were
    /// larger by the half width of its 95 % interval, and every step erred as estimated, with a
    /// work of NaN where a window has no interval. None of several histories, whose scatter tells
    /// more.
    pub largest: Vec<WearState>,
    /// Of each history, at each support: the depth worn off the tube in each sector of a round
    /// support, or at each flat, m; none of a tube that does not wear.
    #[serde(skip)]
    pub depths_m: Vec<Vec<Vec<f64>>>,
}

impl WearPoint {
    /// The state of a history at a support, both by number.
    fn state(&self, history: usize, support: usize) -> Option<&WearState> {
        self.histories.get(history)?.get(support)
    }

    /// The depths of all parts of a support, by number, in each history, m.
    pub(super) fn depths(&self, support: usize) -> Vec<Vec<f64>> {
        self.depths_m.iter().filter_map(|supports| supports.get(support).cloned()).collect()
    }

    /// A support, by number, as it would be with the largest work rates, where these are known.
    fn largest(&self, support: usize) -> Option<&WearState> {
        self.largest.get(support).filter(|state| state.work_j.is_finite())
    }
}

/// Where the tube is worn through, by the mean over the histories of the deepest depth.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WornThrough {
    /// The name of the support.
    pub support: String,
    /// Thickness of the wall, m; `None` where it is not known.
    pub wall_m: Option<f64>,
    /// The depth at which the histories end, m: the wall, or else the radius of the tube.
    pub depth_m: f64,
    /// Time in service, s.
    pub time_s: f64,
}

/// Histories of wear.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WearHistories {
    /// The names of the supports.
    pub supports: Vec<String>,
    /// From the start to the end.
    pub points: Vec<WearPoint>,
    /// Where the histories end before the time in service.
    pub worn_through: Option<WornThrough>,
    /// At the end of each history, of each support: the depth worn off the tube in each sector of a
    /// round support, or at each flat, m; none of a tube that does not wear.
    pub depths_at_end_m: Vec<Vec<Vec<f64>>>,
    /// The same of a single history with the largest work rates (field `largest` of
    /// [`WearPoint`]); none of several histories.
    pub largest_depths_at_end_m: Vec<Vec<f64>>,
    /// Number of windows that were run, or had been run before.
    pub windows: u64,
    /// The windows that the judge refuted: number and findings.
    pub refuted: Vec<(u64, Vec<Finding>)>,
    /// The windows with notes that limit the use of their results.
    pub cautioned: Cautioned,
}

/// The mean of a quantity over the histories, and the half width of its 95 % interval: of a single
/// history by the half widths of the work rates of its windows, as if these erred all alike, and
/// the estimated errors of its steps. Of the deepest depth it is the largest of the means of all
/// parts; its half width holds the bias of taking the largest, by the jackknife over the histories.
#[must_use]
pub fn mean(point: &WearPoint, support: usize, quantity: WearQuantity) -> (f64, Option<f64>) {
    let largest = point.largest(support).map(|state| quantity.of(state));
    if quantity == WearQuantity::DepthDeepest {
        let found = Deepest::of(&point.depths(support));
        return within(found.value, found.half_width_95, largest);
    }
    let states = point.histories.iter().filter_map(|states| states.get(support));
    let values: Vec<f64> = states.map(|state| quantity.of(state)).collect();
    let (mean, _, half_width) = mean_of(&values);
    within(mean, half_width, largest)
}

/// A mean with its half width, of a single history by its value at the largest work rates, where
/// that is known.
fn within(mean: f64, half_width: Option<f64>, largest: Option<f64>) -> (f64, Option<f64>) {
    let of_windows = largest.map(|largest| (largest - mean).abs());
    (mean, half_width.or(of_windows).filter(|half_width| half_width.is_finite()))
}

impl WearHistories {
    /// The mean over the histories of the depth at their end in each sector or at each flat of a
    /// support, m, and the half width of its 95 % interval, as of [`mean`].
    #[must_use]
    pub fn mean_depths_at_end(&self, support: usize) -> Vec<(f64, Option<f64>)> {
        let own: Vec<&Vec<f64>> = self.depths_at_end_m.iter().filter_map(|supports| supports.get(support)).collect();
        let parts = own.first().map_or(0, |depths| depths.len());
        let part = |part: usize| {
            let values: Vec<f64> = own.iter().filter_map(|depths| depths.get(part).copied()).collect();
            let largest = self.largest_depths_at_end_m.get(support).and_then(|depths| depths.get(part));
            let (mean, _, half_width) = mean_of(&values);
            within(mean, half_width, largest.copied())
        };
        (0..parts).map(part).collect()
    }

    /// The time in service at which the mean over the histories of a quantity of a support, which
    /// grows, reaches `limit`, s: straight between the points; `None` where it does not.
    #[must_use]
    pub fn reaches(&self, support: usize, limit: f64, quantity: WearQuantity) -> Option<f64> {
        self.crossing(limit, |point| Some(mean(point, support, quantity).0))
    }

    /// The half width of the 95 % interval of that time, s: of the histories where each reaches the
    /// limit, of a single one by the half widths of the work rates of its windows. Of the deepest
    /// depth of several that of the depth then, over the rate at which it grows.
    #[must_use]
    pub fn half_width_of_time(&self, support: usize, limit: f64, quantity: WearQuantity) -> Option<f64> {
        let time = self.reaches(support, limit, quantity)?;
        if self.is_deepest_of_several(quantity) {
            let along = self.points.windows(2).find(|pair| pair[1].time_s >= time)?;
            return Straight::between(along, support, quantity)?.reaches(limit).1;
        }
        let each: Option<Vec<f64>> = self.reaches_by_history(support, limit, quantity).into_iter().collect();
        let of_windows = || self.crossing(limit, |point| point.largest(support).map(|state| quantity.of(state)));
        each.and_then(|times| mean_of(&times).2).or_else(|| Some(time - of_windows()?))
    }

    /// The time in service at which each history alone reaches it, s.
    #[must_use]
    pub fn reaches_by_history(&self, support: usize, limit: f64, quantity: WearQuantity) -> Vec<Option<f64>> {
        let histories = self.points.first().map_or(0, |point| point.histories.len());
        let own = |history: usize| {
            self.crossing(limit, |point| point.state(history, support).map(|state| quantity.of(state)))
        };
        (0..histories).map(own).collect()
    }

    /// The time in service at which the mean over the histories reaches `limit` after their end, if
    /// all go on to grow as between the last two points, s, and the half width of its 95 %
    /// interval; `None` where one has reached it, or does not grow.
    #[must_use]
    pub fn reaches_at_last_rate(
        &self,
        support: usize,
        limit: f64,
        quantity: WearQuantity,
    ) -> Option<(f64, Option<f64>)> {
        let ends @ [before, last] = self.points.last_chunk()?;
        if self.is_deepest_of_several(quantity) {
            let along = Straight::between(ends, support, quantity)?;
            return (along.rate() > 0.0 && along.last.1 < limit).then(|| along.reaches(limit));
        }
        let own = |history: usize| {
            let [start, end] = [before, last].map(|point| point.state(history, support));
            let (start, end) = (quantity.of(start?), quantity.of(end?));
            let rate = (end - start) / (last.time_s - before.time_s);
            let time = last.time_s + (limit - end) / rate;
            (rate > 0.0 && end < limit).then_some(time)
        };
        let times: Vec<f64> = (0..last.histories.len()).map(own).collect::<Option<_>>()?;
        let (time, _, half_width) = mean_of(&times);
        (!times.is_empty()).then_some((time, half_width))
    }

    /// True for the deepest depth of several histories, of which none alone has an estimate.
    fn is_deepest_of_several(&self, quantity: WearQuantity) -> bool {
        quantity == WearQuantity::DepthDeepest && self.points.first().is_some_and(|point| point.histories.len() > 1)
    }

    /// The time at which a value that grows along the points reaches `limit`, s.
    fn crossing(&self, limit: f64, value: impl Fn(&WearPoint) -> Option<f64>) -> Option<f64> {
        let along: Vec<(f64, f64)> =
            self.points.iter().filter_map(|point| Some((point.time_s, value(point)?))).collect();
        along.windows(2).find(|pair| pair[1].1 >= limit).map(|pair| {
            let [(t0, d0), (t1, d1)] = [pair[0], pair[1]];
            t0 + (t1 - t0) * ((limit - d0) / (d1 - d0)).clamp(0.0, 1.0)
        })
    }
}

/// A mean and its half width that go straight on through two points of time.
struct Straight {
    first: (f64, f64, Option<f64>),
    last: (f64, f64, Option<f64>),
}

impl Straight {
    fn between(points: &[WearPoint], support: usize, quantity: WearQuantity) -> Option<Self> {
        let at = |point: &WearPoint| {
            let (mean, half_width) = mean(point, support, quantity);
            (point.time_s, mean, half_width)
        };
        let [first, last] = points else { return None };
        Some(Self { first: at(first), last: at(last) })
    }

    fn rate(&self) -> f64 {
        (self.last.1 - self.first.1) / (self.last.0 - self.first.0)
    }

    /// The time at which the mean is `limit`, and the half width of that time.
    fn reaches(&self, limit: f64) -> (f64, Option<f64>) {
        let share = (limit - self.first.1) / (self.last.1 - self.first.1);
        let half_width = self.first.2.zip(self.last.2).map(|(first, last)| first + share * (last - first));
        let half_width = half_width.map(|half_width| (half_width / self.rate()).abs());
        (self.first.0 + share * (self.last.0 - self.first.0), half_width.filter(|half_width| half_width.is_finite()))
    }
}
