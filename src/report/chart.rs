//! The page of a chart: accuracy against speed.

use super::folder::Folder;
use super::older;
use super::run::case_text;
use crate::error::Result;
use crate::output::work_precision::{column, label};
use crate::scheme::Method;
use crate::study::work_precision::Quantity;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The columns that the page draws or shows as text.
const SHOWN: [&str; 12] = [
    "method",
    "step_s",
    "seconds",
    "on_front",
    "displacement_error_over_gap",
    "velocity_graph_error",
    "impulse_error_of_the_worst_wall",
    "contact_time_error",
    "own_displacement_error_over_gap",
    "contacts_missing",
    "contacts_spurious",
    "remark",
];

/// The columns of a point of the picture.
pub(super) const NUMBERS: [&str; 2] = ["seconds", "displacement_error_over_gap"];

/// The short name of a method.
pub(super) fn short(method: &str) -> String {
    method.parse::<Method>().map_or_else(|_| method.to_owned(), |method| label(&method))
}

/// What the page of a chart shows.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    let table = folder.cells("work-precision.csv")?;
    // What is drawn must be numbers.
    for name in NUMBERS {
        table.column(name)?;
    }
    let told = |key: &str| &folder.manifest[key];
    Ok(json!({
        "subtitle": "accuracy against speed",
        "chart": {
            "table": table.for_page(Some(&SHOWN)),
            "labels": (0..table.rows.len()).map(|row| short(table.text(row, "method"))).collect::<Vec<_>>(),
            "conclusions": older::conclusions(folder.manifest),
            "cheapest": told("cheapest"),
            "names": BTreeMap::from(Quantity::ALL.map(|quantity| (column(quantity), quantity.name()))),
            "floors": told("floors"),
            "orders": told("orders"),
            "programs": told("other_programs"),
            "compared": told("compared"),
        },
        "case": case_text(told("case_file")),
        "notes": told("remarks"),
    }))
}
