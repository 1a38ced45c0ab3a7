//! Folders that an older version wrote: what their files allow of what pages show today, and what
//! they lack, by name.

use crate::output::work_precision::column;
use crate::study::work_precision::Quantity;
use serde_json::{Value, json};

/// What is said of a stability study without the list of largest stable steps.
pub(super) const WITHOUT_STABLE_STEPS: &str = "the largest stable step of each scheme is missing: an \
     older version wrote this folder. The same study again has it";

/// Names that columns, keys and measures had before, and what they are now.
const RENAMED: [(&str, &str); 13] = [
    ("mean_force", "force_mean"),
    ("mean_force_y", "force_mean_y"),
    ("mean_force_z", "force_mean_z"),
    ("mean_force_along_y", "force_mean_y"),
    ("mean_force_along_z", "force_mean_z"),
    ("rms_force", "force_rms"),
    ("RMS_force", "force_rms"),
    ("largest_force", "force_largest"),
    ("mean_force_N", "force_mean_N"),
    ("mean_force_along_y_N", "force_mean_y_N"),
    ("mean_force_along_z_N", "force_mean_z_N"),
    ("RMS_force_N", "force_rms_N"),
    ("largest_force_N", "force_largest_N"),
];

/// The name of today of a column, a key or a measure.
pub(super) fn renamed(name: &str) -> &str {
    RENAMED.iter().find(|(before, _)| *before == name).map_or(name, |(_, now)| now)
}

/// Gives what a document tells of forces the names of today.
pub(super) fn rename(document: &mut Value) {
    match document {
        Value::Array(items) => items.iter_mut().for_each(rename),
        Value::Object(map) => {
            if let Some(Value::String(measure)) = map.get_mut("measure") {
                *measure = renamed(measure).to_owned();
            }
            if let Some(largest) = map.remove("largest_force") {
                map.insert("force_largest".to_owned(), largest);
            }
            map.values_mut().for_each(rename);
        }
        _ => {}
    }
}

/// What the `manifest` of a chart says of each error, by its column; that of an older version says
/// it of the displacement alone.
pub(super) fn conclusions(manifest: &Value) -> Value {
    match &manifest["conclusions"] {
        Value::Null => json!({ column(Quantity::Displacement): manifest["conclusion"] }),
        said => said.clone(),
    }
}

/// Gives the walls and supports of a run's `summary` their `force_largest` where an older version
/// left that out: of an elastic wall the largest force of its contacts, of a rigid one and of a
/// support the largest mean over a stretch. Returns a sentence that names the walls and supports of
/// which the summary has neither.
pub(super) fn complete_forces(summary: &mut Value) -> Option<String> {
    let mut lacking = Vec::new();
    let walls = summary.pointer_mut("/statistics/walls").and_then(Value::as_array_mut);
    for wall in walls.into_iter().flatten() {
        let force = &wall["force"];
        if wall.get("force_largest").is_some() || force.is_null() {
            continue;
        }
        let is_elastic = force["rms_averaged_over_s"].is_null();
        let peak = wall["episode_peak_force_n"]["max"].as_f64().filter(|_| is_elastic);
        let at_once = peak.map(|peak| json!({ "mean_n": peak, "averaged_over_s": 0.0 }));
        match at_once.or_else(|| force.get("largest").cloned()) {
            Some(largest) => wall["force_largest"] = largest,
            None => lacking.push(wall["wall"].to_string()),
        }
    }
    let supports = summary.pointer_mut("/statistics/supports").and_then(Value::as_array_mut);
    for support in supports.into_iter().flatten() {
        let force = &support["force"];
        if support.get("force_largest").is_some() || force.is_null() {
            continue;
        }
        match force.get("largest").cloned() {
            Some(largest) => support["force_largest"] = largest,
            None => lacking.push(support["support"].to_string()),
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

/// What the errors of a comparison are against, in words; `None` where there is no reference. An
/// older version wrote it into a remark alone.
pub(super) fn reference(manifest: &Value) -> Option<&str> {
    if let Some(stated) = manifest.get("reference") {
        return stated.as_str();
    }
    let mut remarks = manifest["remarks"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let told = remarks.find_map(|remark| {
        let none = remark.starts_with("no reference: ").then_some(None);
        none.or_else(|| remark.strip_prefix("no exact motion: errors are against ").map(Some))
    });
    told.unwrap_or(Some("the exact motion"))
}

/// A sentence that names those of `columns` that the `header` of the table `file` does not have.
pub(super) fn without_columns(file: &str, header: &[String], columns: &[String]) -> Option<String> {
    let lacking: Vec<&str> = columns.iter().filter(|column| !header.contains(column)).map(String::as_str).collect();
    (!lacking.is_empty()).then(|| {
        format!("{file} has no {}: an older version wrote it. The same study again has it", lacking.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::{complete_forces, reference};
    use serde_json::json;

    #[test]
    fn a_summary_of_another_shape_lacks_nothing_by_name() {
        let walls = json!({ "statistics": { "walls": [3, [], { "force": [] }], "supports": 3 } });
        for mut summary in [json!([]), json!(3), json!({ "statistics": 3 }), json!({ "statistics": [] })] {
            assert_eq!(complete_forces(&mut summary), None);
        }
        let lacking = complete_forces(&mut walls.clone()).unwrap();
        assert!(lacking.starts_with("summary.json has no largest force of null"), "{lacking}");
    }

    #[test]
    fn the_reference_of_an_older_comparison_is_read_from_its_remarks() {
        let of = |remark: &str| reference(&json!({ "remarks": ["chaos", remark] })).map(str::to_owned);
        assert_eq!(of("not chaotic").as_deref(), Some("the exact motion"));
        assert_eq!(of("no exact motion: errors are against event").as_deref(), Some("event"));
        assert_eq!(of("no reference: it failed"), None);
        assert_eq!(reference(&json!({ "reference": null, "remarks": ["chaos"] })), None);
    }
}
