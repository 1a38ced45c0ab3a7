//! Wear that feeds back: supports whose gaps grow by the wear that they cause.
//!
//! Of a tube in a round support that wears evenly all round, and the support with it, the radial
//! gap γ grows with the work of wear E by Archard's law,
//!
//! dγ/dt = (k_t + k_s) W(γ)/(2πRw),   E = ∫ W dt,
//!
//! with the coefficients k_t of the tube and k_s of the support, the radius R of the tube and the
//! width w of the support. The work rate W comes from a run with the gap of that time, a *window*:
//! vibration takes seconds, wear takes years, and W is taken as constant in between. W depends on
//! the gaps of all supports, so that the equations of all of them are solved together, by Heun's
//! method (order 2): windows at the gaps of the start and at those of a step of Euler's method, of
//! which the mean counts. A step makes no gap more than half as large again, and is halved where
//! Heun's gap differs from Euler's by more than 0.5 %, unless that is within the scatter of the
//! windows.
//!
//! Gaps of flats stay as they are; their wear is counted all the same.
//!
//! Under random loads several histories are followed side by side, each window with seeds of its
//! own, so that the scatter of depths between histories is that of what was not averaged out.

use super::realisations::{Measure, Realisation, mean_of, realisations};
use crate::error::{Error, Result};
use crate::residual::Finding;
use crate::run::Options;
use crate::scene::Scene;
use crate::scheme::Method;
use crate::statistics::{ContactPlace, PlaceKind};
use crate::wear::{Archard, all_round};
use serde::Serialize;

/// Largest growth of a gap in a step, as a share of the gap.
const MOST_GROWTH: f64 = 0.5;

/// Largest difference of Heun's and Euler's gap, as a share of the gap.
const TOLERANCE: f64 = 0.005;

/// The shortest step, as a share of the time in service.
const SHORTEST: f64 = 1.0 / 1024.0;

/// A support that wears.
#[derive(Debug, Clone, PartialEq)]
pub struct WearingSupport {
    /// Its name.
    pub name: String,
    /// The gap at the start, m: of a round support the radial one.
    pub gap: f64,
    /// True for a round support, whose gap grows; those of flats stay as they are.
    pub grows: bool,
    /// The law of wear, with the coefficients of tube and support and a scar.
    pub law: Archard,
}

/// A support at one time of a history.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WearState {
    /// The gap, m.
    pub gap_m: f64,
    /// The work of wear since the start, J.
    pub work_j: f64,
    /// The work rate at this gap, W.
    pub work_rate_w: f64,
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
}

/// Histories of wear.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WearHistories {
    /// The names of the supports.
    pub supports: Vec<String>,
    /// From the start to the end.
    pub points: Vec<WearPoint>,
    /// Number of windows that were run.
    pub windows: u64,
    /// The windows that the judge refuted: number and findings.
    pub refuted: Vec<(u64, Vec<Finding>)>,
}

/// What histories of wear are followed, and how.
pub struct WearPlan<'a> {
    /// The supports that wear.
    pub supports: &'a [WearingSupport],
    /// The scene of a window, from its number, from 1, which decides the seeds, and from the gaps
    /// of the supports (m).
    pub scene: &'a (dyn Fn(u64, &[f64]) -> Result<Scene> + Sync),
    /// The scheme.
    pub method: &'a Method,
    /// Step and window of the statistics.
    pub options: &'a Options,
    /// Number of histories, 1 or more.
    pub histories: usize,
    /// Time in service, s.
    pub service: f64,
}

impl WearingSupport {
    /// The gap after the work `work` (J), m.
    fn gap_after(&self, work: f64) -> f64 {
        self.gap + work * self.gap_per_work()
    }

    /// Growth of the gap by the work of wear, m/J.
    fn gap_per_work(&self) -> f64 {
        let Archard { coefficient, support_coefficient, scar, .. } = self.law;
        let volume = coefficient.unwrap_or(0.0) + support_coefficient.unwrap_or(0.0);
        let growth = scar.map_or(f64::NAN, |scar| all_round(volume, scar.width, scar.radius));
        if self.grows { growth } else { 0.0 * growth }
    }

    /// The state after the work `work` (J) at the work rate `rate` (W).
    fn state(&self, work: f64, rate: f64) -> WearState {
        let worn = Archard { service: 1.0, ..self.law }.worn(work);
        WearState {
            gap_m: self.gap_after(work),
            work_j: work,
            work_rate_w: rate,
            depth_all_round_m: worn.depth_all_round_m.unwrap_or(0.0),
            depth_one_scar_m: if work > 0.0 && worn.volume_m3.is_some() {
                worn.depth_one_scar_m.unwrap_or(f64::NAN)
            } else {
                0.0
            },
        }
    }
}

/// The work rates of a window of each history: a value for each support, W.
type Rates = Vec<Vec<f64>>;

impl WearPlan<'_> {
    /// Follows the histories. `progress` is called with the share of the service that is done.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a service that is not above 0, for no history, and for a support
    /// without coefficient or scar; errors of the windows; [`Error::Stopped`].
    pub fn follow(&self, progress: &mut dyn FnMut(f64)) -> Result<WearHistories> {
        self.check()?;
        let mut found = WearHistories {
            supports: self.supports.iter().map(|support| support.name.clone()).collect(),
            points: Vec::new(),
            windows: 0,
            refuted: Vec::new(),
        };
        let mut work = vec![vec![0.0; self.supports.len()]; self.histories];
        let (mut time, mut step) = (0.0, self.service);
        loop {
            let rates = self.rates(&work, &mut found)?;
            found.points.push(self.point(time, &work, &rates));
            if time >= self.service {
                return Ok(found);
            }
            step = self.longest_step(&work, &rates).min(step).min(self.service - time);
            loop {
                let ahead = advanced(&work, &rates, &rates, step);
                let then = self.rates(&ahead, &mut found)?;
                let corrected = advanced(&work, &rates, &then, step);
                if step <= SHORTEST * self.service || self.agree(&ahead, &corrected) {
                    work = corrected;
                    break;
                }
                step *= 0.5;
            }
            time = if self.service - time <= step { self.service } else { time + step };
            step *= 2.0;
            progress(time / self.service);
        }
    }

    fn check(&self) -> Result<()> {
        if !(self.service.is_finite() && self.service > 0.0) {
            return Err(Error::invalid("service", format_args!("{:?}", self.service), "a number above 0, in s"));
        }
        if self.histories == 0 {
            return Err(Error::invalid("histories", 0, "1 or more"));
        }
        let wears = |support: &WearingSupport| support.gap_per_work().is_finite() && support.gap >= 0.0;
        match self.supports.iter().find(|support| !wears(support)) {
            None => Ok(()),
            Some(support) => {
                let name = format!("{:?}", support.name);
                Err(Error::invalid("support", name, "a support with a gap, a wear coefficient and a width"))
            }
        }
    }

    /// Runs a window of each history after the work `work` (J).
    fn rates(&self, work: &Rates, found: &mut WearHistories) -> Result<Rates> {
        let count = self.histories as u64;
        let first = found.windows + 1;
        let scene = |number: u64| {
            let history = work.get((number - first) as usize).map_or(&[][..], Vec::as_slice);
            let gaps = self.supports.iter().zip(history).map(|(support, work)| support.gap_after(*work));
            (self.scene)(number, &gaps.collect::<Vec<_>>())
        };
        let numbers = first..=found.windows + count;
        let members = realisations(numbers, &scene, self.method, self.options, &mut |_| {})?;
        found.windows += count;
        let refuted = members.iter().filter(|member| !member.findings.is_empty());
        found.refuted.extend(refuted.map(|member| (member.number, member.findings.clone())));
        let rate = |member: &Realisation, support: &WearingSupport| {
            let place = ContactPlace { name: support.name.clone(), kind: PlaceKind::Support };
            member.value(&place, Measure::WorkRate).unwrap_or(0.0)
        };
        let rates = |member| self.supports.iter().map(|support| rate(member, support)).collect();
        Ok(members.iter().map(rates).collect())
    }

    fn point(&self, time: f64, work: &Rates, rates: &Rates) -> WearPoint {
        let states = |(work, rates): (&Vec<f64>, &Vec<f64>)| {
            let all = self.supports.iter().zip(work.iter().zip(rates));
            all.map(|(support, (work, rate))| support.state(*work, *rate)).collect()
        };
        WearPoint { time_s: time, histories: work.iter().zip(rates).map(states).collect() }
    }

    /// The longest step in which no gap grows by more than [`MOST_GROWTH`] of itself, s.
    fn longest_step(&self, work: &Rates, rates: &Rates) -> f64 {
        let all = work.iter().zip(rates).flat_map(|(work, rates)| self.supports.iter().zip(work.iter().zip(rates)));
        let longest = |(support, (work, rate)): (&WearingSupport, (&f64, &f64))| {
            let speed = rate * support.gap_per_work();
            if speed > 0.0 { MOST_GROWTH * support.gap_after(*work) / speed } else { f64::INFINITY }
        };
        all.map(longest).fold(f64::INFINITY, f64::min).max(SHORTEST * self.service)
    }

    /// True if the gaps after the work of Euler's and of Heun's step agree, or differ by no more
    /// than they scatter.
    fn agree(&self, euler: &Rates, heun: &Rates) -> bool {
        self.supports.iter().enumerate().all(|(index, support)| {
            let gaps = |work: &Rates| -> Vec<f64> {
                work.iter().filter_map(|work| Some(support.gap_after(*work.get(index)?))).collect()
            };
            let (euler, heun) = (gaps(euler), gaps(heun));
            let differences: Vec<f64> = euler.iter().zip(&heun).map(|(euler, heun)| heun - euler).collect();
            let (difference, _, half_width) = mean_of(&differences);
            difference.abs() <= half_width.unwrap_or(0.0).max(TOLERANCE * mean_of(&heun).0)
        })
    }
}

/// The work after a step of `step` seconds with the mean of the two rates.
fn advanced(work: &Rates, first: &Rates, second: &Rates, step: f64) -> Rates {
    let history = |((work, first), second): ((&Vec<f64>, &Vec<f64>), &Vec<f64>)| {
        let all = work.iter().zip(first.iter().zip(second));
        all.map(|(work, (first, second))| work + step * (0.5 * (first + second))).collect()
    };
    work.iter().zip(first).zip(second).map(history).collect()
}

/// The mean of a quantity over the histories, and the half width of its 95 % interval.
#[must_use]
pub fn mean(point: &WearPoint, support: usize, quantity: impl Fn(&WearState) -> f64) -> (f64, Option<f64>) {
    let values: Vec<f64> = point.histories.iter().filter_map(|states| states.get(support)).map(quantity).collect();
    let (mean, _, half_width) = mean_of(&values);
    (mean, half_width)
}

impl WearHistories {
    /// The time in service at which the mean over the histories of a quantity of a support, which
    /// grows, reaches `limit`, s: straight between the points; `None` where it does not.
    #[must_use]
    pub fn reaches(&self, support: usize, limit: f64, quantity: impl Fn(&WearState) -> f64 + Copy) -> Option<f64> {
        let along: Vec<(f64, f64)> =
            self.points.iter().map(|point| (point.time_s, mean(point, support, quantity).0)).collect();
        along.windows(2).find(|pair| pair[1].1 >= limit).map(|pair| {
            let [(t0, d0), (t1, d1)] = [pair[0], pair[1]];
            t0 + (t1 - t0) * ((limit - d0) / (d1 - d0)).clamp(0.0, 1.0)
        })
    }
}
