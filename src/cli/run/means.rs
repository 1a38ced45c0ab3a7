//! `run --accuracy` of means over realisations: the step that keeps their error.

use super::args::Args;
use super::checked::{CheckedRun, made};
use crate::case::Case;
use crate::cli::realisations::{self, StudyRequest, batch_with_bar, of_argument};
use crate::cli::ui::Ui;
use crate::error::{Error, Result};
use crate::output::run_folder::RunGoal;
use crate::study::realisations::{Batch, FoundStep, RealisationStudy};

/// The first run at the step that keeps the error `share` of the means, with what was reached, and
/// the study at that step. Of a case in which nothing is random the start scatters.
pub(super) fn studied(args: &Args, case: &Case, share: f64, ui: &Ui) -> Result<(CheckedRun, RealisationStudy)> {
    let scattered = case.with_scattered_start().map_err(of_argument)?;
    let start_scatter = (!case.is_random()).then(|| case.start_scatter());
    if let Some(scatter) = start_scatter {
        ui.message(&format!(
            "nothing is random here, so the velocities of the start scatter, another start for each realisation: \
             initial.scatter.velocity={scatter:e}, at a wall at most 1e-4 of the gap in a forcing period"
        ));
    }
    let (run, found) = search(args, scattered, share, ui)?;
    let asked = StudyRequest { count: found.count, checked: found.pairs, known: found.known.clone() };
    let study = realisations::study(&run.case, (&run.run, &run.method), asked, "", ui)?;
    let (mut accuracy, shortfall) = found.judge(&study);
    accuracy.start_scatter = start_scatter;
    Ok((CheckedRun { accuracy: Some(Ok(accuracy)), shortfall, ..run }, study))
}

/// The same of a motion that no step predicts beyond `until` (s), without having been asked for.
pub(super) fn of_chaos(
    args: &Args,
    (case, until): (&Case, f64),
    share: f64,
    ui: &Ui,
) -> Result<(CheckedRun, RealisationStudy)> {
    ui.message(&format!(
        "beyond about t = {until:.4e} s no step keeps an error of {share:e} of this motion: rounding alone grows to \
         it; so the error is that of the means, work rates and forces (with --of motion, of the motion up to then)"
    ));
    studied(args, case, share, ui)
}

/// The first run at the step that was found for the error `share` of the means, and what was found.
fn search(args: &Args, mut case: Case, share: f64, ui: &Ui) -> Result<(CheckedRun, FoundStep)> {
    if args.no_verdict {
        let expected =
            "no such argument beside --accuracy of means: checks with half the step find it (--of motion has none)";
        return Err(Error::invalid("--no-verdict", "given", expected));
    }
    let (method, reason) = args.chosen(&case)?;
    let most = args.seeds.most_beside_accuracy(&case)?;
    let search = case.step_search(&method, share, most);
    search.validate().map_err(of_argument)?;
    let goal = RunGoal::Means { accuracy: share, most_seeds: most };
    let results = args.open(&case, Some(&method), goal)?;
    let mut make = |batch: &Batch<'_>| batch_with_bar(&case, &method, batch, ui);
    let found = search.find(&mut make, &mut |text| ui.message(text))?;
    case.time = found.time;
    Ok((made(args, case, (method, reason), results, false, ui)?, found))
}
