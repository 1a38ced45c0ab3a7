//! `run --accuracy`: scheme, step and modes that keep an error.

use super::args::Args;
use super::checked::CheckedRun;
use crate::case::Case;
use crate::cli::estimate::DurationEstimate;
use crate::cli::ui::Ui;
use crate::error::Result;
use crate::output::run_folder::RunGoal;
use crate::scheme::Method;
use crate::study::accuracy::{Outcome, Target, foresee, most_steps, reach};
use crate::study::choice;
use crate::study::truncation::{ChosenModes, choose_modes};

/// What a search for an accuracy came to.
pub(super) enum Searched {
    /// The run that keeps it, or falls short of it.
    Motion(Box<CheckedRun>),
    /// Nothing yet: no step predicts the motion of this case beyond this time (s), and the error
    /// may be one of means.
    Unpredictable(Box<Case>, f64),
}

/// A run that keeps the error asked for; what it falls short of is part of the outcome. Where it
/// may be an error of means instead, and the motion cannot be predicted to its end, the search ends
/// with that.
pub(super) fn search(args: &Args, case: Case, tolerance: f64, ui: &Ui) -> Result<Searched> {
    let method = args.scheme.as_ref().map(|name| args.request.method(name, &case)).transpose()?;
    if let Some(method) = method {
        args.request.check_use(&[method])?;
    }
    let target = Target { method, ..Target::new(tolerance, case.time) };
    target.validate()?;
    let most = most_steps(&case.scene, target.most_steps);
    let estimate = DurationEstimate::of_search(&case.scene, method, case.time.step, most);
    let searched = ui.with_estimate("", estimate, |_| -> Result<_> {
        let foreseen = foresee(&case.scene, &target).ok().flatten();
        if let Some(until) = foreseen.filter(|_| may_judge_means(args, &case, method.as_ref())) {
            return Ok(Err((case, until)));
        }
        // A limit of realisations, where there are none.
        args.seeds.check(&case)?;
        let results = args.open(&case, method.as_ref(), RunGoal::Motion { accuracy: tolerance })?;
        let (case, modes) = enough_modes(case, &target, foreseen, ui)?;
        let target = Target { most_steps: most_steps(&case.scene, target.most_steps), ..target };
        let end = case.scene.duration;
        let outcome =
            ui.with_bar("refining", |bar| reach(&case.scene, &target, &mut |time| bar.set_share(time / end)))?;
        Ok(Ok((case, results, modes, outcome)))
    })?;
    let (case, results, modes, outcome) = match searched {
        Ok(found) => found,
        Err((case, until)) => return Ok(Searched::Unpredictable(Box::new(case), until)),
    };
    let Outcome { method, reason, run, accuracy, shortfall } = outcome;
    ui.refute(&method.to_string(), &run.findings);
    let shortfall = shortfall.or(modes.as_ref().and_then(ChosenModes::shortfall));
    let (modes, accuracy) = (modes.map(Ok), Some(Ok(accuracy)));
    let (refinement, truncation) = (None, None);
    let run = CheckedRun { case, results, method, reason, run, refinement, truncation, modes, accuracy, shortfall };
    Ok(Searched::Motion(Box::new(run)))
}

/// Whether the error asked for may be one of means: none is named, there are means, and the
/// `method` that is named, if any is, has a step to find.
fn may_judge_means(args: &Args, case: &Case, method: Option<&Method>) -> bool {
    args.of.is_none() && !case.scene.walls.is_empty() && method.is_none_or(|method| !method.scheme.is_exact())
}

/// The case with as many modes as `target` takes, and how their number was found; unchanged where
/// it is not reduced to modes, and where the error can be kept until `foreseen` (s) only, which
/// this says before the search, which may take minutes.
fn enough_modes(case: Case, target: &Target, foreseen: Option<f64>, ui: &Ui) -> Result<(Case, Option<ChosenModes>)> {
    if let Some(until) = foreseen {
        ui.message(&format!(
            "beyond about t = {until:.4e} s no step keeps an error of {:e}: rounding alone grows to it; so scheme \
             and step are found for the time up to then at most",
            target.tolerance
        ));
    }
    let Some(truncated) = &case.truncated else { return Ok((case, None)) };
    let start = truncated.reduction.modes.count();
    if foreseen.is_some() {
        // The error cannot be kept with any number of modes, and runs that separated by chance
        // cannot be compared.
        ui.message(&format!("so the {start} modes of the case are kept, and no more are tried"));
        return Ok((case, None));
    }
    let method = target.method.unwrap_or_else(|| choice::choose(&case.scene).method);
    let end = case.scene.duration;
    let chosen = ui.with_bar("modes", |bar| {
        let mut progress = |time| bar.set_share(time / end);
        choose_modes(&truncated.whole, start, &method, &case.time, target.tolerance, &mut progress)
    })?;
    let planes = case.planes.modes();
    Ok((case.with("system.modes", (chosen.modes / planes) as i64)?, Some(chosen)))
}
