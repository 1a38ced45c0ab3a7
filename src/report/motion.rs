//! One run as the page draws it: displacement and velocity of the watched places, finite forces,
//! contacts, and the shape of the structure over time.

use super::column::{extremes, f32, f64, i16, u32, words};
use super::folder::{Cells, Folder, Numbers};
use super::scene::{drawn_at, in_keys};
use crate::error::{Error, Result};
use crate::order::sort_by_number;
use crate::output::pictures::FEW_ROWS;
use crate::output::shape::{self, BodyStations, Stations};
use serde_json::{Value, json};
use std::borrow::Cow;

/// Most rows of a run that the page holds; of a longer one the rows with extremes.
const MOST_ROWS: usize = 1 << 17;
/// Most rows times watched places.
const MOST_NUMBERS: usize = 24 * MOST_ROWS;
/// Most watched places that the page holds.
const MOST_PROBES: usize = 64;
/// Most numbers of a shape.
const MOST_SHAPE: usize = 800_000;

/// The motion in the folder `prefix` (empty for the folder itself) of a run with this `summary`.
pub(super) fn motion(folder: &Folder<'_>, prefix: &str, summary: &Value) -> Result<Value> {
    let named = |name: &str| if prefix.is_empty() { name.to_owned() } else { format!("{prefix}/{name}") };
    let table = folder.numbers(&named("trajectory.csv"))?;
    let walls = summary["scene"]["walls"].as_array().map_or(0, Vec::len);
    let columns = table.header.len() - beside(summary).min(table.header.len());
    let first = table.header.get(1).is_none_or(|name| name.starts_with("displacement") || walls > 0);
    if columns < 1 + 2 * walls || !(columns - 1 - 2 * walls).is_multiple_of(2) || !first || table.count() == 0 {
        let reason = format!(
            "has {} rows of {columns} columns; expected time_s, a displacement and a velocity for each probe, and a \
             force and an impulse for each of the {walls} walls of summary.json",
            table.count()
        );
        return Err(table.wrong(reason));
    }
    let probes = (columns - 1 - 2 * walls) / 2;
    let contacts = folder.cells(&named("contacts.csv"))?;
    let mut left_out = Vec::new();
    if probes > MOST_PROBES {
        left_out.push(format!("of {probes} watched places the first {MOST_PROBES} are shown; trajectory.csv has all"));
    }
    let shown: Vec<&[f64]> =
        table.columns.iter().skip(1).take(2 * probes.min(MOST_PROBES)).map(Vec::as_slice).collect();
    let most = MOST_ROWS.min(2 * MOST_NUMBERS / shown.len().max(1));
    let rows = extremes(&shown, table.count(), most);
    if let Some(rows) = &rows {
        left_out.push(format!(
            "of {} rows the {} are drawn in which a curve is least or largest in its stretch; trajectory.csv has all",
            table.count(),
            rows.len()
        ));
    }
    let picked = |column: &[f64]| match &rows {
        Some(rows) => f32(rows.iter().map(|&row| column.get(row).copied().unwrap_or(f64::NAN))),
        None => f32(column.iter().copied()),
    };
    let names = probe_names(&table, summary, probes);
    let probes: Vec<Value> = shown
        .chunks_exact(2)
        .zip(names)
        .map(|(pair, (name, at))| json!({ "name": name, "at": at, "q": picked(pair[0]), "v": picked(pair[1]) }))
        .collect();
    let time = table.columns.first().map_or(&[][..], Vec::as_slice);
    let end = time.last().copied().unwrap_or(0.0);
    let mut out = json!({
        "rows": table.count(),
        "end": end,
        "kept": rows.as_deref().map(u32),
        "probes": probes,
        "forces": forces(&table, time, summary, &contacts)?,
        "contacts": episodes(&contacts)?,
        "left_out": left_out,
    });
    if folder.has(&named(shape::FILE)) {
        let shapes = drawn_shapes(&folder.numbers(&named(shape::FILE))?)?;
        let alone = shapes.iter().find(|(body, _)| body.is_empty()).map(|(_, shape)| shape.clone());
        out["shape"] = json!(alone);
        out["bodies"] = shapes.into_iter().filter(|(body, _)| !body.is_empty()).collect();
    }
    Ok(out)
}

/// Adds to the notes of a page what the drawings of `run` leave out, each sentence once.
pub(super) fn add_left_out(notes: &mut Value, run: &mut Value) {
    let left_out = run["left_out"].take();
    let mut all = notes.as_array().cloned().unwrap_or_default();
    for sentence in left_out.as_array().into_iter().flatten() {
        if !all.contains(sentence) {
            all.push(sentence.clone());
        }
    }
    *notes = Value::Array(all);
}

/// Columns that supports add after those of the walls: four of each round one, and the work of
/// each.
fn beside(summary: &Value) -> usize {
    let supports = summary["scene"]["supports"].as_array().map_or(&[][..], Vec::as_slice);
    supports.iter().map(|support| if support["shape"] == "round" { 5 } else { 1 }).sum()
}

/// Names of the probes, and where each is: from the scene in the summary, else from the header.
fn probe_names(table: &Numbers, summary: &Value, count: usize) -> Vec<(String, Value)> {
    let listed = summary["scene"]["probes"].as_array().filter(|list| list.len() == count);
    let of_header = |index: usize| {
        let name = table.header.get(1 + 2 * index).map_or("", String::as_str);
        let name = name.strip_prefix("displacement").unwrap_or(name);
        name.strip_suffix("_m").unwrap_or(name).trim_start_matches('_').to_owned()
    };
    (0..count)
        .map(|index| match listed.and_then(|list| list.get(index)) {
            Some(probe) => {
                let name = probe["name"].as_str().unwrap_or_default();
                (name.to_owned(), drawn_at(in_keys(&probe["at"]), summary))
            }
            None => (of_header(index), Value::Null),
        })
        .collect()
}

/// The contact episodes.
fn episodes(cells: &Cells) -> Result<Value> {
    let column = |name: &str| Ok::<_, Error>(f64(&cells.column(name)?));
    Ok(json!({
        "count": cells.rows.len(),
        "wall": words((0..cells.rows.len()).map(|row| cells.text(row, "wall"))),
        "start": column("start_s")?,
        "end": column("end_s")?,
        "impulse": column("impulse_N_s")?,
        "peak": column("peak_force_N")?,
        "approach": column("approach_speed_m_per_s")?,
        "departure": column("departure_speed_m_per_s")?,
    }))
}

/// The force of each wall, and the magnitude of that of each round support, over the rows, within
/// contacts of finite force, and 0 elsewhere; of a contact that a spring pushes for less than
/// [`FEW_ROWS`] rows the peak. An impact has no finite force; its impulse is among the contacts.
fn forces(table: &Numbers, time: &[f64], summary: &Value, contacts: &Cells) -> Result<Vec<Value>> {
    let list = |key: &str| summary["scene"][key].as_array().map_or(&[][..], Vec::as_slice);
    let (walls, supports) = (list("walls"), list("supports"));
    let (start, end) = (contacts.column("start_s")?, contacts.column("end_s")?);
    let (peak, impulse) = (contacts.column("peak_force_N")?, contacts.column("impulse_N_s")?);
    let penalty = summary["scheme"].as_str().is_some_and(|scheme| scheme.starts_with("penalty"));
    let spacing = time.get(1).copied().unwrap_or(0.0);
    // `motion` has checked the number of columns.
    let from = table.columns.len().saturating_sub(2 * walls.len() + beside(summary));
    let column = |index: usize| table.columns.get(index).map_or(&[][..], Vec::as_slice);
    let of_wall = |(index, wall)| (wall, Cow::Borrowed(column(from + 2 * index)));
    let of_hole = |(index, hole)| {
        let [y, z] = [0, 2].map(|part: usize| column(from + 2 * walls.len() + 4 * index + part));
        (hole, Cow::Owned(y.iter().zip(z).map(|(y, z)| y.hypot(*z)).collect::<Vec<f64>>()))
    };
    let holes = supports.iter().filter(|support| support["shape"] == "round").enumerate().map(of_hole);
    let mut out = Vec::new();
    for (place, force) in walls.iter().enumerate().map(of_wall).chain(holes) {
        let name = place["name"].as_str().unwrap_or_default();
        let mut shown = vec![0.0; force.len()];
        let here = (0..peak.len()).filter(|&k| peak[k].is_finite() && contacts.text(k, "wall") == name);
        let spring = penalty || !place["law"]["stiffness_n_per_m"].is_null();
        let mut any = false;
        let mut peaks = Vec::new();
        for k in here {
            any = true;
            if spring && end[k] - start[k] < FEW_ROWS * spacing {
                let top = peak[k].copysign(impulse[k]);
                peaks.extend([(start[k], 0.0), (0.5 * (start[k] + end[k]), top), (end[k], 0.0)]);
                continue;
            }
            // A row has the mean since the row before: the first after the end has a share.
            let first = time.partition_point(|&t| t < start[k]);
            let last = if end[k].is_nan() { time.len() } else { time.partition_point(|&t| t < end[k]) + 1 };
            let last = last.min(time.len());
            if let (Some(to), Some(of)) = (shown.get_mut(first..last), force.get(first..last)) {
                to.copy_from_slice(of);
            }
        }
        if !any {
            continue;
        }
        // The rows that are not 0, and the neighbours where the force begins and ends.
        let not_0 = |i: usize| shown.get(i).is_some_and(|f| *f != 0.0);
        let edge = |i: usize| i == 0 || i + 1 == shown.len() || not_0(i) || not_0(i + 1) || not_0(i.wrapping_sub(1));
        let mut kept: Vec<usize> = (0..shown.len()).filter(|&i| edge(i)).collect();
        if kept.len() > MOST_ROWS {
            kept = extremes(&[&shown], shown.len(), MOST_ROWS).unwrap_or(kept);
        }
        let mut points: Vec<(f64, f64)> = kept.iter().filter_map(|&i| Some((*time.get(i)?, shown[i]))).collect();
        points.extend(peaks);
        sort_by_number(&mut points, |a| a.0);
        let (time, force): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        out.push(json!({ "place": name, "time": f64(&time), "force": f32(force.into_iter()) }));
    }
    Ok(out)
}

/// The shape of the system, without a name, or of each body: where its stations are, and their
/// displacement over time.
fn drawn_shapes(table: &Numbers) -> Result<Vec<(String, Value)>> {
    let (Some(time), Some(stations)) = (table.columns.first(), Stations::of(&table.header)) else {
        return Err(table.wrong("its columns are not time_s and the displacement at each station"));
    };
    let every = (table.count() * table.columns.len()).div_ceil(MOST_SHAPE).max(1);
    let picked = |column: &[f64]| column.iter().copied().step_by(every).collect::<Vec<_>>();
    let time = picked(time);
    let shape = |body: &BodyStations| {
        // Row by row, so that the shape at an instant lies together: along y, then along z.
        let own = stations.columns(body).filter_map(|column| table.columns.get(column + 1));
        let columns: Vec<Vec<f64>> = own.map(|column| picked(column)).collect();
        let values: Vec<f64> =
            (0..time.len()).flat_map(|row| columns.iter().filter_map(move |c| c.get(row).copied())).collect();
        let shape = json!({
            "stations": body.places,
            "planes": stations.planes,
            "time": f64(&time),
            "u": i16(&values),
        });
        (body.name.clone(), shape)
    };
    Ok(stations.bodies.iter().map(shape).collect())
}
