//! The request, as recorded beside its results: it shows whether a folder holds the results of this
//! request or of another one.

use super::manifest::FINGERPRINT;
use super::values::{VALUES, by_keys};
use crate::case::{Case, WearOptions, sha256};
use crate::scheme::{Method, Scheme};
use crate::study::realisations::RealisationCount;
use serde_json::{Map, Value, json};
use std::fmt::Debug;

/// The part of a request that is the law of wear.
const WEAR: &str = "wear";

/// The request of `command` for `methods` on `case`: times and settings as values, the rest of the
/// case (walls, loads and so on) as fingerprints. Titles and comments of a case file are left out.
#[must_use]
pub fn request(command: &str, case: &Case, methods: &[Method]) -> Map<String, Value> {
    let whole = case.unreduced();
    let integrator = |method: &Method| matches!(method.scheme, Scheme::Penalty { .. });
    let mut request = object(json!({
        "command": command,
        "case": case.name,
        "end_s": case.scene.duration,
        "step_s": case.time.step,
        "sample_s": case.time.sample,
        "statistics_from_s": case.time.statistics_from,
        "force_averaging_s": case.time.force_averaging,
        "sectors": case.time.sectors,
        "modes": case.truncated.as_ref().map(|truncated| truncated.reduction.modes.count()),
        "methods": methods.iter().map(ToString::to_string).collect::<Vec<_>>(),
    }));
    if let Some(statistics) = case.statistics {
        request.insert("rest_s".to_owned(), json!(statistics.rest));
        request.insert("spectra".to_owned(), json!(statistics.spectra));
    }
    if methods.is_empty() || methods.iter().any(integrator) {
        request.insert(format!("penalty{FINGERPRINT}"), fingerprint(&case.penalty));
    }
    let truncated =
        case.truncated.as_ref().map(|truncated| (&truncated.whole.damping, truncated.whole.static_correction));
    for (part, digest) in [
        ("system", fingerprint(&(&whole.system, truncated))),
        ("walls", fingerprint(&whole.walls)),
        ("supports", fingerprint(&whole.supports)),
        (WEAR, wear(case, case.wear)),
        ("loads", fingerprint(&whole.loads)),
        ("initial", fingerprint(&whole.initial)),
        ("probes", fingerprint(&whole.probes)),
    ] {
        request.insert(format!("{part}{FINGERPRINT}"), digest);
    }
    if !whole.output_times.is_empty() {
        request.insert("output_times_s".to_owned(), json!(whole.output_times));
    }
    if !case.sliders.is_empty() {
        request.insert(format!("sliders{FINGERPRINT}"), fingerprint(&case.sliders));
    }
    if !case.turbulence().is_empty() {
        request.insert(format!("turbulence{FINGERPRINT}"), fingerprint(&case.turbulence()));
    }
    request.insert(VALUES.to_owned(), Value::Object(by_keys(&case.document.json().unwrap_or_default())));
    request
}

/// The request `of` a study of wear without the limit, which changes no window of it.
#[must_use]
pub(super) fn without_limit(mut of: Map<String, Value>, case: &Case) -> Map<String, Value> {
    of.insert(format!("{WEAR}{FINGERPRINT}"), wear(case, WearOptions { limit: None, ..case.wear }));
    if let Some(values) = of.get_mut(VALUES).and_then(Value::as_object_mut) {
        values.remove("wear.limit");
    }
    of
}

/// The fingerprint of the law of wear of `case` with the time in service and the limit of `wear`.
fn wear(case: &Case, wear: WearOptions) -> Value {
    let supports: Vec<_> = case.written.supports.iter().map(|support| support.wear).collect();
    fingerprint(&(wear, supports))
}

/// This program with its version, where results of another version are those of another request.
pub(crate) fn program() -> String {
    format!("signorini {}", env!("CARGO_PKG_VERSION"))
}

/// A request with further keys.
#[must_use]
pub fn extended(mut request: Map<String, Value>, more: Value) -> Map<String, Value> {
    request.extend(object(more));
    request
}

/// What is recorded of as many realisations as an interval takes.
pub(crate) fn interval(count: RealisationCount) -> Value {
    let RealisationCount::Within { share, most, most_time } = count else { return json!({}) };
    let mut settings = json!({ "until_interval": share, "most_seeds": most });
    if let Some(limit) = most_time {
        settings["most_time_s"] = json!(limit.seconds());
    }
    settings
}

fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// A digest of the value's Debug form, which shows all digits of a float.
fn fingerprint(value: &dyn Debug) -> Value {
    json!(sha256(format!("{value:?}").as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_differ_where_their_numbers_do_and_not_in_their_titles() {
        let case = Case::embedded("rigid-walls-sine").unwrap();
        let method = [Method::new(Scheme::Event)];
        let own = request("run", &case, &method);
        let renamed = Case { title: Some("another title".to_owned()), ..case.clone() };
        assert_eq!(own, request("run", &renamed, &method));
        let moved = case.with("wall.upper.position", 5e-3 * (1.0 + f64::EPSILON)).unwrap();
        let other = request("run", &moved, &method);
        let differing: Vec<_> = own.keys().filter(|key| own[*key] != other[*key]).collect();
        assert_eq!(differing, ["walls_fingerprint", "values"]);
        assert_ne!(own, request("compare", &case, &method));
    }
}
