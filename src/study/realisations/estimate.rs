//! Means over realisations and their intervals.

use super::check::Refined;
use super::error_parts::ErrorParts;
use super::measure::{Figure, Measure};
use super::realisation::Realisation;
use crate::statistics::{ContactPlace, PlaceKind, student_95};
use serde::Serialize;

/// What the half widths of a study are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Interval {
    /// 95 % of the mean over independent realisations, by Student's t.
    StudentOfRealisations,
    /// 95 % of the mean of the batches of the only realisation: it knows what scatters within the
    /// window, and nothing that is slower than a batch.
    BatchesOfOneRealisation,
}

/// The mean of one quantity of one place over the realisations.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Estimate {
    /// Where.
    #[serde(flatten)]
    pub place: ContactPlace,
    /// What.
    pub measure: Measure,
    /// Unit of the numbers below.
    pub unit: &'static str,
    /// The mean.
    pub mean: f64,
    /// Standard deviation of one realisation, with N − 1 in the denominator; `None` for N = 1.
    pub standard_deviation: Option<f64>,
    /// Half width of the 95 % interval of the mean; `None` where one realisation has too few
    /// contacts for batches, or the quantity is an extreme.
    pub half_width_95: Option<f64>,
    /// Its error in parts; `None` unless
    /// [`Realisations::with_checks`](super::Realisations::with_checks) was called, for one
    /// realisation, and unless [`Measure::is_judged`].
    pub error: Option<ErrorParts>,
    /// Of a quantity that need not converge, what each check makes of it, and no error.
    pub refinements: Vec<Refinement>,
}

/// The mean of some realisations, and that of the same with something refined.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Refinement {
    /// What is refined.
    pub refined: Refined,
    /// The mean of the realisations that were run again, as they are in the study.
    pub own: f64,
    /// Their mean with the refinement.
    pub then: f64,
}

/// Mean, standard deviation and half width of the 95 % interval of the mean: x̄, s and t s/√N.
pub(crate) fn mean_of(values: &[f64]) -> (f64, Option<f64>, Option<f64>) {
    let count = values.len() as f64;
    let mean = match values {
        [] => f64::NAN,
        // The sum of equal values would round.
        [first, others @ ..] if others.iter().all(|x| x == first) => *first,
        _ => values.iter().sum::<f64>() / count,
    };
    if values.len() < 2 {
        return (mean, None, None);
    }
    let square = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
    let deviation = (square / (count - 1.0)).sqrt();
    (mean, Some(deviation), Some(student_95(values.len() as u64 - 1) * deviation / count.sqrt()))
}

/// The values of the quantity of `figure` in all of `members`; `None` where one has none.
fn values(figure: &Figure, members: &[Realisation]) -> Option<Vec<f64>> {
    members.iter().map(|member| member.value(&figure.place, figure.measure)).collect()
}

/// The figures of `wanted` with their values in all of `members`; work rates of supports only.
pub(super) fn judged(members: &[Realisation], wanted: Measure) -> impl Iterator<Item = (&Figure, Vec<f64>)> {
    let figures = members.first().map_or(&[][..], |member| &member.figures).iter();
    let own = figures.filter(move |figure| figure.measure == wanted);
    let own = own.filter(move |figure| wanted != Measure::WorkRate || figure.place.kind == PlaceKind::Support);
    own.filter_map(|figure| Some((figure, values(figure, members)?)))
}

/// The estimates over `members`, which have the same places.
pub(super) fn estimates(members: &[Realisation]) -> Vec<Estimate> {
    let figures = members.first().map_or(&[][..], |member| &member.figures);
    let estimate = |figure: &Figure| {
        let (mean, standard_deviation, half) = mean_of(&values(figure, members)?);
        let alone = figure.batch_half_width_95.filter(|_| members.len() == 1);
        Some(Estimate {
            place: figure.place.clone(),
            measure: figure.measure,
            unit: figure.measure.unit(),
            mean,
            standard_deviation,
            half_width_95: half.or(alone),
            error: None,
            refinements: Vec::new(),
        })
    };
    figures.iter().filter_map(estimate).collect()
}
