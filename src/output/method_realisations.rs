//! Several methods under the same realisations of random loads: their means, and their differences.

use super::csv::{self, digits};
use super::error_parts;
use super::realisations::{self, find, shown, with_interval};
use super::results::Results;
use super::table::Table;
use crate::error::Result;
use crate::scene::Scene;
use crate::study::compare::{MethodStudies, MethodStudy};
use crate::study::realisations::{Difference, Estimate, Measure, Realisations};
use serde_json::{Value, json};

/// Name of the file of the means.
pub const FILE: &str = "compare-realisations.csv";

/// Most places of the table in the terminal.
const MOST_PLACES: usize = 6;

/// Writes `realisations.csv`, the means, and `errors.csv` where errors are known, of all methods.
pub fn write(results: &mut Results, studies: &MethodStudies) -> Result<()> {
    let own = named(studies);
    realisations::write_methods(&results.place(realisations::FILE)?, &own)?;
    if has_errors(studies) {
        error_parts::write_methods(&results.place(error_parts::FILE)?, &own)?;
    }
    let (header, rows) = cells(studies);
    csv::table(&results.place(FILE)?, &header, rows.into_iter())
}

fn named(studies: &MethodStudies) -> Vec<(String, &Realisations)> {
    studies.methods.iter().map(|one| (one.method.clone(), &one.study)).collect()
}

fn has_errors(studies: &MethodStudies) -> bool {
    studies.methods.iter().any(|one| error_parts::has_any(&one.study))
}

/// The header and the rows of the means, one for each method, place and measure: the mean, the
/// deviation of one realisation and the half width of the interval of the mean, the same of the
/// difference from the reference, and how many realisations the judge refutes.
#[must_use]
pub fn cells(studies: &MethodStudies) -> (Vec<String>, Vec<Vec<String>>) {
    let of_mean = ["place", "kind", "measure", "unit", "mean", "standard_deviation", "half_width_95"];
    let of_difference = ["less", "difference", "difference_half_width_95", "refuted"];
    let header = ["method"].into_iter().chain(of_mean).chain(of_difference).map(str::to_owned).collect();
    let row = |one: &MethodStudy, mean: &Estimate| {
        let less = one.less(mean);
        let mut row = vec![one.method.clone(), mean.place.name.clone(), mean.place.kind.word().to_owned()];
        row.extend([mean.measure.name(), mean.unit].map(str::to_owned));
        row.extend([Some(mean.mean), mean.standard_deviation, mean.half_width_95].map(digits));
        row.push(less.map_or("", |_| studies.reference.as_str()).to_owned());
        row.extend([less.map(|less| less.mean), less.and_then(|less| less.half_width_95)].map(digits));
        row.push(one.study.refuted.len().to_string());
        row
    };
    let rows = studies.methods.iter().flat_map(|one| one.study.estimates.iter().map(move |mean| row(one, mean)));
    (header, rows.collect())
}

/// The studies as JSON, with the method that the differences are taken from.
#[must_use]
pub fn document(studies: &MethodStudies) -> Value {
    let one = |one: &MethodStudy| json!({ "method": one.method, "study": one.study, "differences": one.differences });
    json!({ "reference": studies.reference, "methods": studies.methods.iter().map(one).collect::<Vec<_>>() })
}

/// The table for the terminal: by place and quantity, the mean of each method and its difference
/// from the reference; `None` without walls.
#[must_use]
pub fn table(studies: &MethodStudies, scene: &Scene) -> Option<Table> {
    let MethodStudies { methods: studies, reference, .. } = studies;
    let first = &studies.first()?.study;
    let mut rows = Vec::new();
    for place in shown(first, scene, MOST_PLACES) {
        for measure in [Measure::ForceMean, Measure::ForceRms, Measure::WorkRate] {
            for one in studies {
                let Some(mean) = find(&one.study, place, measure) else { continue };
                let quantity = format!("{} ({})", measure.words(), mean.unit);
                let less = |less: &Difference| with_interval(less.mean, less.half_width_95);
                let less = one.less(mean).map_or_else(|| "-".to_owned(), less);
                let mean = with_interval(mean.mean, mean.half_width_95);
                let mut row = vec![place.name.clone(), quantity, one.method.clone(), mean];
                row.extend((studies.len() > 1).then_some(less));
                rows.push(row);
            }
        }
    }
    let less = format!("less {reference}");
    let header = ["place", "quantity", "method", "mean", &less];
    let header = if studies.len() > 1 { &header[..] } else { &header[..4] };
    (!rows.is_empty()).then(|| Table::new(header, rows))
}

/// The table of the errors for the terminal; `None` where none is known.
#[must_use]
pub fn error_table(studies: &MethodStudies, scene: &Scene) -> Option<Table> {
    error_parts::table_of_methods(&named(studies), scene)
}

/// The remarks below the tables, a sentence each.
#[must_use]
pub fn remarks(studies: &MethodStudies) -> Vec<String> {
    let count = studies.count;
    let mut remarks = vec![format!(
        "± is the half width of the 95 % interval of the mean over {count} realisations, by \
         Student's t; differences are between runs with the same seeds, and one within its ± is not distinguished \
         from none"
    )];
    remarks.extend(has_errors(studies).then(|| error_parts::REMARK_OF_METHODS.to_owned()));
    remarks.extend((count > 1).then(|| "all but the means and their errors is of realisation 1 alone".to_owned()));
    remarks.extend(warnings(studies));
    remarks.extend(studies.failures.iter().map(ToString::to_string));
    remarks
}

/// What makes means wrong, or leaves a part of their errors unknown, since the judge refutes runs.
#[must_use]
pub fn warnings(studies: &MethodStudies) -> Vec<String> {
    let MethodStudies { count, methods, .. } = studies;
    let refuted = methods.iter().filter(|one| !one.study.refuted.is_empty()).map(|one| {
        let refuted = one.study.refuted.len();
        format!("{}: {refuted} of {count} realisations are refuted: its means are wrong", one.method)
    });
    let unknown = methods.iter().flat_map(|one| {
        let checks = one.study.checks.iter().filter_map(error_parts::refuted);
        checks.map(|text| format!("{}: {text}", one.method))
    });
    refuted.chain(unknown).collect()
}
