//! Points of other results beneath branches of orbits: read from their tables, written as
//! `beneath.csv`.

use super::compare::folder_of;
use super::csv::{self, digits};
use super::manifest::{self, MANIFEST};
use crate::case::{CaseFile, Key, MOST_TABLE_BYTES, open_regular, read_text};
use crate::error::{Error, Result};
use crate::orbit::Kind;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The file beside the branches.
pub const FILE: &str = "beneath.csv";

/// The column of approach speeds, here and in the tables of contacts and of instants.
const SPEED: &str = "approach_speed_m_per_s";

/// Writes the points: the value of the key, under the name `column`, and the approach speed.
pub fn write(path: &Path, column: &str, points: &[(f64, f64)]) -> Result<()> {
    let rows = points.iter().map(|(x, y)| vec![digits(Some(*x)), digits(Some(*y))]);
    csv::table(path, &[column, SPEED], rows)
}

/// The approach speeds of results over `key`, whose values tables have in `column`: of a sweep and
/// of branches over this key, and of one run, orbit or comparison (of its exact motion, else of its
/// first method) at the value of its case. `path` is their folder, or the table of a sweep.
///
/// # Errors
/// [`Error::Io`] for results that cannot be read or have no approach speeds over a key;
/// [`Error::Unknown`] for a table without the column; [`Error::Invalid`] for a run whose case has
/// no value of the key.
pub fn read(path: &Path, key: &Key, column: &str) -> Result<Vec<(f64, f64)>> {
    if path.is_file() {
        return sweep(path, column);
    }
    let wrong = |reason: &str| Error::io(path.display(), reason.to_owned(), true);
    if !path.is_dir() {
        return Err(wrong("not a regular file; expected a folder of results, or the sweep.csv of `signorini sweep`"));
    }
    let expected = "expected a folder of results of sweep, continue, orbit, run or compare";
    let Some(manifest) = manifest::read(path) else {
        return Err(wrong(&format!("holds no {MANIFEST} that can be read; {expected}")));
    };
    if !manifest::is_finished(&manifest) {
        return Err(wrong("its results are not finished: a run was interrupted, or is still at work"));
    }
    match manifest["request"]["command"].as_str().unwrap_or_default() {
        "sweep" => sweep(&path.join("sweep.csv"), column),
        "continue" => branches(path, column),
        "run" => run(path, key),
        "compare" => run(&best_method(path)?, key),
        "orbit" => {
            let case = toml::to_string(&manifest["case_file"]).map_err(|error| wrong(&error.to_string()))?;
            contacts(path, key, &CaseFile::from_text(&case, &path.display().to_string(), path))
        }
        other => Err(wrong(&format!("holds results of {other:?}; {expected}"))),
    }
}

/// The approach speeds of the contacts of one run.
fn run(folder: &Path, key: &Key) -> Result<Vec<(f64, f64)>> {
    contacts(folder, key, &CaseFile::read(folder.join("summary.json"))?)
}

/// The folder of the exact motion of a comparison, or else of its first method with a result.
fn best_method(path: &Path) -> Result<PathBuf> {
    let table = Table::open(&path.join("compare.csv"))?;
    let (method, failure) = (table.place("method")?, table.place("failure")?);
    let records = table.records()?;
    let ran: Vec<&str> =
        records.iter().filter(|row| row.get(failure) == Some("")).filter_map(|row| row.get(method)).collect();
    let exact = ran.iter().find(|name| **name == "event").or(ran.first());
    let none = || Error::io(path.display(), "no method of the comparison has a result", true);
    Ok(path.join(folder_of(exact.ok_or_else(none)?)))
}

/// The approach speeds of the contacts of one run or orbit, at the value that its case has of
/// `key`.
fn contacts(folder: &Path, key: &Key, case: &CaseFile) -> Result<Vec<(f64, f64)>> {
    let found = case.get(key)?.map(|value| value.to_string());
    let Some(x) = found.as_ref().and_then(|text| text.parse::<f64>().ok()) else {
        let value = found.unwrap_or_else(|| "no value, or several".to_owned());
        let expected = format!("results of a case with a number as {key}");
        return Err(Error::invalid(format!("{}: {key}", folder.display()), value, expected));
    };
    let table = Table::open(&folder.join("contacts.csv"))?;
    let speed = table.place(SPEED)?;
    Ok(table.records()?.iter().filter_map(|record| Some((x, number(record, speed)?))).collect())
}

/// The approach speeds along branches, of the events at which the body arrives at a wall.
fn branches(folder: &Path, column: &str) -> Result<Vec<(f64, f64)>> {
    let path = folder.join("branches.json");
    let wrong = |reason: String| Error::io(path.display(), reason, true);
    let document: Value = serde_json::from_str(&read_text(&path, MOST_TABLE_BYTES).map_err(&wrong)?)
        .map_err(|error| wrong(format!("not valid JSON: {error}")))?;
    let arrives = |event: &Value| {
        let kind = event["kind"].as_str().and_then(|name| name.parse().ok());
        kind.is_some_and(Kind::is_approach)
    };
    let table = Table::open(&folder.join("branches.csv"))?;
    let (own, branch) = (table.place(column)?, table.place("branch")?);
    let mut points = Vec::new();
    for record in table.records()? {
        let (Some(x), Some(branch)) = (number(&record, own), number(&record, branch)) else { continue };
        let events = document["branches"][(branch as usize).wrapping_sub(1)]["events"].as_array();
        for (event, _) in events.into_iter().flatten().enumerate().filter(|(_, event)| arrives(event)) {
            let speed = table.place(&format!("speed_{}_m_per_s", event + 1))?;
            points.extend(number(&record, speed).map(|y| (x, y)));
        }
    }
    Ok(points)
}

/// The approach speeds of a sweep: of the instants beside its table, else the column of the table
/// that begins with `approach_speed`.
fn sweep(path: &Path, column: &str) -> Result<Vec<(f64, f64)>> {
    let table = Table::open(path)?;
    let own = table.place(column)?;
    let without_speeds = || {
        let reason = "the sweep has no approach speeds; expected one with --samples impacts, or with --measure \
                      approach_speed_max";
        Error::io(path.display(), reason, true)
    };
    let rows = table.records()?;
    let samples = path.with_file_name("samples.csv");
    if !samples.is_file() {
        let speed = table.header.iter().position(|name| name.starts_with("approach_speed"));
        let speed = speed.ok_or_else(without_speeds)?;
        return Ok(rows.iter().filter_map(|row| Some((number(row, own)?, number(row, speed)?))).collect());
    }
    let of_row: BTreeMap<&str, f64> = rows.iter().filter_map(|row| Some((row.get(0)?, number(row, own)?))).collect();
    let table = Table::open(&samples)?;
    let speed = table.header.iter().position(|name| name == SPEED).ok_or_else(without_speeds)?;
    let point = |record: &::csv::StringRecord| Some((*of_row.get(record.get(0)?)?, number(record, speed)?));
    Ok(table.records()?.iter().filter_map(point).collect())
}

fn number(record: &::csv::StringRecord, index: usize) -> Option<f64> {
    record.get(index).and_then(|text| text.parse().ok())
}

/// A table of results: its file, and the names of its columns.
struct Table {
    path: PathBuf,
    header: ::csv::StringRecord,
}

impl Table {
    fn open(path: &Path) -> Result<Self> {
        let header = reader(path)?.headers().map_err(|error| failed(path, &error))?.clone();
        Ok(Self { path: path.to_owned(), header })
    }

    /// The index of the column of that name.
    fn place(&self, name: &str) -> Result<usize> {
        self.header.iter().position(|own| own == name).ok_or_else(|| self.unknown(name))
    }

    fn unknown(&self, name: &str) -> Error {
        let known = self.header.iter().map(str::to_owned).collect();
        Error::Unknown { kind: "column of the results", name: name.to_owned(), known }
    }

    fn records(&self) -> Result<Vec<::csv::StringRecord>> {
        let all = reader(&self.path)?.into_records().collect::<std::result::Result<_, _>>();
        all.map_err(|error| failed(&self.path, &error))
    }
}

fn reader(path: &Path) -> Result<::csv::Reader<std::io::Take<std::fs::File>>> {
    let opened = open_regular(path).map_err(|reason| Error::io(path.display(), reason, true));
    opened.map(|(file, _)| ::csv::Reader::from_reader(file))
}

fn failed(path: &Path, error: &::csv::Error) -> Error {
    Error::io(path.display(), error.to_string(), true)
}
