//! The page of histories of wear: depth over the years.

use super::folder::Folder;
use super::run::case_text;
use super::sweep::names;
use crate::error::Result;
use serde_json::{Value, json};

/// What the page of histories of wear shows.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    let years = folder.cells("years.csv")?;
    years.column("year")?;
    Ok(json!({
        "subtitle": "wear over the years",
        "wear": {
            "years": years.for_page(None),
            "answers": folder.manifest["answers"],
            "supports": names(&folder.manifest["supports"]),
            "seeds": folder.manifest["histories"],
            "first": folder.manifest["realisations"],
        },
        "margins": folder.manifest["fluid_elastic"],
        "case": case_text(&folder.manifest["case_file"]),
        "notes": folder.manifest["remarks"],
    }))
}
