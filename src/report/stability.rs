//! The page of a stability study: where each scheme fails.

use super::folder::Folder;
use super::older;
use super::run::case_text;
use crate::error::Result;
use crate::output::figure::Class as Tone;
use crate::output::stable_steps::criterion;
use crate::study::stability::class::Class;
use crate::study::stability::impact::PHASES;
use serde_json::{Value, json};

/// The columns of the maps that the page draws or shows as text.
const SHOWN: [&str; 6] = ["scheme", "parameter", "value", "step_s", "class", "reason"];

/// What the page of a stability study shows.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    let maps = folder.cells("stability.csv")?;
    maps.column("step_s")?;
    let mut notes = folder.manifest["remarks"].as_array().cloned().unwrap_or_default();
    notes.extend(folder.manifest["stable_steps"].is_null().then(|| json!(older::WITHOUT_STABLE_STEPS)));
    Ok(json!({
        "subtitle": "where each scheme fails",
        "stability": {
            "maps": maps.for_page(Some(&SHOWN)),
            "classes": Class::ALL.map(Class::name),
            "tones": std::array::from_fn::<_, { Class::ALL.len() }, _>(Tone::fill),
            "conclusion": folder.manifest["conclusion"],
            "steps": folder.manifest["stable_steps"],
            "criterion": criterion(),
            "impacts": folder.cells("impact-map.csv")?.for_page(Some(&["phase", "restitution"])),
            "groups": folder.manifest["impacts"],
            "phases": PHASES,
            "lasting": folder.cells("lasting-contact.csv")?.for_page(None),
        },
        "case": case_text(&folder.manifest["case_file"]),
        "notes": notes,
    }))
}
