//! What histories of wear found.

use super::super::realisations::mean_of;
use crate::residual::Finding;
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
    /// in two.
    pub depth_deepest_m: f64,
    /// The depth worn off the tube, evenly all round, m.
    pub depth_all_round_m: f64,
    /// The depth if all that is worn off the tube comes off one scar in the first gap, m; NaN where
    /// that would cut the tube in two.
    pub depth_one_scar_m: f64,
}

/// All histories at one time.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WearPoint {
    /// Time in service, s.
    pub time_s: f64,
    /// Each history, with a state for each support.
    pub histories: Vec<Vec<WearState>>,
    /// Of a single history each support as it would be if the work rate of every window were larger
    /// by the half width of its 95 % interval, with a work of NaN where a window has none. None of
    /// several histories, whose scatter tells more.
    pub largest: Vec<WearState>,
}

impl WearPoint {
    /// The state of a history at a support, both by number.
    fn state(&self, history: usize, support: usize) -> Option<&WearState> {
        self.histories.get(history)?.get(support)
    }

    /// A support, by number, as it would be with the largest work rates, where these are known.
    fn largest(&self, support: usize) -> Option<&WearState> {
        self.largest.get(support).filter(|state| state.work_j.is_finite())
    }
}

/// The first history in which the tube is worn through.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WornThrough {
    /// Its number, from 1.
    pub history: usize,
    /// The name of the support.
    pub support: String,
    /// Thickness of the wall, m.
    pub wall_m: f64,
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
    /// Where the histories end before the time in service: the first that is worn through.
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
}

/// The mean of a quantity over the histories, and the half width of its 95 % interval: of a single
/// history by the half widths of the work rates of its windows, as if these erred all alike.
#[must_use]
pub fn mean(point: &WearPoint, support: usize, quantity: impl Fn(&WearState) -> f64) -> (f64, Option<f64>) {
    let values: Vec<f64> = point.histories.iter().filter_map(|states| states.get(support)).map(&quantity).collect();
    mean_within(&values, point.largest(support).map(quantity))
}

/// The mean of a quantity over the histories and its half width, with the value of a single history
/// at the largest work rates, where that is known.
fn mean_within(values: &[f64], largest: Option<f64>) -> (f64, Option<f64>) {
    let (mean, _, half_width) = mean_of(values);
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
            mean_within(&values, largest.copied())
        };
        (0..parts).map(part).collect()
    }

    /// The time in service at which the mean over the histories of a quantity of a support, which
    /// grows, reaches `limit`, s: straight between the points; `None` where it does not.
    #[must_use]
    pub fn reaches(&self, support: usize, limit: f64, quantity: impl Fn(&WearState) -> f64 + Copy) -> Option<f64> {
        self.crossing(limit, |point| Some(mean(point, support, quantity).0))
    }

    /// The half width of the 95 % interval of that time, s: of the histories where each reaches the
    /// limit, of a single one by the half widths of the work rates of its windows.
    #[must_use]
    pub fn half_width_of_time(
        &self,
        support: usize,
        limit: f64,
        quantity: impl Fn(&WearState) -> f64 + Copy,
    ) -> Option<f64> {
        let time = self.reaches(support, limit, quantity)?;
        let each: Option<Vec<f64>> = self.reaches_by_history(support, limit, quantity).into_iter().collect();
        let of_windows = || self.crossing(limit, |point| point.largest(support).map(quantity));
        each.and_then(|times| mean_of(&times).2).or_else(|| Some(time - of_windows()?))
    }

    /// The time in service at which each history alone reaches it, s.
    #[must_use]
    pub fn reaches_by_history(
        &self,
        support: usize,
        limit: f64,
        quantity: impl Fn(&WearState) -> f64 + Copy,
    ) -> Vec<Option<f64>> {
        let histories = self.points.first().map_or(0, |point| point.histories.len());
        let own = |history: usize| self.crossing(limit, |point| point.state(history, support).map(quantity));
        (0..histories).map(own).collect()
    }

    /// The time after the end at which each history reaches `limit` if it goes on to grow as
    /// between the last two points, s; `None` where it has reached it, or does not grow.
    #[must_use]
    pub fn reaches_at_last_rate(
        &self,
        support: usize,
        limit: f64,
        quantity: impl Fn(&WearState) -> f64 + Copy,
    ) -> Vec<Option<f64>> {
        let [.., before, last] = &self.points[..] else { return Vec::new() };
        let own = |history: usize| {
            let [start, end] = [before, last].map(|point| point.state(history, support).map(quantity));
            let (start, end) = start.zip(end)?;
            let rate = (end - start) / (last.time_s - before.time_s);
            let time = last.time_s + (limit - end) / rate;
            (rate > 0.0 && end < limit).then_some(time)
        };
        (0..last.histories.len()).map(own).collect()
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
