//! Other results in the figures of a page: a run over a run, a sweep over a sweep.

use super::folder::Folder;
use super::motion::{add_left_out, motion};
use super::scene::scene;
use super::sweep::{SAMPLES, TABLE};
use crate::error::{Error, Result};
use serde_json::{Value, json};

/// Adds the results in `other`, shown under `name`, to the figures of `page`, which shows results
/// of `command`.
///
/// # Errors
/// [`Error::Io`], a wrong request, where the other results are of another command, or of another
/// scene or key.
pub(super) fn add(page: &mut Value, command: &str, other: &Folder<'_>, name: &str) -> Result<()> {
    let wrong = |reason: String| Error::io(other.path.display(), reason, true);
    let theirs = other.manifest["request"]["command"].as_str().unwrap_or_default();
    if theirs != command {
        return Err(wrong(format!(
            "holds results of {theirs:?}; expected those of {command:?}, as in the page's folder"
        )));
    }
    match command {
        "run" => run(page, other, name),
        "sweep" => sweep(page, other, name),
        "continue" => Err(wrong("branches are drawn over others by `signorini continue … --over FOLDER`".to_owned())),
        _ => Err(wrong(format!("the page of {command:?} has no figure for two results; one of run and sweep has"))),
    }
}

/// The motion of another run of the same walls and probes.
fn run(page: &mut Value, other: &Folder<'_>, name: &str) -> Result<()> {
    let summary = other.json("summary.json")?;
    let mut added = motion(other, "", &summary)?;
    let names =
        |list: &Value| -> Vec<Value> { list.as_array().into_iter().flatten().map(|one| one["name"].clone()).collect() };
    let same = [
        ("walls", &page["scene"]["walls"], &scene(&summary)["walls"]),
        ("probes", &page["runs"][0]["probes"], &added["probes"]),
    ];
    if let Some((what, ..)) = same.iter().find(|(_, own, theirs)| names(own) != names(theirs)) {
        let reason = format!("its run has other {what} than that of the page: their motions do not go together");
        return Err(Error::io(other.path.display(), reason, true));
    }
    let scheme = summary["scheme"].as_str().unwrap_or_default();
    added["label"] = json!(format!("{scheme}, {name}"));
    add_left_out(&mut page["notes"], &mut added);
    if let Some(runs) = page["runs"].as_array_mut() {
        runs.push(added);
    }
    Ok(())
}

/// The curves and instants of another sweep over the same key.
fn sweep(page: &mut Value, other: &Folder<'_>, name: &str) -> Result<()> {
    let axes = page["sweep"]["axes"].as_array().map_or(&[][..], Vec::as_slice);
    let [axis] = axes else {
        let reason = "a sweep is drawn over another where both have one key".to_owned();
        return Err(Error::io(other.path.display(), reason, true));
    };
    let table = other.cells(TABLE)?;
    table.column(axis["column"].as_str().unwrap_or_default())?;
    let samples = if other.has(SAMPLES) { Some(other.cells(SAMPLES)?) } else { None };
    page["sweep"]["over"] = json!({
        "name": name,
        "table": table.for_page(None),
        "samples": samples.map(|samples| samples.for_page(None)),
    });
    Ok(())
}
