//! The floors of a chart: how near penalties can come to rigid walls, and why no nearer.

use super::cheapest::percent;
use super::work_precision::{column, law_label};
use crate::error::amount;
use crate::study::work_precision::{Errors, Floor, Quantity, WorkPrecision};
use serde_json::{Value, json};

/// The floor of an error, if it is known: that of the motion between the springs themselves.
pub(super) fn of(floor: &Floor, quantity: Quantity) -> Option<f64> {
    quantity.of(floor.errors.as_ref()?).filter(|error| error.is_finite() && *error > 0.0)
}

/// The label of a floor in a picture.
pub(super) fn mark(floor: &Floor, error: f64) -> String {
    format!("{}: floor {}", law_label(floor.law), percent(error))
}

/// Why the error of a penalty does not vanish with the step; `None` where its floor is unknown.
fn reason(floor: &Floor) -> Option<String> {
    let errors: &Errors = floor.errors.as_ref().filter(|errors| errors.displacement > 0.0)?;
    Some(format!(
        "{}: with finer steps the error of the penalty tends to {} of the gap, not to 0: its walls give way and \
         have a restitution of their own, 1 without damping, and the exact motion between its springs is that far from \
         the one between rigid walls",
        law_label(floor.law),
        percent(errors.displacement)
    ))
}

/// What is known of the floors of `chart`, for the terminal.
pub(crate) fn sentences(chart: &WorkPrecision) -> Vec<String> {
    let sentence = |floor: &Floor| match (&floor.reference, reason(floor)) {
        (Ok(own), Some(reason)) => Some(format!(
            "{reason}; its own motion up to t = {} s: {}, known to {:.1e}",
            amount(floor.end, 4),
            own.how,
            own.uncertainty.displacement
        )),
        (Err(error), _) => Some(format!("{}: no motion of its own to compare with: {error}", law_label(floor.law))),
        _ => None,
    };
    chart.floors.iter().filter_map(sentence).collect()
}

/// The floors as JSON, for the page: place and label in each error, under the name of its column in
/// `work-precision.csv`.
pub(crate) fn rows(chart: &WorkPrecision) -> Value {
    let row = |floor: &Floor| {
        let shown = |error: Option<f64>| error.map(|at| json!({ "at": at, "label": mark(floor, at) }));
        let mut row = json!({
            "law": law_label(floor.law),
            "reason": reason(floor)?,
            "velocity_graph_error": shown(floor.errors.as_ref().map(|errors| errors.velocity)),
        });
        for quantity in Quantity::ALL {
            row[column(quantity)] = json!(shown(of(floor, quantity)));
        }
        Some(row)
    };
    chart.floors.iter().filter_map(row).collect()
}
