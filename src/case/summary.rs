//! Reads the case in the `summary.json` of a run.

use super::Embedded;
use super::digest::sha256;
use super::text::{MOST_TABLE_BYTES, read_text};
use crate::error::{Error, Result};
use serde_json::Value;
use std::path::Path;

/// Name and text of the case file within `text`, a summary at `path`, and the parsed summary.
pub(super) fn read(text: &str, path: &Path) -> Result<(String, String, Value)> {
    let failed = |reason: String| Error::io(path.display(), reason, true);
    let summary: Value =
        serde_json::from_str(text).map_err(|error| failed(format!("not valid JSON: {error}")).caused_by(error))?;
    let written = summary.get("case_file").filter(|value| value.is_object()).ok_or_else(|| {
        let help = "a case file is a TOML text; of JSON files the summary.json of a run is read, which has a \
                    key `case_file`";
        failed(format!("not the summary of a run\nhelp: {help}"))
    })?;
    let case = toml::to_string(written)
        .map_err(|error| failed(format!("its `case_file` is not a case file: {error}")).caused_by(error))?;
    let name = summary.get("case").and_then(Value::as_str).unwrap_or("case").to_owned();
    Ok((format!("{name}.toml"), case, summary))
}

/// Path and text of a file that the run of `summary` read; it must be unchanged.
pub(super) fn open(summary: &Value, file: &str) -> std::result::Result<(String, String), String> {
    let entry = summary["files"].as_array().and_then(|files| files.iter().find(|entry| entry["file"] == file));
    let word = |key: &str| entry.and_then(|entry| entry[key].as_str());
    let at = word("path").unwrap_or(file);
    let text = match read_text(Path::new(at), MOST_TABLE_BYTES) {
        Ok(text) => text,
        Err(reason) => {
            let mut tables = Embedded::all().iter().flat_map(|case| case.tables);
            tables.find(|(name, _)| *name == at).map(|(_, text)| (*text).to_owned()).ok_or(reason)?
        }
    };
    match word("sha256") {
        Some(digest) if digest != sha256(text.as_bytes()) => {
            Err(format!("{at} is not what the run read: the SHA-256 of that file was {digest}"))
        }
        _ => Ok((at.to_owned(), text)),
    }
}
