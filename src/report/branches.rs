//! The page of branches of periodic orbits.

use super::column;
use super::folder::{Cells, Folder};
use super::run::case_text;
use crate::error::Result;
use crate::orbit::Kind;
use crate::output::{orbits, overlay};
use serde_json::{Value, json};
use std::collections::HashMap;

/// Most orbits, and most points of other results beneath them, that the page holds.
const MOST_POINTS: usize = 20_000;
const MOST_BENEATH: usize = 100_000;

/// The columns of the branches that the page draws or shows as text, beside the key.
const SHOWN: [&str; 11] = [
    "branch",
    "point",
    "period",
    "symmetric",
    "signature",
    "label",
    "stable",
    "admissible",
    "period_s",
    "least_gap_m",
    "displacement_max_m",
];

/// Keeps every `every`th of the orbits, and the special points.
fn keep_every(table: &mut Cells, every: usize) {
    let kept = |row: usize| row.is_multiple_of(every) || !table.text(row, "label").is_empty();
    let kept: Vec<bool> = (0..table.rows.len()).map(kept).collect();
    let mut kept = kept.into_iter();
    table.rows.retain(|_| kept.next().unwrap_or(true));
}

/// The points drawn beneath the branches, with a note where not all of them are.
fn beneath(folder: &Folder<'_>, notes: &mut Vec<String>) -> Result<Value> {
    let points = folder.numbers(overlay::FILE)?;
    let [x, y] = &points.columns[..] else {
        return Err(points.wrong("expected two columns, the key and the approach speed"));
    };
    let every = x.len().div_ceil(MOST_BENEATH).max(1);
    if every > 1 {
        notes.push(format!("of {} points beneath the branches every {every}th is drawn", x.len()));
    }
    let picked = |column: &[f64]| column::f32(column.iter().copied().step_by(every));
    Ok(json!({ "x": picked(x), "y": picked(y), "name": &folder.manifest["request"]["over"] }))
}

/// What the page of branches shows.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    let document = folder.json("branches.json")?;
    let key = document["key"].as_str().unwrap_or_default();
    let mut table = folder.cells("branches.csv")?;
    let mut notes: Vec<String> = Vec::new();
    let every = table.rows.len().div_ceil(MOST_POINTS).max(1);
    if every > 1 {
        notes.push(format!(
            "of {} orbits every {every}th and the special points are shown; branches.csv has all",
            table.rows.len()
        ));
        keep_every(&mut table, every);
    }
    let mut shown: Vec<&str> = SHOWN.to_vec();
    shown.push(key);
    let multipliers: Vec<String> =
        table.header.iter().filter(|name| name.starts_with("multiplier_")).cloned().collect();
    shown.extend(multipliers.iter().map(String::as_str));
    for name in shown.iter().filter(|name| !["signature", "label"].contains(name)) {
        table.column(name)?;
    }
    let mut out = json!({
        "key": key,
        "label": document["label"],
        "path": folder.manifest["request"]["key"],
        "command": folder.manifest["orbit_command"],
        "branches": document["branches"],
        "approaches": Kind::ALL.into_iter().filter(|kind| kind.is_approach()).map(Kind::name).collect::<Vec<_>>(),
        "specials": document["specials"],
        "walls": document["walls"],
        "place": document["place"],
        "points": table.for_page(Some(&shown)),
        "events": events(&table, &document["branches"])?,
    });
    if folder.has(orbits::FILE) {
        out["orbits"] = motions(&folder.cells(orbits::FILE)?, &table)?;
    } else {
        notes.push("there is no orbits.csv, from which the motion along each orbit is drawn".to_owned());
    }
    if folder.has(overlay::FILE) {
        out["beneath"] = beneath(folder, &mut notes)?;
    }
    if folder.has("loci.csv") {
        out["loci"] = loci(&folder.cells("loci.csv")?);
    }
    let count = document["branches"].as_array().map_or(0, Vec::len);
    Ok(json!({
        "subtitle": format!("periodic orbits over {}: {count} branches", document["label"].as_str().unwrap_or(key)),
        "continue": out,
        "case": case_text(&folder.manifest["case_file"]),
        "notes": notes,
    }))
}

/// Phases and speeds of the events of every row, one row after the other, as many as its branch has
/// events.
fn events(table: &Cells, branches: &Value) -> Result<Value> {
    let numbers = table.column("branch")?;
    let count = |branch: f64| branches[(branch as usize).wrapping_sub(1)]["events"].as_array().map_or(0, Vec::len);
    let counts: Vec<usize> = numbers.iter().map(|branch| count(*branch)).collect();
    let most = counts.iter().copied().max().unwrap_or(0);
    let mut both = [vec![f64::NAN; counts.iter().sum()], vec![f64::NAN; counts.iter().sum()]];
    for event in 0..most {
        for (out, name) in both.iter_mut().zip(["phase", "speed"]) {
            let unit = if name == "phase" { "cycles" } else { "m_per_s" };
            let column = table.column(&format!("{name}_{}_{unit}", event + 1))?;
            let mut first = 0;
            for (value, count) in column.iter().zip(&counts) {
                if let (true, Some(cell)) = (event < *count, out.get_mut(first + event)) {
                    *cell = *value;
                }
                first += count;
            }
        }
    }
    Ok(json!({ "phases": column::f64(&both[0]), "speeds": column::f64(&both[1]) }))
}

/// The motion of the orbits: the row of each among the points, where its instants begin, and the
/// instants of all.
fn motions(cells: &Cells, table: &Cells) -> Result<Value> {
    let at = |cells: &Cells| -> Result<Vec<(u64, u64)>> {
        let (branch, point) = (cells.column("branch")?, cells.column("point")?);
        Ok(branch.iter().zip(&point).map(|(b, p)| (*b as u64, *p as u64)).collect())
    };
    let rows: HashMap<(u64, u64), usize> = at(table)?.into_iter().enumerate().map(|(row, at)| (at, row)).collect();
    let instants = at(cells)?;
    let (mut row, mut first, mut kept) = (Vec::new(), Vec::new(), Vec::new());
    let mut last = None;
    for (index, instant) in instants.iter().enumerate() {
        let Some(own) = rows.get(instant) else { continue };
        if last != Some(instant) {
            row.push(*own);
            first.push(kept.len());
        }
        last = Some(instant);
        kept.push(index);
    }
    let picked = |name: &str| -> Result<Value> {
        let column = cells.column(name)?;
        Ok(column::f32(kept.iter().map(|&index| column.get(index).copied().unwrap_or(f64::NAN))))
    };
    Ok(json!({
        "row": column::u32(&row),
        "first": column::u32(&first),
        "phase": picked("phase_cycles")?,
        "q": picked("displacement_m")?,
        "v": picked("velocity_m_per_s")?,
    }))
}

/// The curves of special points in the plane of two keys, which are the columns after the first
/// three.
fn loci(cells: &Cells) -> Value {
    let keys: Vec<&str> = cells.header.iter().skip(3).take(2).map(String::as_str).collect();
    let shown: Vec<&str> = ["locus", "label", "signature"].into_iter().chain(keys.iter().copied()).collect();
    json!({ "keys": keys, "table": cells.for_page(Some(&shown)) })
}
