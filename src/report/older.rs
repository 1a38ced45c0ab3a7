//! Folders that an older version wrote: what their files allow of what pages show today, and what
//! they lack, by name.

use serde_json::{Value, json};

/// Gives the walls of a run's `summary` their `largest_force` where an older version left that out:
/// of an elastic wall the largest force of its contacts, of a rigid one the largest mean over a
/// stretch. Returns a sentence that names the walls and supports of which the summary has neither.
pub(super) fn complete_forces(summary: &mut Value) -> Option<String> {
    let mut lacking = Vec::new();
    for wall in summary["statistics"]["walls"].as_array_mut().into_iter().flatten() {
        let force = &wall["force"];
        if wall.get("largest_force").is_some() || force.is_null() {
            continue;
        }
        let is_elastic = force["rms_averaged_over_s"].is_null();
        let peak = wall["episode_peak_force_n"]["max"].as_f64().filter(|_| is_elastic);
        let at_once = peak.map(|peak| json!({ "mean_n": peak, "averaged_over_s": 0.0 }));
        match at_once.or_else(|| force.get("largest").cloned()) {
            Some(largest) => wall["largest_force"] = largest,
            None => lacking.push(wall["wall"].to_string()),
        }
    }
    for support in summary["statistics"]["supports"].as_array().into_iter().flatten() {
        let force = &support["force"];
        if !force.is_null() && force.get("largest").is_none() {
            lacking.push(support["support"].to_string());
        }
    }
    (!lacking.is_empty()).then(|| {
        let names = lacking.join(", ");
        format!("summary.json has no largest force of {names}: an older version wrote it. The same run again has it")
    })
}

/// The histories that a study of wear followed; an older version wrote their number into the
/// request alone.
pub(super) fn histories(manifest: &Value) -> &Value {
    let stated = &manifest["histories"];
    if stated.is_null() { &manifest["request"]["histories"] } else { stated }
}

/// A sentence that names those of `columns` that the `header` of the table `file` does not have.
pub(super) fn without_columns(file: &str, header: &[String], columns: &[String]) -> Option<String> {
    let lacking: Vec<&str> = columns.iter().filter(|column| !header.contains(column)).map(String::as_str).collect();
    (!lacking.is_empty()).then(|| {
        format!("{file} has no {}: an older version wrote it. The same study again has it", lacking.join(", "))
    })
}
