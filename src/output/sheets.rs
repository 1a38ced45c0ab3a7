//! Tables as the sheets of a workbook, which Excel opens: each is read from its CSV file, so that
//! both have the same cells, and is written to a temporary file row by row, however long it is.
//!
//! The format is Office Open XML (ISO/IEC 29500), whose numbers are binary64 without infinities and
//! NaN; its limits are those of "Excel specifications and limits" of Microsoft's documentation.
//! Equal tables give equal bytes.

use super::atomic::WholeFile;
use super::record::Record;
use crate::case::open_regular;
use crate::error::{Error, Result};
use csv::StringRecord;
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, Worksheet, XlsxError};
use std::io::{self, Write};
use std::path::Path;

/// Most rows of a sheet, with the header.
const ROWS: u64 = 1 << 20;

/// Most columns of a sheet.
const COLUMNS: usize = 1 << 14;

/// Most characters of the name of a sheet.
const NAME: usize = 31;

/// Most characters of a cell.
const CELL: usize = 32_767;

/// Least width of a column, characters.
const WIDTH: usize = 10;

/// Rows of a table from one report of progress to the next.
const REPORTED: u32 = 1 << 10;

/// Tables of more bytes need the 64-bit lengths of a ZIP archive, which some programs cannot read:
/// a cell `1,` becomes some 16 times as long, of at most 4 GiB.
const LONG: u64 = 1 << 28;

/// The sheets of a workbook.
pub(super) struct Sheets {
    workbook: Workbook,
    /// Their names in small letters: Excel takes `A` and `a` for the same.
    names: Vec<String>,
}

impl Sheets {
    /// A workbook without sheets, whose temporary files are in `folder`.
    ///
    /// # Errors
    /// [`Error::Io`] where they cannot be.
    pub fn new(folder: &Path) -> Result<Self> {
        let failed = |error| failure(folder, &error);
        let mut workbook = Workbook::new();
        workbook.set_tempdir(folder).map_err(failed)?;
        // The first day that a ZIP archive can have, as its files have it: not the day of writing.
        let made = ExcelDateTime::from_ymd(1980, 1, 1).map_err(failed)?;
        workbook.set_properties(&DocProperties::new().set_creation_datetime(&made));
        Ok(Self { workbook, names: Vec::new() })
    }

    /// True without a sheet.
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// Adds the table at `path`, of which `record` is recorded, as the sheet that has its name
    /// without `.csv`. Returns what the table has that no sheet can hold, where there is such.
    /// `progress` is called with the bytes that are read.
    ///
    /// # Errors
    /// [`Error::Io`] for a table that cannot be read, and for a temporary file that cannot be
    /// written.
    pub fn add(
        &mut self,
        path: &Path,
        record: &Record,
        progress: &mut (dyn FnMut(u64) + Send),
    ) -> Result<Option<String>> {
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        // Excel keeps the name History for a sheet of its own.
        let name = file.strip_suffix(".csv").filter(|name| *name != "history").unwrap_or(&file);
        let unread = |error: csv::Error| Error::io(path.display(), error.to_string(), false).caused_by(error);
        let (source, _) = open_regular(path).map_err(|reason| Error::io(path.display(), reason, false))?;
        let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(source);
        let header = reader.headers().map_err(unread)?.clone();
        let small = name.to_lowercase();
        let more =
            |count: u64, what: &str, most: u64| Some(format!("{count} {what}, where a sheet has at most {most}"));
        let beyond = match (record.rows + 1, header.len(), name.chars().count()) {
            (rows, ..) if rows > ROWS => more(rows, "rows with the header", ROWS),
            (_, columns, _) if columns > COLUMNS => more(columns as u64, "columns", COLUMNS as u64),
            (.., letters) if letters > NAME => more(letters as u64, "characters in its name", NAME as u64),
            _ if self.names.contains(&small) => Some("the name of another sheet but for capitals".to_owned()),
            _ => None,
        };
        if beyond.is_some() {
            return Ok(beyond);
        }
        let failed = |error| failure(path, &error);
        let sheet = self.workbook.add_worksheet_with_constant_memory().map_err(failed)?;
        put_header(sheet, name, &header).map_err(failed)?;
        let mut cells = StringRecord::new();
        let mut row = 0;
        while reader.read_record(&mut cells).map_err(unread)? {
            row += 1;
            if row % REPORTED == 0 {
                progress(reader.position().byte());
            }
            match put_row(sheet, row, &cells) {
                Err(XlsxError::MaxStringLengthExceeded) => {
                    self.workbook.worksheets_mut().pop();
                    return Ok(Some(format!("a cell of more than {CELL} characters in row {row}")));
                }
                put => put.map_err(failed)?,
            }
        }
        if record.bytes > LONG {
            self.workbook.use_zip_large_file(true);
        }
        self.names.push(small);
        Ok(None)
    }

    /// Writes the workbook to `path`, whole or not at all. `progress` is called with the bytes that
    /// are written.
    pub fn write(mut self, path: &Path, progress: &mut (dyn FnMut(u64) + Send)) -> Result<()> {
        let mut counted = CountedFile { file: WholeFile::create(path)?, written: 0, progress };
        self.workbook.save_to_writer(&mut counted).map_err(|error| failure(path, &error))?;
        counted.file.finish()
    }
}

/// A file, and the bytes that are written to it.
struct CountedFile<'a> {
    file: WholeFile,
    written: u64,
    progress: &'a mut (dyn FnMut(u64) + Send),
}

impl Write for CountedFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.written += written as u64;
        (self.progress)(self.written);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Names the sheet and writes its header, which stays in sight.
fn put_header(sheet: &mut Worksheet, name: &str, header: &StringRecord) -> std::result::Result<(), XlsxError> {
    sheet.set_name(name)?.set_freeze_panes(1, 0)?;
    let bold = Format::new().set_bold();
    for (column, word) in (0..).zip(header) {
        sheet.set_column_width(column, word.chars().count().max(WIDTH) as f64 + 1.0)?;
        sheet.write_string_with_format(0, column, word, &bold)?;
    }
    Ok(())
}

/// Writes a row of cells; an empty one is left out.
fn put_row(sheet: &mut Worksheet, row: u32, cells: &StringRecord) -> std::result::Result<(), XlsxError> {
    for (column, cell) in (0..).zip(cells).filter(|(_, cell)| !cell.is_empty()) {
        match number(cell) {
            Some(x) => sheet.write_number(row, column, x)?,
            None => sheet.write_string(row, column, cell)?,
        };
    }
    Ok(())
}

/// The number that a cell is. All other cells are text: a name such as 007, a seed that binary64
/// does not have, `inf`, `NaN`.
fn number(cell: &str) -> Option<f64> {
    let x: f64 = cell.parse().ok()?;
    let is_whole = cell.bytes().skip(usize::from(cell.starts_with('-'))).all(|byte| byte.is_ascii_digit());
    (x.is_finite() && (!is_whole || x.to_string() == cell)).then_some(x)
}

fn failure(path: &Path, error: &XlsxError) -> Error {
    Error::io(path.display(), error.to_string(), false)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What keeps the table `text` out of `sheets` as the sheet `name`.
    fn beyond(sheets: &mut Sheets, name: &str, text: &str) -> Option<String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(format!("{name}.csv"));
        std::fs::write(&path, text).unwrap();
        sheets.add(&path, &Record::of(text.as_bytes()).unwrap(), &mut |_| ()).unwrap()
    }

    #[test]
    fn the_largest_tables_are_sheets_and_larger_ones_are_refused_by_what_is_too_large() {
        let folder = tempfile::tempdir().unwrap();
        let mut sheets = Sheets::new(folder.path()).unwrap();
        let (rows, columns) = ((1 << 20) - 1, 1 << 14);
        let long = |rows: usize| format!("a\n{}", "1\n".repeat(rows));
        let wide = |columns: usize| format!("{}a\n", "a,".repeat(columns - 1));
        let cell = |letters: usize| format!("a\n1\n{}\n", "x".repeat(letters));
        let name = "n".repeat(31);
        for (name, text) in [("rows", long(rows)), ("columns", wide(columns)), ("cell", cell(32_767)), (&name, wide(1))]
        {
            assert_eq!(beyond(&mut sheets, name, &text), None);
        }
        for (name, text, wanted) in [
            ("more", long(rows + 1), "1048577 rows with the header, where a sheet has at most 1048576"),
            ("wider", wide(columns + 1), "16385 columns, where a sheet has at most 16384"),
            ("longer", cell(32_768), "a cell of more than 32767 characters in row 2"),
            (&"n".repeat(32), wide(1), "32 characters in its name, where a sheet has at most 31"),
            ("Rows", wide(1), "the name of another sheet but for capitals"),
        ] {
            assert_eq!(beyond(&mut sheets, name, &text).as_deref(), Some(wanted));
        }
        // What was left out half way leaves nothing behind, not even its name.
        assert_eq!(beyond(&mut sheets, "longer", &cell(1)), None);
        let names: Vec<String> = sheets.workbook.worksheets().iter().map(Worksheet::name).collect();
        assert_eq!(names, ["rows", "columns", "cell", &name, "longer"]);
    }

    #[test]
    fn progress_tells_the_bytes_of_the_table_and_then_those_of_the_workbook() {
        let folder = tempfile::tempdir().unwrap();
        let [table, workbook] = ["t.csv", "t.xlsx"].map(|name| folder.path().join(name));
        let text = format!("a,b\n{}", "1.5,-2.25\n".repeat(4096));
        std::fs::write(&table, &text).unwrap();
        let mut sheets = Sheets::new(folder.path()).unwrap();
        let mut read = Vec::new();
        sheets.add(&table, &Record::of(text.as_bytes()).unwrap(), &mut |bytes| read.push(bytes)).unwrap();
        assert_eq!(read, [1, 2, 3, 4].map(|k| 4 + 10 * 1024 * k));
        let mut written = Vec::new();
        sheets.write(&workbook, &mut |bytes| written.push(bytes)).unwrap();
        assert!(written.is_sorted());
        assert_eq!(*written.last().unwrap(), std::fs::metadata(&workbook).unwrap().len());
    }

    #[test]
    fn a_cell_is_the_number_that_its_digits_are_or_text() {
        for (text, x) in [
            ("0.0", 0.0),
            ("-0.0", -0.0),
            ("-0.00000e0", -0.0),
            ("1.50000e-3", 0.0015),
            ("12", 12.0),
            ("-3", -3.0),
            ("1e16", 1e16),
            ("5e-324", f64::from_bits(1)),
            ("1.7976931348623157e308", f64::MAX),
            ("9007199254740992", 9_007_199_254_740_992.0),
        ] {
            assert_eq!(number(text).map(f64::to_bits), Some(x.to_bits()), "{text}");
        }
        for text in ["", "-", "007", "1e5x", "inf", "-inf", "NaN", "9007199254740993", "18446744073709551615", "1e400"]
        {
            assert_eq!(number(text), None, "{text}");
        }
    }
}
