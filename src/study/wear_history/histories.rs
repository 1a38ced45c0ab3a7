//! What histories of wear found.

use super::super::realisations::{Deepest, mean_of};
use super::accrual::{Accrual, Works, at_support};
use super::state::{WearQuantity, WearState};
use super::support::WearingSupport;
use crate::residual::Finding;
use crate::run::Cautioned;
use crate::wear::WearWork;
use serde::Serialize;

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
    /// At each support, of each history: the depth worn off the tube in each sector of a round
    /// support, or at each flat, m, by the mean work of all histories and, about it, by what the
    /// work of this one departs from it; none of a tube that does not wear.
    #[serde(skip)]
    pub(super) depths_m: Vec<Vec<Vec<f64>>>,
    /// Likewise the depth of one scar of all of the work, m.
    #[serde(skip)]
    pub(super) scars_m: Vec<Vec<f64>>,
    /// The work so far.
    #[serde(skip)]
    pub(super) work: Accrual,
    /// The rates at which it grows.
    #[serde(skip)]
    pub(super) rates: Accrual,
}

impl WearPoint {
    /// The point at `time_s` (s) of the `supports`, after the work `work` (J) at the rates `rates`
    /// (W).
    pub(crate) fn new(supports: &[WearingSupport], time_s: f64, work: Accrual, rates: Accrual) -> Self {
        let states = |work: &Works, rates: &Works| -> Vec<Vec<WearState>> {
            let history = |(work, rates): (&Vec<WearWork>, &Vec<WearWork>)| {
                let all = supports.iter().zip(work.iter().zip(rates));
                all.map(|(support, (work, rate))| support.state(work, rate.total)).collect()
            };
            work.iter().zip(rates).map(history).collect()
        };
        let at_each = || supports.iter().enumerate().map(|(index, one)| (one, at_support(&work.found, index)));
        Self {
            time_s,
            histories: states(&work.found, &rates.found),
            largest: states(&work.largest, &rates.largest).concat(),
            depths_m: at_each().map(|(support, works)| support.depths_about_mean(&works)).collect(),
            scars_m: at_each().map(|(support, works)| support.scars_about_mean(&works)).collect(),
            work,
            rates,
        }
    }

    /// The point at the share `share` of the step to `other`, over which rates grow straight.
    pub(super) fn towards(&self, other: &Self, share: f64, supports: &[WearingSupport]) -> Self {
        let step = other.time_s - self.time_s;
        let (work, rates) = self.work.within(&self.rates, &other.work, step, share);
        Self::new(supports, self.time_s + share * step, work, rates)
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

/// When a limit is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TimeOfLimit {
    /// Time in service, s.
    pub time_s: f64,
    /// Half width of its 95 % interval, s: of the histories where each reaches the limit, of a
    /// single one by the half widths of the work rates of its windows. Of the deepest depth of
    /// several that of the depth then, over the rate at which it grows.
    pub half_width_95_s: Option<f64>,
}

/// When a quantity of a support that grows reaches a limit.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LimitReached {
    /// By the mean over the histories within the time in service; `None` where it does not.
    pub mean: Option<TimeOfLimit>,
    /// Where the mean does not, at the last rates after the end of the histories.
    pub at_last_rate: Option<TimeOfLimit>,
    /// The time in service at which each history alone reaches it, s.
    pub histories: Vec<Option<f64>>,
}

/// The depths that the work (J) of a history has worn off the tube at each support, m.
pub(super) fn depths(supports: &[WearingSupport], history: &[WearWork]) -> Vec<Vec<f64>> {
    supports.iter().zip(history).map(|(support, work)| support.depths(work)).collect()
}

/// Histories of wear.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WearHistories {
    /// The names of the supports.
    pub supports: Vec<String>,
    /// The supports.
    #[serde(skip)]
    pub(super) wearing: Vec<WearingSupport>,
    /// From the start to the end: at each window, and between two where a depth does not grow
    /// straight.
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
/// Depths of scars are those of the mean work, in place of their means over the histories.
#[must_use]
pub fn mean(point: &WearPoint, support: usize, quantity: WearQuantity) -> (f64, Option<f64>) {
    let largest = point.largest(support).map(|state| quantity.of(state));
    if quantity == WearQuantity::DepthDeepest {
        let found = Deepest::of(point.depths_m.get(support).map_or(&[], Vec::as_slice));
        return within(found.value, found.half_width_95, largest);
    }
    let states = point.histories.iter().filter_map(|states| states.get(support));
    let values: Vec<f64> = match quantity {
        WearQuantity::DepthOneScar => point.scars_m.get(support).cloned().unwrap_or_default(),
        _ => states.map(|state| quantity.of(state)).collect(),
    };
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
    /// Histories of `supports` that have not begun.
    pub(crate) fn none(supports: &[WearingSupport]) -> Self {
        Self {
            supports: supports.iter().map(|support| support.name.clone()).collect(),
            wearing: supports.to_vec(),
            points: Vec::new(),
            worn_through: None,
            depths_at_end_m: Vec::new(),
            largest_depths_at_end_m: Vec::new(),
            windows: 0,
            refuted: Vec::new(),
            cautioned: Cautioned::default(),
        }
    }

    /// The mean over the histories of the depth at their end in each sector or at each flat of a
    /// support, m, and the half width of its 95 % interval, as of [`mean`].
    #[must_use]
    pub fn mean_depths_at_end(&self, support: usize) -> Vec<(f64, Option<f64>)> {
        let own = self.points.last().and_then(|point| point.depths_m.get(support)).map_or(&[][..], Vec::as_slice);
        let parts = own.first().map_or(0, Vec::len);
        let part = |part: usize| {
            let values: Vec<f64> = own.iter().filter_map(|depths| depths.get(part).copied()).collect();
            let largest = self.largest_depths_at_end_m.get(support).and_then(|depths| depths.get(part));
            let (mean, _, half_width) = mean_of(&values);
            within(mean, half_width, largest.copied())
        };
        (0..parts).map(part).collect()
    }
}
