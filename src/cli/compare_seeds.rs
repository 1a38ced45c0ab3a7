//! `compare --seeds`: every method under the same realisations of the random loads.

use super::pipeline::Answer;
use super::realisations::{self, StudyRequest};
use super::ui::Ui;
use crate::case::Case;
use crate::error::Result;
use crate::output::error_parts;
use crate::output::method_realisations as output;
use crate::study::compare::{Comparison, MethodStudies};
use crate::study::realisations::RealisationCount;

/// The studies of `count` realisations of `case` by each method of `comparison` that ran, with
/// `verdict` also the errors of their means.
pub fn studies(case: &Case, comparison: &Comparison, count: u64, verdict: bool, ui: &Ui) -> Result<MethodStudies> {
    MethodStudies::of(comparison, count, &mut |run, method| {
        let asked = StudyRequest::new(RealisationCount::Exactly(count), verdict);
        realisations::study(case, (run, method), asked, &format!("{method}, "), ui)
    })
}

/// The checks that failed, in words.
pub fn unchecked(studies: &MethodStudies) -> impl Iterator<Item = String> {
    let failures = studies.failures.iter();
    failures.filter_map(|failure| Some(format!("{} of {}", failure.refined?, failure.method)))
}

/// Shows the tables of the studies and the remarks on them.
pub fn show(studies: &MethodStudies, answer: &mut Answer, case: &Case) {
    if let Some(table) = output::table(studies, &case.scene) {
        answer.table(table, output::FILE);
    }
    if let Some(table) = output::error_table(studies, &case.scene) {
        answer.table(table, error_parts::FILE);
    }
    answer.messages(output::remarks(studies));
}
