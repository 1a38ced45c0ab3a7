//! The step that a search found, and the study at it.

use super::count::RealisationCount;
use super::counted::{PartShare, counted, widest_counted};
use super::error_parts::ErrorParts;
use super::estimate::Estimate;
use super::known::KnownRealisations;
use super::plan::RealisationStudy;
use crate::error::Error;
use crate::scene::Scene;
use crate::study::accuracy::{Accuracy, AccuracyOf, JudgedBy, Level, StepPairs, WholeError};
use crate::time::TimeOptions;

/// The step that a [`StepSearch`](super::StepSearch) found. The study at it is a
/// [`RealisationPlan`](super::RealisationPlan) with its times, its counts and its realisations.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct FoundStep {
    /// Step, rows and window of the study.
    pub time: TimeOptions,
    /// How many realisations the study has.
    pub count: RealisationCount,
    /// How many of them are checked with half the step.
    pub pairs: u64,
    /// Those that have been run.
    pub known: KnownRealisations,
    pub(super) scene: Scene,
    pub(super) share: f64,
    /// How many realisations the interval of the means would take.
    pub(super) wanted: u64,
    pub(super) levels: Vec<Level>,
    /// Why the part of the step is not within the share, where it is not.
    pub(super) why: Option<String>,
}

impl FoundStep {
    /// What the study at this step has reached, and what it falls short of: the part of the step is
    /// not within the share, the interval of a mean that counts is wider for want of realisations
    /// ([`Error::Scattered`]), or the part of the start or of the modes is certainly larger, by its
    /// whole interval ([`Error::Biased`]).
    #[must_use]
    pub fn judge(&self, study: &RealisationStudy) -> (Accuracy, Option<Error>) {
        let realisations = &study.realisations;
        let counted = counted(realisations, &self.scene);
        let step = PartShare::all(&counted, |error| error.step).and_then(PartShare::worst);
        let reached = step.as_ref().map_or(f64::INFINITY, |worst| worst.part.at_most());
        let seen = step.as_ref().is_some_and(|worst| worst.part.is_seen());
        let quantity = step.map_or_else(|| "nothing to compare".to_owned(), |worst| worst.quantity);
        let why = self.why.clone().unwrap_or_else(|| "its share of the means of all realisations is larger".to_owned());
        let (part, tolerance) = ("step", self.share);
        let large = self.why.is_some() || reached > self.share;
        let biased = large.then(|| Error::Biased { part, tolerance, reached, seen, quantity: quantity.clone(), why });
        let widest = widest_counted(&counted, realisations);
        let scattered = || widest.and_then(|widest| widest.shortfall(self.share, self.wanted));
        let start = || self.certain(&counted, "start", "a later statistics_from would make it smaller");
        let modes = || {
            self.certain(
                &counted,
                "modes",
                "only the step is searched, and more modes (system.modes) would make it smaller",
            )
        };
        let shortfall = biased.or_else(scattered).or_else(start).or_else(modes);
        let kept = if shortfall.is_none() { Some(self.time.step) } else { None };
        let accuracy = Accuracy {
            tolerance,
            of: AccuracyOf::Means,
            reached,
            quantity,
            until_s: self.scene.duration,
            growth: None,
            judged_by: JudgedBy::Realisations,
            step_s: Some(self.time.step),
            sufficient_step_s: kept,
            levels: self.levels.clone(),
            total_steps: self.known.total_steps(self.scene.duration),
            pairs: Some(StepPairs { count: self.pairs, seen }),
            whole: largest_error(&counted),
            start_scatter: None,
        };
        (accuracy, shortfall)
    }

    /// That the whole interval of a part of the error of a mean that counts lies beyond the share.
    fn certain(&self, counted: &[&Estimate], part: &'static str, why: &str) -> Option<Error> {
        let of = |error: &ErrorParts| if part == "start" { Some(error.start) } else { error.modes };
        let all = PartShare::all(counted, of)?.into_iter();
        let beyond = all.filter(|one| one.part.mean.abs() - one.part.half_width_95 > self.share);
        let PartShare { quantity, part: largest } = PartShare::worst(beyond.collect())?;
        let (tolerance, reached, why) = (self.share, largest.at_most(), why.to_owned());
        Some(Error::Biased { part, tolerance, reached, seen: true, quantity, why })
    }
}

/// The largest error of these means, as a share of the mean.
fn largest_error(counted: &[&Estimate]) -> Option<WholeError> {
    let whole = |one: &&Estimate| {
        Some(WholeError { share: one.error?.total / one.mean.abs(), quantity: one.measure.at(&one.place) })
    };
    counted.iter().filter_map(whole).max_by(|a, b| a.share.total_cmp(&b.share))
}
