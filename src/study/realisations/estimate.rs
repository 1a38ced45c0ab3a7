//! Means over realisations, their intervals, and what half the step changes.

use super::measure::{Figure, Measure};
use super::realisation::Realisation;
use crate::statistics::{ContactPlace, student_95};
use serde::Serialize;

/// What the half widths of a study are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Interval {
    /// 95 % of the mean over independent realisations, by Student's t.
    StudentOfRealisations,
    /// 95 % of the mean of ten batches of the only realisation: it knows what scatters within the
    /// window, and nothing that is slower than a batch.
    TenBatchesOfOneRealisation,
}

/// Which of two errors of a mean is the larger.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Larger {
    /// What half the step changes.
    Step,
    /// The half width of the interval: more or longer realisations would help first.
    Sampling,
}

/// What half the step changes in a mean.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct StepChange {
    /// Mean of the difference between the runs with half the step and those with the whole one,
    /// under the same loads.
    pub change: f64,
    /// Half width of its own 95 % interval, from the differences; `None` for one realisation. A
    /// change within it is not distinguished from 0: in an irregular motion the two runs of a pair
    /// part, and their difference scatters too.
    pub half_width_95: Option<f64>,
    /// Whether |`change`| exceeds the half width of the mean; `None` where that has none.
    pub larger: Option<Larger>,
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
    /// What half the step changes; `None` where that was not computed.
    pub half_step: Option<StepChange>,
}

/// Mean, standard deviation and half width of the 95 % interval of the mean: x̄, s and t s/√N.
pub(crate) fn mean_of(values: &[f64]) -> (f64, Option<f64>, Option<f64>) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
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
            half_step: None,
        })
    };
    figures.iter().filter_map(estimate).collect()
}

/// Adds what `halves`, the same realisations with half the step, change.
pub(super) fn add_half_step(estimates: &mut [Estimate], members: &[Realisation], halves: &[Realisation]) {
    for estimate in estimates {
        let of = |member: &Realisation| member.value(&estimate.place, estimate.measure);
        let pairs = members.iter().zip(halves);
        let differences: Option<Vec<f64>> = pairs.map(|(whole, half)| Some(of(half)? - of(whole)?)).collect();
        let Some(differences) = differences.filter(|all| all.len() == members.len()) else { continue };
        let (change, _, half_width_95) = mean_of(&differences);
        let larger = |half: f64| if change.abs() > half { Larger::Step } else { Larger::Sampling };
        let larger = estimate.half_width_95.map(larger);
        estimate.half_step = Some(StepChange { change, half_width_95, larger });
    }
}
