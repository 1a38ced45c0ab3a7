//! How deep supports wear between the windows and after the last one, and when a limit is reached.
//!
//! In a step the rate of the work grows straight from that of its first window on, as Heun's method
//! has it, so that the work is a parabola; depths follow from the work. That of a scar on a flat
//! grows about like the work to the power of 2/3: no straight line through the depths at two
//! windows tells when a limit is reached in between or later.

use super::super::realisations::{Deepest, mean_of};
use super::accrual::Accrual;
use super::histories::{LimitReached, TimeOfLimit, WearHistories, WearPoint, mean};
use super::state::WearQuantity;
use super::support::WearingSupport;
use crate::wear::WearWork;

/// A time is known to the stretch over two to this power.
const HALVINGS: usize = 50;

/// Doublings of the time in service within which a limit is sought after its end.
const DOUBLINGS: i32 = 60;

/// Points stand between windows where a depth departs from the straight line by more than this
/// share of its last value.
const STRAIGHT: f64 = 0.02;

/// Most halvings of a stretch between two windows.
const MOST_PARTS: u32 = 8;

/// The share of a time over which a slope is taken.
const SLOPE: f64 = 1e-4;

/// The time between `from` and `to` from which on `is_reached`, which it is at `to`.
pub(super) fn reached_from([from, to]: [f64; 2], is_reached: impl Fn(f64) -> bool) -> f64 {
    let (mut before, mut after) = (from, to);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (before + after);
        *(if is_reached(middle) { &mut after } else { &mut before }) = middle;
    }
    after
}

/// Whose quantity it is.
#[derive(Debug, Clone, Copy)]
enum Of {
    /// The mean over all histories.
    Mean,
    /// One history, by its number from 0.
    History(usize),
    /// A single history with the largest work rates.
    Largest,
}

/// A quantity of a support over the time in service.
struct Course<'a> {
    points: &'a [WearPoint],
    support: &'a WearingSupport,
    index: usize,
    quantity: WearQuantity,
    of: Of,
}

impl<'a> Course<'a> {
    fn parts(&self, accrual: &'a Accrual) -> Vec<&'a WearWork> {
        let own = |history: &'a Vec<WearWork>| history.get(self.index);
        match self.of {
            Of::Mean => accrual.found.iter().filter_map(own).collect(),
            Of::History(number) => accrual.found.get(number).and_then(own).into_iter().collect(),
            Of::Largest => accrual.largest.iter().filter_map(own).collect(),
        }
    }

    /// The work at `time` (s), J, and the rates (W) at which it grows: straight ones between the
    /// windows, and the last ones after them.
    fn accrued(&self, time: f64) -> Vec<(WearWork, f64)> {
        let after = self.points.partition_point(|point| point.time_s < time);
        let before = after.checked_sub(1).and_then(|before| self.points.get(before)).or(self.points.first());
        let Some(before) = before else { return Vec::new() };
        let own = self.parts(&before.work).into_iter().zip(self.parts(&before.rates));
        let Some(next) = self.points.get(after) else {
            let seconds = time - before.time_s;
            return own.map(|(work, rate)| (work.advanced(rate, rate, seconds), rate.total)).collect();
        };
        let step = next.time_s - before.time_s;
        let share = if step > 0.0 { (time - before.time_s) / step } else { 0.0 };
        let within = |((work, rate), next): ((&WearWork, &WearWork), &WearWork)| {
            let (work, rate) = work.within(rate, next, step, share);
            (work, rate.total)
        };
        own.zip(self.parts(&next.work)).map(within).collect()
    }

    /// The quantity at `time` (s), and the half width of its 95 % interval over the histories;
    /// `None` where the work is not known.
    fn at(&self, time: f64) -> Option<(f64, Option<f64>)> {
        let accrued = self.accrued(time);
        if accrued.is_empty() || accrued.iter().any(|(work, _)| !work.total.is_finite()) {
            return None;
        }
        let works = || accrued.iter().map(|(work, _)| work.clone()).collect::<Vec<_>>();
        let values: Vec<f64> = match self.quantity {
            WearQuantity::DepthDeepest if accrued.len() > 1 => {
                let deepest = Deepest::of(&self.support.depths_about_mean(&works()));
                return Some((deepest.value, deepest.half_width_95));
            }
            WearQuantity::DepthOneScar => self.support.scars_about_mean(&works()),
            _ => {
                let state = |(work, rate): &(WearWork, f64)| self.support.state(work, *rate);
                accrued.iter().map(|accrued| self.quantity.of(&state(accrued))).collect()
            }
        };
        let (mean, _, half_width) = mean_of(&values);
        Some((mean, half_width))
    }

    /// True at a time from which on it is `limit` or more, or the tube is cut in two.
    fn is_beyond(&self, time: f64, limit: f64) -> bool {
        self.at(time).is_some_and(|(value, _)| value >= limit || value.is_nan())
    }

    /// The time at which it reaches `limit` between the windows, s.
    fn reaches(&self, limit: f64) -> Option<f64> {
        let pair = self.points.windows(2).find(|pair| self.is_beyond(pair[1].time_s, limit))?;
        let ends = [pair[0].time_s, pair[1].time_s];
        Some(reached_from(ends, |time| self.is_beyond(time, limit)))
    }

    /// The time at which it reaches `limit` after the last window, at the last rates, s; `None`
    /// where it has reached it, or does not grow.
    fn reaches_later(&self, limit: f64) -> Option<f64> {
        let last = self.points.last()?.time_s;
        if self.is_beyond(last, limit) {
            return None;
        }
        let mut doubled = (1..=DOUBLINGS).map(|power| last * 2_f64.powi(power));
        let beyond = doubled.find(|time| self.is_beyond(*time, limit))?;
        Some(reached_from([0.5 * beyond, beyond], |time| self.is_beyond(time, limit)))
    }

    /// The half width of a time at which its mean has the half width that it then has, s.
    fn half_width_of(&self, time: f64) -> Option<f64> {
        let (value, half_width) = self.at(time)?;
        let slope = (value - self.at((1.0 - SLOPE) * time)?.0) / (SLOPE * time);
        half_width.map(|half_width| (half_width / slope).abs()).filter(|half_width| half_width.is_finite())
    }
}

impl WearHistories {
    fn course(&self, support: usize, quantity: WearQuantity, of: Of) -> Option<Course<'_>> {
        let own = self.wearing.get(support)?;
        Some(Course { points: &self.points, support: own, index: support, quantity, of })
    }

    fn count(&self) -> usize {
        self.points.first().map_or(0, |point| point.histories.len())
    }

    /// True for the deepest depth of several histories, of which none alone has an estimate.
    fn is_deepest_of_several(&self, quantity: WearQuantity) -> bool {
        quantity == WearQuantity::DepthDeepest && self.count() > 1
    }

    /// When the mean over the histories of a quantity of a support, which grows, reaches `limit`
    /// within the time in service; `None` where it does not.
    #[must_use]
    pub fn reaches(&self, support: usize, limit: f64, quantity: WearQuantity) -> Option<TimeOfLimit> {
        self.mean_reaches((support, limit, quantity), &|| self.reaches_by_history(support, limit, quantity))
    }

    /// The same, with the times at which each history alone reaches it, where they are needed.
    fn mean_reaches(
        &self,
        (support, limit, quantity): (usize, f64, WearQuantity),
        histories: &dyn Fn() -> Vec<Option<f64>>,
    ) -> Option<TimeOfLimit> {
        let course = self.course(support, quantity, Of::Mean)?;
        let time_s = course.reaches(limit)?;
        let half_width_95_s = if self.is_deepest_of_several(quantity) {
            course.half_width_of(time_s)
        } else if self.count() > 1 {
            let each: Option<Vec<f64>> = histories().into_iter().collect();
            each.and_then(|times| mean_of(&times).2)
        } else {
            self.course(support, quantity, Of::Largest)?.reaches(limit).map(|earlier| time_s - earlier)
        };
        Some(TimeOfLimit { time_s, half_width_95_s })
    }

    /// The time in service at which each history alone reaches it, s.
    #[must_use]
    pub fn reaches_by_history(&self, support: usize, limit: f64, quantity: WearQuantity) -> Vec<Option<f64>> {
        let own = |history: usize| self.course(support, quantity, Of::History(history))?.reaches(limit);
        (0..self.count()).map(own).collect()
    }

    /// When the mean over the histories reaches `limit` (m) after their end, if the work of all
    /// goes on to grow at the rates of the last windows; `None` where it has reached it, or does
    /// not grow.
    #[must_use]
    pub fn reaches_at_last_rate(&self, support: usize, limit: f64, quantity: WearQuantity) -> Option<TimeOfLimit> {
        let course = self.course(support, quantity, Of::Mean)?;
        let time_s = course.reaches_later(limit)?;
        let largest = || {
            let course = self.course(support, quantity, Of::Largest)?;
            course.reaches(limit).or_else(|| course.reaches_later(limit)).map(|earlier| time_s - earlier)
        };
        let half_width_95_s = if self.count() > 1 { course.half_width_of(time_s) } else { largest() };
        Some(TimeOfLimit { time_s, half_width_95_s })
    }

    /// When a quantity of a support reaches `limit`: by the mean and in each history, or else at
    /// the last rates.
    #[must_use]
    pub fn limit_reached(&self, support: usize, limit: f64, quantity: WearQuantity) -> LimitReached {
        let histories = self.reaches_by_history(support, limit, quantity);
        let mean = self.mean_reaches((support, limit, quantity), &|| histories.clone());
        let at_last_rate = if mean.is_none() { self.reaches_at_last_rate(support, limit, quantity) } else { None };
        LimitReached { mean, at_last_rate, histories }
    }

    /// Adds points between those of two windows where a depth does not grow straight.
    pub(super) fn add_points_between(&mut self) {
        let mut points = Vec::with_capacity(self.points.len());
        for pair in self.points.windows(2) {
            points.push(pair[0].clone());
            self.between([&pair[0], &pair[1]], MOST_PARTS, &mut points);
        }
        points.extend(self.points.last().cloned());
        self.points = points;
    }

    /// Adds to `points` those wanted between two.
    fn between(&self, [before, after]: [&WearPoint; 2], parts: u32, points: &mut Vec<WearPoint>) {
        let middle = before.towards(after, 0.5, &self.wearing);
        if parts == 0 || self.is_straight([before, &middle, after]) {
            return;
        }
        self.between([before, &middle], parts - 1, points);
        points.push(middle.clone());
        self.between([&middle, after], parts - 1, points);
    }

    /// True where the mean depths of three points, the second half way, lie on straight lines.
    fn is_straight(&self, three: [&WearPoint; 3]) -> bool {
        let depths = [WearQuantity::DepthDeepest, WearQuantity::DepthOneScar];
        (0..self.wearing.len()).all(|support| {
            depths.iter().all(|depth| {
                let [before, middle, after] = three.map(|point| mean(point, support, *depth).0);
                let most = self.points.last().map_or(0.0, |last| mean(last, support, *depth).0);
                let most = if most.is_finite() { most } else { after };
                let departs = (middle - 0.5 * (before + after)).abs();
                departs.is_nan() || departs <= STRAIGHT * most
            })
        })
    }
}
