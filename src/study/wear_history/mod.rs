//! Wear that feeds back: supports whose gaps grow by the wear that they cause.
//!
//! The gaps of a support follow from the work of wear E that was done there, by its
//! [`Growth`](crate::wear::Growth); of a tube in a round support that wears evenly all round, and
//! the support with it, the radial gap γ grows by Archard's law,
//!
//! dγ/dt = (k_t + k_s) W(γ)/(2πRw),   E = ∫ W dt,
//!
//! with the coefficients k_t of the tube and k_s of the support, the radius R of the tube and the
//! width w of the support. The work rate W comes from a run with the gap of that time, a *window*:
//! vibration takes seconds, wear takes years, and between two windows W grows straight. W depends
//! on the gaps of all supports, so that the equations of all of them are solved together, for the
//! work of each support by sectors and walls, by Heun's method (order 2): windows at the gaps of
//! the start and at those of a step of Euler's method, of which the mean counts. A step makes no
//! gap more than half as large again, and is halved where Heun's gap differs from Euler's by more
//! than 0.5 %, or the place of a centre by more than 0.5 % of the gap, unless that is within the
//! scatter of the windows: that of the histories, or of a single one by the intervals of its work
//! rates.
//!
//! Histories end together: where the deepest depth over all of them is the wall of the tube, or its
//! radius where the wall is not known, or with the service. That depth is the largest of the means
//! of all sectors, or flats; the deepest sector of a single history is one that is the deepest by
//! chance.
//!
//! Of a single history each depth has a half width by those of the work rates of its windows, and
//! by the errors of its steps: the depth if all these rates were larger by theirs, at the same
//! gaps, and each step erred as estimated, less the depth found. For a rate like a power p of the
//! gap a step in which the gap grows by x of itself errs by x (p + 1)/6 of what Heun's step differs
//! from Euler's; x of it is taken, twice that of p = 2, since what early steps err grows with the
//! gap. Under random loads several histories are followed side by side, each window with seeds of
//! its own, so that the scatter of depths between histories is that of what was not averaged out.

mod accrual;
mod course;
mod histories;
mod state;
mod support;
mod window;

pub(crate) use accrual::Accrual;
use accrual::{Works, at_support, towards};
use course::reached_from;
use histories::depths;
pub use histories::{LimitReached, TimeOfLimit, WearHistories, WearPoint, WornThrough, mean};
pub use state::{WearQuantity, WearState};
pub use support::WearingSupport;
pub use window::WearWindow;

use super::realisations::{Deepest, Realisation, mean_of, realisations};
use crate::error::{Error, Result};
use crate::run::Options;
use crate::scene::Scene;
use crate::scheme::Method;
use crate::wear::{Opening, WearWork};

/// A year of 365.25 days, s.
pub const YEAR: f64 = 31_557_600.0;

/// Histories that are followed under random loads, unless another number is given.
pub const HISTORIES: usize = 6;

/// Windows of a usual history, each one run: for estimates of the time that it takes.
pub const USUAL_WINDOWS: f64 = 7.0;

/// Largest growth of a gap in a step, as a share of the gap.
const MOST_GROWTH: f64 = 0.5;

/// Largest difference of Heun's and Euler's gap, as a share of the gap.
const TOLERANCE: f64 = 0.005;

/// The shortest step that halving leaves, as a share of the longest; of gaps that are closed, whose
/// growth is no share of them, as a share of the time in service.
const SHORTEST: f64 = 1.0 / 1024.0;

/// Most steps: as many as a gap has that becomes half as large again in each of them, until it is
/// 1e35 times its first.
const MOST_STEPS: usize = 200;

/// What histories of wear are followed, and how.
pub struct WearPlan<'a> {
    /// The supports that wear.
    pub supports: &'a [WearingSupport],
    /// The scene of a window, from its number, from 1, which decides the seeds, and from what wear
    /// has made of the supports.
    pub scene: &'a (dyn Fn(u64, &[Opening]) -> Result<Scene> + Sync),
    /// The scheme.
    pub method: &'a Method,
    /// Step and window of the statistics.
    pub options: &'a Options,
    /// Number of histories, 1 or more.
    pub histories: usize,
    /// Time in service, s.
    pub service: f64,
}

impl WearPlan<'_> {
    /// Follows the histories. The windows that were `kept` by an earlier call, numbers 1, 2, … in
    /// order, are not run again where these histories have the same supports in them: all of those
    /// of the same call, and those of a call for a shorter service up to its last step, which ends
    /// with that service. So what is found does not depend on what was kept. `keep` is called with
    /// each window that is run, and `progress` with the share of the steps that are done, as far as
    /// their number is known.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a service that is not above 0, for no history, and for a support
    /// without coefficient or scar; errors of the windows and of `keep`; [`Error::Stopped`].
    pub fn follow(
        &self,
        kept: &[WearWindow],
        keep: &mut dyn FnMut(&WearWindow) -> Result<()>,
        progress: &mut dyn FnMut(f64),
    ) -> Result<WearHistories> {
        self.check()?;
        let mut found = WearHistories::none(self.supports);
        let none = |support: &WearingSupport| WearWork::none(self.options.time.sectors, support.gaps.len());
        let mut work: Works = vec![self.supports.iter().map(none).collect(); self.histories];
        let mut largest = if self.histories == 1 { work.clone() } else { Works::new() };
        let (mut time, mut step, mut first) = (0.0, self.service, None);
        loop {
            let rates = self.rates(&work, &mut found, kept, keep)?;
            let accrued = Accrual { found: work.clone(), largest: largest.clone() };
            let point = WearPoint::new(self.supports, time, accrued, rates.clone());
            let last = time >= self.service || found.worn_through.is_some();
            if last {
                found.depths_at_end_m = work.iter().map(|history| depths(self.supports, history)).collect();
            }
            found.points.push(point);
            if last {
                let all = largest.iter().flat_map(|history| depths(self.supports, history));
                found.largest_depths_at_end_m = all.collect();
                found.add_points_between();
                return Ok(found);
            }
            if found.points.len() > MOST_STEPS {
                return Err(self.too_long(time));
            }
            step = self.longest_step(&work, &rates.found).min(step).min(self.service - time);
            let shortest = SHORTEST * step;
            loop {
                let ahead = advanced(&work, &rates.found, &rates.found, step);
                let then = self.rates(&ahead, &mut found, kept, keep)?;
                let corrected = advanced(&work, &rates.found, &then.found, step);
                let widest = advanced(&work, &rates.largest, &then.largest, step);
                if step <= shortest || self.agree(&ahead, &corrected, &widest) {
                    let intact = self.intact(&work, (&rates.found, &then.found), step);
                    let then = rates.towards(&then, intact / step);
                    step = intact;
                    let after = advanced(&work, &rates.found, &then.found, step);
                    largest = advanced(&largest, &rates.largest, &then.largest, step);
                    self.add_step_error(&mut largest, [&work, &after], (&rates.found, &then.found), step);
                    work = after;
                    break;
                }
                step *= 0.5;
            }
            time = if self.service - time <= step { self.service } else { time + step };
            found.worn_through = self.worn_through(time, &work);
            step *= 2.0;
            progress(share(time, self.service, *first.get_or_insert(time)));
        }
    }

    /// The first support at which the work has worn through the tube, at that time.
    fn worn_through(&self, time: f64, work: &Works) -> Option<WornThrough> {
        self.supports.iter().enumerate().find_map(|(index, support)| {
            let depth_m = support.end()?;
            let depth = Deepest::of(&support.depths_about_mean(&at_support(work, index))).value;
            let is_through = depth.is_nan() || depth >= depth_m;
            let wall_m = support.wall;
            is_through.then(|| WornThrough { support: support.name.clone(), wall_m, depth_m, time_s: time })
        })
    }

    /// How much of a step (s) passes until the tube is worn through, s, while the rates grow
    /// straight from the first to the second.
    fn intact(&self, work: &Works, (first, second): (&Works, &Works), step: f64) -> f64 {
        let is_worn_through = |part: f64| {
            let then = towards(first, second, part / step);
            self.worn_through(0.0, &advanced(work, first, &then, part)).is_some()
        };
        if !is_worn_through(step) {
            return step;
        }
        reached_from([0.0, step], is_worn_through)
    }

    /// The error of a service of which so many seconds take all steps.
    fn too_long(&self, time: f64) -> Error {
        let expected = format!(
            "at most {time:.2e} s: until then the work rates grow with the gaps, of which one became half as large \
             again in each of {MOST_STEPS} steps"
        );
        Error::invalid("service", format_args!("{:?}", self.service), expected)
    }

    fn check(&self) -> Result<()> {
        if !(self.service.is_finite() && self.service > 0.0) {
            return Err(Error::invalid("service", format_args!("{:?}", self.service), "a number above 0, in s"));
        }
        if self.histories == 0 {
            return Err(Error::invalid("histories", 0, "1 or more"));
        }
        match self.supports.iter().find(|support| !support.wears()) {
            None => Ok(()),
            Some(support) => {
                let name = format!("{:?}", support.name);
                Err(Error::invalid("support", name, "a support with a gap, a wear coefficient and a width"))
            }
        }
    }

    /// The rates in a window of each history after the work `work` (J), with the supports as they
    /// are after that work; those that follow the ones that were kept are run.
    fn rates(
        &self,
        work: &Works,
        found: &mut WearHistories,
        kept: &[WearWindow],
        keep: &mut dyn FnMut(&WearWindow) -> Result<()>,
    ) -> Result<Accrual> {
        let (first, last) = (found.windows + 1, found.windows + self.histories as u64);
        let openings: Vec<Vec<Opening>> = work.iter().map(|history| self.openings(history)).collect();
        let there = kept.iter().skip(found.windows as usize).zip(&openings);
        let same = there.take_while(|(window, openings)| window.openings == **openings);
        let mut windows: Vec<WearWindow> = same.map(|(window, _)| window.clone()).collect();
        let next = first + windows.len() as u64;
        if next <= last {
            let of = |number: u64| openings.get((number - first) as usize).map_or(&[][..], Vec::as_slice);
            let scene = |number: u64| (self.scene)(number, of(number));
            let members = realisations(next..=last, &scene, self.method, self.options, &mut |_| {})?;
            let window = |member: &Realisation| WearWindow::after(member, self.supports, of(member.number).to_vec());
            let run: Vec<_> = members.iter().map(window).collect();
            run.iter().try_for_each(keep)?;
            windows.extend(run);
        }
        found.windows += self.histories as u64;
        let refuted = windows.iter().filter(|window| !window.findings.is_empty());
        found.refuted.extend(refuted.map(|window| (window.number, window.findings.clone())));
        windows.iter().for_each(|window| found.cautioned.add(window.number, window.caution.clone()));
        let single = if self.histories == 1 { &windows[..] } else { &[] };
        let largest = single.iter().map(WearWindow::largest_rates).collect();
        Ok(Accrual { largest, found: windows.into_iter().map(|window| window.rates).collect() })
    }

    /// What the work (J) of a history has made of each support.
    fn openings(&self, history: &[WearWork]) -> Vec<Opening> {
        self.supports.iter().zip(history).map(|(support, work)| support.opening(work)).collect()
    }

    /// Adds to the work of a single history, `largest`, the estimated error of a step of `step` (s)
    /// with the mean of two rates, which made of the work `before` that `after`.
    fn add_step_error(
        &self,
        largest: &mut Works,
        [before, after]: [&Works; 2],
        (first, second): (&Works, &Works),
        step: f64,
    ) {
        let works = before.iter().zip(after).zip(first.iter().zip(second));
        for (largest, ((before, after), (first, second))) in largest.iter_mut().zip(works) {
            let rates = first.iter().zip(second);
            let all = self.supports.iter().zip(largest).zip(before.iter().zip(after)).zip(rates);
            for (((support, largest), (before, after)), (first, second)) in all {
                let [before, after] = [before, after].map(|work| support.gaps_after(work));
                let growth = before.iter().zip(&after).filter(|(before, _)| **before > 0.0);
                let growth = growth.map(|(before, after)| after / before - 1.0).fold(0.0, f64::max);
                // Heun's step differs from Euler's by half of the difference of the rates.
                let time = growth * 0.5 * step;
                *largest = largest.plus_difference(first, second, time);
            }
        }
    }

    /// The longest step in which no gap grows by more than [`MOST_GROWTH`] of itself, s.
    fn longest_step(&self, work: &Works, rates: &Works) -> f64 {
        let all = work.iter().zip(rates).flat_map(|(work, rates)| self.supports.iter().zip(work.iter().zip(rates)));
        let longest = |(support, (work, rate)): (&WearingSupport, (&WearWork, &WearWork))| {
            support.growth.time_to_open(&support.law, &support.gaps, work, rate, MOST_GROWTH)
        };
        let closed = self.supports.iter().flat_map(|support| &support.gaps).any(|gap| *gap == 0.0);
        all.map(longest).fold(f64::INFINITY, f64::min).max(if closed { SHORTEST * self.service } else { 0.0 })
    }

    /// True if gaps and centres after the work of Euler's and of Heun's step agree, or differ by no
    /// more than they scatter: of a single history by the work with the largest rates, `widest`.
    fn agree(&self, euler: &Works, heun: &Works, widest: &Works) -> bool {
        self.supports.iter().enumerate().all(|(index, support)| {
            // Of each history the gaps, then the place of the centre.
            let shapes = |works: &Works| -> Vec<Vec<f64>> {
                let shape = |work: &WearWork| [support.gaps_after(work), support.opening(work).shift.to_vec()].concat();
                works.iter().filter_map(|history| history.get(index)).map(shape).collect()
            };
            let (euler, heun, widest) = (shapes(euler), shapes(heun), shapes(widest));
            let walls = support.gaps.len();
            (0..walls + 2).all(|part| {
                let of = |shape: &Vec<f64>, part: usize| shape.get(part).copied().unwrap_or(0.0);
                let gap = if part < walls { part } else { 0 };
                let gaps: Vec<f64> = heun.iter().map(|shape| of(shape, gap)).collect();
                let differences: Vec<f64> =
                    euler.iter().zip(&heun).map(|(euler, heun)| of(heun, part) - of(euler, part)).collect();
                let (difference, _, half_width) = mean_of(&differences);
                let by_rates =
                    || widest.iter().zip(&heun).map(|(widest, heun)| (of(widest, part) - of(heun, part)).abs());
                let scatter = half_width.or_else(|| by_rates().next()).unwrap_or(0.0);
                // A scatter that is not known is NaN.
                difference.abs() <= scatter.max(TOLERANCE * mean_of(&gaps).0)
            })
        })
    }
}

/// The share of the steps until `service` (s) that are done at `time`, where the first step ended
/// at the time `first` and each is twice as long as the one before it, as far as steps may
/// lengthen.
fn share(time: f64, service: f64, first: f64) -> f64 {
    (time / first).ln_1p() / (service / first).ln_1p()
}

/// The work after a step of `step` seconds with the mean of the two rates.
fn advanced(work: &Works, first: &Works, second: &Works, step: f64) -> Works {
    let history = |((work, first), second): ((&Vec<WearWork>, &Vec<WearWork>), &Vec<WearWork>)| {
        let all = work.iter().zip(first.iter().zip(second));
        all.map(|(work, (first, second))| work.advanced(first, second, step)).collect()
    };
    work.iter().zip(first).zip(second).map(history).collect()
}
