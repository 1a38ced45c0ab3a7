//! What all commands share: the folder of their results is opened before the work, and afterwards
//! is finished, gets its report, and the answer is printed, for a person or as JSON. A command
//! itself checks what is asked, does the work, writes its files and says what is shown.

use super::command_line::command_line;
use super::formats::FileFormats;
use super::ui::Ui;
use crate::case::Case;
use crate::error::{Error, Result, escaped};
use crate::output::results::Results;
use crate::output::table::Table;
use crate::report::{self, Finished};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// Where results are written, and in which formats.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Destination {
    /// Folder for the results [default: out/CASE/COMMAND]
    #[arg(long, value_name = "DIR", value_hint = clap::ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Replace the results of another request
    #[arg(long)]
    pub force: bool,
    /// Write no report.html, nor shape.csv, animation.svg and orbits.csv, which draw motions
    #[arg(long)]
    pub no_report: bool,
    /// File formats of pictures and tables
    #[command(flatten)]
    pub formats: FileFormats,
}

impl Destination {
    /// The folder for the results of `command` on the case or sweep of that name.
    pub fn folder(&self, name: &str, command: &str) -> PathBuf {
        self.out.clone().unwrap_or_else(|| Path::new("out").join(name).join(command))
    }

    /// Opens the folder for the results of `command` on `case`, which must be writable and must not
    /// hold results of another request than `request`. Call it before the work, which may be long.
    ///
    /// # Errors
    /// As [`Results::open`]; [`Error::Invalid`] for a format that this build cannot write.
    pub fn open(&self, case: &Case, command: &str, request: Map<String, Value>) -> Result<Results> {
        let (folder, formats) = (self.folder(&case.name, command), self.formats.usable()?);
        let mut results = Results::open(&folder, request, self.force, formats)?;
        results.add_to_manifest("command_line", json!(command_line()));
        results.add_to_manifest("title", json!(case.title));
        Ok(results)
    }
}

/// A part of what is shown.
enum Part {
    /// A table on stdout, and the file that has all its columns.
    Table(Table, &'static str),
    /// Sentences on stdout, whose lines break between words.
    Prose(String),
    /// Text on stdout as it is.
    Verbatim(String),
    /// A sentence on stderr about the tables; with `--json` the document says the same.
    Remark(String),
    /// A sentence on stderr that is printed with `--json`, too.
    Message(String),
}

/// The answer of a command: what is printed, and the folder of its results if it has one.
#[derive(Default)]
pub struct Answer {
    parts: Vec<Part>,
    document: Value,
    results: Option<Results>,
    report: bool,
    /// The end of the last line, after the name of the folder.
    remark: String,
    /// The last line of a command without a folder.
    last_line: Option<String>,
    shortfall: Option<Error>,
}

impl Answer {
    /// The answer of a command without results on disk; `document` is printed with `--json`.
    pub fn new(document: Value) -> Self {
        Self { document, ..Self::default() }
    }

    /// The answer of a command whose files are in `results`, with a report beside them where it is
    /// wanted.
    pub fn of(results: Results, report: bool, document: Value) -> Self {
        Self { document, results: Some(results), report, ..Self::default() }
    }

    /// Adds a table, whose columns are all in `file`.
    pub fn table(&mut self, table: Table, file: &'static str) {
        self.parts.push(Part::Table(table, file));
    }

    /// Adds `value` under `key` to what is printed with `--json`.
    pub fn add(&mut self, key: &str, value: Value) {
        if let Some(document) = self.document.as_object_mut() {
            document.insert(key.to_owned(), value);
        }
    }

    /// Adds sentences on stdout.
    pub fn prose(&mut self, text: String) {
        self.parts.push(Part::Prose(text));
    }

    /// Adds text on stdout whose lines stay as they are.
    pub fn verbatim(&mut self, text: String) {
        self.parts.push(Part::Verbatim(text));
    }

    /// Adds sentences on stderr that are left out with `--json`.
    pub fn remarks(&mut self, texts: impl IntoIterator<Item = String>) {
        self.parts.extend(texts.into_iter().map(Part::Remark));
    }

    /// Adds sentences on stderr.
    pub fn messages(&mut self, texts: impl IntoIterator<Item = String>) {
        self.parts.extend(texts.into_iter().map(Part::Message));
    }

    /// Ends the last line with `remark`, before the page to open.
    pub fn close_with(&mut self, remark: impl Into<String>) {
        self.remark = remark.into();
    }

    /// Sets the last line of a command that has no folder.
    pub fn last_line(&mut self, line: String) {
        self.last_line = Some(line);
    }

    /// What the results fall short of: the command fails after they are written and shown.
    pub fn fall_short(&mut self, error: Option<Error>) {
        self.shortfall = error;
    }

    /// Finishes the folder, writes the report and prints everything.
    ///
    /// # Errors
    /// [`Error::Io`] for a file that cannot be written and for stdout; [`Error::Refuted`] if a run
    /// was refuted; else the shortfall.
    pub fn conclude(mut self, ui: &Ui) -> Result<()> {
        let last_line = self.finish(ui)?;
        let printed = self.print(ui);
        if let Some(line) = last_line {
            // Folders may have any name.
            ui.message(&escaped(&line));
        }
        printed?;
        ui.verdict()?;
        self.shortfall.map_or(Ok(()), Err)
    }

    /// Writes the workbooks and finishes the folder; returns the last line of the command.
    fn finish(&mut self, ui: &Ui) -> Result<Option<String>> {
        let Some(results) = &mut self.results else { return Ok(self.last_line.take()) };
        let said = ui.with_bar("tables.xlsx", |bar| results.write_workbooks(&mut |share| bar.set_share(share)))?;
        said.iter().for_each(|said| ui.message(said));
        let Finished { page, said } = report::finish(results, self.report)?;
        let open = page.map_or_else(String::new, |page| format!("; open {}", page.display()));
        said.iter().for_each(|said| ui.message(said));
        if let Some(map) = self.document.as_object_mut() {
            map.insert("results".to_owned(), json!(results.folder()));
            map.insert("files_written".to_owned(), json!(results.files()));
        }
        Ok(Some(format!("results in {}{}{open}", results.folder().display(), self.remark)))
    }

    fn print(&mut self, ui: &Ui) -> Result<()> {
        if ui.json() {
            ui.document(&self.document)?;
        }
        for part in self.parts.drain(..) {
            match part {
                Part::Message(text) => ui.message(&text),
                _ if ui.json() => {}
                Part::Remark(text) => ui.message(&text),
                Part::Table(table, file) => ui.table(&table, file)?,
                Part::Prose(text) => ui.prose(&text)?,
                Part::Verbatim(text) => ui.answer(&text)?,
            }
        }
        Ok(())
    }
}
