//! Other results in the figures of a page: runs and comparisons over each other, and a sweep, a
//! chart, an orbit or histories of wear over results of the same kind.

use super::chart::{NUMBERS, short};
use super::folder::Folder;
use super::motion::{add_left_out, motion};
use super::scene::scene;
use super::sweep::{SAMPLES, TABLE, names};
use super::{compare, orbit};
use crate::error::{Error, Result};
use crate::scheme::{Method, PenaltyLaw, Scheme};
use serde_json::{Value, json};

/// Adds the results in `other`, shown under `name`, to the figures of `page`, which shows results
/// of `command`.
///
/// # Errors
/// [`Error::Io`], a wrong request, where the other results are of a command whose figures are not
/// those of the page, or of another scene or key.
pub(super) fn add(page: &mut Value, command: &str, other: &Folder<'_>, name: &str) -> Result<()> {
    let wrong = |reason: String| Error::io(other.path.display(), reason, true);
    let theirs = other.manifest["request"]["command"].as_str().unwrap_or_default();
    let expected = match command {
        "run" | "compare" => "run or compare",
        "sweep" | "chart" | "orbit" | "wear" => command,
        "continue" => {
            return Err(wrong("branches are drawn over others by `signorini continue … --over FOLDER`".to_owned()));
        }
        _ => {
            let reason = "has no figure for two results; those of run, compare, sweep, chart, orbit and wear have";
            return Err(wrong(format!("the page of {command:?} {reason}")));
        }
    };
    match (command, theirs) {
        ("run" | "compare", "run") => run(page, other, name),
        ("run" | "compare", "compare") => methods(page, other, name),
        ("sweep", "sweep") => sweep(page, other, name),
        ("chart", "chart") => chart(page, other, name),
        ("orbit", "orbit") => orbit(page, other, name),
        ("wear", "wear") => wear(page, other, name),
        _ => {
            Err(wrong(format!("holds results of {theirs:?}; expected those of {expected}, as the page's figures show")))
        }
    }
}

/// The motion of another run of the same walls and probes.
fn run(page: &mut Value, other: &Folder<'_>, name: &str) -> Result<()> {
    let summary = other.json("summary.json")?;
    let mut added = motion(other, "", &summary)?;
    added["label"] = summary["scheme"].clone();
    motions(page, other, name, (vec![added], summary))
}

/// The motions of the methods of a comparison of the same walls and probes.
fn methods(page: &mut Value, other: &Folder<'_>, name: &str) -> Result<()> {
    let found = compare::runs(other, &other.cells("compare.csv")?)?;
    motions(page, other, name, found)
}

/// Adds motions to those of the page, whose scene is that of `summary`.
fn motions(page: &mut Value, other: &Folder<'_>, name: &str, (added, summary): (Vec<Value>, Value)) -> Result<()> {
    let names =
        |list: &Value| -> Vec<Value> { list.as_array().into_iter().flatten().map(|one| one["name"].clone()).collect() };
    let scene = scene(&summary);
    for mut run in added {
        let same = [
            ("walls", &page["scene"]["walls"], &scene["walls"]),
            ("probes", &page["runs"][0]["probes"], &run["probes"]),
        ];
        if let Some((what, ..)) = same.iter().find(|(_, own, theirs)| names(own) != names(theirs)) {
            let reason = format!("its run has other {what} than that of the page: their motions do not go together");
            return Err(Error::io(other.path.display(), reason, true));
        }
        run["label"] = json!(format!("{}, {name}", run["label"].as_str().unwrap_or_default()));
        // The pale band is the reference of the page alone.
        run["reference"] = json!(false);
        add_left_out(&mut page["notes"], &mut run);
        if let Some(runs) = page["runs"].as_array_mut() {
            runs.push(run);
        }
    }
    Ok(())
}

/// The errors and times of another chart, as those of other programs: of a penalty against the
/// walls its first integrator stands for all.
fn chart(page: &mut Value, other: &Folder<'_>, name: &str) -> Result<()> {
    let table = other.cells("work-precision.csv")?;
    let [seconds, errors] = NUMBERS.map(|column| table.column(column));
    let (seconds, errors) = (seconds?, errors?);
    let mut curves: Vec<(String, Vec<[f64; 2]>)> = Vec::new();
    // The first method of each law of a penalty.
    let mut laws: Vec<(PenaltyLaw, &str)> = Vec::new();
    for (row, (error, seconds)) in errors.into_iter().zip(seconds).enumerate() {
        let method = table.text(row, "method");
        if let Ok(Method { scheme: Scheme::Penalty { law, .. }, .. }) = method.parse() {
            match laws.iter().find(|(own, _)| *own == law) {
                Some((_, first)) if *first != method => continue,
                Some(_) => {}
                None => laws.push((law, method)),
            }
        }
        if !(error > 0.0 && seconds > 0.0) {
            continue;
        }
        let label = format!("{}, {name}", short(method));
        match curves.iter_mut().find(|(own, _)| *own == label) {
            Some((_, points)) => points.push([error, seconds]),
            None => curves.push((label, vec![[error, seconds]])),
        }
    }
    let own = page["chart"]["programs"].as_array().cloned().unwrap_or_default();
    page["chart"]["programs"] = own.into_iter().chain(curves.into_iter().map(|curve| json!(curve))).collect();
    Ok(())
}

/// The curves and instants of another sweep over the same key.
fn sweep(page: &mut Value, other: &Folder<'_>, name: &str) -> Result<()> {
    let axes = page["sweep"]["axes"].as_array().map_or(&[][..], Vec::as_slice);
    let [axis] = axes else {
        let reason = "a sweep is drawn over another where both have one key".to_owned();
        return Err(Error::io(other.path.display(), reason, true));
    };
    let theirs = &other.manifest["request"];
    let one = theirs["vary"].as_array().is_some_and(|axes| axes.len() == 1);
    if !one || !theirs["random"].is_null() {
        let reason = "varies several keys, or draws values at random: a sweep over one key has curves to draw beneath";
        return Err(Error::io(other.path.display(), reason, true));
    }
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

/// The motion of another orbit; a structure's has none.
fn orbit(page: &mut Value, other: &Folder<'_>, name: &str) -> Result<()> {
    let theirs = orbit::read_motion(other, &other.json("orbit.json")?)?;
    if theirs.is_null() || page["orbit"]["motion"].is_null() {
        let reason = "an orbit is drawn over another where both have their motion in orbit.csv: those of one \
                      degree of freedom have";
        return Err(Error::io(other.path.display(), reason, true));
    }
    page["orbit"]["over"] = json!({ "name": name, "motion": theirs });
    Ok(())
}

/// The years of another study of wear at supports of the same names.
fn wear(page: &mut Value, other: &Folder<'_>, name: &str) -> Result<()> {
    let own = page["wear"]["supports"].as_array().map_or(&[][..], Vec::as_slice);
    if !names(&other.manifest["supports"]).iter().any(|name| own.contains(name)) {
        let reason = "its study has no support of a name that the page's supports have".to_owned();
        return Err(Error::io(other.path.display(), reason, true));
    }
    let years = other.cells("years.csv")?;
    years.column("year")?;
    page["wear"]["over"] = json!({ "name": name, "years": years.for_page(None) });
    Ok(())
}
