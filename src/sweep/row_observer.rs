//! Collects from the steps of a row what its measures and samples need.

use super::forcing;
use super::measure::{Measure, Scope};
use super::motion::{Motion, Seen};
use super::request::{Sweep, Window};
use super::sample::Sample;
use super::sample::Samples;
use super::strobe::Strobe;
use crate::case::Case;
use crate::error::Result;
use crate::order::sort_by_number;
use crate::output::through;
use crate::run::notes;
use crate::scene::{Checked, Scene, State};
use crate::scheme::Stepper;
use crate::statistics::{Forces, Statistics, WallStatistics, WearStatistics, WearTally};
use crate::step::{Contact, Step};
use crate::study::attractor::{self, MOST_FREEDOM};
use crate::time::TimeOptions;
use crate::variation::{Exponent, Exponents, NoDerivative};
use crate::wear::WearWork;

/// What a row has at its end.
pub(super) struct Observed {
    pub measures: Vec<Option<f64>>,
    /// The work rates at each support, W, where they are kept and it has a law of wear.
    pub rates: Vec<Option<WearWork>>,
    /// A warning of a depth that the tube does not have.
    pub through: Option<String>,
    /// That the window begins before the motion has settled.
    pub unsettled: Option<String>,
    pub samples: Vec<Sample>,
}

/// Collects what the measures of a row need from its steps.
pub(super) struct RowObserver {
    from: f64,
    /// Contact episodes that reach into the window.
    contacts: Vec<Contact>,
    forces: Option<Forces>,
    wear: Option<WearTally>,
    motion: Option<Motion>,
    strobe: Option<Strobe>,
    /// The growth of a small change of the start; an error from the step on at which there is no
    /// derivative.
    growth: Option<std::result::Result<Exponents, NoDerivative>>,
}

impl RowObserver {
    /// An observer of a row that `stepper` begins at `start`.
    pub fn new(sweep: &Sweep, stepper: &Stepper, time: &TimeOptions, start: &State) -> Result<Self> {
        // That in which a penalty's walls are springs.
        let scene = stepper.scene();
        let any = |test: fn(Measure) -> bool| sweep.measures.iter().any(|measure| test(*measure));
        let from = time.statistics_from;
        let strobe = match sweep.window {
            Window::Periods { settle, keep }
                if sweep.samples == Some(Samples::Periods)
                    || sweep.measures.contains(&Measure::Period)
                    || (any(Measure::sees_growth) && start.q.len() <= MOST_FREEDOM) =>
            {
                Some(Strobe::new(forcing::period(scene)?, settle, keep, start))
            }
            _ => None,
        };
        let growth =
            if any(Measure::sees_growth) { Some(Ok(Exponents::new(scene, 1, [from, scene.duration])?)) } else { None };
        let speeds = sweep.measures.contains(&Measure::VelocityMax);
        Ok(Self {
            from,
            contacts: Vec::new(),
            forces: any(Measure::sees_force)
                .then(|| Forces::new(scene, from, stepper.force_averaging(time.force_averaging))),
            wear: any(Measure::sees_sliding).then(|| WearTally::new(scene, from, time.sectors)),
            motion: any(Measure::sees_motion).then(|| Motion::new(scene, from, start, speeds)),
            strobe,
            growth,
        })
    }

    #[inline]
    pub fn observe(&mut self, step: &Step<'_>) {
        if !step.closed.is_empty() {
            let here = |contact: &&Contact| contact.end.is_none_or(|end| end >= self.from);
            self.contacts.extend(step.closed.iter().filter(here));
        }
        if let Some(forces) = &mut self.forces {
            forces.observe(step);
        }
        if let Some(wear) = &mut self.wear {
            wear.observe(step);
        }
        if let Some(motion) = &mut self.motion {
            motion.observe(step);
        }
        if let Some(strobe) = &mut self.strobe {
            strobe.observe(step);
        }
        if let Some(Ok(exponents)) = &mut self.growth
            && let Err(none) = exponents.observe(step)
        {
            self.growth = Some(Err(none));
        }
    }

    /// Why a measure has no value, where the other measures do not show it.
    pub fn note(&self) -> Option<String> {
        self.growth.as_ref().and_then(|growth| growth.as_ref().err()).map(ToString::to_string)
    }

    /// The measures, work rates and samples of the row of `case`, with the episodes `open` at its
    /// end.
    pub fn finish(mut self, sweep: &Sweep, case: &Case, scene: &Checked, open: &[Contact]) -> Observed {
        self.contacts.extend_from_slice(open);
        sort_by_number(&mut self.contacts, |contact| contact.wall as f64);
        sort_by_number(&mut self.contacts, |contact| contact.start);
        let of = |contacts: &[Contact]| Statistics::of(scene, scene.wall_masses(), contacts, self.from);
        let statistics = match &self.forces {
            Some(forces) => of(&forces.in_window(&self.contacts)).with_forces(forces),
            None => of(&self.contacts),
        };
        let statistics = match &self.wear {
            Some(wear) => statistics.with_wear(wear),
            None => statistics,
        };
        let mut values = Vec::new();
        let exponent = self.exponent(scene);
        for &measure in &sweep.measures {
            self.push_values(measure, sweep, case, scene, (&statistics, exponent), &mut values);
        }
        let samples = sweep.samples.map_or_else(Vec::new, |samples| self.samples(samples, sweep.most_samples, scene));
        let supports = statistics.wear.iter().enumerate().filter(|_| sweep.keeps_work_rates());
        let rates = supports.map(|(index, wear)| case.archard(index).map(|_| wear.rates())).collect();
        let scars = statistics.wear.iter().enumerate().filter(|_| sweep.measures.iter().any(|one| one.needs_scar()));
        let worn = |(index, wear): (usize, &WearStatistics)| Some((index, case.archard(index)?.worn(wear.work_rate_w)));
        let through = scars.filter_map(worn).find_map(|(index, worn)| through::beyond(case, index, &worn));
        let unsettled = notes::unsettled(scene, &statistics);
        Observed { measures: values, rates, through, unsettled, samples }
    }

    fn began_here(&self) -> impl Iterator<Item = &Contact> {
        self.contacts.iter().filter(|contact| contact.start >= self.from)
    }

    fn push_values(
        &self,
        measure: Measure,
        sweep: &Sweep,
        case: &Case,
        scene: &Scene,
        (statistics, exponent): (&Statistics, Option<Exponent>),
        values: &mut Vec<Option<f64>>,
    ) {
        match measure.scope() {
            Scope::Wall => {
                values.extend(statistics.walls.iter().enumerate().map(|(i, wall)| self.at_wall(measure, i, wall)));
            }
            Scope::Support => {
                let supports = 0..statistics.supports.len();
                values.extend(supports.map(|index| at_support(measure, statistics, index, case)));
            }
            Scope::Place => {
                let supports = 0..statistics.supports.len();
                values.extend(supports.map(|index| at_support(measure, statistics, index, case)));
                let alone = statistics.walls.iter().enumerate().filter(|(wall, _)| scene.support_of(*wall).is_none());
                values.extend(alone.map(|(wall, of_wall)| self.at_wall(measure, wall, of_wall)));
            }
            Scope::Probe => {
                let length = scene.duration - self.from;
                let seen = self.motion.iter().flat_map(|motion| &motion.seen);
                values.extend(seen.map(|seen| at_probe(measure, seen, length)));
            }
            Scope::Row => values.push(self.of_row(measure, sweep, scene, exponent)),
        }
    }

    /// The value of a measure at wall number `index`.
    fn at_wall(&self, measure: Measure, index: usize, wall: &WallStatistics) -> Option<f64> {
        let here = || self.began_here().filter(|contact| contact.wall == index);
        let speeds = || here().map(|contact| contact.approach_speed);
        // Of the contacts, where there are any.
        let mean = |sum: f64| (wall.contacts > 0).then(|| sum / wall.contacts as f64);
        match measure {
            Measure::Contacts => Some(wall.contacts as f64),
            Measure::Impacts => Some(here().filter(|contact| contact.end == Some(contact.start)).count() as f64),
            Measure::ContactRate => Some(wall.contact_rate_per_s),
            Measure::ContactTimeRatio => Some(wall.contact_time_ratio),
            Measure::Impulse => Some(wall.force?.impulse_n_s),
            Measure::ImpulseMean => wall.episode_impulse_n_s.mean,
            Measure::ImpulseMax => wall.episode_impulse_n_s.max,
            Measure::ImpulseRms => mean(here().map(|contact| contact.impulse.powi(2)).sum()).map(f64::sqrt),
            Measure::ForceMean => Some(wall.force?.mean_n),
            Measure::ForceRms => Some(wall.force?.rms_n),
            Measure::ForceLargest => Some(wall.force_largest?.mean_n),
            Measure::PeakForceMean => wall.episode_peak_force_n.mean,
            Measure::PeakForceMax => wall.episode_peak_force_n.max,
            Measure::ImpactPower => Some(wall.impact_power_w),
            Measure::ArrivedLessDepartedPower => Some(wall.arrived_less_departed_power_w),
            Measure::ApproachSpeedMean => mean(speeds().sum()),
            Measure::ApproachSpeedMax => speeds().reduce(f64::max),
            Measure::ApproachSpeedLeast => speeds().reduce(f64::min),
            _ => None,
        }
    }

    /// The value of a measure of the whole row.
    fn of_row(&self, measure: Measure, sweep: &Sweep, scene: &Scene, exponent: Option<Exponent>) -> Option<f64> {
        match (measure, sweep.window) {
            (Measure::ImpactsPerPeriod, Window::Periods { keep, .. }) => {
                let impacts = self.began_here().filter(|contact| contact.end == Some(contact.start)).count();
                Some(impacts as f64 / f64::from(keep))
            }
            (Measure::Lyapunov, _) => Some(exponent?.per_s),
            (Measure::LyapunovError, _) => exponent?.error_per_s,
            (Measure::Period, _) => Some(self.strobe.as_ref()?.repeats(scene.orbit_gap())? as f64),
            // The row itself fills the attractor in: it is run in another way.
            _ => None,
        }
    }

    /// The largest Lyapunov exponent. For a motion that repeats itself it is that of the orbit,
    /// which is exact; the mean over the window would oscillate about it.
    fn exponent(&self, scene: &Checked) -> Option<Exponent> {
        let exponents = self.growth.as_ref()?.as_ref().ok()?;
        let orbit = self.strobe.as_ref().and_then(|strobe| {
            let count = strobe.repeats(scene.orbit_gap())?;
            let (_, state) = strobe.taken.last()?;
            attractor::exponent(scene, strobe.period(), count, state)
        });
        let exact = |per_s: f64| Exponent { per_s, error_per_s: per_s.is_finite().then_some(0.0) };
        Some(orbit.map_or_else(|| exponents.largest(), exact))
    }

    /// The last `most` of the instants.
    fn samples(&self, samples: Samples, most: usize, scene: &Scene) -> Vec<Sample> {
        let mut all: Vec<Sample> = match samples {
            Samples::Impacts => {
                let period = forcing::period(scene).ok();
                let of = |contact: &Contact| Sample::Impact {
                    wall: scene.walls.get(contact.wall).map_or_else(String::new, |wall| wall.name.clone()),
                    start: contact.start,
                    phase: period.map(|period| (contact.start / period).fract()),
                    approach: contact.approach_speed,
                    departure: contact.departure_speed,
                    impulse: contact.impulse,
                };
                self.began_here().map(of).collect()
            }
            Samples::Periods => {
                let of = |(time, state): &(f64, State)| Sample::Strobe {
                    time: *time,
                    seen: scene.probes.iter().map(|probe| [probe.at.dot(&state.q), probe.at.dot(&state.v)]).collect(),
                };
                self.strobe.iter().flat_map(|strobe| &strobe.taken).map(of).collect()
            }
        };
        all.drain(..all.len().saturating_sub(most));
        all
    }
}

/// The value of a measure at a probe that was `seen` over `length` seconds.
fn at_probe(measure: Measure, seen: &Seen, length: f64) -> Option<f64> {
    match measure {
        Measure::DisplacementMax => Some(seen.highest.abs().max(seen.lowest.abs())),
        Measure::DisplacementHighest => Some(seen.highest),
        Measure::DisplacementLowest => Some(seen.lowest),
        Measure::DisplacementRms => Some((seen.square / length).sqrt()),
        Measure::VelocityMax => Some(seen.speed),
        _ => None,
    }
}

/// The value of a measure at support number `index`.
fn at_support(measure: Measure, statistics: &Statistics, index: usize, case: &Case) -> Option<f64> {
    let support = statistics.supports.get(index)?;
    let wear = || statistics.wear.get(index);
    let worn = || Some(case.archard(index)?.worn(wear()?.work_rate_w));
    match measure {
        Measure::WorkRate => Some(wear()?.work_rate_w),
        Measure::ImpactShare => wear()?.impact_share,
        Measure::SlidingRate => {
            let length = statistics.to_s - statistics.from_s;
            (length > 0.0).then_some(wear()?.sliding_m / length)
        }
        Measure::FrictionPower => Some(wear()?.friction_power_w),
        Measure::ForceMean => Some(support.force.as_ref()?.mean_n),
        Measure::ForceRms => Some(support.force.as_ref()?.rms_n),
        Measure::ForceLargest => Some(support.force_largest?.mean_n),
        Measure::WornVolume => worn()?.volume_m3,
        Measure::SupportWornVolume => worn()?.support_volume_m3,
        Measure::DepthDeepest => case.depth_deepest(index, wear()?),
        Measure::DepthOneScar => worn()?.depth_one_scar_m,
        Measure::DepthAllRound => worn()?.depth_all_round_m,
        _ => None,
    }
}
