//! Which means of a study count for its error, and the shares of their errors in them.

use super::error_parts::{ErrorPart, ErrorParts};
use super::estimate::Estimate;
use super::sample::Realisations;
use super::stein::NeededRealisations;
use crate::scene::Scene;

/// A mean counts if it is at least this share of the sum over all places of its kind.
const LEAST_SHARE: f64 = 0.05;

/// The judged means of `study` that count: work rate, mean force and RMS force of supports, and the
/// forces of walls that are no flats of a support, each with 5 % or more of its sum over all
/// supports, or over all such walls.
pub(super) fn counted<'a>(study: &'a Realisations, scene: &Scene) -> Vec<&'a Estimate> {
    let own = |one: &&Estimate| one.measure.is_judged() && one.place.stands_alone(scene);
    let all: Vec<&Estimate> = study.estimates.iter().filter(own).collect();
    let sum = |like: &Estimate| -> f64 {
        let same = |one: &&&Estimate| (one.place.kind, one.measure) == (like.place.kind, like.measure);
        all.iter().filter(same).map(|one| one.mean.abs()).sum()
    };
    let counts = |one: &&Estimate| one.mean != 0.0 && one.mean.abs() >= LEAST_SHARE * sum(one);
    all.iter().copied().filter(counts).collect()
}

/// A part of the error of a mean as shares of that mean.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PartShare {
    /// Which mean.
    pub quantity: String,
    /// The part, and the half width of its 95 % interval.
    pub part: ErrorPart,
}

impl PartShare {
    /// The same part of the errors of all means that count; `None` where one of them lacks it.
    pub fn all(counted: &[&Estimate], part: impl Fn(&ErrorParts) -> Option<ErrorPart>) -> Option<Vec<Self>> {
        let share = |one: &&Estimate| {
            let quantity = one.measure.at(&one.place);
            Some(Self { quantity, part: part(&one.error?)?.times(1.0 / one.mean.abs()) })
        };
        counted.iter().map(share).collect()
    }

    /// The one that may be largest.
    pub fn worst(shares: Vec<Self>) -> Option<Self> {
        shares.into_iter().max_by(|a, b| a.part.at_most().total_cmp(&b.part.at_most()))
    }
}

/// The mean that counts whose interval is widest, with that share, over the realisations of
/// `study`.
pub(super) fn widest_counted(counted: &[&Estimate], study: &Realisations) -> Option<NeededRealisations> {
    let width = |one: &&Estimate| {
        let pilot_share = one.half_width_95? / one.mean.abs();
        let (place, measure) = (one.place.clone(), one.measure);
        Some(NeededRealisations { count: study.count as u64, pilot_share, place, measure })
    };
    counted.iter().filter_map(width).max_by(|a, b| a.pilot_share.total_cmp(&b.pilot_share))
}
