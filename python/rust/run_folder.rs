//! The folder of a run of a case: the files of `signorini run`, by their own writer.

use crate::plan::Plan;
use signorini as sg;
use signorini::output::Span;
use signorini::output::format::{Format, Formats};
use signorini::output::results::Results;
use signorini::output::run_folder::{self, RunRequest};
use signorini::output::summary::Checks;
use signorini::report;
use signorini::study::accuracy::Accuracy;
use signorini::study::choice::choose;
use signorini::study::realisations::RealisationStudy;
use std::borrow::Cow;
use std::path::Path;

/// A folder that is open for the files of a run.
pub struct RunFolder(Results);

impl RunFolder {
    /// Opens `path` for what is asked.
    pub fn open(path: &Path, asked: &RunRequest<'_>) -> sg::Result<Self> {
        let formats = Formats { pictures: vec![Format::Svg], workbook: false };
        asked.open(path, false, formats).map(Self)
    }

    /// The run of `case`, whose shape over time is written.
    pub fn run(
        &mut self,
        case: &sg::case::Case,
        method: &sg::Method,
        progress: &mut dyn FnMut(f64),
    ) -> sg::Result<sg::Run> {
        run_folder::drawn_run(&mut self.0, "", case, method, true, progress)
    }

    /// Writes the other files of `run`, the first of those of the `study` where there is one, and
    /// the page; with `verdict` the run is checked before, as by the tool. Returns what is not
    /// known since a check failed or is refuted, in sentences.
    pub fn write(
        mut self,
        case: &sg::case::Case,
        (run, plan, reason): (&sg::Run, &Plan, String),
        (study, accuracy): (Option<&RealisationStudy>, Option<&Accuracy>),
        verdict: bool,
    ) -> sg::Result<Vec<String>> {
        let results = &mut self.0;
        let made = verdict.then(|| run_folder::checks(case, (run, &plan.method), &mut |_| {}));
        let (refinement, truncation) = made.map_or((None, None), |(half, more)| (Some(half), more));
        if let Some(study) = study {
            run_folder::write_study(results, case, study)?;
        }
        let checks = Checks {
            refinement: refinement.as_ref().and_then(|found| found.as_ref().ok()),
            truncation: truncation.as_ref().and_then(|found| found.as_ref().ok()),
            accuracy,
            realisations: study.map(|study| &study.realisations),
            ..Checks::default()
        };
        let span = Span { from: 0.0, to: case.scene.duration };
        run_folder::write(results, "", case, (run, &plan.method, reason), checks, span)?;
        report::finish(results, true)?;
        let half = unknown("half the step", refinement.as_ref(), |found| &found.findings);
        let more = unknown("more modes", truncation.as_ref(), |found| &found.findings);
        Ok([half, more].into_iter().flatten().collect())
    }
}

/// Why nothing follows from the check with `what`, if so.
fn unknown<T>(what: &str, found: Option<&sg::Result<T>>, findings: fn(&T) -> &[sg::Finding]) -> Option<String> {
    match found? {
        Err(error) => Some(format!("the check of the run with {what} failed: {error}")),
        Ok(found) => {
            findings(found).first().map(|finding| format!("the check of the run with {what} is refuted: {finding}"))
        }
    }
}

/// `case` with the `step` that is asked for as its own, as its file has it.
pub fn stepped(case: &sg::case::Case, step: Option<f64>) -> sg::Result<Cow<'_, sg::case::Case>> {
    step.map_or(Ok(Cow::Borrowed(case)), |step| case.with("time.step", step).map(Cow::Owned))
}

/// Why `case` is run by the `scheme` that was named, or that chosen.
pub fn reason(case: &sg::case::Case, scheme: Option<&str>) -> String {
    scheme.map_or_else(|| choose(&case.scene).reason, |_| "asked for".to_owned())
}
