//! A run, checked with half the step and with more modes.

use super::args::Args;
use crate::case::Case;
use crate::cli::estimate::DurationEstimate;
use crate::cli::ui::Ui;
use crate::error::{Error, Result};
use crate::output::animation::{self, animation};
use crate::output::results::Results;
use crate::output::shape::{self, Shape};
use crate::run::{Options, Run, run_with_progress};
use crate::scheme::Method;
use crate::study::accuracy::Accuracy;
use crate::study::truncation::{ChosenModes, Truncation};
use crate::study::verdict::{self, Verdict};
use serde_json::json;

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
    let results = args.open(&case, &[method], json!({ "verdict": !args.no_verdict }))?;
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
    let reduced = case.truncated.as_ref().filter(|_| verdict);
    let cost = if verdict { verdict::COST } else { 0.0 };
    let runs = 1.0 + cost;
    let shape = if args.request.place.no_report { Shape::default() } else { Shape::of(&case) };
    let estimate = DurationEstimate::of_run(&case.scene, &method, case.time.step).times(runs);
    let (run, refinement, truncation) = ui.with_estimate(&method.to_string(), estimate, |bar| -> Result<_> {
        let from = |before: f64, cost: f64| {
            let end = case.scene.duration;
            move |time: f64| bar.set_share((before + cost * time / end) / runs)
        };
        let mut run = run_with_progress(&shape.watched(&case), &method, &Options::new(case.time), &mut from(0.0, 1.0))?;
        let moved = shape.take(&mut run);
        if !shape.is_empty() {
            let time = run.trajectory.time();
            shape.write(&results.place(shape::FILE)?, time, &moved)?;
            let picture = shape.stations().and_then(|stations| animation(&case, &stations, time, &moved));
            if let Some(svg) = picture {
                results.write(animation::FILE, svg)?;
            }
        }
        // Side by side; the longer one moves the bar.
        let with_half_the_step = || Verdict::of(&case.scene, &method, &run, &case.time, &mut from(1.0, cost));
        let with_more_modes = || {
            let truncated = reduced?;
            Truncation::of(&truncated.whole, &truncated.reduction, &run, &method, &case.time, &mut |_| {}).transpose()
        };
        let (refinement, more_modes) = rayon::join(|| verdict.then(with_half_the_step), with_more_modes);
        Ok((run, refinement, more_modes))
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
