//! A study of realisations of a case, for the commands that make one: `run` and `wear`.

use super::estimate::DurationEstimate;
use super::pipeline::Answer;
use super::ui::Ui;
use crate::case::Case;
use crate::error::{Error, Result, Subject};
use crate::output::realisations as output;
use crate::output::{error_parts, refinements};
use crate::parallel::cores;
use crate::run::Run;
use crate::scheme::Method;
use crate::study::realisations::{
    Batch, KnownRealisations, Purpose, RandomScenes, Realisation, RealisationCount, RealisationPlan, RealisationStudy,
    Refined, checked,
};

/// The share that `text` of `argument` says: `5%` or `0.05`.
///
/// # Errors
/// [`Error::Invalid`] under `argument` for a text that is no number.
pub fn share(argument: &'static str, text: &str) -> Result<f64> {
    // Divided, 7% is the same number as 0.07.
    let (number, whole) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 100.0),
        None => (text, 1.0),
    };
    let wrong = |_| Error::invalid(argument, text, "a share above 0 and below 1: 5% or 0.05");
    Ok(number.trim().parse::<f64>().map_err(wrong)? / whole)
}

/// The seconds that `text` of `argument` says: `10min`, `90s`, `1h 30min`.
///
/// # Errors
/// [`Error::Invalid`] under `argument` for a text that is no time above 0.
pub fn seconds(argument: &'static str, text: &str) -> Result<f64> {
    let time = humantime::parse_duration(text.trim()).ok().filter(|time| !time.is_zero());
    time.map(|time| time.as_secs_f64())
        .ok_or_else(|| Error::invalid(argument, text, "a time above 0 with its unit: 10min, 90s or \"1h 30min\""))
}

/// The error of a request under the name of the command line's argument: `until_interval` is
/// `--until-interval`.
pub fn of_argument(error: Error) -> Error {
    match error {
        Error::Invalid { subject, value, expected } => {
            let subject = Subject::of(format!("--{}", subject.to_string().replace('_', "-")));
            Error::Invalid { subject, value, expected }
        }
        other => other,
    }
}

/// A study of realisations that is asked for.
pub struct StudyRequest {
    /// How many realisations.
    pub count: RealisationCount,
    /// How many of them are checked, as [`RealisationPlan::checked`].
    pub checked: u64,
    /// Those that have been run already.
    pub known: KnownRealisations,
}

impl StudyRequest {
    /// A study of `count` realisations, with `verdict` also the errors of their means.
    pub fn new(count: RealisationCount, verdict: bool) -> Self {
        Self { count, checked: checked(verdict), known: KnownRealisations::default() }
    }
}

/// The study of realisations of `case` that is `asked` for, of which `run` by `method` is the
/// first. Its bars say how far it is, and what is refuted in it fails the command, under the name
/// of the run after `of`.
pub fn study(
    case: &Case,
    (run, method): (&Run, &Method),
    asked: StudyRequest,
    of: &str,
    ui: &Ui,
) -> Result<RealisationStudy> {
    let StudyRequest { count, checked, mut known } = asked;
    let plan = RealisationPlan { scenes: case, run, method, time: case.time, count, checked };
    let mut make = |batch: &Batch<'_>| known.complete(batch, &mut |missing| batch_with_bar(case, method, missing, ui));
    let study = plan.follow(&mut make, &mut |pilots| ui.message(&pilots.to_string()))?;
    if let Some(words) = study.wider_in_words() {
        ui.message(&words);
    }
    // Of its first run the command itself has told.
    for (refined, member) in study.refuted().filter(|(refined, member)| refined.is_some() || member.number > 1) {
        let with = refined.map_or_else(String::new, |refined| format!(" with {refined}"));
        ui.refute(&format!("{of}realisation {}{with}", member.number), &member.findings);
    }
    Ok(study)
}

/// What the study of `seeds` realisations of `case` by one method costs after its first run, in
/// runs like that one after one another: the other realisations, and with `verdict` up to six of
/// them with half the step, unless the scheme is `exact`, and with more modes, all on all cores.
pub fn cost(case: &Case, seeds: u64, verdict: bool, exact: bool) -> f64 {
    let on_all_cores = |count: u64| count as f64 / (cores() as f64).min(count.max(1) as f64);
    let others = on_all_cores(seeds.saturating_sub(1));
    // A single realisation has no interval, and so no errors.
    let again = on_all_cores(if seeds > 1 { seeds.min(checked(verdict)) } else { 0 });
    let half_step = if exact { 0.0 } else { 2.0 };
    let more_modes = case.modes().map_or(0.0, |[own, more]| more as f64 / own.max(1) as f64);
    others + again * (half_step + more_modes)
}

/// Runs `batch` under a bar with its name.
pub fn batch_with_bar(case: &Case, method: &Method, batch: &Batch<'_>, ui: &Ui) -> Result<Vec<Realisation>> {
    let (label, other) = match batch.purpose {
        Purpose::Pilots => ("pilots".to_owned(), None),
        Purpose::Check(refined @ Refined::MoreModes { .. }) => (refined.to_string(), Some(batch.scene(1)?)),
        Purpose::Check(refined) => (refined.to_string(), None),
        Purpose::Means => ("realisations".to_owned(), None),
    };
    let scene = other.as_ref().unwrap_or(&case.scene);
    let estimate = DurationEstimate::of_run(scene, method, batch.step()).on_all_cores(batch.count() as f64);
    ui.with_estimate(&label, estimate, |bar| batch.run(&mut |done| bar.set_share(done)))
}

/// The refinements of the checks of `study` that failed, in words.
pub fn failed_checks(study: &RealisationStudy) -> impl Iterator<Item = String> {
    study.failures.iter().map(|failed| failed.refined.to_string())
}

/// That the checks failed in which `refined` is refined; `None` where none did.
pub fn not_checked(refined: impl Iterator<Item = String>) -> Option<Error> {
    let mut checks: Vec<String> = refined.collect();
    checks.sort();
    checks.dedup();
    (!checks.is_empty()).then_some(Error::Unchecked { checks })
}

/// Shows the errors of the means of `study`: their table, the remarks on it, and which checks
/// failed.
pub fn show_errors(study: &RealisationStudy, answer: &mut Answer, case: &Case) {
    if let Some(table) = error_parts::table(&study.realisations, &case.scene) {
        answer.table(table, error_parts::FILE);
    }
    answer.messages(error_parts::remarks(&study.realisations, &case.scene));
    if let Some(table) = refinements::table(&study.realisations, &case.scene) {
        answer.table(table, output::FILE);
        answer.messages([refinements::REMARK.to_owned()]);
    }
    answer.messages(
        study
            .failures
            .iter()
            .map(|failed| format!("the check of the means with {} failed: {}", failed.refined, failed.error)),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checks_that_failed_fail_the_command_and_each_is_named_once() {
        let names = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        let all = names(&["half the step", "8 modes", "half the step"]);
        let error = not_checked(all.into_iter()).expect("some failed");
        assert!(!error.is_request(), "exit code 1: the run failed, and not the request");
        assert!(error.to_string().ends_with("not known: the run with 8 modes; the run with half the step"), "{error}");
        assert_eq!(not_checked(std::iter::empty()), None);
    }

    #[test]
    fn a_study_costs_its_other_realisations_and_the_checks_of_six() {
        // Of the built-in tube with 20 of its modes in each plane, whose checks have twice as many.
        let case = Case::embedded("tube-in-cross-flow").unwrap();
        let on = |count: f64| count / (cores() as f64).min(count);
        assert_eq!(cost(&case, 13, false, false), on(12.0));
        assert_eq!(cost(&case, 13, true, false), on(12.0) + on(6.0) * 4.0);
        assert_eq!(cost(&case, 4, true, true), on(3.0) + on(4.0) * 2.0);
        assert_eq!(cost(&case, 1, true, false), 0.0);
    }

    #[test]
    fn per_cent_are_the_share_that_they_stand_for_to_the_last_bit() {
        for percent in 1..100 {
            let expected = f64::from(percent) / 100.0;
            for text in [format!("{percent}%"), format!("{expected:?}")] {
                assert_eq!(share("until_interval", &text), Ok(expected), "{text}");
            }
        }
    }
}
