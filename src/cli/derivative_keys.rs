//! The keys of `--derivative`, and the table of what 1 % more of each changes.

use crate::case::{Case, Key};
use crate::cli::pipeline::Answer;
use crate::error::{Error, Result};
use crate::output::derivatives::FILE;
use crate::output::effects::DerivativeKey;
use crate::output::results::Results;
use crate::output::table::Table;
use crate::variation::SceneTangent;
use serde_json::json;

/// The keys of these names in `case`, and the derivatives of its scene by them.
///
/// # Errors
/// [`Error::Invalid`] for a key that is asked for twice; as [`Case::tangent`].
pub(super) fn derivative_keys(case: &Case, names: &[String]) -> Result<(Vec<DerivativeKey>, Vec<SceneTangent>)> {
    let (mut keys, mut tangents): (Vec<DerivativeKey>, Vec<SceneTangent>) = (Vec::new(), Vec::new());
    for name in names {
        let key: Key = name.parse()?;
        if keys.iter().any(|other| other.key == key.to_string()) {
            let found = format!("{key}, for the second time");
            return Err(Error::invalid("--derivative", found, "each key once"));
        }
        let tangent = case.tangent(&key)?;
        keys.push(DerivativeKey {
            key: key.to_string(),
            value: tangent.value(),
            unit: key.unit(),
            error: tangent.error(),
        });
        tangents.push(tangent);
    }
    Ok((keys, tangents))
}

/// Keeps the table and its remarks for the page.
pub(super) fn record_effects(results: &mut Results, table: Option<Table>, remarks: &[String]) {
    results.add_to_manifest("effects", json!(table.map(|table| table.document())));
    results.add_to_manifest("effect_remarks", json!(remarks));
}

/// Shows the table and its remarks.
pub(super) fn show_effects(answer: &mut Answer, table: Option<Table>, remarks: Vec<String>) {
    if let Some(table) = table {
        answer.table(table, FILE);
    }
    answer.remarks(remarks);
}
