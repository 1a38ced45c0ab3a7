//! `request.json`: what was asked, when it was done, which files belong to it, and what is recorded
//! of its tables and documents.

use super::atomic::{sync_folder, write_whole};
use super::lock::Lock;
use super::values::{VALUES, differing, shown};
use crate::case::read_text;
use crate::error::{Error, Result};
use serde_json::{Map, Value, json};
use std::path::Path;

/// The file that describes the contents of a folder.
pub(crate) const MANIFEST: &str = "request.json";

/// Largest manifest that is read, bytes.
const MOST_BYTES: u64 = 1 << 24;

/// The key that says that the files of the manifest are not all there yet.
pub(super) const UNFINISHED: &str = "unfinished";

/// Files that results consist of: a folder with one of them but no manifest holds results of an
/// unknown request.
const RESULTS: [&str; 10] = [
    "summary.json",
    "trajectory.csv",
    "compare.csv",
    "work-precision.csv",
    "stability.csv",
    "impact-map.csv",
    "sweep.csv",
    "orbit.json",
    "branches.csv",
    "report.html",
];

/// The name of a file of unknown results in `folder`, if there is one.
pub(super) fn unknown_results(folder: &Path) -> Option<&'static str> {
    RESULTS.into_iter().find(|name| folder.join(name).exists())
}

/// Checks that `folder` holds no results of another request than `request`; with `growing`, a key,
/// they may be those of the same request with a smaller number there.
///
/// # Errors
/// [`Error::OtherResults`].
pub(crate) fn check(folder: &Path, request: &Map<String, Value>, growing: Option<&str>) -> Result<()> {
    let refused = match read(folder) {
        Some(other) => differences(grown(&other, request, growing).as_ref(), request).map(|what| {
            format!("holds results of another request, made {}:{what}", made(&other).unwrap_or("at some time"))
        }),
        None => unknown_results(folder)
            .map(|name| format!("holds results ({name}) but no {MANIFEST} that says which request made them")),
    };
    let other = |reason| Err(Error::OtherResults { path: folder.display().to_string(), reason });
    refused.map_or(Ok(()), other)
}

/// The request of the manifest `other`, with the number that `request` has under the key `growing`
/// in place of a smaller one.
fn grown(other: &Value, request: &Map<String, Value>, growing: Option<&str>) -> Option<Value> {
    let mut there = other.get("request")?.clone();
    if let Some((key, asked)) = growing.and_then(|key| Some((key, request.get(key)?)))
        && let Some(value) = there.get_mut(key)
        && value.as_f64().zip(asked.as_f64()).is_some_and(|(there, asked)| there < asked)
    {
        *value = asked.clone();
    }
    Some(there)
}

/// The manifest in `folder`, if there is one that can be read.
pub(crate) fn read(folder: &Path) -> Option<Value> {
    let text = read_text(&folder.join(MANIFEST), MOST_BYTES).ok()?;
    serde_json::from_str(&text).ok()
}

/// The names of the files that `manifest` lists.
pub(crate) fn files(manifest: &Value) -> impl Iterator<Item = &str> {
    manifest.get("files").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str)
}

/// True if the files that `manifest` lists are all there; false after an interruption.
pub(crate) fn is_finished(manifest: &Value) -> bool {
    manifest.get(UNFINISHED).is_none()
}

pub(super) fn made(manifest: &Value) -> Option<&str> {
    manifest.get("made").and_then(Value::as_str)
}

/// Writes `manifest` into `folder`, and what is in the folder onto the disk.
pub(super) fn write(folder: &Path, manifest: &Value) -> Result<()> {
    write_whole(&folder.join(MANIFEST), format!("{manifest:#}\n").as_bytes())?;
    sync_folder(folder)
}

/// Writes `bytes` to the file `name` in `folder`, and adds it to those that `manifest`, the
/// manifest there, lists.
///
/// # Errors
/// [`Error::Io`] where it cannot be written, or where another process writes to the folder.
pub(crate) fn add(folder: &Path, mut manifest: Value, name: &str, bytes: &[u8]) -> Result<()> {
    let _lock = Lock::take(folder)?;
    write_whole(&folder.join(name), bytes)?;
    match manifest.get_mut("files").and_then(Value::as_array_mut) {
        Some(files) if !files.iter().any(|file| file == name) => {
            files.push(json!(name));
            write(folder, &manifest)
        }
        _ => sync_folder(folder),
    }
}

/// How `request` differs from `other`, one line per difference; `None` where both ask the same.
pub(crate) fn differences(other: Option<&Value>, request: &Map<String, Value>) -> Option<String> {
    let empty = Map::new();
    let other = other.and_then(Value::as_object).unwrap_or(&empty);
    let keys = other.keys().chain(request.keys().filter(|key| !other.contains_key(*key)));
    let (mut lines, mut parts) = (Vec::new(), Vec::new());
    for key in keys.filter(|key| other.get(*key).unwrap_or(&Value::Null) != request.get(*key).unwrap_or(&Value::Null)) {
        // A fingerprint shows that something differs; its digits mean nothing to the reader.
        match key.strip_suffix(FINGERPRINT) {
            Some(what) => parts.push(what),
            None if key == VALUES => {}
            None => lines.push(format!(
                "{key}: {} there, {} asked",
                shown(other.get(key).or(Some(&Value::Null))),
                shown(request.get(key).or(Some(&Value::Null)))
            )),
        }
    }
    let (values, unnamed) = differing(&parts, other, request);
    lines.extend(values);
    lines.extend(unnamed.iter().map(|part| format!("{}: other data there", part.replace('_', " "))));
    (!lines.is_empty()).then(|| lines.iter().map(|line| format!("\n  {line}")).collect())
}

/// Suffix of the keys that hold fingerprints.
pub const FINGERPRINT: &str = "_fingerprint";
