//! Several methods under the same realisations of random loads: their means, and their differences.

use super::csv::{self, digits};
use super::realisations::{find, shown, with_interval};
use super::table::Table;
use crate::error::Result;
use crate::scene::Scene;
use crate::study::realisations::{Difference, Estimate, Measure, Realisations};
use serde_json::{Value, json};
use std::path::Path;

/// Name of the file of the means.
pub const FILE: &str = "compare-realisations.csv";

/// Most places of the table in the terminal.
const MOST_PLACES: usize = 6;

/// One method under all realisations.
#[derive(Debug)]
pub struct MethodStudy {
    /// The method.
    pub method: String,
    /// Its realisations.
    pub study: Realisations,
    /// What it differs by from the reference; empty for the reference itself.
    pub differences: Vec<Difference>,
}

impl MethodStudy {
    /// What its mean differs by from that of the reference.
    fn less(&self, mean: &Estimate) -> Option<&Difference> {
        self.differences.iter().find(|less| less.place == mean.place && less.measure == mean.measure)
    }
}

/// Writes one row for each method, place and measure: the mean, the deviation of one realisation
/// and the half width of the interval of the mean, the same of the difference from `reference`, and
/// how many realisations the judge refutes.
pub fn write(path: &Path, studies: &[MethodStudy], reference: &str) -> Result<()> {
    let columns: [csv::Column<'_, (&MethodStudy, &Estimate)>; 12] = [
        ("method", &|(one, _)| one.method.clone()),
        ("place", &|(_, mean)| mean.place.name.clone()),
        ("kind", &|(_, mean)| mean.place.kind.word().to_owned()),
        ("measure", &|(_, mean)| mean.measure.words().replace(' ', "_")),
        ("unit", &|(_, mean)| mean.unit.to_owned()),
        ("mean", &|(_, mean)| digits(Some(mean.mean))),
        ("standard_deviation", &|(_, mean)| digits(mean.standard_deviation)),
        ("half_width_95", &|(_, mean)| digits(mean.half_width_95)),
        ("less", &|(one, mean)| one.less(mean).map_or("", |_| reference).to_owned()),
        ("difference", &|(one, mean)| digits(one.less(mean).map(|less| less.mean))),
        ("difference_half_width_95", &|(one, mean)| digits(one.less(mean).and_then(|less| less.half_width_95))),
        ("refuted", &|(one, _)| one.study.refuted.len().to_string()),
    ];
    csv::records(path, &columns, studies.iter().flat_map(|one| one.study.estimates.iter().map(move |mean| (one, mean))))
}

/// The studies as JSON, with the method that the differences are taken from.
#[must_use]
pub fn document(studies: &[MethodStudy], reference: &str) -> Value {
    let one = |one: &MethodStudy| json!({ "method": one.method, "study": one.study, "differences": one.differences });
    json!({ "reference": reference, "methods": studies.iter().map(one).collect::<Vec<_>>() })
}

/// The table for the terminal: by place and quantity, the mean of each method and its difference
/// from the reference; `None` without walls.
#[must_use]
pub fn table(studies: &[MethodStudy], reference: &str, scene: &Scene) -> Option<Table> {
    let first = &studies.first()?.study;
    let mut rows = Vec::new();
    for place in shown(first, scene, MOST_PLACES) {
        for measure in [Measure::MeanForce, Measure::RmsForce, Measure::WorkRate] {
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

/// The remark below the table.
#[must_use]
pub fn remark(count: u64) -> String {
    format!(
        "± is the half width of the 95 % interval of the mean over {count} realisations, by \
         Student's t; differences are between runs with the same seeds, and one within its ± is not distinguished \
         from none"
    )
}
