//! The folder of a sweep: what it was asked, how far it has come, and what it may replace.

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

/// What a folder holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// Nothing of this request.
    Empty,
    /// Some of its rows.
    Begun,
    /// All of them, in tables.
    Finished,
}

impl Plan {
    /// What is asked, as the folder remembers it: rows of two requests that are equal here have the
    /// same bits on one machine.
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
                "judged": sweep.judged,
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
    json!({ "column": column, "keys": keys, "count": axis.count(), "values": format!("{:?}", axis.values), "follow": format!("{:?}", axis.follow) })
}

/// A digest of the sines and exponentials of this machine: its mathematical library decides on
/// their last bits, and so on those of the rows.
pub(super) fn arithmetic() -> String {
    let mut bytes = Vec::new();
    for i in 0..4096 {
        let x = f64::from(i) * 0.037_109_375 + 1e-3;
        bytes.extend([x.sin(), x.cos(), (-x).exp(), x.ln()].map(f64::to_le_bytes).concat());
    }
    // Lanes with fused products have one set of bits, those without another.
    bytes.push(u8::from(Width::available().contains(&Width::Avx2)));
    sha256(&bytes)
}

/// What `folder` holds of `request`. With `force` whatever it holds is taken for nothing.
///
/// # Errors
/// [`Error::Io`], a wrong request, for results of another request.
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

/// What a folder remembers beside the request, which changes no number.
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

/// Says in `folder` what was asked of it and which files it holds.
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
    // What is not there is none of another request's to take away.
    let files: &[&str] = if finished {
        &[TABLE, SAMPLES, "summary.json", "sweep.svg", "sweep.pdf", "sweep.png"]
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

/// The request of a shard: that of the whole, and which part.
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

/// A wrong request about `folder`.
pub(super) fn wrong(folder: &Path, reason: String) -> Error {
    Error::io(folder.display(), reason, true)
}
