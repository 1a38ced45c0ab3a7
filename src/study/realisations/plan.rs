//! A study of realisations: how many there are, and the errors of their means.

use super::batch::{Batch, Purpose, RandomScenes};
use super::check::{Check, MOST_CHECKED, Refined};
use super::count::{PILOTS, Pilots, RealisationCount};
use super::realisation::Realisation;
use super::sample::Realisations;
use super::stein::{NeededRealisations, widest};
use crate::error::{Error, Result};
use crate::run::{Options, Run};
use crate::scheme::Method;
use crate::time::TimeOptions;
use std::ops::RangeInclusive;
use std::time::Instant;

/// A study of realisations.
pub struct RealisationPlan<'a> {
    /// The scenes.
    pub scenes: &'a dyn RandomScenes,
    /// The run of realisation 1; the others have its step and its rows.
    pub run: &'a Run,
    /// The scheme.
    pub method: &'a Method,
    /// Window of the statistics.
    pub time: TimeOptions,
    /// How many realisations.
    pub count: RealisationCount,
    /// For the errors of the means: up to so many of them are run again with half the step, and of
    /// these up to [`MOST_CHECKED`] with more modes; 0 for none, and for no errors.
    pub checked: u64,
}

/// A check of a study that failed.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FailedCheck {
    /// What is refined.
    pub refined: Refined,
    /// Why it failed.
    pub error: Error,
}

/// What a study of realisations found.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct RealisationStudy {
    /// The realisations and their means.
    pub realisations: Realisations,
    /// The checks that failed: parts of the errors are not known.
    pub failures: Vec<FailedCheck>,
    /// [`Error::Scattered`] where the interval asked for was not reached.
    pub shortfall: Option<Error>,
    /// The share of their means that the intervals were asked to have; `None` of a number of
    /// realisations.
    pub share: Option<f64>,
}

impl RealisationPlan<'_> {
    /// Makes the study. Each batch of runs is made by `make`, which is [`Batch::run`] or calls it;
    /// `tell` is called with what the pilots say, before the other realisations are run.
    ///
    /// # Errors
    /// Of the realisations, through `make`; [`Error::Stopped`].
    pub fn follow(
        &self,
        make: &mut dyn FnMut(&Batch<'_>) -> Result<Vec<Realisation>>,
        tell: &mut dyn FnMut(&Pilots),
    ) -> Result<RealisationStudy> {
        let mut members = vec![Realisation::of(1, self.run)];
        let (count, wanted) = match self.count {
            RealisationCount::Exactly(count) => (count, None),
            RealisationCount::Within { share, most, most_time } => {
                let began = Instant::now();
                members.extend(make(&self.batch(Purpose::Pilots, 2..=PILOTS))?);
                let run_s = began.elapsed().as_secs_f64() / (PILOTS - 1) as f64;
                let needed = NeededRealisations::from_pilots(&members, share);
                let wanted = needed.as_ref().map_or(PILOTS, |needed| needed.count);
                let affordable = most_time.map(|limit| limit.affordable(PILOTS, run_s, self.runs_of_checks()));
                let count = wanted.min(most).min(affordable.unwrap_or(most));
                let most_time_s = most_time.filter(|_| count < wanted.min(most)).map(|limit| limit.seconds());
                tell(&Pilots { needed, share, count, most_time_s });
                (count, Some((share, wanted)))
            }
        };
        members.extend(make(&self.batch(Purpose::Means, members.len() as u64 + 1..=count))?);
        let shortfall = wanted.and_then(|(share, needed)| shortfall(&members, share, needed));
        let (checks, failures) = self.checks(count, make)?;
        let realisations = Realisations::new(members);
        let realisations = if self.checked > 0 { realisations.with_checks(checks) } else { realisations };
        let share = wanted.map(|(share, _)| share);
        Ok(RealisationStudy { realisations, failures, shortfall, share })
    }

    fn batch(&self, purpose: Purpose, numbers: RangeInclusive<u64>) -> Batch<'_> {
        let step = match purpose {
            Purpose::Check(Refined::HalfStep { step_s, .. }) => step_s,
            _ => self.run.grid.step,
        };
        let time = TimeOptions { step, sample: Some(self.run.grid.row_spacing()), ..self.time };
        Batch { purpose, numbers, scenes: self.scenes, method: self.method, options: Options::new(time) }
    }

    /// What the checks cost, in runs of a realisation.
    fn runs_of_checks(&self) -> f64 {
        let half_step = if self.method.scheme.entry().order.is_some() { 2.0 } else { 0.0 };
        let more_modes = self.scenes.modes().map_or(0.0, |[own, more]| more as f64 / own.max(1) as f64);
        half_step * self.checked as f64 + more_modes * self.checked.min(MOST_CHECKED) as f64
    }

    /// The checks of a study of `count` realisations, and those that failed; none for a single
    /// realisation, whose differences have no interval.
    fn checks(
        &self,
        count: u64,
        make: &mut dyn FnMut(&Batch<'_>) -> Result<Vec<Realisation>>,
    ) -> Result<(Vec<Check>, Vec<FailedCheck>)> {
        let (mut checks, mut failures) = (Vec::new(), Vec::new());
        if self.checked == 0 || count < 2 {
            return Ok((checks, failures));
        }
        let order = self.method.scheme.entry().order;
        let half_step = order.map(|order| Refined::HalfStep { step_s: 0.5 * self.run.grid.step, order });
        let more_modes = self.scenes.modes().map(|modes| Refined::MoreModes { modes });
        for refined in half_step.into_iter().chain(more_modes) {
            let most = if refined.is_step() { self.checked } else { self.checked.min(MOST_CHECKED) };
            match make(&self.batch(Purpose::Check(refined), 1..=count.min(most))) {
                Ok(members) => checks.push(Check::new(refined, members)),
                Err(Error::Stopped) => return Err(Error::Stopped),
                Err(error) => failures.push(FailedCheck { refined, error }),
            }
        }
        Ok((checks, failures))
    }
}

/// That `members` are fewer than `needed`, and leave an interval wider than `share` of its mean.
pub(crate) fn shortfall(members: &[Realisation], share: f64, needed: u64) -> Option<Error> {
    widest(members)?.shortfall(share, needed)
}

impl RealisationStudy {
    /// That an interval came out wider than asked for, although there are as many realisations as
    /// its pilots called for, in words.
    #[must_use]
    pub fn wider_in_words(&self) -> Option<String> {
        let asked = self.share.filter(|_| self.shortfall.is_none())?;
        let NeededRealisations { measure, place, pilot_share, .. } = widest(&self.realisations.members)?;
        (pilot_share > asked).then(|| {
            format!(
                "the interval of the {} of {} {:?} is ± {:.1} % of it, wider than the ± {:.1} % asked for: the pilots, \
                 by which the number of realisations was chosen, scatter less than all of them, as in one study of \
                 twenty",
                measure.words(),
                place.kind.word(),
                place.name,
                100.0 * pilot_share,
                100.0 * asked
            )
        })
    }

    /// The runs that the judge refutes, each with what is refined in it, where it belongs to a
    /// check.
    pub fn refuted(&self) -> impl Iterator<Item = (Option<Refined>, &Realisation)> {
        let checks = self.realisations.checks.iter();
        let checked = checks.flat_map(|check| check.members.iter().map(|member| (Some(check.refined), member)));
        let members = self.realisations.members.iter().map(|member| (None, member));
        members.chain(checked).filter(|(_, member)| !member.findings.is_empty())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::qp::Backend;
    use crate::run::run;
    use crate::scene::{Density, RandomForce, Scene, Wall};
    use crate::scheme::Scheme;

    /// 1 kg before a stop under a random force; with modes, of which there are none, a scene that
    /// has another damping.
    struct Shaken;

    impl RandomScenes for Shaken {
        fn realisation(&self, number: u64) -> Result<Scene> {
            self.with_modes(number, 1)
        }

        fn modes(&self) -> Option<[usize; 2]> {
            Some([1, 2])
        }

        fn with_modes(&self, number: u64, modes: usize) -> Result<Scene> {
            let force =
                RandomForce { density: Density::Flat { rms: 3.0, from: 1.0, to: 20.0 }, seed: number, stream: 0 };
            let stop = Wall::upper("stop", 2e-3).with_restitution(0.5);
            let scene = Scene::oscillator(1.0, 2.0 * modes as f64, 400.0).with_wall(stop);
            Ok(scene.with_load(force.load(1.0)?).with_duration(1.0))
        }
    }

    const METHOD: Method = Method { scheme: Scheme::MoreauJean { theta: 0.5 }, backend: Backend::Auto };

    /// The study of `count` realisations, whose batches `make` makes.
    fn study(
        count: RealisationCount,
        make: &mut dyn FnMut(&Batch<'_>) -> Result<Vec<Realisation>>,
    ) -> Result<RealisationStudy> {
        let time = TimeOptions::with_step(1e-3);
        let run = run(&Shaken.realisation(1)?, &METHOD, &Options::new(time))?;
        let plan = RealisationPlan { scenes: &Shaken, run: &run, method: &METHOD, time, count, checked: MOST_CHECKED };
        plan.follow(make, &mut |_| {})
    }

    #[test]
    fn checks_are_of_the_first_six_realisations_with_half_the_step_and_with_more_modes() {
        let mut batches = Vec::new();
        let found = study(RealisationCount::Exactly(7), &mut |batch| {
            batches.push((batch.purpose, batch.numbers.clone(), batch.step(), batch.scene(1)?.system));
            batch.run(&mut |_| {})
        });
        let found = found.unwrap();
        let half = Refined::HalfStep { step_s: 5e-4, order: 1 };
        let more = Refined::MoreModes { modes: [1, 2] };
        let (one, two) = (Shaken.with_modes(1, 1).unwrap().system, Shaken.with_modes(1, 2).unwrap().system);
        let expected = vec![
            (Purpose::Means, 2..=7, 1e-3, one.clone()),
            (Purpose::Check(half), 1..=6, 5e-4, one),
            (Purpose::Check(more), 1..=6, 1e-3, two),
        ];
        assert_eq!(batches, expected);
        assert_eq!((found.realisations.count, found.failures.len(), found.shortfall), (7, 0, None));
        assert!(found.realisations.estimates[0].error.is_some_and(|error| error.step.is_some()));
    }

    #[test]
    fn a_check_that_fails_leaves_its_part_open_and_is_told_and_the_means_stay() {
        let fail = |batch: &Batch<'_>| match batch.purpose {
            Purpose::Check(Refined::HalfStep { .. }) => Err(Error::no_orbit("the check fails")),
            _ => batch.run(&mut |_| {}),
        };
        let found = study(RealisationCount::Exactly(2), &mut { fail }).unwrap();
        let [failed] = found.failures.as_slice() else { panic!("{:?}", found.failures) };
        assert_eq!(
            (failed.refined.to_string().as_str(), &failed.error),
            ("half the step", &Error::no_orbit("the check fails"))
        );
        let error = found.realisations.estimates[0].error.unwrap();
        assert!(error.step.is_none() && error.modes.is_some());
        // An interruption ends the study, in checks as anywhere.
        let stop = |batch: &Batch<'_>| match batch.purpose {
            Purpose::Check(_) => Err(Error::Stopped),
            _ => batch.run(&mut |_| {}),
        };
        assert_eq!(study(RealisationCount::Exactly(2), &mut { stop }), Err(Error::Stopped));
    }

    #[test]
    fn an_interval_out_of_reach_is_told_with_what_it_needs() {
        let within = RealisationCount::Within { share: 1e-3, most: 7, most_time: None };
        let found = study(within, &mut |batch| batch.run(&mut |_| {})).unwrap();
        let Some(Error::Scattered { share, count: 7, needed, .. }) = found.shortfall else { panic!("{found:?}") };
        assert!(share == 1e-3 && needed > 7);
    }
}
