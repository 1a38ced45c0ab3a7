//! The values of a case by their keys, recorded beside a request: they name what differs between
//! two requests where a fingerprint shows only that something does.

use serde_json::{Map, Value};

/// The key of a request that holds them. It decides nothing: two requests that differ in it alone
/// are the same.
pub(super) const VALUES: &str = "values";

/// Most numbers of a list that is kept.
const MOST_NUMBERS: usize = 8;

/// Most values that are named.
const MOST_NAMED: usize = 12;

/// The values of `case_file`, a case in the keys of a case file, by their keys as `--set` takes
/// them. Long lists, such as the rows of a table, are left out.
pub(super) fn by_keys(case_file: &Value) -> Map<String, Value> {
    let mut values = Map::new();
    for (part, value) in case_file.as_object().into_iter().flatten() {
        // The title and the times are no part of a fingerprint.
        if !["title", "source", "time"].contains(&part.as_str()) {
            add(&mut values, part, value);
        }
    }
    values
}

fn add(values: &mut Map<String, Value>, key: &str, value: &Value) {
    match value {
        Value::Object(map) => map.iter().for_each(|(name, value)| add(values, &format!("{key}.{name}"), value)),
        Value::Array(list) if list.iter().any(Value::is_object) => {
            for (index, entry) in list.iter().enumerate() {
                let name = entry["name"].as_str().map_or_else(|| (index + 1).to_string(), str::to_owned);
                add(values, &format!("{key}.{name}"), entry);
            }
        }
        Value::Array(list) if list.len() > MOST_NUMBERS => {}
        value => drop(values.insert(key.to_owned(), value.clone())),
    }
}

/// The part of a request to which a key of a case belongs.
fn belongs(key: &str, part: &str) -> bool {
    let table = key.split('.').next().unwrap_or_default();
    match part {
        "system" => table == "system",
        "walls" => table == "wall" || table == "support" || table == "slider",
        "supports" => table == "support" || table == "slider",
        "sliders" => table == "slider",
        "wear" => table == "wear" || table == "support",
        // A slider is pressed by a load.
        "loads" => table == "load" || table == "slider",
        "turbulence" => table == "turbulence",
        "initial" => table == "initial",
        "probes" => table == "probe",
        "penalty" => table == "penalty",
        // The whole text of a case.
        _ => true,
    }
}

/// The values of the parts `parts` that differ between the requests `there` and `asked`, a line
/// each, and the parts in which none is known to differ.
pub(super) fn differing<'a>(
    parts: &[&'a str],
    there: &Map<String, Value>,
    asked: &Map<String, Value>,
) -> (Vec<String>, Vec<&'a str>) {
    let empty = Map::new();
    let [before, now] = [there, asked].map(|request| request.get(VALUES).and_then(Value::as_object).unwrap_or(&empty));
    let keys = before.keys().chain(now.keys().filter(|key| !before.contains_key(*key)));
    let of_parts = |key: &&String| parts.iter().any(|part| belongs(key, part));
    // Where one of the requests was recorded without values, all of the other's would differ.
    let known = !before.is_empty() && !now.is_empty();
    let differing: Vec<&String> =
        keys.filter(|key| known && before.get(*key) != now.get(*key)).filter(of_parts).collect();
    let line = |key: &&String| format!("{key}: {} there, {} asked", shown(before.get(*key)), shown(now.get(*key)));
    let mut lines: Vec<String> = differing.iter().take(MOST_NAMED).map(line).collect();
    if differing.len() > MOST_NAMED {
        lines.push(format!("and {} values more", differing.len() - MOST_NAMED));
    }
    let unnamed = parts.iter().filter(|part| !differing.iter().any(|key| belongs(key, part)));
    (lines, unnamed.copied().collect())
}

/// A value as a case file has it.
pub(super) fn shown(value: Option<&Value>) -> String {
    match value {
        None => "left out".to_owned(),
        Some(Value::Null) => "none".to_owned(),
        Some(Value::String(text)) => text.clone(),
        Some(Value::Number(number)) => match number.as_f64().filter(|_| number.is_f64()) {
            Some(x) if x != 0.0 && !(1e-3..1e6).contains(&x.abs()) => format!("{x:e}"),
            Some(x) => x.to_string(),
            None => number.to_string(),
        },
        Some(value) => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn request(gap: f64) -> Map<String, Value> {
        let file = json!({
            "title": format!("a gap of {gap}"),
            "support": [{ "name": "plate-1", "gap": gap, "directions": [0.0, 90.0] }],
            "load": [{ "harmonic": { "amplitude": 3.0 } }, { "table": { "rows": vec![0.0; 100] } }],
        });
        let values = Value::Object(by_keys(&file));
        json!({ VALUES: values }).as_object().cloned().unwrap_or_default()
    }

    #[test]
    fn values_that_differ_are_named_by_their_keys_and_other_parts_are_left() {
        let (there, asked) = (request(2e-4), request(3e-4));
        let (lines, unnamed) = differing(&["walls", "supports", "loads"], &there, &asked);
        assert_eq!(lines, ["support.plate-1.gap: 2e-4 there, 3e-4 asked"]);
        assert_eq!(unnamed, ["loads"], "a table of other rows has no value by which to name it");
        let (lines, unnamed) = differing(&["walls"], &Map::new(), &asked);
        assert!(lines.is_empty() && unnamed == ["walls"], "recorded by an older version: {lines:?}");
        assert_eq!(there[VALUES]["load.1.harmonic.amplitude"], 3.0);
    }
}
