//! The page of a sweep: curves, maps and bifurcation diagrams.

use super::folder::Folder;
use crate::error::{Error, Result};
use crate::output::results;
use serde_json::{Value, json};

/// Most cells of the tables that a page holds: some tens of megabytes of HTML.
const MOST_CELLS: usize = 4_000_000;

/// The table of the attractors, of a sweep that tells them, and what the page tells of each.
const ATTRACTORS: &str = "attractors.csv";
const TOLD: [&str; 8] =
    ["attractor", "rows", "share", "signature", "period", "phases_cycles", "approach_speeds_m_per_s", "multipliers"];

/// What the page of a sweep shows.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    let table = folder.cells("sweep.csv")?;
    let samples = if folder.has("samples.csv") { Some(folder.cells("samples.csv")?) } else { None };
    let attractors = if folder.has(ATTRACTORS) { Some(folder.cells(ATTRACTORS)?) } else { None };
    let cells = |table: &super::folder::Cells| table.rows.len() * table.header.len();
    let count = cells(&table) + samples.as_ref().map_or(0, cells);
    if count > MOST_CELLS {
        let reason = format!("its tables have {count} cells; a report holds {MOST_CELLS} at most");
        return Err(Error::io(folder.path.display(), reason, true));
    }
    let request = &folder.manifest["request"];
    let axes: Vec<Value> = request["vary"].as_array().cloned().unwrap_or_default();
    let summary = if folder.has("summary.json") { folder.json("summary.json")? } else { Value::Null };
    let program = folder.manifest["program"].as_str().unwrap_or_default();
    Ok(json!({
        "program": program,
        "title": summary["title"],
        "subtitle": format!("{} rows", table.rows.len()),
        "command": summary["command_line"],
        "sweep": {
            "table": table.for_page(None),
            "attractors": attractors.map(|attractors| attractors.for_page(Some(&TOLD))),
            "samples": samples.map(|samples| samples.for_page(None)),
            "axes": axes,
            "scheme": request["methods"][0],
        },
        "case": folder.manifest["case_text"],
        "summary": { "status": summary["status"], "first_error": summary["first_error"], results::MANIFEST: request },
    }))
}
