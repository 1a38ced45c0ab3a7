//! `compare --seeds`: every method under the same realisations of the random loads.

use super::estimate::DurationEstimate;
use super::pipeline::Answer;
use super::ui::Ui;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::method_realisations::{self as output, MethodStudy};
use crate::output::realisations::{FILE, write_methods};
use crate::output::results::Results;
use crate::run::{Options, Run};
use crate::scheme::Method;
use crate::study::compare::Comparison;
use crate::study::realisations::{Difference, Realisation, Realisations, realisations};
use crate::time::{TimeGrid, TimeOptions};
use serde_json::Value;

/// The methods under all realisations.
pub struct Studies {
    count: u64,
    /// The method that differences are taken from: the exact one where it ran, else the first.
    reference: String,
    methods: Vec<MethodStudy>,
    /// What kept methods out of it, in sentences.
    failures: Vec<String>,
}

impl Studies {
    /// The studies of `count` realisations of `case` by each method of `comparison` that ran; its
    /// runs are the first realisation.
    pub fn of(case: &Case, comparison: &Comparison, count: u64, ui: &Ui) -> Result<Self> {
        // The steps and rows of the comparison.
        let grid = TimeGrid::stepping(case.scene.duration, &case.time)?;
        let options = Options::new(TimeOptions { sample: Some(grid.row_spacing()), ..case.time });
        let ran: Vec<(Method, &Run)> =
            comparison.rows.iter().filter_map(|row| Some((row.method, row.outcome.as_ref().ok()?))).collect();
        let methods: Vec<Method> = ran.iter().map(|(method, _)| *method).collect();
        let estimate = DurationEstimate::of_comparison(&case.scene, &methods, case.time.step);
        let estimate = estimate.on_all_cores((count - 1) as f64);
        let mut studies = Self { count, reference: String::new(), methods: Vec::new(), failures: Vec::new() };
        let scene = |number: u64| Ok(case.realisation(number)?.scene);
        ui.with_estimate("realisations", estimate, |bar| -> Result<()> {
            for (index, (method, run)) in ran.iter().enumerate() {
                let mut progress = |share: f64| bar.set_share((index as f64 + share) / ran.len() as f64);
                let mut members = vec![Realisation::of(1, run)];
                match realisations(2..=count, &scene, method, &options, &mut progress) {
                    Ok(others) => members.extend(others),
                    Err(Error::Stopped) => return Err(Error::Stopped),
                    Err(error) => {
                        let what = format!("{method} has no means: one of {count} realisations failed: {error}");
                        studies.failures.push(what);
                        continue;
                    }
                }
                let (method, study) = (method.to_string(), Realisations::new(members));
                studies.methods.push(MethodStudy { method, study, differences: Vec::new() });
            }
            Ok(())
        })?;
        studies.compare(&ran);
        for one in &studies.methods {
            for member in one.study.members.iter().skip(1) {
                ui.refute(&format!("{}, realisation {}", one.method, member.number), &member.findings);
            }
        }
        Ok(studies)
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

    /// Writes `realisations.csv`, and the means.
    pub fn write(&self, results: &mut Results) -> Result<()> {
        let studies: Vec<(String, &Realisations)> =
            self.methods.iter().map(|one| (one.method.clone(), &one.study)).collect();
        write_methods(&results.place(FILE)?, &studies)?;
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
        let above = (self.count > 1).then(|| "what stands above is of realisation 1 alone".to_owned());
        let refuted = self.methods.iter().filter(|one| !one.study.refuted.is_empty()).map(|one| {
            let count = one.study.refuted.len();
            format!("{}: {count} of {} realisations are refuted: its means are wrong", one.method, self.count)
        });
        let failures = self.failures.iter().cloned();
        answer.messages([output::remark(self.count)].into_iter().chain(above).chain(refuted).chain(failures));
    }
}
