//! Finds the coarsest step of a study of realisations whose part in the errors is small enough.

use super::batch::{Batch, Purpose, RandomScenes};
use super::check::{Check, Refined};
use super::count::{PILOTS, Pilots, RealisationCount};
use super::counted::{PartShare, counted, widest_counted};
use super::found_step::FoundStep;
use super::known::KnownRealisations;
use super::realisation::Realisation;
use super::sample::Realisations;
use super::stein::NeededRealisations;
use crate::error::{Error, Result, amount};
use crate::run::Options;
use crate::scene::Scene;
use crate::scheme::Method;
use crate::study::accuracy::{CoarseGrid, Level};
use crate::time::TimeOptions;
use std::fmt;

/// Share of the steps of a run in which the body may stand still between opposite walls: more says
/// that the step is too large to see its motion, whatever half the step changes.
const FROZEN: f64 = 0.01;

/// The scatter of the part of the step falls with the step, and a smaller one may make it known,
/// if it has fallen below this share of that at twice the step. Where motions part it stays as it
/// is; from six pairs it is known to about a third.
const FALLING: f64 = 0.7;

/// A search for the coarsest step h of a study of realisations at which the part of the step in the
/// error of every mean that counts is within a share of it: |mean| + half width of its 95 %
/// interval, of the paired difference between half the step and the step, times 2ᵖ/(2ᵖ − 1) with
/// the order p of the scheme.
///
/// The means that count are work rate, mean force and RMS force of the supports that have 5 % or
/// more of them, and mean and RMS force of such walls.
///
/// Steps are halved from the grid that just sees the shortest time of the scene. At each step
/// [`PILOTS`] realisations are run with it and with half of it; those with half of it are the first
/// ones of the next step. Where the part is seen and too large, the step is halved. Where it is not
/// seen and only its interval is too wide, as many pairs are run as bring the interval within half
/// the share, by Stein's procedure ([`NeededRealisations`]); so a part up to the other half is
/// found to be small enough. If more than `most` would be needed, the step is halved as long as the
/// scatter falls with it. The first step of all is taken only if half of it shows no larger part
/// either: without a coarser one nothing tells whether the means change by chance so little.
pub struct StepSearch<'a> {
    /// The scenes.
    pub scenes: &'a dyn RandomScenes,
    /// The scheme.
    pub method: &'a Method,
    /// Rows and window of the statistics; its step is ignored.
    pub time: TimeOptions,
    /// The share, above 0 and below 1.
    pub share: f64,
    /// Most realisations, [`PILOTS`] or more.
    pub most: u64,
    /// Most steps of a run.
    pub most_steps: u64,
}

type Make<'m> = &'m mut dyn FnMut(&Batch<'_>) -> Result<Vec<Realisation>>;

impl StepSearch<'_> {
    /// Searches the step. Each batch of runs is made by `make`, which is [`Batch::run`] or calls
    /// it; `tell` is called with a sentence on each step that was tried, and on the number of
    /// realisations.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a scheme without a step, a share that is none and fewer realisations
    /// than pilots; of the runs where they fail with every step; [`Error::Stopped`]. A share that
    /// is not reached is no error here: see [`FoundStep::judge`].
    pub fn find(&self, make: Make<'_>, tell: &mut dyn FnMut(&str)) -> Result<FoundStep> {
        let order = self.validate()?;
        let scene = self.scenes.realisation(1)?;
        let coarse = CoarseGrid::of(&scene, &self.time)?;
        let known = KnownRealisations::default();
        let mut steps = Steps { search: self, scene, coarse, order, known, levels: Vec::new(), make, tell };
        let (tried, why) = steps.walk()?;
        steps.found(tried, why)
    }

    /// The order of the scheme, unless the search makes no sense.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `scheme`, `accuracy` or `most_seeds`, as in [`StepSearch::find`].
    pub fn validate(&self) -> Result<u32> {
        let Some(order) = self.method.scheme.entry().order else {
            let expected = "a scheme with a step, for the error of means over random loads: an exact one has no step \
                            to find";
            return Err(Error::invalid("scheme", self.method, expected));
        };
        if !(self.share > 0.0 && self.share < 1.0) {
            let expected = "a share of the means above 0 and below 1, such as 0.05 or 5%";
            return Err(Error::invalid("accuracy", self.share, expected));
        }
        if self.most < PILOTS {
            return Err(Error::invalid("most_seeds", self.most, format!("{PILOTS} or more: so many are run first")));
        }
        Ok(order)
    }
}

/// What a step was found to be.
#[derive(Debug, Clone, PartialEq)]
enum StepVerdict {
    /// The part is within the share.
    Within,
    /// It is seen and larger, or may be larger after as many pairs as should have shown it.
    TooLarge,
    /// Its interval is too wide: so many pairs are needed.
    Scattered(u64),
    /// Nothing is touched.
    Untouched,
}

/// A step that was tried.
#[derive(Debug, Clone)]
struct TriedStep {
    level: u32,
    step_s: f64,
    pairs: u64,
    verdict: StepVerdict,
    /// The largest part, as shares of its mean.
    worst: Option<PartShare>,
    /// The widest interval of any part, as a share of its mean.
    scatter: f64,
}

/// The steps of a search so far.
struct Steps<'a, 'm> {
    search: &'a StepSearch<'a>,
    /// Realisation 1.
    scene: Scene,
    coarse: CoarseGrid,
    order: u32,
    known: KnownRealisations,
    levels: Vec<Level>,
    make: Make<'m>,
    tell: &'m mut dyn FnMut(&str),
}

impl Steps<'_, '_> {
    /// Halves the step until it is found; returns the step of the result, and why it falls short of
    /// the share where it does.
    fn walk(&mut self) -> Result<(TriedStep, Option<String>)> {
        let most_steps = self.search.most_steps;
        let (mut last, mut failure): (Option<TriedStep>, Option<Error>) = (None, None);
        // The first step of all, while half of it is asked for its word.
        let mut first: Option<TriedStep> = None;
        for level in 0..u64::BITS - 1 {
            if self.coarse.steps.saturating_mul(2 << level) > most_steps {
                break;
            }
            let (tried, why) = match self.with_enough_pairs(level, last.as_ref()) {
                Ok(tried) => tried,
                Err(error) if error.is_request() || error == Error::Stopped => return Err(error),
                // If a step is too large for the scheme, a smaller one may still work.
                Err(error) => {
                    self.add_failed(level, &error);
                    (first, failure) = (None, Some(error));
                    continue;
                }
            };
            if let Some(first) = first.take().filter(|_| tried.verdict != StepVerdict::TooLarge) {
                return Ok((first, None));
            }
            match tried.verdict {
                _ if why.is_some() => return Ok((tried, why)),
                StepVerdict::Within if level == 0 => first = Some(tried.clone()),
                StepVerdict::Within => return Ok((tried, None)),
                _ => {}
            }
            last = Some(tried);
        }
        match (first, last, failure) {
            (Some(first), ..) => Ok((first, None)),
            (None, Some(last), _) => {
                Ok((last, Some(format!("half of that step would take more than {most_steps} steps a run"))))
            }
            (None, None, Some(error)) => Err(error),
            (None, None, None) => Err(self.unknown(format!(
                "the coarsest runs that could see the motion take {} steps, with half the step twice as many, and \
                 {most_steps} are the most",
                self.coarse.steps
            ))),
        }
    }

    /// Tries the step that is halved `level` times with the pilots and, where these cannot tell,
    /// with as many pairs as can; and why the search ends there, where it does without success.
    /// `last` is twice the step.
    fn with_enough_pairs(&mut self, level: u32, last: Option<&TriedStep>) -> Result<(TriedStep, Option<String>)> {
        let pilots = self.tried(level, PILOTS)?;
        let needed = match pilots.verdict {
            StepVerdict::Scattered(needed) => needed,
            StepVerdict::Untouched => {
                let why = format!("no wall and no support is touched in {PILOTS} realisations");
                return Ok((pilots, Some(why)));
            }
            StepVerdict::Within | StepVerdict::TooLarge => return Ok((pilots, None)),
        };
        let most = self.search.most;
        let falls = last.is_none_or(|last| pilots.scatter < FALLING * last.scatter);
        if needed > most && falls {
            return Ok((pilots, None));
        }
        let tried = self.tried(level, needed.min(most))?;
        let ends = needed > most && matches!(tried.verdict, StepVerdict::Scattered(_));
        let why = || format!("{needed} pairs of realisations would show it, and no more than {most} are allowed");
        Ok((tried, ends.then(why)))
    }

    /// That the part of the step is not known, and why.
    fn unknown(&self, why: String) -> Error {
        let (tolerance, reached, quantity) = (self.search.share, f64::INFINITY, String::new());
        Error::Biased { part: "step", tolerance, reached, seen: false, quantity, why }
    }

    /// Tries the step that is halved `level` times with so many pairs of realisations, and tells of
    /// it.
    fn tried(&mut self, level: u32, pairs: u64) -> Result<TriedStep> {
        let study = self.checked(level, pairs)?;
        let counted = counted(&study, &self.scene);
        let shares = PartShare::all(&counted, |error| error.step).unwrap_or_default();
        let verdict = verdict(&shares, self.search.share, pairs);
        let scatter = shares.iter().map(|share| share.part.half_width_95).fold(0.0, f64::max);
        let worst = PartShare::worst(shares);
        let step_s = self.coarse.options(level, &self.search.time).step;
        let tried = TriedStep { level, step_s, pairs, verdict, worst, scatter };
        let error = tried.worst.as_ref().map(|worst| worst.part.at_most());
        self.levels.retain(|one| one.step_s != step_s);
        self.levels.push(Level { step_s, steps: self.coarse.steps << level, error, failure: None });
        (self.tell)(&tried.to_string());
        Ok(tried)
    }

    /// So many realisations with the step that is halved `level` times, checked with half of it.
    fn checked(&mut self, level: u32, pairs: u64) -> Result<Realisations> {
        let half =
            Refined::HalfStep { step_s: self.coarse.options(level + 1, &self.search.time).step, order: self.order };
        let members = self.run(Purpose::Pilots, level, pairs)?;
        let again = self.run(Purpose::Check(half), level + 1, pairs)?;
        for member in members.iter().chain(&again) {
            if let Some(finding) = member.findings.first() {
                return Err(Error::Refuted { runs: vec![format!("realisation {}: {finding}", member.number)] });
            }
        }
        if let Some(member) = members.iter().find(|member| member.frozen_share > FROZEN) {
            return Err(self.unknown(format!(
                "in {:.0} % of the steps of realisation {} the body crosses its gap in less than a step",
                100.0 * member.frozen_share,
                member.number
            )));
        }
        Ok(Realisations::new(members).with_checks(vec![Check::new(half, again)]))
    }

    /// The first `count` realisations with the step that is halved `level` times.
    fn run(&mut self, purpose: Purpose, level: u32, count: u64) -> Result<Vec<Realisation>> {
        let StepSearch { scenes, method, time, .. } = *self.search;
        let options = Options::new(self.coarse.options(level, &time));
        self.known.complete(&Batch { purpose, numbers: 1..=count, scenes, method, options }, self.make)
    }

    fn add_failed(&mut self, level: u32, error: &Error) {
        let step_s = self.coarse.options(level, &self.search.time).step;
        (self.tell)(&format!("step {} s: {error}", amount(step_s, 3)));
        let (steps, failure) = (self.coarse.steps << level, Some(error.to_string()));
        self.levels.push(Level { step_s, steps, error: None, failure });
    }

    /// The outcome, with the number of realisations that the interval of the means takes.
    fn found(mut self, tried: TriedStep, why: Option<String>) -> Result<FoundStep> {
        let StepSearch { time, share, most, .. } = *self.search;
        let pilots = Realisations::new(self.run(Purpose::Pilots, tried.level, PILOTS)?);
        let widest = widest_counted(&counted(&pilots, &self.scene), &pilots);
        let needed = widest.map(|widest| widest.for_share(share));
        let wanted = needed.as_ref().map_or(PILOTS, |needed| needed.count);
        let count = wanted.min(most).max(tried.pairs);
        (self.tell)(&Pilots { needed, share, count, most_time_s: None }.to_string());
        Ok(FoundStep {
            time: self.coarse.options(tried.level, &time),
            count: RealisationCount::Exactly(count),
            pairs: tried.pairs,
            known: self.known,
            scene: self.scene,
            share,
            wanted,
            levels: self.levels,
            why,
        })
    }
}

/// What `shares` of the part of the step, from so many pairs, say of the step.
fn verdict(shares: &[PartShare], share: f64, pairs: u64) -> StepVerdict {
    if shares.is_empty() {
        return StepVerdict::Untouched;
    }
    let beyond = || shares.iter().map(|one| one.part).filter(|part| part.at_most() > share);
    if beyond().any(|part| part.is_seen()) {
        return StepVerdict::TooLarge;
    }
    let needed = beyond().map(|part| NeededRealisations::count_for(pairs, part.half_width_95, 0.5 * share));
    needed.max().map_or(StepVerdict::Within, StepVerdict::Scattered)
}

impl fmt::Display for TriedStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { step_s, pairs, worst, .. } = self;
        write!(f, "step {} s: ", amount(*step_s, 3))?;
        let Some(PartShare { quantity, part }) = worst else { return f.write_str("nothing is touched") };
        let seen = if part.is_seen() { "seen" } else { "not seen" };
        write!(f, "its part is {seen}, at most {} % ({quantity}, {pairs} pairs)", amount(100.0 * part.at_most(), 2))
    }
}
