//! The data of pictures: the axes of a sweep, and the columns of its tables by name.

use super::measure::{Measure, Scope};
use super::seeds::asked;
use super::table::{HALF_WIDTH, ONE_AT_A_TIME, TABLE, Table};
use crate::error::amount;
use crate::output::csv::words;
use crate::output::figure::Scale;
use crate::study::realisations::RealisationCount;
use serde_json::{Map, Value};
use std::path::Path;

/// An axis as recorded in `request.json`.
pub(super) struct SweepAxis {
    pub column: String,
    pub key: String,
    pub scale: Scale,
    pub follows: bool,
    /// Number of its values.
    pub count: u64,
}

/// The data of a picture.
pub(super) struct Source<'a> {
    pub folder: &'a Path,
    pub title: &'a str,
    pub axes: Vec<SweepAxis>,
    pub random: bool,
    pub one_at_a_time: bool,
    /// How many realisations of the random loads every row has.
    pub seeds: Option<RealisationCount>,
    pub columns: Vec<String>,
    pub sample_columns: Vec<String>,
    /// The names of the walls, of the supports and of the probes.
    pub walls: Vec<String>,
    pub supports: Vec<String>,
    pub places: Vec<String>,
    probes: Vec<String>,
}

impl<'a> Source<'a> {
    pub fn new(folder: &'a Path, request: &Map<String, Value>, title: &'a str) -> Self {
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        let list = |key: &str| {
            let list = request.get(key).and_then(Value::as_array);
            list.map_or_else(Vec::new, |list| list.iter().map(text).collect::<Vec<_>>())
        };
        let along = |axis: &Value| {
            let values = text(&axis["values"]);
            let log = values.starts_with("Log") || values.contains("log: true");
            SweepAxis {
                column: text(&axis["column"]),
                key: text(&axis["keys"][0]["key"]),
                scale: if log { Scale::Log } else { Scale::Linear },
                follows: axis["follow"] != "No",
                count: axis["count"].as_u64().unwrap_or(0),
            }
        };
        Self {
            folder,
            title,
            axes: request
                .get("vary")
                .and_then(Value::as_array)
                .map_or_else(Vec::new, |axes| axes.iter().map(along).collect()),
            random: request.get("random").is_some_and(|random| !random.is_null()),
            one_at_a_time: request.get(ONE_AT_A_TIME).and_then(Value::as_bool).unwrap_or(false),
            seeds: asked(request),
            columns: list("columns"),
            sample_columns: list("sample_columns"),
            walls: list("wall_names"),
            supports: list("support_names"),
            places: list("place_names"),
            probes: list("probe_names"),
        }
    }
}

impl Source<'_> {
    /// True if rows have attractors.
    pub fn tells_attractors(&self) -> bool {
        self.columns.iter().any(|column| column == Measure::Attractor.name())
    }

    /// The wall, support or probe of a column of `measure`, by its own name; by the word in the
    /// column's name where an older version has recorded no names.
    pub fn place(&self, column: &str, measure: &str) -> String {
        let word = place_of(column, measure);
        let names = match measure.parse::<Measure>().map(Measure::scope) {
            Ok(Scope::Wall) => &self.walls,
            Ok(Scope::Support) => &self.supports,
            Ok(Scope::Place) => &self.places,
            Ok(Scope::Probe) => &self.probes,
            Ok(Scope::Row) | Err(_) => return word,
        };
        let own = words(names).iter().position(|one| *one == word).and_then(|at| names.get(at));
        own.cloned().unwrap_or(word)
    }
}

impl SweepAxis {
    /// True if its values are numbers.
    pub fn is_numeric(&self, source: &Source<'_>) -> bool {
        let Ok(table) = Table::open(&source.folder.join(TABLE)) else { return false };
        let Ok(index) = table.column(&self.column) else { return false };
        table.first(|row| row.number(index).is_some()).unwrap_or(false)
    }
}

/// True if `column` is that name, followed by a wall, a probe or a unit.
pub(super) fn of(column: &str, name: &str) -> bool {
    column == name || column.strip_prefix(name).is_some_and(|rest| rest.starts_with('_'))
}

/// The wall, support or probe in the name of a column of `measure`.
pub(super) fn place_of(column: &str, measure: &str) -> String {
    place_suffix(column, measure).trim_start_matches('_').to_owned()
}

/// The same with its sign.
pub(super) fn place_suffix(column: &str, measure: &str) -> String {
    let unit =
        measure.parse::<Measure>().ok().and_then(Measure::unit).map_or_else(String::new, |unit| format!("_{unit}"));
    let rest = column.strip_prefix(measure).unwrap_or_default();
    rest.strip_suffix(&unit).unwrap_or(rest).to_owned()
}

/// The column of the half width of the interval of `column`, one of `measure`.
pub(super) fn half_width_of(column: &str, measure: &str) -> String {
    format!("{measure}{HALF_WIDTH}{}", column.strip_prefix(measure).unwrap_or_default())
}

/// True for the column of a half width.
pub(super) fn is_half_width(column: &str, measure: &str) -> bool {
    column.strip_prefix(measure).is_some_and(|rest| of(rest, HALF_WIDTH))
}

/// A cell, rounded to the digits of a label.
pub(super) fn short(cell: &str) -> String {
    cell.parse().map_or_else(|_| cell.to_owned(), |x| amount(x, 5))
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn a_cell_is_written_as_a_person_writes_it() {
        let cells = ["0.000000000000001", "2.0", "0.02", "1.23456789e-4", "0.30000000000000004", "event", ""];
        assert_eq!(cells.map(short), ["1e-15", "2", "0.02", "1.2346e-4", "0.3", "event", ""]);
    }
}
