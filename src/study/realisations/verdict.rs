//! The error of each mean of a study, from its realisations and from checks of them.

use super::check::{Check, Refined};
use super::error_parts::{ErrorPart, ErrorParts};
use super::estimate::{Estimate, Refinement, mean_of};
use super::paired::Difference;
use super::realisation::Realisation;
use super::sample::Realisations;

impl Realisations {
    /// Adds to each judged mean its error in parts; `checks` are the first realisations of the
    /// study again, with half the step and with more modes, as far as there are such. For one
    /// realisation there is none, since nothing tells how much it scatters.
    #[must_use]
    pub fn with_checks(mut self, checks: Vec<Check>) -> Self {
        let found: Vec<(Refined, Vec<Difference>)> =
            checks.iter().map(|check| (check.refined, differences(check, &self))).collect();
        let told = |estimate: &Estimate| {
            let refinement = |check: &Check| refinement(estimate, &self, check);
            (error_parts(estimate, &self, &found), checks.iter().filter_map(refinement).collect())
        };
        let told: Vec<(Option<ErrorParts>, Vec<Refinement>)> = self.estimates.iter().map(told).collect();
        for (estimate, (error, refinements)) in self.estimates.iter_mut().zip(told) {
            (estimate.error, estimate.refinements) = (error, refinements);
        }
        self.checks = checks;
        self
    }
}

/// What `check` changes in the values of `study`; nothing where it is refuted.
fn differences(check: &Check, study: &Realisations) -> Vec<Difference> {
    if check.refuted.is_empty() {
        Difference::all(&Realisations::new(check.members.clone()), study)
    } else {
        Vec::new()
    }
}

/// What `check` makes of a quantity that need not converge; `None` where the check is refuted.
fn refinement(estimate: &Estimate, study: &Realisations, check: &Check) -> Option<Refinement> {
    let mean = |members: &[Realisation]| {
        let values = members.iter().map(|member| member.value(&estimate.place, estimate.measure));
        Some(mean_of(&values.collect::<Option<Vec<f64>>>()?).0)
    };
    if estimate.measure.converges() || !check.refuted.is_empty() {
        return None;
    }
    let own = study.members.get(..check.members.len())?;
    Some(Refinement { refined: check.refined, own: mean(own)?, then: mean(&check.members)? })
}

/// The parts of the error of `estimate`, given what the checks of `study` change.
fn error_parts(estimate: &Estimate, study: &Realisations, found: &[(Refined, Vec<Difference>)]) -> Option<ErrorParts> {
    let sampling = estimate.half_width_95.filter(|_| study.members.len() > 1)?;
    let part = |step: bool| {
        let (refined, all) = found.iter().find(|(refined, _)| refined.is_step() == step)?;
        let less = all.iter().find(|less| less.place == estimate.place && less.measure == estimate.measure)?;
        Some(ErrorPart::new(less.mean, less.half_width_95?).times(refined.factor()))
    };
    Some(ErrorParts::new(start(estimate, study)?, part(true), part(false), sampling))
}

/// The second half of the window less the first.
fn start(estimate: &Estimate, study: &Realisations) -> Option<ErrorPart> {
    let changes = study.members.iter().map(|member| {
        let [first, second] = member.figure(&estimate.place, estimate.measure)?.halves?;
        Some(second - first)
    });
    let (mean, _, half) = mean_of(&changes.collect::<Option<Vec<f64>>>()?);
    Some(ErrorPart::new(mean, half?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::{mix, unit};
    use crate::residual::{Finding, Refuted};
    use crate::statistics::{ContactPlace, PlaceKind};
    use crate::study::realisations::{Figure, Measure};

    fn member(number: u64, value: f64, halves: [f64; 2]) -> Realisation {
        let place = ContactPlace { name: "plate".to_owned(), kind: PlaceKind::Support };
        let (measure, halves) = (Measure::WorkRate, Some(halves));
        let figure = Figure { place, measure, value, batch_half_width_95: None, halves };
        Realisation::of_figures(number, vec![figure])
    }

    const STEP: Refined = Refined::HalfStep { step_s: 1e-3, order: 1 };
    const MODES: Refined = Refined::MoreModes { modes: [20, 40] };

    /// `of` again with each value changed by `change`.
    fn check(refined: Refined, of: &[Realisation], change: impl Fn(u64) -> f64) -> Check {
        let again = |m: &Realisation| member(m.number, m.figures[0].value + change(m.number), [0.0; 2]);
        Check::new(refined, of.iter().map(again).collect())
    }

    #[test]
    fn the_parts_are_means_of_differences_and_add_up() {
        // The differences 1, 2, 3, 6 of pairs: mean 3, half width t₃ √(14/3)/2, t₃ =
        // 3.182446305284.
        let half = 3.182_446_305_284 * (14.0_f64 / 3.0).sqrt() / 2.0;
        let differences = |number: u64| [1.0, 2.0, 3.0, 6.0][number as usize - 1];
        let members: Vec<_> =
            [5.0, 6.0, 7.0, 10.0].into_iter().zip(1..).map(|(x, k)| member(k, x, [x, x - 0.5])).collect();
        let error = |order: u32| {
            let step = check(Refined::HalfStep { step_s: 1e-3, order }, &members, differences);
            let modes = check(MODES, &members, |_| 0.25);
            Realisations::new(members.clone()).with_checks(vec![modes, step]).estimates[0].error.unwrap()
        };
        let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-11, "{x} instead of {y}");
        for (order, factor) in [(1, 2.0), (2, 4.0 / 3.0)] {
            let error = error(order);
            let [step, modes] = [error.step, error.modes].map(Option::unwrap);
            close(step.mean, factor * 3.0);
            close(step.half_width_95, factor * half);
            assert_eq!((modes, error.start), (ErrorPart::new(0.25, 0.0), ErrorPart::new(-0.5, 0.0)));
            close(error.sampling_half_width_95, half);
            close(error.total, factor * 3.0 + 0.75 + half * (1.0 + factor * factor).sqrt());
            assert!(modes.is_seen() && !step.is_seen());
            close(step.at_most(), factor * (3.0 + half));
        }
    }

    #[test]
    fn nothing_follows_from_a_refuted_check_nor_for_one_realisation() {
        let members: Vec<_> = (1..=3).map(|k| member(k, k as f64, [1.0, 1.0])).collect();
        let mut halves = check(STEP, &members, |_| 1.0).members;
        let reason = "rounding".into();
        let finding =
            Finding { refuted: Refuted::Energy, residual: 1.0, tolerance: 0.1, reason, time_s: 1.0, wall: None };
        halves[1].findings.push(finding);
        let study = Realisations::new(members.clone()).with_checks(vec![Check::new(STEP, halves)]);
        let error = study.estimates[0].error.unwrap();
        assert_eq!((error.step, error.modes, study.checks[0].refuted.as_slice()), (None, None, &[2][..]));
        let one = Realisations::new(members[..1].to_vec()).with_checks(Vec::new());
        assert_eq!(one.estimates[0].error, None);
    }

    /// Draw number `index` of a normal distribution (Box & Muller 1958).
    fn normal(draw: u64, part: u64, index: u64) -> f64 {
        let uniform = |k: u64| unit(mix(draw, part, 2 * index + k));
        (-2.0 * (1.0 - uniform(0)).ln()).sqrt() * (std::f64::consts::TAU * uniform(1)).cos()
    }

    #[test]
    fn nineteen_of_twenty_intervals_hold_the_error_and_the_total_bounds_their_sum() {
        // A work rate of 10 W that scatters by 1; the window begins too early by -0.4, half the
        // step changes -0.3, so that the step errs by twice that, and the modes left out change
        // 0.2.
        let wanted = [-0.4, -0.6, 0.2];
        let (mut holding, mut bounded, mut sampled) = ([0; 3], 0, 0);
        for draw in 0..1000 {
            let noise = |part: u64, number: u64, scatter: f64| scatter * normal(draw, part, number);
            let value = |number: u64| 10.0 + noise(0, number, 1.0);
            let half = |number: u64| -0.2 + noise(1, number, 0.25);
            let one = |k: u64| member(k, value(k), [value(k) - half(k), value(k) + half(k)]);
            let members: Vec<_> = (1..=8).map(one).collect();
            // Six of the eight are run again.
            let step = check(STEP, &members[..6], |k| -0.3 + noise(2, k, 0.6));
            let modes = check(MODES, &members[..6], |k| 0.2 + noise(3, k, 0.5));
            let study = Realisations::new(members).with_checks(vec![step, modes]);
            let (estimate, error) = (&study.estimates[0], study.estimates[0].error.unwrap());
            let parts = [error.start, error.step.unwrap(), error.modes.unwrap()];
            for (held, (part, wanted)) in holding.iter_mut().zip(parts.into_iter().zip(wanted)) {
                *held += usize::from((part.mean - wanted).abs() <= part.half_width_95);
            }
            sampled += usize::from((estimate.mean - 10.0).abs() <= error.sampling_half_width_95);
            let limit = 10.0 + wanted.iter().sum::<f64>();
            bounded += usize::from((estimate.mean - limit).abs() <= error.total);
        }
        // 950 of 1000, with a standard deviation of √(1000·0.95·0.05) = 6.9; three of them either
        // way.
        assert!(holding.iter().chain([&sampled]).all(|held| (930..=970).contains(held)), "{holding:?} {sampled}");
        assert!(bounded >= 950, "{bounded} of 1000 errors are within the total");
    }
}
