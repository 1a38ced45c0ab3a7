//! Points of a sweep beneath branches of orbits: read from its tables, written as `beneath.csv`.

use super::csv::{self, digits};
use crate::case::open_regular;
use crate::error::{Error, Result};
use std::path::Path;

/// The file beside the branches.
pub const FILE: &str = "beneath.csv";

/// Writes the points: the value of the key, under the name `column`, and the approach speed.
///
/// # Errors
/// [`Error::Io`] where the file cannot be written.
pub fn write(path: &Path, column: &str, points: &[(f64, f64)]) -> Result<()> {
    let rows = points.iter().map(|(x, y)| vec![digits(Some(*x)), digits(Some(*y))]);
    csv::table(path, &[column, "approach_speed_m_per_s"].map(str::to_owned), rows)
}

/// Points of a sweep that vary `column`, to be drawn beneath: the approach speeds of the instants
/// beside the table, else the column of the table that begins with `approach_speed`.
///
/// # Errors
/// [`Error::Io`] for a table that cannot be read; [`Error::Unknown`] for one without the column.
pub fn read(path: &Path, column: &str) -> Result<Vec<(f64, f64)>> {
    let failed = |path: &Path, error: &::csv::Error| Error::io(path.display(), error.to_string(), true);
    let open = |path: &Path| {
        let opened = open_regular(path).map_err(|reason| Error::io(path.display(), reason, true));
        opened.map(|(file, _)| ::csv::Reader::from_reader(file))
    };
    let place = |header: &::csv::StringRecord, name: &str| header.iter().position(|own| own == name);
    if !path.is_file() {
        return Err(Error::io(
            path.display(),
            "not a regular file; expected the sweep.csv of `signorini sweep`".to_owned(),
            true,
        ));
    }
    let mut table = open(path)?;
    let header = table.headers().map_err(|error| failed(path, &error))?.clone();
    let unknown = |name: &str| Error::Unknown {
        kind: "column of the sweep",
        name: name.to_owned(),
        known: header.iter().map(str::to_owned).collect(),
    };
    let own = place(&header, column).ok_or_else(|| unknown(column))?;
    let number =
        |record: &::csv::StringRecord, index: usize| record.get(index).and_then(|text| text.parse::<f64>().ok());
    let samples = path.with_file_name("samples.csv");
    let speed = header.iter().position(|name| name.starts_with("approach_speed"));
    let mut of_row = std::collections::BTreeMap::new();
    let mut points = Vec::new();
    for record in table.records() {
        let record = record.map_err(|error| failed(path, &error))?;
        let (Some(row), Some(x)) = (record.get(0).map(str::to_owned), number(&record, own)) else { continue };
        of_row.insert(row, x);
        points.extend(speed.and_then(|index| number(&record, index)).map(|y| (x, y)));
    }
    if !samples.is_file() {
        return if speed.is_some() { Ok(points) } else { Err(unknown("approach_speed")) };
    }
    points.clear();
    let mut table = open(&samples)?;
    let header = table.headers().map_err(|error| failed(&samples, &error))?.clone();
    let Some(speed) = place(&header, "approach_speed_m_per_s") else {
        return Err(Error::Unknown {
            kind: "column of the sweep's instants",
            name: "approach_speed_m_per_s".to_owned(),
            known: header.iter().map(str::to_owned).collect(),
        });
    };
    for record in table.records() {
        let record = record.map_err(|error| failed(&samples, &error))?;
        let x = record.get(0).and_then(|row| of_row.get(row));
        points.extend(x.zip(number(&record, speed)).map(|(x, y)| (*x, y)));
    }
    Ok(points)
}
