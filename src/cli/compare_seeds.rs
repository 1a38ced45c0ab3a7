//! `compare --seeds`: every method under the same realisations of the random loads.

use super::pipeline::Answer;
use super::realisations::{self, StudyRequest};
use super::ui::Ui;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::error_parts;
use crate::output::method_realisations::{self as output, MethodStudy};
use crate::output::realisations::{FILE, write_methods};
use crate::output::results::Results;
use crate::run::Run;
use crate::scheme::Method;
use crate::study::compare::Comparison;
use crate::study::realisations::{Difference, RealisationCount, RealisationStudy, Realisations};
use serde_json::Value;

/// The methods under all realisations.
pub struct Studies {
    count: u64,
    /// The method that differences are taken from: the exact one where it ran, else the first.
    reference: String,
    methods: Vec<MethodStudy>,
    /// What kept methods or parts of errors out of it, in sentences.
    failures: Vec<String>,
    /// The checks that failed.
    unchecked: Vec<String>,
}

impl Studies {
    /// The studies of `count` realisations of `case` by each method of `comparison` that ran, with
    /// `verdict` also the errors of their means; its runs are the first realisation.
    pub fn of(case: &Case, comparison: &Comparison, count: u64, verdict: bool, ui: &Ui) -> Result<Self> {
        let ran: Vec<(Method, &Run)> =
            comparison.rows.iter().filter_map(|row| Some((row.method, row.outcome.as_ref().ok()?))).collect();
        let mut studies =
            Self { count, reference: String::new(), methods: Vec::new(), failures: Vec::new(), unchecked: Vec::new() };
        let count = RealisationCount::Exactly(count);
        for (method, run) in &ran {
            match realisations::study(
                case,
                (run, method),
                StudyRequest::new(count, verdict),
                &format!("{method}, "),
                ui,
            ) {
                Ok(study) => studies.add(method.to_string(), study),
                Err(Error::Stopped) => return Err(Error::Stopped),
                Err(error) => {
                    let all = studies.count;
                    studies.failures.push(format!("{method} has no means: one of {all} realisations failed: {error}"));
                }
            }
        }
        studies.compare(&ran);
        Ok(studies)
    }

    /// Adds the study of `method`.
    fn add(&mut self, method: String, study: RealisationStudy) {
        let failed = study.failures.iter();
        self.unchecked.extend(failed.clone().map(|failed| format!("{} of {method}", failed.refined)));
        self.failures.extend(failed.map(|failed| {
            format!("the check of the means of {method} with {} failed: {}", failed.refined, failed.error)
        }));
        self.methods.push(MethodStudy { method, study: study.realisations, differences: Vec::new() });
    }

    /// The checks that failed, in words.
    pub fn unchecked(&self) -> impl Iterator<Item = String> {
        self.unchecked.iter().cloned()
    }

    /// Fills in the differences from the exact method, or else from the first.
    fn compare(&mut self, ran: &[(Method, &Run)]) {
        let exact = ran.iter().find(|(method, _)| method.scheme.is_exact()).map(|(method, _)| method.to_string());
        let at = |name: &String| self.methods.iter().position(|one| one.method == *name);
        let Some(reference) = exact.as_ref().and_then(at).or((!self.methods.is_empty()).then_some(0)) else { return };
        let differences = |(index, one): (usize, &MethodStudy)| match self.methods.get(reference) {
            Some(other) if index != reference => Difference::all(&one.study, &other.study),
            _ => Vec::new(),
        };
        let all: Vec<Vec<Difference>> = self.methods.iter().enumerate().map(differences).collect();
        self.reference = self.methods.get(reference).map_or_else(String::new, |one| one.method.clone());
        self.methods.iter_mut().zip(all).for_each(|(one, differences)| one.differences = differences);
    }

    fn named(&self) -> Vec<(String, &Realisations)> {
        self.methods.iter().map(|one| (one.method.clone(), &one.study)).collect()
    }

    fn has_errors(&self) -> bool {
        self.methods.iter().any(|one| error_parts::has_any(&one.study))
    }

    /// Writes `realisations.csv`, the means, and `errors.csv` where errors are known.
    pub fn write(&self, results: &mut Results) -> Result<()> {
        let studies = self.named();
        write_methods(&results.place(FILE)?, &studies)?;
        if self.has_errors() {
            error_parts::write_methods(&results.place(error_parts::FILE)?, &studies)?;
        }
        output::write(&results.place(output::FILE)?, &self.methods, &self.reference)
    }

    /// The studies as JSON.
    pub fn document(&self) -> Value {
        output::document(&self.methods, &self.reference)
    }

    /// Shows their table and the remarks on it.
    pub fn show(&self, answer: &mut Answer, case: &Case) {
        if let Some(table) = output::table(&self.methods, &self.reference, &case.scene) {
            answer.table(table, output::FILE);
        }
        if let Some(table) = error_parts::table_of_methods(&self.named(), &case.scene) {
            answer.table(table, error_parts::FILE);
        }
        let errors = self.has_errors().then(|| error_parts::REMARK_OF_METHODS.to_owned());
        let unknown = self.methods.iter().flat_map(|one| {
            let checks = one.study.checks.iter().filter_map(error_parts::refuted);
            checks.map(|text| format!("{}: {text}", one.method))
        });
        let above = (self.count > 1).then(|| "all but the means and their errors is of realisation 1 alone".to_owned());
        let refuted = self.methods.iter().filter(|one| !one.study.refuted.is_empty()).map(|one| {
            let count = one.study.refuted.len();
            format!("{}: {count} of {} realisations are refuted: its means are wrong", one.method, self.count)
        });
        let failures = self.failures.iter().cloned();
        answer.messages(
            [output::remark(self.count)]
                .into_iter()
                .chain(errors)
                .chain(above)
                .chain(refuted)
                .chain(unknown)
                .chain(failures),
        );
    }
}
