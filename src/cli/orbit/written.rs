//! What orbits of one degree of freedom and of structures share.

use crate::error::Result;
use crate::output::atomic::write_whole;
use crate::output::json;
use crate::output::results::Results;
use serde_json::Value;

/// Writes `orbit.json`.
pub(super) fn write_document(results: &mut Results, document: Value) -> Result<Value> {
    write_whole(&results.place("orbit.json")?, json::text(&document).as_bytes())?;
    Ok(document)
}
