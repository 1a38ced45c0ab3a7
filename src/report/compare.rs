//! The page of a comparison: every method's motion, its distance from the exact one, and the table.

use super::column::{f32, f64};
use super::folder::{Cells, Folder};
use super::motion::{add_left_out, motion};
use super::older;
use super::run::{of_scene, tell_draw};
use crate::error::{Error, Result};
use crate::output::compare::{DISTANCE, folder_of};
use crate::output::method_realisations;
use crate::output::realisations;
use crate::study::compare::AGREEMENT;
use serde_json::{Value, json};

/// Stretches in each of which the largest distance is drawn.
const STRETCHES: usize = 600;
/// An error over the gap, up to the horizon, from which on a method begins switched off.
const FAR: f64 = 2.0;

/// The motions of the methods that succeeded, and the summary of the first of them.
pub(super) fn runs(folder: &Folder<'_>, table: &Cells) -> Result<(Vec<Value>, Value)> {
    let errors = table.column("error_over_gap")?;
    let mut runs = Vec::new();
    let mut first = None;
    for (row, error) in errors.iter().enumerate() {
        let method = table.text(row, "method");
        let prefix = folder_of(method);
        if !table.text(row, "failure").is_empty() {
            continue;
        }
        // The name comes from the table: it must not lead out of the folder.
        if method.is_empty() || prefix.contains(['/', '\\']) || prefix.starts_with('.') {
            let reason = format!("{method:?} is not the name of a method");
            return Err(Error::io(folder.path.join("compare.csv").display(), reason, true));
        }
        let summary = folder.json(&format!("{prefix}/summary.json"))?;
        let mut run = motion(folder, &prefix, &summary)?;
        run["label"] = json!(method);
        run["reference"] = json!(summary["scheme"] == "event");
        // Through Clarabel the motion is the same; a method far from the others would hide them.
        run["hidden"] = json!(method.contains("qp=clarabel") || *error > FAR);
        first.get_or_insert(summary);
        runs.push(run);
    }
    let none = || Error::io(folder.path.join("compare.csv").display(), "no method in it succeeded", true);
    Ok((runs, first.ok_or_else(none)?))
}

/// What the page of a comparison shows.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    let table = folder.cells("compare.csv")?;
    let (mut runs, summary) = runs(folder, &table)?;
    if runs.iter().all(|run| run["hidden"] == true) {
        runs.iter_mut().for_each(|run| run["hidden"] = json!(false));
    }
    let mut page = of_scene(&summary);
    let horizons = table.column("horizon_s")?;
    let horizon = horizons.into_iter().find(|t| t.is_finite());
    page["horizon"] = json!(horizon.filter(|t| *t < page["duration"].as_f64().unwrap_or(0.0) * (1.0 - 1e-9)));
    page["notes"] = folder.manifest["remarks"].clone();
    runs.iter_mut().for_each(|run| add_left_out(&mut page["notes"], run));
    page["runs"] = json!(runs);
    page["compare"] = json!({
        "table": table.for_page(None),
        "conclusion": folder.manifest["conclusion"],
        "agreement": AGREEMENT,
        "length": folder.manifest.get("error_length").and_then(Value::as_str).unwrap_or("gap"),
        "reference": older::reference(folder.manifest),
        "distance": if folder.has(DISTANCE) { distance(folder)? } else { Value::Null },
    });
    if folder.has(method_realisations::FILE) {
        page["compare"]["means"] = folder.cells(method_realisations::FILE)?.for_page(None);
        let draws = folder.cells(realisations::FILE)?.column("realisation")?.into_iter().fold(1.0, f64::max);
        page["compare"]["draws"] = json!(draws);
        tell_draw(&mut page, folder, draws as u64);
    }
    Ok(page)
}

/// The largest distance of each method in each stretch of the run.
fn distance(folder: &Folder<'_>) -> Result<Value> {
    let table = folder.numbers(DISTANCE)?;
    let stretch = table.count().div_ceil(STRETCHES).max(1);
    let Some((time, methods)) = table.columns.split_first() else { return Ok(Value::Null) };
    let middle: Vec<f64> = time.chunks(stretch).filter_map(|part| Some(0.5 * (part.first()? + part.last()?))).collect();
    // NaN, of a state that overflowed, is the largest.
    let largest = |part: &[f64]| part.iter().copied().fold(0.0, |a, b| if b > a || f64::is_nan(b) { b } else { a });
    let column = |values: &Vec<f64>| f32(values.chunks(stretch).map(largest));
    Ok(json!({
        "time": f64(&middle),
        "stretch": time.get(stretch).zip(time.first()).map(|(b, a)| b - a),
        "methods": methods.iter().map(column).collect::<Vec<_>>(),
        "names": table.header.get(1..),
    }))
}
