//! What a comparison shows, in one sentence: how far the best method agrees with the reference, and
//! what becomes of the worst one.

use super::compare::largest_force;
use super::compare_table::{contacts, force};
use super::work_precision::law_label;
use crate::case::Case;
use crate::run::Run;
use crate::scheme::{Method, PenaltyLaw, Scheme};
use crate::study::compare::{AGREEMENT, Comparison, FINER, is_aperiodic};
use crate::study::difference::error_length;
use crate::study::verdict::Verdict;
use std::cmp::Ordering;

/// Numbers of contacts and largest forces that differ by more than this share are told.
const ALIKE: f64 = 0.1;

/// A penalty that passes a rigid wall by more than this share of the gap is told by that.
const TOO_SOFT: f64 = 1.0;

/// A method that has a result, and what became of it.
struct Judged {
    name: String,
    penalty: bool,
    error: f64,
    agrees_until: f64,
    fate: Fate,
    /// How far it passes rigid walls, as a share of the length of errors.
    penetration: f64,
    /// Its contacts and its largest force beside those of the reference, where they differ.
    contacts: Option<String>,
}

/// From good to bad.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
enum Fate {
    /// Agrees with the reference as long as that can be asked.
    Agrees,
    /// Another motion.
    Departs,
    /// Passes the walls by more than the gap.
    Passes,
    /// Breaks what its scheme promises.
    Refuted,
}

/// The sentence: the best of the methods that keep the walls as constraints, and the best and the
/// worst penalty. Without penalties the worst of the others, without others the best penalty.
#[must_use]
pub fn conclusion(case: &Case, comparison: &Comparison) -> String {
    let reference = match (&comparison.reference, &comparison.refined) {
        (Ok(_), _) => "the exact motion".to_owned(),
        (_, Some((method, _))) => format!("a run by {method} with steps {FINER} times finer"),
        (Err(error), None) => return format!("there is no reference to compare with: {error}"),
    };
    let judged = judged(case, comparison);
    let by_error = |a: &&Judged, b: &&Judged| a.worse(b);
    let best = judged.iter().filter(|one| !one.penalty).min_by(by_error);
    let Some(best) = best.or_else(|| judged.iter().min_by(by_error)) else {
        return "there is nothing to compare: no probe, or no method but the exact one has a result".to_owned();
    };
    let others = || judged.iter().filter(|one| !std::ptr::eq(*one, best));
    let worst = others().filter(|one| one.penalty).max_by(by_error).or_else(|| others().max_by(by_error));
    let nearest = others().filter(|one| one.penalty && !best.penalty).min_by(by_error);
    let nearest = nearest.filter(|near| !worst.is_some_and(|worst| std::ptr::eq(*near, worst)));
    let (end, distance) = (end_of_prediction(case, comparison), |x| distance(case, comparison, x));
    let first = match (best.fate, end) {
        (Fate::Agrees, end) => {
            let until = end.map_or_else(|| "to the end".to_owned(), |end| format!("until {end}"));
            format!("{} agrees with {reference} to {} {until}", best.name, distance(best.error))
        }
        (Fate::Departs, Some(end)) => format!("{}, before {end}", best.becomes(&reference, &distance)),
        _ => best.becomes(&reference, &distance),
    };
    let second = nearest.into_iter().chain(worst).map(|one| match best.fate {
        Fate::Refuted | Fate::Passes => one.becomes(&reference, &distance),
        Fate::Agrees | Fate::Departs => one.becomes("it", &distance),
    });
    std::iter::once(first).chain(best.contacts.clone()).chain(second).collect::<Vec<_>>().join("; ")
}

/// What half the step changes, by the first method that was checked.
#[must_use]
pub fn half_the_step(case: &Case, comparison: &Comparison, verdicts: &[Option<Verdict>]) -> Option<String> {
    let checked = comparison.rows.iter().zip(verdicts);
    let (row, change) = checked.filter_map(|(row, verdict)| Some((row, verdict.as_ref()?.displacement?))).next()?;
    Some(format!("half the step changes {} by {}", row.method, distance(case, comparison, change)))
}

/// The methods that have a result and an error. The same scheme with another solver of its
/// quadratic programmes makes the same motion: it is judged once.
fn judged(case: &Case, comparison: &Comparison) -> Vec<Judged> {
    let length = length(case, comparison);
    let mut schemes = Vec::new();
    let mut judged = Vec::new();
    for row in comparison.rows.iter().filter(|row| !row.method.scheme.is_exact()) {
        let (Ok(run), Some(error), Some(until)) = (&row.outcome, row.error, row.agrees_until) else { continue };
        if schemes.contains(&row.method.scheme) {
            continue;
        }
        schemes.push(row.method.scheme);
        let penalty = matches!(row.method.scheme, Scheme::Penalty { .. });
        let penetration = run.residuals.penetration_m / length;
        let fate = fate(run, penalty && penetration > TOO_SOFT, error.is_nan() || error > AGREEMENT);
        // The largest force of springs is that of an instant, at rigid walls it is a mean.
        let reference = comparison.reference_run().filter(|_| !penalty);
        let contacts = reference.and_then(|reference| other_contacts(run, reference));
        let name = name(&row.method);
        judged.push(Judged { name, penalty, error, agrees_until: until, fate, penetration, contacts });
    }
    judged
}

/// What became of a run that passes its walls, or departs from the reference.
fn fate(run: &Run, passes: bool, departs: bool) -> Fate {
    match (run.findings.is_empty(), passes, departs) {
        (false, ..) => Fate::Refuted,
        (_, true, _) => Fate::Passes,
        (.., true) => Fate::Departs,
        _ => Fate::Agrees,
    }
}

/// A method in words: a penalty by the springs that it puts in the place of walls.
fn name(method: &Method) -> String {
    let Scheme::Penalty { law, integrator } = method.scheme else { return method.to_string() };
    let springs = if law == PenaltyLaw::None { String::new() } else { format!(" at {}", law_label(law)) };
    let by = if integrator == Default::default() { String::new() } else { format!(" by {integrator}") };
    format!("the penalty{springs}{by}")
}

/// What ends the time over which the methods are compared before the run does, in words.
fn end_of_prediction(case: &Case, comparison: &Comparison) -> Option<String> {
    let what = if is_aperiodic(&case.scene) { "small differences have grown" } else { "chaos takes over" };
    let ended = comparison.horizon < case.scene.duration;
    ended.then(|| format!("{what} at {} s", two_digits(comparison.horizon)))
}

/// The contacts and the largest force of a run over its whole duration beside those of the
/// reference, in words: a motion that is followed no further may still have the same of both.
fn other_contacts(run: &Run, reference: &Run) -> Option<String> {
    let differ = |a: f64, b: f64| (a - b).abs() > ALIKE * a.max(b);
    let [own, wanted] = [run, reference].map(contacts);
    let [strongest, asked] = [run, reference].map(largest_force);
    let alike = own.abs_diff(wanted) <= 1 || !differ(own as f64, wanted as f64);
    let as_strong = strongest.zip(asked).is_none_or(|(own, wanted)| !differ(own, wanted));
    (!alike || !as_strong).then(|| {
        format!(
            "over the whole run it has {own} contacts and {} N at most, for {wanted} and {} N",
            force(strongest),
            force(asked)
        )
    })
}

/// The length of which errors are shares, m.
fn length(case: &Case, comparison: &Comparison) -> f64 {
    comparison.reference_run().map_or(1.0, |run| error_length(&case.scene, &run.trajectory))
}

/// An error, which is a share of that length, in words.
fn distance(case: &Case, comparison: &Comparison, share: f64) -> String {
    match case.scene.gap() {
        Some(_) => format!("{} of the gap", two_digits(share)),
        None => format!("{} m", two_digits(share * length(case, comparison))),
    }
}

/// A number with two digits, as a person writes it.
fn two_digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.1e}").parse().unwrap_or(x);
    if x == 0.0 || (1e-3..1e4).contains(&rounded) { rounded.to_string() } else { format!("{x:.1e}") }
}

impl Judged {
    /// What became of the method beside the reference of that name.
    fn becomes(&self, reference: &str, distance: &dyn Fn(f64) -> String) -> String {
        let name = &self.name;
        match self.fate {
            Fate::Agrees => format!("{name} agrees to {}", distance(self.error)),
            Fate::Departs => format!("{name} departs from {reference} at {} s", two_digits(self.agrees_until)),
            Fate::Passes => format!("{name} passes the walls by {}", distance(self.penetration)),
            Fate::Refuted => format!("{name} is refuted"),
        }
    }

    /// From the best to the worst: of those that depart, the first to do so is the worst.
    fn worse(&self, other: &Self) -> Ordering {
        let fate = self.fate.partial_cmp(&other.fate).unwrap_or(Ordering::Equal);
        let departure = match self.fate {
            Fate::Departs => other.agrees_until.total_cmp(&self.agrees_until),
            _ => Ordering::Equal,
        };
        fate.then(departure).then(self.error.total_cmp(&other.error))
    }
}
