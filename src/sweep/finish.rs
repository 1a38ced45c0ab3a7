//! The tables of a sweep, in the order of their rows.

use super::attractors::{self, ATTRACTORS, Attractors};
use super::block::Block;
use super::fold::Fold;
use super::instability::Unstable;
use super::plan::Plan;
use super::scars::Scars;
use super::status::Status;
use super::table::{REALISATIONS, SAMPLES, TABLE, cells_of, line_of, with_number};
use crate::case::open_regular;
use crate::error::{Error, Result};
use crate::output::atomic::WholeFile;
use crate::output::journal::Journal;
use crate::output::results::Results;
use csv::StringRecord;
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
    /// The rows whose motion is unstable.
    unstable: Unstable,
}

impl Tables {
    /// Counts a row.
    pub(super) fn count(&mut self, number: &str, status: &str, error: &str) {
        match self.counts.iter_mut().find(|(known, _)| known == status) {
            Some((_, count)) => *count += 1,
            None => self.counts.push((status.to_owned(), 1)),
        }
        self.unstable.count(number, error);
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

    /// What a reader must know of rows whose motion is unstable, in sentences.
    #[must_use]
    pub fn instabilities(&self) -> Vec<String> {
        self.unstable.sentences(self.rows()).collect()
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
        let mut record = StringRecord::new();
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
    pub fn of(header: &StringRecord) -> Self {
        let find = |name: &str| header.iter().position(|column| column == name).unwrap_or(usize::MAX);
        Self { status: find("status"), error: find("error") }
    }

    pub fn count(&self, record: &StringRecord, tables: &mut Tables) {
        let cell = |index: usize| record.get(index).unwrap_or_default();
        tables.count(cell(0), cell(self.status), cell(self.error));
    }
}

/// The tables that are being written.
struct Files {
    table: WholeFile,
    samples: Option<WholeFile>,
    /// The table of the realisations, how these become a row, and their depths.
    realisations: Option<(WholeFile, Fold, Option<Scars>)>,
    /// The column of the attractors' numbers, and the attractors.
    attractors: Option<(usize, Attractors)>,
    columns: Columns,
    tables: Tables,
}

impl Files {
    fn create(plan: &Plan, results: &mut Results) -> Result<Self> {
        let mut create = |name: &str, header: &[String]| -> Result<WholeFile> {
            let mut file = WholeFile::create(&results.place(name)?)?;
            put(&mut file, &line_of(header))?;
            Ok(file)
        };
        let table = create(TABLE, plan.header())?;
        let samples = plan.sweep.samples.map(|_| create(SAMPLES, plan.sample_header())).transpose()?;
        let runs = plan.run_header.as_ref();
        let fold = |header| Fold::of(header, plan.until.clone());
        let realisations =
            runs.map(|header| Ok((create(REALISATIONS, header)?, fold(header), Scars::of(plan)))).transpose()?;
        Ok(Self {
            table,
            samples,
            realisations,
            attractors: plan.attractor_column().map(|column| (column, Attractors::default())),
            columns: Columns::of(&StringRecord::from(plan.header().to_vec())),
            tables: Tables::default(),
        })
    }

    /// Adds row number `row` of `plan`, with these runs.
    fn add(&mut self, plan: &Plan, row: u64, runs: &[Block]) -> Result<()> {
        let line = match &mut self.realisations {
            Some((file, fold, scars)) => {
                let cells = |run: &Block| cells_of(&run.line).iter().map(str::to_owned).collect();
                let mut lines: Vec<Vec<String>> = runs.iter().map(cells).collect();
                if let Some(scars) = scars {
                    scars.fill(&mut lines, (plan, row, runs))?;
                }
                lines.iter().try_for_each(|line| put(file, &line_of(line)))?;
                line_of(&fold.row(&lines.into_iter().map(StringRecord::from).collect::<Vec<_>>()))
            }
            None => runs.iter().flat_map(|run| &run.line).copied().collect(),
        };
        let record = cells_of(&line);
        self.columns.count(&record, &mut self.tables);
        let told = runs.first().map_or(&[][..], |run| &run.samples);
        match &mut self.attractors {
            Some((column, attractors)) if !told.is_empty() => {
                let told: Vec<String> = cells_of(told).iter().map(str::to_owned).collect();
                put(&mut self.table, &with_number(&record, *column, attractors.number(&told)))?;
            }
            _ => put(&mut self.table, &line)?,
        }
        match &mut self.samples {
            Some(samples) => runs.iter().try_for_each(|run| put(samples, &run.samples)),
            None => Ok(()),
        }
    }

    /// Finishes the tables of `rows` rows.
    fn finish(self, results: &mut Results, rows: u64) -> Result<Tables> {
        let realisations = self.realisations.map(|(file, ..)| file);
        self.samples.into_iter().chain(realisations).try_for_each(WholeFile::finish)?;
        if let Some((_, attractors)) = self.attractors {
            attractors.write(&results.place(ATTRACTORS)?, rows)?;
        }
        self.table.finish()?;
        Ok(self.tables)
    }
}

fn put(file: &mut WholeFile, bytes: &[u8]) -> Result<()> {
    let help = "help: all rows are kept in the journal; make room and give the same command again";
    let written = file.write_all(bytes);
    written.map_err(|error| Error::io(file.path().display(), format!("{error}\n{help}"), false))
}

/// Adds the tables of so many rows, each with its number of runs, written from the journal, to
/// `results`.
pub(super) fn write_tables(
    plan: &Plan,
    results: &mut Results,
    journal: &mut Journal,
    (rows, runs): (u64, &dyn Fn(u64) -> u64),
) -> Result<Tables> {
    let mut files = Files::create(plan, results)?;
    let missing = |folder: &Path| Error::io(folder.display(), "a row is missing in the journal", false);
    for row in 0..rows {
        let first = row * plan.runs_of_row();
        let runs = (first..first + runs(row))
            .map(|place| Block::read(journal, place as usize)?.ok_or_else(|| missing(results.folder())))
            .collect::<Result<Vec<_>>>()?;
        files.add(plan, row, &runs)?;
    }
    files.finish(results, rows)
}
