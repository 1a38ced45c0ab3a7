//! The tables of a sweep, in the order of their rows.

use super::attractors::{self, ATTRACTORS, Attractors};
use super::journal::Journal;
use super::plan::Plan;
use super::row::Status;
use super::table::{SAMPLES, TABLE, cells_of, line_of, with_number};
use crate::case::open_regular;
use crate::error::{Error, Result};
use crate::output::atomic::WholeFile;
use crate::output::results::Results;
use std::io::Write;
use std::path::Path;

/// The numbers of rows of a table by status.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Tables {
    /// Number of rows by their status, in the order in which these first appear.
    pub counts: Vec<(String, u64)>,
    /// The first row that failed, with its number.
    pub first_error: Option<String>,
}

impl Tables {
    /// Counts a row.
    pub(super) fn count(&mut self, number: &str, status: &str, error: &str) {
        match self.counts.iter_mut().find(|(known, _)| known == status) {
            Some((_, count)) => *count += 1,
            None => self.counts.push((status.to_owned(), 1)),
        }
        if !Status::is_good_word(status) && self.first_error.is_none() {
            self.first_error = Some(format!("row {number}: {error}"));
        }
    }

    /// Number of rows that failed.
    #[must_use]
    pub fn bad(&self) -> u64 {
        let bad = self.counts.iter().filter(|(status, _)| !Status::is_good_word(status));
        bad.map(|(_, count)| count).sum()
    }

    /// Number of rows with results whose start leads to no attractor that was found, by the table
    /// of attractors in `folder`; `None` where the sweep does not look for attractors.
    ///
    /// # Errors
    /// [`Error::Io`] for a table that cannot be read.
    pub(crate) fn undecided(&self, folder: &Path) -> Result<Option<u64>> {
        let Some(found) = attractors::rows_found(folder)? else { return Ok(None) };
        Ok(Some((self.rows() - self.bad()).saturating_sub(found)))
    }

    /// Number of all rows.
    pub(super) fn rows(&self) -> u64 {
        self.counts.iter().map(|(_, count)| count).sum()
    }

    /// The counts of a table that exists.
    ///
    /// # Errors
    /// [`Error::Io`] for a file that cannot be read.
    pub fn read(path: &Path) -> Result<Self> {
        let failed = |error: csv::Error| Error::io(path.display(), error.to_string(), false);
        let (file, _) = open_regular(path).map_err(|reason| Error::io(path.display(), reason, true))?;
        let mut reader = csv::Reader::from_reader(file);
        let columns = Columns::of(reader.headers().map_err(failed)?);
        let mut tables = Self::default();
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record).map_err(failed)? {
            columns.count(&record, &mut tables);
        }
        Ok(tables)
    }
}

/// The columns of status and error in a table.
pub(super) struct Columns {
    status: usize,
    error: usize,
}

impl Columns {
    pub fn of(header: &csv::StringRecord) -> Self {
        let find = |name: &str| header.iter().position(|column| column == name).unwrap_or(usize::MAX);
        Self { status: find("status"), error: find("error") }
    }

    pub fn count(&self, record: &csv::StringRecord, tables: &mut Tables) {
        let cell = |index: usize| record.get(index).unwrap_or_default();
        tables.count(cell(0), cell(self.status), cell(self.error));
    }
}

/// Adds the tables, written from the journal, to `results`.
pub(super) fn write_tables(plan: &Plan, results: &mut Results, journal: &mut Journal, rows: u64) -> Result<Tables> {
    let failed = |path: &Path, error: &std::io::Error| {
        Error::io(
            path.display(),
            format!("{error}\nhelp: all rows are kept in the journal; make room and give the same command again"),
            false,
        )
    };
    let mut table = WholeFile::create(&results.place(TABLE)?)?;
    let mut samples =
        plan.sweep.samples.map(|_| results.place(SAMPLES).and_then(|path| WholeFile::create(&path))).transpose()?;
    let put = |file: &mut WholeFile, bytes: &[u8]| {
        let written = file.write_all(bytes);
        written.map_err(|error| failed(file.path(), &error))
    };
    put(&mut table, &line_of(plan.header()))?;
    if let Some(samples) = &mut samples {
        put(samples, &line_of(plan.sample_header()))?;
    }
    let mut tables = Tables::default();
    let columns = Columns::of(&csv::StringRecord::from(plan.header().to_vec()));
    let (attractor_column, mut attractors) = (plan.attractor_column(), Attractors::default());
    for place in 0..rows {
        let block = journal
            .read(place as usize)?
            .ok_or_else(|| Error::io(results.folder().display(), "a row is missing in the journal", false))?;
        let record = cells_of(&block.line);
        columns.count(&record, &mut tables);
        match attractor_column {
            Some(column) if !block.samples.is_empty() => {
                let told: Vec<String> = cells_of(&block.samples).iter().map(str::to_owned).collect();
                put(&mut table, &with_number(&record, column, attractors.number(&told)))?;
            }
            _ => put(&mut table, &block.line)?,
        }
        if let Some(samples) = &mut samples {
            put(samples, &block.samples)?;
        }
    }
    if let Some(samples) = samples {
        samples.finish()?;
    }
    if attractor_column.is_some() {
        attractors.write(&results.place(ATTRACTORS)?, rows)?;
    }
    table.finish()?;
    Ok(tables)
}
