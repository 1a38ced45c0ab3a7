//! The page of histories of wear: depth over the years.

use super::folder::Folder;
use super::older;
use super::run::{case_text, draws};
use super::scene::scene;
use super::sweep::names;
use crate::error::Result;
use crate::output::wear_history;
use serde_json::{Value, json};

/// What the page of histories of wear shows.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    let years = folder.cells("years.csv")?;
    years.column("year")?;
    let mut notes = folder.manifest["remarks"].as_array().cloned().unwrap_or_default();
    let lacking = older::without_columns("years.csv", &years.header, &wear_history::columns());
    notes.extend(lacking.map(Value::String));
    let written = json!({ "case_file": folder.manifest["case_file"], "scene": folder.manifest["scene"] });
    Ok(json!({
        "scene": if written["scene"].is_object() { scene(&written) } else { Value::Null },
        "draws": draws(folder, "history.csv", folder.manifest)?,
        "subtitle": "wear over the years",
        "wear": {
            "years": years.for_page(None),
            "answers": folder.manifest["answers"],
            "supports": names(&folder.manifest["supports"]),
            "seeds": older::histories(folder.manifest),
            "first": folder.manifest["realisations"],
        },
        "margins": folder.manifest["fluid_elastic"],
        "case": case_text(&folder.manifest["case_file"]),
        "notes": notes,
    }))
}
