//! `run --accuracy` of a case with random loads: the step that keeps the error of its means.

use super::args::Args;
use super::checked::{CheckedRun, made};
use crate::case::Case;
use crate::cli::realisations::{self, StudyRequest, batch_with_bar, of_argument};
use crate::cli::ui::Ui;
use crate::error::{Error, Result};
use crate::study::realisations::{Batch, FoundStep, RealisationStudy};
use serde_json::json;

/// The first run at the step that keeps the error `share` of the means, with what was reached, and
/// the study at that step.
pub(super) fn studied(args: &Args, case: Case, share: f64, ui: &Ui) -> Result<(CheckedRun, RealisationStudy)> {
    let (run, found) = search(args, case, share, ui)?;
    let asked = StudyRequest { count: found.count, checked: found.pairs, known: found.known.clone() };
    let study = realisations::study(&run.case, (&run.run, &run.method), asked, "", ui)?;
    let (accuracy, shortfall) = found.judge(&study);
    Ok((CheckedRun { accuracy: Some(Ok(accuracy)), shortfall, ..run }, study))
}

/// The first run at the step that was found for the error `share` of the means, and what was found.
fn search(args: &Args, mut case: Case, share: f64, ui: &Ui) -> Result<(CheckedRun, FoundStep)> {
    if args.no_verdict {
        let expected =
            "no such argument beside --accuracy of a case with random loads: checks with half the step find it";
        return Err(Error::invalid("--no-verdict", "given", expected));
    }
    let (method, reason) = args.chosen(&case)?;
    let most = args.seeds.most_beside_accuracy(&case)?;
    let search = case.step_search(&method, share, most);
    search.validate().map_err(of_argument)?;
    let asked = json!({ "step_s": null, "accuracy": share, "most_seeds": most });
    let results = args.open(&case, &[method], asked)?;
    let mut make = |batch: &Batch<'_>| batch_with_bar(&case, &method, batch, ui);
    let found = search.find(&mut make, &mut |text| ui.message(text))?;
    case.time = found.time;
    Ok((made(args, case, (method, reason), results, false, ui)?, found))
}
