//! How many realisations an interval needs.

use super::estimate::{judged, mean_of};
use super::measure::{Figure, Measure};
use super::realisation::Realisation;
use crate::error::Error;
use crate::statistics::ContactPlace;
use serde::Serialize;

/// How many realisations bring the 95 % intervals of the judged means within a share of them: those
/// of the work rates of supports, or without work of the mean forces of all places.
///
/// Stein's procedure in two stages (1945, doi:10.1214/aoms/1177731088): from n pilots with the mean
/// x̄ and the standard deviation s,
///
/// N = ⌈(t s/(εx̄))²⌉,   t of n − 1 degrees of freedom at 97.5 %.
///
/// The number is fixed before the other realisations are run: to stop at the first interval that is
/// narrow enough would favour those that are narrow by chance, and hold the mean too seldom.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct NeededRealisations {
    /// N.
    pub count: u64,
    /// Half width over mean of the pilots.
    pub pilot_share: f64,
    /// The place that needs most.
    #[serde(flatten)]
    pub place: ContactPlace,
    /// The measure of it.
    pub measure: Measure,
}

/// The judged means of `members`: place, measure, mean and half width.
fn means(members: &[Realisation]) -> Vec<(ContactPlace, Measure, f64, f64)> {
    let of = |wanted| -> Vec<_> {
        let mean = |(figure, values): (&Figure, Vec<f64>)| {
            let (mean, _, half) = mean_of(&values);
            Some((figure.place.clone(), wanted, mean.abs(), half?)).filter(|_| mean != 0.0)
        };
        judged(members, wanted).filter_map(mean).collect()
    };
    let rates = of(Measure::WorkRate);
    if rates.is_empty() { of(Measure::ForceMean) } else { rates }
}

impl NeededRealisations {
    /// From two pilots or more; `None` where nothing is judged: no contact, or no scatter.
    pub(crate) fn from_pilots(pilots: &[Realisation], share: f64) -> Option<Self> {
        Some(widest(pilots)?.for_share(share))
    }

    /// The number that brings the interval of `self`, which is of its count of realisations, within
    /// `share`; never fewer than there are.
    pub(super) fn for_share(self, share: f64) -> Self {
        Self { count: Self::count_for(self.count, self.pilot_share, share), ..self }
    }

    /// The number that brings an interval, of the half width `reached` from `count`, within
    /// `wanted`; never fewer than there are.
    pub(super) fn count_for(count: u64, reached: f64, wanted: f64) -> u64 {
        // t s = half width times √n.
        ((count as f64 * (reached / wanted).powi(2)).ceil() as u64).max(count)
    }

    /// That its count of realisations is below `needed`, and leaves an interval wider than `share`.
    pub(super) fn shortfall(&self, share: f64, needed: u64) -> Option<Error> {
        let quantity = self.measure.at(&self.place);
        let (reached, count) = (self.pilot_share, self.count);
        (needed > count && reached > share).then_some(Error::Scattered { share, reached, quantity, count, needed })
    }
}

/// The judged mean whose interval is widest, with that share, among `members`.
#[must_use]
pub fn widest(members: &[Realisation]) -> Option<NeededRealisations> {
    let all = means(members).into_iter().map(|(place, measure, mean, half)| NeededRealisations {
        count: members.len() as u64,
        pilot_share: half / mean,
        place,
        measure,
    });
    all.max_by(|a, b| a.pilot_share.total_cmp(&b.pilot_share))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::PlaceKind;

    fn members(values: &[(f64, f64)]) -> Vec<Realisation> {
        let figure = |name: &str, kind, measure, value| {
            let place = ContactPlace { name: name.to_owned(), kind };
            Figure { place, measure, value, batch_half_width_95: None, halves: None }
        };
        let member = |(number, &(rate, force)): (u64, &(f64, f64))| {
            let work_rate = figure("plate", PlaceKind::Support, Measure::WorkRate, rate);
            let mean_force = figure("stop", PlaceKind::Wall, Measure::ForceMean, force);
            Realisation::of_figures(number, vec![work_rate, mean_force])
        };
        (1..).zip(values).map(member).collect()
    }

    #[test]
    fn the_number_follows_from_the_scatter_of_the_pilots() {
        // 1, 2, 3, 6: mean 3, s² = 14/3, t₃ = 3.182446305284: N = ⌈(t s/0.1 x̄)²⌉ = ⌈525.13⌉.
        let pilots = members(&[(1.0, 5.0), (2.0, 50.0), (3.0, 5.0), (6.0, 5.0)]);
        let needed = NeededRealisations::from_pilots(&pilots, 0.1).unwrap();
        assert_eq!((needed.count, needed.measure, needed.place.name.as_str()), (526, Measure::WorkRate, "plate"));
        // Never fewer than there are.
        assert_eq!(NeededRealisations::from_pilots(&pilots, 2.0).unwrap().count, 4);
    }

    #[test]
    fn without_work_forces_are_judged_and_without_contact_nothing() {
        let pilots = members(&[(0.0, 5.0), (0.0, 5.5), (0.0, 4.5)]);
        assert_eq!(widest(&pilots).unwrap().measure, Measure::ForceMean);
        assert_eq!(NeededRealisations::from_pilots(&members(&[(0.0, 0.0), (0.0, 0.0)]), 0.1), None);
        assert_eq!(NeededRealisations::from_pilots(&members(&[(1.0, 1.0)]), 0.1), None);
    }
}
