//! Several realisations, and the means over them.

use super::check::Check;
use super::estimate::{Estimate, Interval, estimates};
use super::groups::{PlaceGroups, groups};
use super::realisation::Realisation;
use crate::run::Cautioned;
use serde::Serialize;

/// Several realisations, and what follows from them.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Realisations {
    /// How many there are.
    pub count: usize,
    /// What the half widths are.
    pub interval: Interval,
    /// Numbers of those that the judge refutes: their figures are wrong, and so are the means.
    pub refuted: Vec<u64>,
    /// The mean of every measure of every place.
    pub estimates: Vec<Estimate>,
    /// Where the realisations fall into two groups.
    pub groups: Vec<PlaceGroups>,
    /// The checks from which the parts of their errors come.
    pub checks: Vec<Check>,
    /// The realisations.
    #[serde(skip)]
    pub members: Vec<Realisation>,
}

impl Realisations {
    /// How many realisations have notes that limit the use of their results.
    #[must_use]
    pub fn cautioned(&self) -> Cautioned {
        let mut cautioned = Cautioned::default();
        self.members.iter().for_each(|member| cautioned.add(member.number, member.caution.clone()));
        cautioned
    }

    /// The study of `members`, one or more of one scene; a single one has the intervals of its own
    /// batches.
    #[must_use]
    pub fn new(members: Vec<Realisation>) -> Self {
        let interval = match members.len() {
            0 | 1 => Interval::BatchesOfOneRealisation,
            _ => Interval::StudentOfRealisations,
        };
        let refuted = members.iter().filter(|member| !member.findings.is_empty()).map(|member| member.number);
        Self {
            count: members.len(),
            interval,
            refuted: refuted.collect(),
            estimates: estimates(&members),
            groups: groups(&members),
            checks: Vec::new(),
            members,
        }
    }

    /// Where the realisations fall into two groups, a sentence each.
    #[must_use]
    pub fn groups_in_words(&self) -> Vec<String> {
        self.groups.iter().map(PlaceGroups::to_string).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::{ContactPlace, PlaceKind};
    use crate::study::realisations::{Figure, Measure};

    fn member(number: u64, value: f64, batch: Option<f64>) -> Realisation {
        let place = ContactPlace { name: "stop".to_owned(), kind: PlaceKind::Wall };
        let figure = Figure { place, measure: Measure::ForceMean, value, batch_half_width_95: batch, halves: None };
        Realisation::of_figures(number, vec![figure])
    }

    #[test]
    fn the_interval_is_that_of_student() {
        // 1, 2, 3, 6: mean 3, deviation √(14/3), t₃ = 3.182446305284.
        let values = [1.0, 2.0, 3.0, 6.0];
        let members: Vec<_> = values.iter().enumerate().map(|(i, &x)| member(i as u64 + 1, x, Some(9.0))).collect();
        let study = Realisations::new(members);
        let estimate = &study.estimates[0];
        let deviation = (14.0_f64 / 3.0).sqrt();
        assert_eq!(study.interval, Interval::StudentOfRealisations);
        assert!((estimate.mean - 3.0).abs() < 1e-15);
        assert!((estimate.standard_deviation.unwrap() - deviation).abs() < 1e-15);
        assert!((estimate.half_width_95.unwrap() - 3.182_446_305_284 * deviation / 2.0).abs() < 1e-11);
    }

    #[test]
    fn realisations_of_two_attractors_are_told_apart() {
        let values = [1.0, 5.0, 1.1, 5.2, 0.9, 5.1, 1.05];
        let members = values.iter().enumerate().map(|(i, &x)| member(i as u64 + 1, x, None)).collect();
        let [words] = &Realisations::new(members).groups_in_words()[..] else { panic!("one place") };
        assert!(
            words.contains("two groups at wall \"stop\": 4 with a mean force of 1.01 N in the mean and 3"),
            "{words}"
        );
    }

    #[test]
    fn one_realisation_has_the_interval_of_its_batches() {
        let study = Realisations::new(vec![member(1, 2.0, Some(0.25))]);
        let estimate = &study.estimates[0];
        assert_eq!(study.interval, Interval::BatchesOfOneRealisation);
        assert_eq!((estimate.standard_deviation, estimate.half_width_95), (None, Some(0.25)));
    }
}
