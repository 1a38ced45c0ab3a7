//! What is drawn of a scene: the structure, its walls and loads with where they are, from the
//! summary of a run.

use crate::output::ring::reach;
use serde_json::{Map, Value, json};

/// The drawing's data.
pub(super) fn scene(summary: &Value) -> Value {
    let case = &summary["case_file"];
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let kinds = ["oscillator", "chain", "bar", "beam", "matrices", "modal"];
    let system = kinds.into_iter().find(|kind| case["system"].get(kind).is_some()).unwrap_or("matrices");
    let walls: Vec<Value> = list(&summary["scene"]["walls"])
        .iter()
        .map(|wall| {
            json!({
                "name": wall["name"],
                "side": wall["side"],
                "position": wall["position_m"],
                "restitution": wall["law"]["restitution"],
                "at": drawn_at(in_keys(&wall["at"]), summary),
            })
        })
        .collect();
    let loads = list(&case["load"]).into_iter().filter(Value::is_object).map(|mut load| {
        load["at"] = drawn_at(place(&load), summary);
        load
    });
    let mut out = Map::new();
    out.insert("kind".to_owned(), json!(system));
    out.insert("planes".to_owned(), summary["scene"]["planes"].clone());
    out.insert("walls".to_owned(), json!(walls));
    let supports = list(&summary["scene"]["supports"]);
    let drawn = supports.iter().filter(|one| one["shape"] != "slider");
    out.insert("supports".to_owned(), drawn.map(|one| support(one, summary)).collect());
    out.insert("loads".to_owned(), loads.collect());
    out.insert("bodies".to_owned(), list(&case["body"]).iter().map(|one| body(one, summary)).collect());
    let of = &case["system"][system];
    for key in ["mass", "damping", "stiffness", "left", "right", "masses"] {
        out.insert(key.to_owned(), of[key].clone());
    }
    out.insert("ends".to_owned(), json!(ends(of, line(summary, &Value::Null))));
    Value::Object(out)
}

/// One of several bodies: its name, and of what lies along a line where it ends, and how it is held
/// there.
fn body(body: &Value, summary: &Value) -> Value {
    let of = ["bar", "beam"].map(|kind| &body[kind]).into_iter().find(|table| table.is_object());
    let of = of.unwrap_or(&Value::Null);
    let ends = ends(of, line(summary, &body["name"]));
    json!({ "name": body["name"], "ends": ends, "left": of["left"], "right": of["right"] })
}

/// Where a bar or beam begins and ends, m, after its own length or the sum of its spans; else where
/// the `line` of matrices or modes does.
fn ends(of: &Value, line: &[Value]) -> Option<[f64; 2]> {
    let spans = || of["spans"].as_array().map(|spans| spans.iter().filter_map(Value::as_f64).sum::<f64>());
    let along = || Some([line.first()?, line.last()?].map(|point| point["position_m"].as_f64().unwrap_or(0.0)));
    of["length"].as_f64().or_else(spans).map(|length| [0.0, length]).or_else(along)
}

/// The points of the line of a body, null for the one system; none where there is no line.
fn line<'a>(summary: &'a Value, body: &Value) -> &'a [Value] {
    let lines = summary["scene"]["lines"].as_array().map_or(&[][..], Vec::as_slice);
    let own = lines.iter().find(|line| line["body"] == *body);
    own.and_then(|line| line["points"].as_array()).map_or(&[], Vec::as_slice)
}

/// The place `at`, in keys of a case file, with the position in m where it is a point on a line.
pub(super) fn drawn_at(mut at: Value, summary: &Value) -> Value {
    let Some(map) = at.as_object_mut() else { return at };
    if let Some(other) = map.get_mut("relative_to") {
        *other = drawn_at(other.take(), summary);
    }
    let body = map.get("body").cloned().unwrap_or_default();
    let named = |key: &str| if key == "point" { "points".to_owned() } else { key.to_owned() };
    let sum = |key: &str, value: &Value| if key == "point" { json!([[value, 1.0]]) } else { value.clone() };
    let own = map.iter().filter(|(key, _)| !["body", "relative_to", "direction"].contains(&key.as_str()));
    let place: Value = own.map(|(key, value)| (named(key), sum(key, value))).collect::<Map<_, _>>().into();
    let point = line(summary, &body).iter().find(|point| in_keys(&point["at"]) == place);
    if let Some(point) = point {
        map.insert("position".to_owned(), point["position_m"].clone());
    }
    at
}

/// A support: where it is, its centre, and its outline, a circle or flats with their directions and
/// distances from the centre; and how far its drawing reaches, m.
fn support(support: &Value, summary: &Value) -> Value {
    let round = support["shape"] == "round";
    let numbers = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let gaps = if round { vec![support["gap_m"].clone()] } else { numbers(&support["gaps_m"]) };
    let largest = gaps.iter().filter_map(Value::as_f64).fold(0.0, f64::max);
    json!({
        "name": support["name"],
        "at": drawn_at(in_keys(&support["at"]), summary),
        "centre": support["centre_m"],
        "round": round,
        "gaps": gaps,
        "directions": numbers(&support["directions_deg"]),
        "reach": reach(largest, round),
    })
}

/// Where a load of a case file is, its direction with it.
fn place(entry: &Value) -> Value {
    let mut at = entry["at"].clone();
    if let (Some(map), Some(direction)) = (at.as_object_mut(), entry.get("direction")) {
        map.insert("direction".to_owned(), direction.clone());
    }
    at
}

/// A place of the scene in the keys of a case file.
pub(super) fn in_keys(at: &Value) -> Value {
    let Some(at) = at.as_object() else { return Value::Null };
    let key = |key: &str| key.trim_end_matches("_deg").trim_end_matches("_m").trim_start_matches("row_").to_owned();
    let value = |value: &Value| if value.is_object() { in_keys(value) } else { value.clone() };
    Value::Object(at.iter().map(|(name, found)| (key(name), value(found))).collect())
}

/// The period of the load, s, where one harmonic load drives the scene.
pub(super) fn period(summary: &Value) -> Option<f64> {
    let loads = summary["case_file"]["load"].as_array()?;
    let mut frequencies = loads.iter().filter_map(|load| load["harmonic"]["frequency"].as_f64()).filter(|f| *f > 0.0);
    let first = frequencies.next()?;
    frequencies.all(|f| f == first).then_some(1.0 / first)
}
