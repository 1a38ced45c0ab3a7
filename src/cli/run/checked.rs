//! A run, checked with half the step and with more modes.

use super::args::Args;
use crate::case::Case;
use crate::cli::estimate::DurationEstimate;
use crate::cli::ui::Ui;
use crate::error::{Error, Result};
use crate::output::results::Results;
use crate::output::run_folder::{self, RunGoal};
use crate::run::Run;
use crate::scheme::Method;
use crate::study::accuracy::Accuracy;
use crate::study::truncation::{ChosenModes, Truncation};
use crate::study::verdict::{self, Verdict};

/// A finished run, and what was found out about it; a check that failed has the reason.
pub(super) struct CheckedRun {
    pub case: Case,
    pub results: Results,
    pub method: Method,
    /// Why this method.
    pub reason: String,
    pub run: Run,
    pub refinement: Option<Result<Verdict>>,
    pub truncation: Option<Result<Truncation>>,
    pub modes: Option<Result<ChosenModes>>,
    pub accuracy: Option<Result<Accuracy>>,
    /// What the run falls short of.
    pub shortfall: Option<Error>,
}

/// The run by the method asked for or chosen, checked with half the step and with more modes unless
/// that is not wanted.
pub(super) fn checked(args: &Args, case: Case, ui: &Ui) -> Result<CheckedRun> {
    let (method, reason) = args.chosen(&case)?;
    let results = args.open(&case, Some(&method), RunGoal::Step { verdict: !args.no_verdict })?;
    made(args, case, (method, reason), results, !args.no_verdict, ui)
}

/// The run by `method`, with the reason for it, whose files are in `results`; with `verdict`
/// checked with half the step and with more modes.
pub(super) fn made(
    args: &Args,
    case: Case,
    (method, reason): (Method, String),
    mut results: Results,
    verdict: bool,
    ui: &Ui,
) -> Result<CheckedRun> {
    let cost = if verdict { verdict::COST } else { 0.0 };
    let runs = 1.0 + cost;
    let estimate = DurationEstimate::of_run(&case.scene, &method, case.time.step).times(runs);
    let (run, refinement, truncation) = ui.with_estimate(&method.to_string(), estimate, |bar| -> Result<_> {
        let from = |before: f64, cost: f64| {
            let end = case.scene.duration;
            move |time: f64| bar.set_share((before + cost * time / end) / runs)
        };
        let drawn = !args.request.place.no_report;
        let run = run_folder::drawn_run(&mut results, "", &case, &method, drawn, &mut from(0.0, 1.0))?;
        if !verdict {
            return Ok((run, None, None));
        }
        let (refinement, more_modes) = run_folder::checks(&case, (&run, &method), &mut from(1.0, cost));
        Ok((run, Some(refinement), more_modes))
    })?;
    ui.refute(&method.to_string(), &run.findings);
    if let Some(Ok(verdict)) = &refinement {
        ui.refute("the check of its step", &verdict.findings);
    }
    if let Some(Ok(truncation)) = &truncation {
        ui.refute("the check with more modes", &truncation.findings);
    }
    let (modes, accuracy, shortfall) = (None, None, None);
    Ok(CheckedRun { case, results, method, reason, run, refinement, truncation, modes, accuracy, shortfall })
}
