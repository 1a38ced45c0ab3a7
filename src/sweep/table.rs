//! Reads tables line by line.

use crate::case::open_regular;
use crate::error::{Error, Result};
use crate::output::csv::digits;
use serde_json::Value;
use std::fs::File;
use std::io::Take;
use std::path::{Path, PathBuf};

/// File names of the table of the rows, of that of their instants, and of that of the realisations
/// of random loads.
pub(super) const TABLE: &str = "sweep.csv";
pub(super) const SAMPLES: &str = "samples.csv";
pub(super) const REALISATIONS: &str = "realisations.csv";

/// The columns of the number of a realisation, and of the number of realisations in the means of a
/// row.
pub(super) const REALISATION: &str = "realisation";
pub(super) const SEEDS: &str = "seeds";

/// The entries of a request whose rows have as many realisations as their intervals take.
pub(super) const UNTIL_INTERVAL: &str = "until_interval";
pub(super) const MOST_SEEDS: &str = "most_seeds";

/// The entry of a request whose axes are varied one at a time.
pub(super) const ONE_AT_A_TIME: &str = "one_at_a_time";

/// What follows the name of a measure in the name of the column of the half width of its interval.
pub(super) const HALF_WIDTH: &str = "_half_width_95";

/// A cell of numbers with blanks between them.
pub(super) fn list_of(numbers: &[f64]) -> String {
    numbers.iter().map(|number| digits(Some(*number))).collect::<Vec<_>>().join(" ")
}

/// The numbers of a cell, with blanks between them; `None` of a cell without any.
pub(super) fn numbers_of(cell: &str) -> Option<Vec<f64>> {
    let numbers: Vec<f64> = cell.split_whitespace().map(str::parse).collect::<std::result::Result<_, _>>().ok()?;
    (!numbers.is_empty()).then_some(numbers)
}

/// A CSV file with a header.
pub(super) struct Table {
    path: PathBuf,
    reader: csv::Reader<Take<File>>,
    header: csv::StringRecord,
}

/// One row.
pub(super) struct CsvRow<'a>(&'a csv::StringRecord);

impl CsvRow<'_> {
    pub fn text(&self, index: usize) -> &str {
        self.0.get(index).unwrap_or_default()
    }

    /// The number in that cell; `None` unless it is a finite number.
    pub fn number(&self, index: usize) -> Option<f64> {
        self.text(index).parse().ok().filter(|x: &f64| x.is_finite())
    }
}

impl Table {
    pub fn open(path: &Path) -> Result<Self> {
        let (file, _) = open_regular(path).map_err(|reason| Error::io(path.display(), reason, false))?;
        let mut reader = csv::Reader::from_reader(file);
        let header = reader.headers().map_err(|error| failed(path, &error))?.clone();
        Ok(Self { path: path.to_owned(), reader, header })
    }

    /// Index of the column of that name.
    pub fn column(&self, name: &str) -> Result<usize> {
        self.header.iter().position(|column| column == name).ok_or_else(|| Error::Unknown {
            kind: "column of the table",
            name: name.to_owned(),
            known: self.header.iter().map(str::to_owned).collect(),
        })
    }

    /// Calls `take` with every line.
    pub fn each(mut self, mut take: impl FnMut(CsvRow<'_>)) -> Result<()> {
        let mut record = csv::StringRecord::new();
        while self.reader.read_record(&mut record).map_err(|error| failed(&self.path, &error))? {
            take(CsvRow(&record));
        }
        Ok(())
    }

    /// The first lines, at most `most`, as objects.
    ///
    /// # Errors
    /// [`Error::Io`] for a line that cannot be read.
    pub fn objects(mut self, most: usize) -> Result<Vec<Value>> {
        let lines = self.reader.records().take(most);
        lines.map(|line| Ok(object(&self.header, &line.map_err(|error| failed(&self.path, &error))?))).collect()
    }

    /// The value of `of` for the first line; `None` for an empty table.
    pub fn first<T>(mut self, of: impl Fn(CsvRow<'_>) -> T) -> Option<T> {
        let mut record = csv::StringRecord::new();
        matches!(self.reader.read_record(&mut record), Ok(true)).then(|| of(CsvRow(&record)))
    }
}

/// The cells of a line by the columns of its `header`: numbers, words, and null for an empty cell.
pub(super) fn object<'a>(header: impl IntoIterator<Item = &'a str>, cells: impl IntoIterator<Item = &'a str>) -> Value {
    let value = |cell: &str| match (cell.parse::<i64>(), cell.parse::<f64>()) {
        _ if cell.is_empty() => Value::Null,
        (Ok(number), _) => Value::from(number),
        (_, Ok(number)) if number.is_finite() => Value::from(number),
        _ => Value::from(cell),
    };
    header.into_iter().zip(cells).map(|(name, cell)| (name.to_owned(), value(cell))).collect()
}

fn failed(path: &Path, error: &csv::Error) -> Error {
    Error::io(path.display(), error.to_string(), false)
}

/// One record of a CSV file, with a line break at its end only.
pub(super) fn line_of(cells: &[String]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (index, cell) in cells.iter().enumerate() {
        if index > 0 {
            bytes.push(b',');
        }
        if cell.contains([',', '"']) {
            bytes.extend(format!("\"{}\"", cell.replace('"', "\"\"")).into_bytes());
        } else {
            bytes.extend(cell.as_bytes());
        }
    }
    bytes.push(b'\n');
    bytes
}

/// The cells of one record.
pub(super) fn cells_of(line: &[u8]) -> csv::StringRecord {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(line);
    reader.records().next().and_then(std::result::Result::ok).unwrap_or_default()
}

/// `record` with the number `number` in a column, as a line.
pub(super) fn with_number(record: &csv::StringRecord, column: usize, number: u64) -> Vec<u8> {
    let number = digits(Some(number as f64));
    let cell = |(at, cell): (usize, &str)| if at == column { number.clone() } else { cell.to_owned() };
    line_of(&record.iter().enumerate().map(cell).collect::<Vec<_>>())
}

/// Units at the end of column names, and in labels; longer ones first.
const UNITS: [(&str, &str); 21] = [
    ("_kg_per_m3", "kg/m³"),
    ("_N_m_per_rad", "N m/rad"),
    ("_N_s_per_m", "N s/m"),
    ("_rad_per_s", "rad/s"),
    ("_m3_per_N", "m³/N"),
    ("_kg_per_m", "kg/m"),
    ("_N_per_m", "N/m"),
    ("_m_per_s", "m/s"),
    ("_per_s", "1/s"),
    ("_cycles", "cycles"),
    ("_N_s", "N s"),
    ("_rad", "rad"),
    ("_kg", "kg"),
    ("_Hz", "Hz"),
    ("_Pa", "Pa"),
    ("_m3", "m³"),
    ("_m2", "m²"),
    ("_m", "m"),
    ("_s", "s"),
    ("_N", "N"),
    ("_W", "W"),
];

/// A column's name without its unit, in words.
pub(super) fn quantity(column: &str) -> String {
    parts(column).0.replace('_', " ")
}

fn parts(column: &str) -> (&str, &'static str) {
    let found = UNITS.iter().find_map(|(end, unit)| Some((column.strip_suffix(end)?, *unit)));
    found.unwrap_or((column, "–"))
}

/// A column's name as the label of an axis: `Displacement max (m)`.
pub(super) fn label(column: &str) -> String {
    let (name, unit) = parts(column);
    let mut letters = name.replace('_', " ");
    if let Some(first) = letters.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    format!("{letters} ({unit})")
}

#[cfg(test)]
mod tests {
    use super::{HALF_WIDTH, label};

    #[test]
    fn labels_say_quantity_and_unit() {
        assert_eq!(label("frequency_Hz"), "Frequency (Hz)");
        assert_eq!(label("approach_speed_max_upper_m_per_s"), "Approach speed max upper (m/s)");
        assert_eq!(label("contacts_upper"), "Contacts upper (–)");
        assert_eq!(label("impulse_upper_N_s"), "Impulse upper (N s)");
    }

    #[test]
    fn the_page_knows_the_columns_of_half_widths() {
        let script = include_str!("../report/page/js/intervals.js");
        assert!(script.contains(&format!("HALF_WIDTH = {HALF_WIDTH:?};")));
    }
}
