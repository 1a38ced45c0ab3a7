//! Differences between two methods under the same realisations.

use super::estimate::mean_of;
use super::measure::Measure;
use super::realisation::Realisation;
use super::sample::Realisations;
use crate::statistics::ContactPlace;
use serde::Serialize;

/// A difference below this share of the values is rounding.
const ROUNDING: f64 = 1e-9;

/// The mean difference in one quantity of one place between two methods, over the realisations that
/// both have.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Difference {
    /// Where.
    #[serde(flatten)]
    pub place: ContactPlace,
    /// What.
    pub measure: Measure,
    /// Unit of the numbers below.
    pub unit: &'static str,
    /// The mean of the differences.
    pub mean: f64,
    /// Half width of its 95 % interval, from the differences, by Student's t; `None` for one
    /// realisation. A difference within it is not distinguished from none: in an irregular motion
    /// two methods part, and their difference scatters too.
    pub half_width_95: Option<f64>,
}

impl Difference {
    /// The differences of `study` less `against`, of every quantity that both have in all their
    /// realisations.
    #[must_use]
    pub fn all(study: &Realisations, against: &Realisations) -> Vec<Self> {
        let figures = study.members.first().map_or(&[][..], |member| &member.figures);
        let of = |member: &Realisation, place: &ContactPlace, measure| {
            let other = against.members.iter().find(|other| other.number == member.number)?;
            let [own, other] = [member.value(place, measure)?, other.value(place, measure)?];
            let difference = own - other;
            Some(if difference.abs() <= ROUNDING * own.abs().max(other.abs()) { 0.0 } else { difference })
        };
        let difference = |(place, measure): (&ContactPlace, Measure)| {
            let pairs: Option<Vec<f64>> = study.members.iter().map(|member| of(member, place, measure)).collect();
            let (mean, _, half_width_95) = mean_of(&pairs?);
            Some(Self { place: place.clone(), measure, unit: measure.unit(), mean, half_width_95 })
        };
        figures.iter().map(|figure| (&figure.place, figure.measure)).filter_map(difference).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::PlaceKind;
    use crate::study::realisations::Figure;

    fn study(values: &[(u64, f64)]) -> Realisations {
        let member = |&(number, value): &(u64, f64)| {
            let place = ContactPlace { name: "stop".to_owned(), kind: PlaceKind::Wall };
            let figure = Figure { place, measure: Measure::ForceMean, value, batch_half_width_95: None, halves: None };
            Realisation::of_figures(number, vec![figure])
        };
        Realisations::new(values.iter().map(member).collect())
    }

    #[test]
    fn differences_are_those_of_the_same_realisations() {
        let one = study(&[(1, 5.0), (2, 7.0), (3, 6.0), (4, 12.0)]);
        // In another order: realisations are paired by their numbers. Differences 1, 2, 3, 6: mean
        // 3, deviation √(14/3), t₃ = 3.182446305284.
        let other = study(&[(4, 6.0), (3, 3.0), (2, 5.0), (1, 4.0)]);
        let all = Difference::all(&one, &other);
        let [found] = all.as_slice() else { panic!("{all:?}") };
        assert!((found.mean - 3.0).abs() < 1e-15);
        let half = 3.182_446_305_284 * (14.0_f64 / 3.0).sqrt() / 2.0;
        assert!((found.half_width_95.unwrap() - half).abs() < 1e-11);
        // What two methods differ by in rounding is no difference.
        let near = study(&[(1, 5.0 * (1.0 + 1e-15)), (2, 7.0), (3, 6.0), (4, 12.0 * (1.0 - 1e-14))]);
        assert_eq!(Difference::all(&one, &near)[0].mean, 0.0);
        // A realisation that one of them lacks leaves nothing to compare.
        assert!(Difference::all(&one, &study(&[(1, 4.0), (2, 5.0)])).is_empty());
    }
}
