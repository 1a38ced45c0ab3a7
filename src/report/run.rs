//! The page of one run.

use super::cards::{cards, short};
use super::folder::Folder;
use super::motion::{add_left_out, motion};
use super::older;
use super::scene::{period, scene};
use crate::error::Result;
use crate::output::derivatives::{FILE, STATES_FILE};
use crate::output::orbit_derivatives::MULTIPLIERS_FILE;
use crate::output::{realisations, sector_means, turbulence};
use crate::study::horizon::LARGEST_GROWTH;
use serde_json::{Value, json};

/// Most rows of a table of derivatives that the page shows.
const MOST_ROWS: usize = 1000;

/// What the page of a run shows.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    let mut summary = folder.json("summary.json")?;
    let lacking = older::complete_forces(&mut summary);
    let mut run = motion(folder, "", &summary)?;
    let label = summary["scheme"].as_str().unwrap_or_default();
    run["label"] = json!(label);
    let mut page = of_scene(&summary);
    page["facts"] = facts(&summary);
    page["notes"] = notes(&summary, lacking);
    add_left_out(&mut page["notes"], &mut run);
    page["margins"] = summary["scene"]["fluid_elastic"].clone();
    page["turbulence"] = turbulence_tables(folder)?;
    if summary["realisations"].is_object() {
        page["draws"] = draws(folder, realisations::FILE, &summary["realisations"])?;
    }
    tell_draw(&mut page, folder, summary["realisations"]["count"].as_u64().unwrap_or(1));
    if folder.manifest["request"]["derivative"].is_array() {
        page["derivatives"] = derivatives(folder)?;
    }
    page["runs"] = json!([run]);
    Ok(page)
}

/// The forces of turbulence, asked and recovered; null where there is none.
pub(super) fn turbulence_tables(folder: &Folder<'_>) -> Result<Value> {
    if !folder.has(turbulence::FILES[0]) {
        return Ok(Value::Null);
    }
    let [spectra, pairs] = turbulence::FILES.map(|file| folder.cells(file).map(|cells| cells.for_page(None)));
    Ok(json!({ "spectra": spectra?, "pairs": pairs? }))
}

/// Every realisation or history, with its seeds, from the table in `file`; and where around each
/// support the tube wears in the mean over them, with the limit of the depth. `told` has seeds,
/// limit and what is to be said of them.
pub(super) fn draws(folder: &Folder<'_>, file: &str, told: &Value) -> Result<Value> {
    let sectors =
        if folder.has(sector_means::FILE) { Some(folder.cells(sector_means::FILE)?.for_page(None)) } else { None };
    Ok(json!({
        "table": if folder.has(file) { folder.cells(file)?.for_page(None) } else { Value::Null },
        "sectors": sectors,
        "limit": told["limit_m"],
        "seeds": told["seeds"],
        "notes": told["notes"],
        "scheme": folder.manifest["request"]["methods"][0],
    }))
}

/// Says in the title of the page how many realisations it is of, in its subtitle which of them its
/// drawings show, where there are several.
pub(super) fn tell_draw(page: &mut Value, folder: &Folder<'_>, count: u64) {
    let title = page["title"].as_str().or(folder.manifest["request"]["case"].as_str());
    if let Some(title) = title.filter(|_| count > 1) {
        page["title"] = json!(format!("{title}: {count} draws"));
        page["draw_count"] = json!(count);
        let subtitle = page["subtitle"].as_str().unwrap_or_default();
        let means = format!("means over {count} stand first; all drawings and other numbers are of draw 1");
        page["subtitle"] = json!(if subtitle.is_empty() { means } else { format!("{subtitle} · {means}") });
    }
}

/// What 1 % more of each key changes; the tables of the derivatives, each with its file, its number
/// of rows and the first of them; and the growth from which on a change is no longer small.
pub(super) fn derivatives(folder: &Folder<'_>) -> Result<Value> {
    let mut tables = Vec::new();
    for file in [FILE, STATES_FILE, MULTIPLIERS_FILE].into_iter().filter(|file| folder.has(file)) {
        let mut cells = folder.cells(file)?;
        let count = cells.rows.len();
        cells.rows.truncate(MOST_ROWS);
        tables.push(json!({ "file": file, "count": count, "table": cells.for_page(None) }));
    }
    let [effects, remarks] = ["effects", "effect_remarks"].map(|key| &folder.manifest[key]);
    Ok(json!({ "tables": tables, "growth": LARGEST_GROWTH, "effects": effects, "remarks": remarks }))
}

/// The page's data on the scene of a run with this summary, and on how reliable the run is.
pub(super) fn of_scene(summary: &Value) -> Value {
    let duration = summary["scene"]["duration_s"].as_f64().unwrap_or(0.0);
    let horizon = summary["refinement"]["horizon_s"].as_f64().filter(|t| *t < duration * (1.0 - 1e-9));
    let names = [&summary["case"], &summary["source"]];
    let subtitle: Vec<&str> = names.iter().filter_map(|name| name.as_str()).collect();
    json!({
        "title": summary["title"],
        "subtitle": subtitle.join(" · "),
        "scene": scene(summary),
        "duration": duration,
        "period": period(summary),
        "horizon": horizon,
        "cards": cards(summary),
        "case": case_text(&summary["case_file"]),
        "summary": summary,
    })
}

/// The case as a case file; as JSON where it cannot be written as one.
pub(super) fn case_text(case_file: &Value) -> Option<String> {
    let shown = || serde_json::to_string_pretty(case_file).unwrap_or_default();
    case_file.is_object().then(|| toml::to_string(case_file).unwrap_or_else(|_| shown()))
}

/// What a reader must know: the notes of the run, and what its files lack.
fn notes(summary: &Value, lacking: Option<String>) -> Value {
    let mut notes = summary["notes"].as_array().cloned().unwrap_or_default();
    notes.extend(summary["wear"].as_str().map(|text| json!(text)));
    notes.extend(lacking.map(Value::String));
    json!(notes)
}

/// The largest force of a wall, and its unit with the stretch over which it is a mean.
fn largest_force(wall: &Value) -> Option<(f64, String)> {
    let largest = &wall["force_largest"];
    let unit = match largest["averaged_over_s"].as_f64()? {
        0.0 => "N".to_owned(),
        over => format!("N over {} ms", short(1e3 * over)),
    };
    Some((largest["mean_n"].as_f64()?, unit))
}

/// The key figures.
fn facts(summary: &Value) -> Value {
    let walls = summary["statistics"]["walls"].as_array().map_or(&[][..], Vec::as_slice);
    let number = |value: &Value| value.as_f64();
    let fact = |label: &str, value: String, unit: &str| json!({ "label": label, "value": value, "unit": unit });
    let mut facts = Vec::new();
    if !walls.is_empty() {
        let contacts: u64 = walls.iter().filter_map(|wall| wall["contacts"].as_u64()).sum();
        let from = number(&summary["statistics"]["from_s"]).filter(|from| *from > 0.0);
        facts.push(fact(
            "contacts",
            contacts.to_string(),
            &from.map_or_else(String::new, |s| format!("from {s} s on")),
        ));
        let impulse = walls.iter().filter_map(|wall| number(&wall["force"]["impulse_n_s"])).map(f64::abs);
        facts.push(fact("Σ|impulse|", short(impulse.sum()), "N s"));
        let largest = walls.iter().filter_map(largest_force).reduce(|a, b| if b.0 > a.0 { b } else { a });
        facts.extend(largest.map(|(force, unit)| fact("largest force", short(force), &unit)));
        let power: f64 = walls.iter().filter_map(|wall| number(&wall["impact_power_w"])).sum();
        facts.push(fact("impact power", short(1e3 * power), "mW"));
    }
    let supports = summary["supports"].as_array().map_or(&[][..], Vec::as_slice);
    if !supports.is_empty() {
        let work: f64 = supports.iter().filter_map(|support| number(&support["work_rate_w"])).sum();
        let forces = summary["statistics"]["supports"].as_array().map_or(&[][..], Vec::as_slice);
        let force: f64 = forces.iter().filter_map(|support| number(&support["force"]["mean_n"])).sum();
        let upper = supports.iter().any(|support| support["upper_figure"] == true);
        let unit = if upper { "mW, upper figure" } else { "mW" };
        facts.push(fact("work rate", short(1e3 * work), unit));
        facts.push(fact("mean force", short(force), "N, of all supports"));
    }
    facts.push(fact("method", summary["scheme"].as_str().unwrap_or_default().to_owned(), ""));
    let length =
        |h: f64| if h < 1e-3 { format!("of {} µs", short(1e6 * h)) } else { format!("of {} ms", short(1e3 * h)) };
    let step = number(&summary["step_s"]).map_or("from event to event".to_owned(), length);
    facts.push(fact("steps", summary["steps"].to_string(), &step));
    facts.extend(number(&summary["wall_clock_s"]).map(|s| fact("took", short(1e3 * s), "ms")));
    json!(facts)
}
