//! The files of a folder of results, read and checked: a table that is missing or was changed since
//! it was written, and a file that is not what it should be, give an error that names the file, and
//! where it can line and column.

use super::{column, older};
use crate::case::{MOST_TABLE_BYTES, open_regular, read_text};
use crate::error::{Error, Result};
use crate::output::record::{MOST_BYTES, Record};
use csv::StringRecord;
use serde_json::{Value, json};
use std::io::Read;
use std::path::{Path, PathBuf};

/// A folder of results.
#[derive(Debug, Clone, Copy)]
pub(super) struct Folder<'a> {
    /// Where it is.
    pub path: &'a Path,
    /// Its `request.json`.
    pub manifest: &'a Value,
}

/// A table of numbers: names and values of its columns; an empty cell is NaN.
#[derive(Debug)]
pub(super) struct Numbers {
    /// The file, for errors.
    file: PathBuf,
    pub header: Vec<String>,
    pub columns: Vec<Vec<f64>>,
}

/// A table of text cells.
#[derive(Debug)]
pub(super) struct Cells {
    file: PathBuf,
    pub header: Vec<String>,
    pub rows: Vec<StringRecord>,
}

impl Folder<'_> {
    /// True if there is a file of that name, or was one when the results were written.
    pub fn has(&self, name: &str) -> bool {
        self.path.join(name).exists() || Record::read(self.manifest, name).is_some()
    }

    /// Rows and columns of the table in the file `name`.
    pub fn size(&self, name: &str) -> Result<(usize, usize)> {
        let file = self.path.join(name);
        let (source, _) = open_regular(&file).map_err(|reason| wrong(&file, reason))?;
        let failed = |error: csv::Error| wrong(&file, error.to_string()).caused_by(error);
        let mut reader = csv::Reader::from_reader(source);
        let columns = reader.byte_headers().map_err(failed)?.len();
        let (mut rows, mut row) = (0, csv::ByteRecord::new());
        while reader.read_byte_record(&mut row).map_err(failed)? {
            rows += 1;
        }
        Ok((rows, columns))
    }

    /// The JSON document in the file `name`, the one that was recorded when it was written.
    pub fn json(&self, name: &str) -> Result<Value> {
        let path = self.path.join(name);
        if let Some(record) = Record::read(self.manifest, name) {
            record.verify(&path)?;
        }
        let text = read_text(&path, MOST_TABLE_BYTES).map_err(|reason| wrong(&path, reason))?;
        let mut document = serde_json::from_str(&text)
            .map_err(|error| wrong(&path, format!("not valid JSON: {error}")).caused_by(error))?;
        older::rename(&mut document);
        Ok(document)
    }

    /// The bytes of the table in the file `name`, which is the one that was recorded when it was
    /// written; of a version that recorded nothing, whatever is there.
    fn table(&self, name: &str) -> Result<Vec<u8>> {
        let path = self.path.join(name);
        if let Some(record) = Record::read(self.manifest, name) {
            return record.bytes(&path);
        }
        let (mut source, length) = open_regular(&path).map_err(|reason| wrong(&path, reason))?;
        if length > MOST_BYTES {
            return Err(wrong(&path, format!("has {length} bytes; a table that is shown has {MOST_BYTES} at most")));
        }
        let mut bytes = Vec::new();
        let read = source.read_to_end(&mut bytes);
        read.map_err(|error| wrong(&path, error.to_string()).caused_by(error)).map(|_| bytes)
    }

    /// The table in the file `name`, all cells numbers.
    pub fn numbers(&self, name: &str) -> Result<Numbers> {
        let cells = self.cells(name)?;
        let mut columns = vec![Vec::with_capacity(cells.rows.len()); cells.header.len()];
        for (row, record) in cells.rows.iter().enumerate() {
            for (index, (cell, column)) in record.iter().zip(&mut columns).enumerate() {
                column.push(cells.number(row, index, cell)?);
            }
        }
        Ok(Numbers { file: cells.file, header: cells.header, columns })
    }

    /// The table in the file `name`; every row has as many cells as the header.
    pub fn cells(&self, name: &str) -> Result<Cells> {
        let file = self.path.join(name);
        let failed = |error: csv::Error| wrong(&file, error.to_string()).caused_by(error);
        let bytes = self.table(name)?;
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        let header = reader.headers().map_err(failed)?.iter().map(|name| older::renamed(name).to_owned()).collect();
        let rows = reader.records().collect::<std::result::Result<_, _>>().map_err(failed)?;
        Ok(Cells { file, header, rows })
    }
}

/// A wrong request: the file at `path` is not what it should be.
fn wrong(path: &Path, reason: impl Into<String>) -> Error {
    Error::io(path.display(), reason, true)
}

impl Numbers {
    /// Rows of the table.
    pub fn count(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// A wrong request: the file is not what it should be.
    pub fn wrong(&self, reason: impl Into<String>) -> Error {
        Error::io(self.file.display(), reason, true)
    }
}

impl Cells {
    /// The cell of that row in the column of that name; empty where there is none.
    pub fn text(&self, row: usize, name: &str) -> &str {
        let column = self.header.iter().position(|column| column == name);
        column.and_then(|column| self.rows.get(row)?.get(column)).unwrap_or_default()
    }

    /// The column of that name as numbers.
    pub fn column(&self, name: &str) -> Result<Vec<f64>> {
        let Some(index) = self.header.iter().position(|column| column == name) else {
            let reason = format!("has no column {name}; it has {}", self.header.join(", "));
            return Err(Error::io(self.file.display(), reason, true));
        };
        let cells = self.rows.iter().enumerate();
        cells.map(|(row, record)| self.number(row, index, record.get(index).unwrap_or_default())).collect()
    }

    /// The number in a cell.
    fn number(&self, row: usize, column: usize, cell: &str) -> Result<f64> {
        if cell.is_empty() {
            return Ok(f64::NAN);
        }
        cell.parse().map_err(|_| {
            let line = self.rows.get(row).and_then(StringRecord::position).map_or(0, csv::Position::line);
            let name = self.header.get(column).map_or("", String::as_str);
            let reason = format!("line {line}, column {name}: {cell:?}; expected a number");
            Error::io(self.file.display(), reason, true)
        })
    }

    /// The columns for the page, those of `wanted` or all: numbers where every cell is a number or
    /// empty, otherwise words, each distinct word once.
    pub fn for_page(&self, wanted: Option<&[&str]>) -> Value {
        let shown = |name: &str| wanted.is_none_or(|wanted| wanted.contains(&name));
        let mut columns = Vec::new();
        for (index, name) in self.header.iter().enumerate().filter(|(_, name)| shown(name)) {
            let named = |cell| if name == "measure" { older::renamed(cell) } else { cell };
            let cells = || self.rows.iter().map(|row| named(row.get(index).unwrap_or_default()));
            let numbers: Option<Vec<f64>> =
                cells().map(|cell| if cell.is_empty() { Some(f64::NAN) } else { cell.parse().ok() }).collect();
            let values = match numbers {
                Some(numbers) if numbers.iter().any(|x| !x.is_nan()) => column::f64(&numbers),
                _ => column::words(cells()),
            };
            columns.push(json!({ "name": name, "values": values }));
        }
        json!({ "rows": self.rows.len(), "columns": columns })
    }
}
