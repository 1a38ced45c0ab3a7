//! The floors of a chart: how near penalties can come to rigid walls, and why no nearer.

use super::cheapest::{percent, whole};
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

/// Why the error of a penalty, `share` of something, does not vanish with the step.
fn reason(floor: &Floor, share: &str) -> String {
    format!(
        "{}: with finer steps the error of the penalty tends to {share}, not to 0: its walls give way and have a \
         restitution of their own, 1 without damping, and the exact motion between its springs is that far from the \
         one between rigid walls",
        law_label(floor.law)
    )
}

/// A floor in words.
fn share(quantity: Quantity, error: f64) -> String {
    format!("{} of the {}", percent(error), whole(quantity))
}

/// What is known of the floors of `chart`, for the terminal.
pub(crate) fn sentences(chart: &WorkPrecision) -> Vec<String> {
    let sentence = |floor: &Floor| match (&floor.reference, of(floor, Quantity::Displacement)) {
        (Ok(own), Some(error)) => Some(format!(
            "{}; its own motion up to t = {} s: {}, known to {:.1e}",
            reason(floor, &share(Quantity::Displacement, error)),
            amount(floor.end, 4),
            own.how,
            own.uncertainty.displacement
        )),
        (Err(error), _) => Some(format!("{}: no motion of its own to compare with: {error}", law_label(floor.law))),
        _ => None,
    };
    chart.floors.iter().filter_map(sentence).collect()
}

/// The floors as JSON, for the page: place, label and reason in each error, under the name of its
/// column in `work-precision.csv`.
pub(crate) fn rows(chart: &WorkPrecision) -> Value {
    let row = |floor: &Floor| {
        let shown =
            |at: f64, share: &str| json!({ "at": at, "label": mark(floor, at), "reason": reason(floor, share) });
        // One without a displacement of its own has no floor.
        let errors: &Errors = floor.errors.as_ref().filter(|errors| errors.displacement > 0.0)?;
        let mut row = json!({
            "law": law_label(floor.law),
            "velocity_graph_error": shown(errors.velocity, &percent(errors.velocity)),
        });
        for quantity in Quantity::ALL {
            row[column(quantity)] = of(floor, quantity).map(|at| shown(at, &share(quantity, at))).into();
        }
        Some(row)
    };
    chart.floors.iter().filter_map(row).collect()
}
