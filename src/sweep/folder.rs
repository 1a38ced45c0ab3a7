//! The folder of a sweep: the request recorded in it, the rows done, and what may be replaced.

use super::attractors::ATTRACTORS;
use super::axis::Axis;
use super::picture::Picture;
use super::plan::Plan;
use super::request::Stretch;
use super::shard::Shard;
use super::table::{SAMPLES, TABLE};
use crate::batch::Width;
use crate::case::sha256;
use crate::error::{Error, Result};
use crate::output::asked::{asked, with};
use crate::output::atomic::write_whole;
use crate::output::json;
use crate::output::results::{self, FINGERPRINT};
use serde_json::{Map, Value, json};
use std::path::Path;

/// The contents of a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// No row of this request.
    Empty,
    /// Some of its rows, in the journal.
    Begun,
    /// All of its rows, in tables.
    Finished,
}

impl Plan {
    /// The part of the request that decides on the numbers: if it is equal for two requests, their
    /// rows have the same bits on one machine.
    pub(crate) fn request(&self) -> Map<String, Value> {
        let sweep = &self.sweep;
        let axes: Vec<Value> = self.axis_columns().map(|(axis, column)| described(axis, column)).collect();
        let random = sweep
            .random
            .map(|random| json!({ "kind": random.design.name(), "points": random.points, "seed": random.seed }));
        let stretch = match sweep.stretch {
            Stretch::Case => json!("the case's"),
            Stretch::Periods { settle, keep } => json!({ "settle_periods": settle, "keep_periods": keep }),
            Stretch::Seconds { settle, keep } => json!({ "settle_s": settle, "keep_s": keep }),
        };
        let methods = [self.method];
        with(
            asked("sweep", &self.base, &methods),
            json!({
                "program": program(),
                "case_text".to_owned() + FINGERPRINT: sweep.case.text().ok().map(|text| sha256(text.as_bytes())),
                "scheme": sweep.scheme,
                "vary": axes,
                "random": random,
                "run": stretch,
                "kernel": format!("{:?}", sweep.kernel).to_lowercase(),
                "columns": self.header(),
                "sample_columns": sweep.samples.map(|_| self.sample_header()),
                "most_samples": sweep.samples.map(|_| sweep.most_samples),
                "judged": sweep.rows_judged().min(self.count()),
                "wall_names": self.base.scene.walls.iter().map(|wall| wall.name.as_str()).collect::<Vec<_>>(),
                "rows": self.count(),
                "rows_of_a_chain": self.chain_rows(),
            }),
        )
    }
}

fn program() -> String {
    format!("signorini {}", env!("CARGO_PKG_VERSION"))
}

fn described(axis: &Axis, column: &str) -> Value {
    let keys: Vec<Value> =
        axis.targets.iter().map(|(target, factor)| json!({ "key": target.to_string(), "factor": factor })).collect();
    json!({
        "column": column,
        "keys": keys,
        "count": axis.count(),
        "values": format!("{:?}", axis.values),
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

/// What `folder` contains of `request`. With `force`, its contents are ignored.
///
/// # Errors
/// [`Error::Io`] (a wrong request) if it contains results of another request.
pub(super) fn look(folder: &Path, request: &Map<String, Value>, force: bool) -> Result<State> {
    if force {
        return Ok(State::Empty);
    }
    results::check(folder, request)?;
    let Some(manifest) = results::read(folder) else { return Ok(State::Empty) };
    let listed = |name: &str| manifest["files"].as_array().is_some_and(|files| files.iter().any(|file| file == name));
    Ok(match (listed(TABLE) && folder.join(TABLE).exists(), listed(super::journal::JOURNAL)) {
        (true, _) => State::Finished,
        (false, true) => State::Begun,
        (false, false) => State::Empty,
    })
}

/// What is recorded in a folder beside the request, and changes no number.
#[derive(Debug, Clone)]
pub(super) struct Study {
    pub case_text: String,
    pub title: String,
    pub picture: Picture,
}

impl Study {
    pub fn of(plan: &Plan) -> Result<Self> {
        let sweep = &plan.sweep;
        Ok(Self { case_text: sweep.case.text()?, title: sweep.title.clone(), picture: sweep.picture.clone() })
    }

    pub fn read(manifest: &Value) -> Self {
        let text = |key: &str| manifest[key].as_str().unwrap_or_default().to_owned();
        let picture = Picture::from_document(&manifest["picture"]);
        Self { case_text: text("case_text"), title: text("title"), picture }
    }
}

/// Writes to `folder` the request and the list of its files.
///
/// # Errors
/// [`Error::Io`] where it cannot be written.
pub(super) fn say(
    folder: &Path,
    request: &Map<String, Value>,
    study: &Study,
    shard: Shard,
    finished: bool,
) -> Result<()> {
    // Files that do not exist are not removed.
    let files: &[&str] = if finished {
        &[TABLE, SAMPLES, ATTRACTORS, "summary.json", "sweep.svg", "sweep.pdf", "sweep.png", "report.html"]
    } else {
        &[super::journal::JOURNAL]
    };
    let manifest = json!({
        "program": program(),
        "made": humantime::format_rfc3339_seconds(std::time::SystemTime::now()).to_string(),
        "request": request,
        "shard": shard.to_string(),
        "arithmetic": arithmetic(),
        "case_text": study.case_text,
        "title": study.title,
        "picture": study.picture.document(),
        "files": files,
    });
    write_whole(&folder.join(results::MANIFEST), format!("{manifest:#}\n").as_bytes())
}

/// The request of a shard: that of the whole sweep, and the number of the shard.
pub(super) fn of_shard(mut request: Map<String, Value>, shard: Shard) -> Map<String, Value> {
    if shard != Shard::WHOLE {
        request.insert("shard".to_owned(), json!(shard.to_string()));
    }
    request
}

/// Writes `summary.json` of a sweep into `folder`.
///
/// # Errors
/// [`Error::Io`] where it cannot be written.
pub(crate) fn write_summary(folder: &Path, document: &Value) -> Result<()> {
    write_whole(&folder.join("summary.json"), json::text(document).as_bytes())
}

/// An error of a wrong request that concerns `folder`.
pub(super) fn wrong(folder: &Path, reason: String) -> Error {
    Error::io(folder.display(), reason, true)
}
