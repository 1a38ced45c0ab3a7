//! The page of histories of wear: depth over the years.

use super::cards::cards;
use super::folder::Folder;
use super::motion::{add_left_out, motion};
use super::older;
use super::run::{case_text, draws, turbulence_tables};
use super::scene::{period, scene};
use super::sweep::names;
use crate::error::Result;
use crate::output::wear_folder::FIRST_WINDOW;
use crate::output::wear_history;
use serde_json::{Value, json};

/// What the page of histories of wear shows.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    let years = folder.cells("years.csv")?;
    years.column("year")?;
    let mut notes = folder.manifest["remarks"].as_array().cloned().unwrap_or_default();
    let lacking = older::without_columns("years.csv", &years.header, &wear_history::columns());
    notes.extend(lacking.map(Value::String));
    let mut first = folder.manifest["realisations"].clone();
    older::rename(&mut first);
    let written = json!({ "case_file": folder.manifest["case_file"], "scene": folder.manifest["scene"] });
    let mut page = json!({
        "scene": if written["scene"].is_object() { scene(&written) } else { Value::Null },
        "draws": draws(folder, "history.csv", folder.manifest)?,
        "subtitle": "wear over the years",
        "wear": {
            "years": years.for_page(None),
            "answers": folder.manifest["answers"],
            "supports": names(&folder.manifest["supports"]),
            "seeds": older::histories(folder.manifest),
            "first": first,
        },
        "margins": folder.manifest["fluid_elastic"],
        "turbulence": turbulence_tables(folder)?,
        "case": case_text(&folder.manifest["case_file"]),
        "notes": notes,
    });
    add_first_window(&mut page, folder)?;
    Ok(page)
}

/// Adds the motion of the first window of the first history, where the folder has it.
fn add_first_window(page: &mut Value, folder: &Folder<'_>) -> Result<()> {
    let file = format!("{FIRST_WINDOW}/summary.json");
    if !folder.has(&file) {
        return Ok(());
    }
    let summary = folder.json(&file)?;
    let mut run = motion(folder, FIRST_WINDOW, &summary)?;
    run["label"] = summary["scheme"].clone();
    add_left_out(&mut page["notes"], &mut run);
    // That one window was not checked says nothing of the study.
    page["cards"] = cards(&summary).into_iter().filter(|card| card["verdict"] != "Not checked").collect();
    page["scene"] = scene(&summary);
    page["duration"] = summary["scene"]["duration_s"].clone();
    page["period"] = json!(period(&summary));
    page["runs"] = json!([run]);
    page["summary"] = summary;
    Ok(())
}
