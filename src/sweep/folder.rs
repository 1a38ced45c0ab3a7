//! The folder of a sweep: the request recorded in it, the rows done, and whether its tables are as
//! they were written.

use super::attractors::ATTRACTORS;
use super::axis::Axis;
use super::block::JOURNAL;
use super::finish::Tables;
use super::layout::Layout;
use super::measure::Scope;
use super::picture::Picture;
use super::plan::Plan;
use super::request::Window;
use super::shard::Shard;
use super::table::{MOST_SEEDS, ONE_AT_A_TIME, REALISATIONS, SAMPLES, SEEDS, TABLE, Table, UNTIL_INTERVAL};
use crate::batch::Width;
use crate::case::{open_regular, sha256};
use crate::error::{Error, Result};
use crate::output::json;
use crate::output::manifest::{self, FINGERPRINT};
use crate::output::record::{Record, TABLES};
use crate::output::request;
use crate::output::results::Results;
use crate::study::realisations::RealisationCount;
use serde_json::{Map, Value, json};
use std::path::Path;

/// The tables of a sweep, each of which may be absent but the first.
const TABLE_NAMES: [&str; 4] = [TABLE, SAMPLES, ATTRACTORS, REALISATIONS];

/// The entry of the manifest with what a reader of the results must know.
const NOTES: &str = "remarks";

/// The contents of a folder.
#[derive(Debug)]
pub(super) enum State {
    /// No row of this request.
    Empty,
    /// Some of its rows, in the journal.
    Begun,
    /// All of its rows, in tables, which are as they were written, and what their reader must know.
    Finished { tables: Tables, records: Vec<(String, Record)>, notes: Vec<String> },
    /// Tables that are no longer as they were written, and which.
    Damaged(String),
}

impl Plan {
    /// The part of the request that decides on the numbers: if it is equal for two requests, their
    /// rows have the same bits on one machine.
    pub(crate) fn request(&self) -> Map<String, Value> {
        let sweep = &self.sweep;
        let axes: Vec<Value> = self.axis_columns().map(|(axis, column)| described(axis, column)).collect();
        let random = sweep
            .layout
            .random()
            .map(|random| json!({ "kind": random.design.name(), "points": random.points, "seed": random.seed }));
        let window = match sweep.window {
            Window::Case => json!("the case's"),
            Window::Periods { settle, keep } => json!({ "settle_periods": settle, "keep_periods": keep }),
            Window::Seconds { settle, keep } => json!({ "settle_s": settle, "keep_s": keep }),
        };
        let methods = [self.method];
        let mut request = request::extended(
            request::request("sweep", &self.base, &methods),
            json!({
                "program": request::program(),
                "case_text".to_owned() + FINGERPRINT: sweep.case.text().ok().map(|text| sha256(text.as_bytes())),
                "scheme": sweep.scheme,
                "vary": axes,
                "random": random,
                "run": window,
                "kernel": format!("{:?}", sweep.kernel).to_lowercase(),
                "columns": self.header(),
                "sample_columns": sweep.samples.map(|_| self.sample_header()),
                "most_samples": sweep.samples.map(|_| sweep.most_samples),
                "judged": sweep.rows_judged().min(self.count()),
                "wall_names": Scope::Wall.places(&self.base.scene),
                "place_names": Scope::Place.places(&self.base.scene),
                "support_names": Scope::Support.places(&self.base.scene),
                "probe_names": Scope::Probe.places(&self.base.scene),
                "rows": self.count(),
                "rows_of_a_chain": self.chain_rows(),
            }),
        );
        if sweep.keeps_work_rates() {
            // Runs of a version that kept depths in their place cannot go on.
            request.insert("work_rates".to_owned(), json!(true));
        }
        if sweep.layout == Layout::OneAtATime {
            request.insert(ONE_AT_A_TIME.to_owned(), json!(true));
        }
        match sweep.realisations {
            Some(RealisationCount::Exactly(count)) => {
                request.insert(SEEDS.to_owned(), json!(count));
            }
            Some(RealisationCount::Within { share, most, .. }) => {
                request.insert(UNTIL_INTERVAL.to_owned(), json!(share));
                request.insert(MOST_SEEDS.to_owned(), json!(most));
            }
            None => {}
        }
        request
    }
}

fn described(axis: &Axis, column: &str) -> Value {
    let keys: Vec<Value> =
        axis.targets.iter().map(|(target, factor)| json!({ "key": target.to_string(), "factor": factor })).collect();
    json!({
        "column": column,
        "keys": keys,
        "count": axis.values.count(),
        "values": axis.values.described(),
        "follow": format!("{:?}", axis.follow),
    })
}

/// A digest of sines and exponentials computed on this machine: their last bits, and so those of
/// the rows, depend on its mathematical library.
pub(super) fn arithmetic() -> String {
    let mut bytes = Vec::new();
    for i in 0..4096 {
        let x = f64::from(i) * 0.037_109_375 + 1e-3;
        bytes.extend([x.sin(), x.cos(), (-x).exp(), x.ln()].map(f64::to_le_bytes).concat());
    }
    // Results with fused multiply-add instructions differ from those without.
    bytes.push(u8::from(Width::available().contains(&Width::Avx2)));
    sha256(&bytes)
}

/// What `folder` contains of the request that its manifest names, which has `rows` rows.
pub(super) fn state(folder: &Path, rows: u64) -> State {
    let Some(manifest) = manifest::read(folder) else { return State::Empty };
    let listed = |name: &str| manifest::files(&manifest).any(|file| file == name);
    if !(listed(TABLE) && manifest::is_finished(&manifest)) {
        return if listed(JOURNAL) { State::Begun } else { State::Empty };
    }
    // The first line alone: what to do about it is being done.
    let damaged = |error: Error| State::Damaged(error.to_string().lines().next().unwrap_or_default().to_owned());
    let mut records = match verified(folder, &manifest) {
        Ok(records) => records,
        Err(error) => return damaged(error),
    };
    // A version that recorded nothing listed all names, whether there were such files or not.
    for name in TABLE_NAMES {
        let path = folder.join(name);
        if listed(name) && path.exists() && records.iter().all(|(known, _)| known != name) {
            let reason = |reason: String| Error::io(path.display(), reason, true);
            let found = open_regular(&path).map_err(reason).and_then(|(file, length)| {
                let record = Record::of(file).map_err(|error| reason(error.to_string()))?;
                if length > 0 { Ok(record) } else { Err(reason("is empty".to_owned())) }
            });
            match found {
                Ok(record) => records.push((name.to_owned(), record)),
                Err(error) => return damaged(error),
            }
        }
    }
    let path = folder.join(TABLE);
    let tables = match Tables::read(&path) {
        Ok(tables) => tables,
        Err(error) => return damaged(error),
    };
    let count = tables.rows();
    if count != rows {
        return State::Damaged(format!("{}: has {count} of {rows} rows", path.display()));
    }
    State::Finished { tables, records, notes: Study::read(&manifest).notes }
}

/// The tables in `folder` with what `manifest` records of each, which it still has; empty for a
/// manifest of a version that recorded nothing.
///
/// # Errors
/// [`Error::Io`], a wrong request, for a table that was emptied, shortened, changed or removed, or
/// is no regular file.
pub(super) fn verified(folder: &Path, manifest: &Value) -> Result<Vec<(String, Record)>> {
    let mut records = Vec::new();
    for name in TABLE_NAMES {
        if let Some(record) = Record::read(manifest, name) {
            record.verify(&folder.join(name))?;
            records.push((name.to_owned(), record));
        }
    }
    Ok(records)
}

/// What is recorded in a folder beside the request, and changes no number.
#[derive(Debug, Clone)]
pub(super) struct Study {
    pub case_text: String,
    pub title: String,
    pub picture: Picture,
    /// What a reader of the results must know.
    pub notes: Vec<String>,
}

impl Study {
    pub fn of(plan: &Plan) -> Result<Self> {
        let sweep = &plan.sweep;
        let (title, picture) = (sweep.title.clone(), sweep.picture.clone());
        Ok(Self { case_text: sweep.case.text()?, title, picture, notes: plan.notes() })
    }

    pub fn read(manifest: &Value) -> Self {
        let text = |key: &str| manifest[key].as_str().unwrap_or_default().to_owned();
        let picture = Picture::from_document(&manifest["picture"]);
        let notes = manifest[NOTES].as_array().into_iter().flatten();
        let notes = notes.filter_map(Value::as_str).map(str::to_owned).collect();
        Self { case_text: text("case_text"), title: text("title"), picture, notes }
    }
}

/// Adds to the manifest of `results` what is recorded beside the request.
pub(super) fn record_request(results: &mut Results, study: &Study, shard: Shard) {
    for (key, value) in [
        ("shard", json!(shard.to_string())),
        ("arithmetic", json!(arithmetic())),
        ("case_text", json!(study.case_text)),
        ("title", json!(study.title)),
        ("picture", study.picture.document()),
        (NOTES, json!(study.notes)),
    ] {
        results.add_to_manifest(key, value);
    }
}

/// Records what a reader of the results must know, of the case and of its runs.
pub(super) fn record_notes(results: &mut Results, notes: &[String]) {
    results.add_to_manifest(NOTES, json!(notes));
}

/// The request of a shard: that of the whole sweep, and the number of the shard.
pub(super) fn of_shard(mut request: Map<String, Value>, shard: Shard) -> Map<String, Value> {
    if shard != Shard::WHOLE {
        request.insert("shard".to_owned(), json!(shard.to_string()));
    }
    request
}

/// Adds `summary.json` of a sweep to `results`: `document`, and what is recorded of the tables.
/// Returns the whole document.
///
/// # Errors
/// [`Error::Io`] where it cannot be written.
pub(crate) fn write_summary(results: &mut Results, mut document: Value) -> Result<Value> {
    document[TABLES] = results.tables("")?;
    results.write("summary.json", json::text(&document))?;
    Ok(document)
}

/// Most rows in the document of `--json`.
const MOST_OBJECTS: usize = 10_000;

/// The first ten thousand rows of the sweep in `folder`, as objects.
///
/// # Errors
/// [`Error::Io`] for a table that cannot be read.
pub(crate) fn first_rows(folder: &Path) -> Result<Vec<Value>> {
    Table::open(&folder.join(TABLE))?.objects(MOST_OBJECTS)
}

/// An error of a wrong request that concerns `folder`.
pub(super) fn wrong(folder: &Path, reason: String) -> Error {
    Error::io(folder.display(), reason, true)
}
