//! Output of the tool: data on stdout, messages and progress on stderr; control characters of
//! names and paths are escaped in both.

use super::bar::Bar;
use super::estimate::DurationEstimate;
use super::terminal::{print_message, width, wrapped};
use crate::error::{Error, Result, escaped_lines};
use crate::output::json;
use crate::output::table::Table;
use crate::residual::Finding;
use serde_json::Value;
use std::cell::{Cell, RefCell};
use std::io::{self, Write};

/// Whether the process was started with a stdout.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stdout {
    /// It has one: a terminal, a pipe, a file, /dev/null.
    Open,
    /// It has no stdout, as after `>&-`: whatever is printed is lost.
    Closed,
}

impl Stdout {
    /// The error of writing to a closed stdout: the runtime replaces it by /dev/null, where writing
    /// succeeds.
    pub(super) fn check(self) -> io::Result<()> {
        match self {
            Self::Open => Ok(()),
            Self::Closed => Err(io::Error::new(io::ErrorKind::NotConnected, "it is closed")),
        }
    }
}

/// How the tool prints.
#[derive(Debug)]
pub struct Ui {
    quiet: bool,
    json: bool,
    stdout: Stdout,
    /// True once the one document of `--json` has been printed.
    printed: Cell<bool>,
    /// True once the reader of stdout has closed it, as `head` does.
    deserted: Cell<bool>,
    /// The runs that the judge has refuted.
    refuted: RefCell<Vec<String>>,
}

impl Ui {
    /// Quiet, JSON, or neither.
    #[must_use]
    pub fn new(quiet: bool, json: bool, stdout: Stdout) -> Self {
        let refuted = RefCell::default();
        Self { quiet, json, stdout, printed: Cell::new(false), deserted: Cell::new(false), refuted }
    }

    /// True if the answer is a JSON document.
    #[must_use]
    pub fn json(&self) -> bool {
        self.json
    }

    /// Prints text on stderr, unless quiet; on a terminal its lines break between words.
    pub fn message(&self, text: &str) {
        if !self.quiet {
            print_message(text);
        }
    }

    /// Prints sentences on stdout, as [`answer`](Self::answer) does; on a terminal their lines
    /// break between words.
    ///
    /// # Errors
    /// As [`answer`](Self::answer).
    pub fn prose(&self, text: &str) -> Result<()> {
        self.answer(&wrapped(text, width(&io::stdout())))
    }

    /// Prints text on stdout: the answer itself. If the reader has closed its end of a pipe,
    /// nothing more is printed, which is not an error.
    ///
    /// # Errors
    /// [`Error::Io`] where stdout cannot be written: a full disk, a closed descriptor.
    pub fn answer(&self, text: &str) -> Result<()> {
        if self.deserted.get() {
            return Ok(());
        }
        let mut stdout = io::stdout();
        let written = self.stdout.check().and_then(|()| writeln!(stdout, "{}", escaped_lines(text)));
        match written.and_then(|()| stdout.flush()) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                self.deserted.set(true);
                Ok(())
            }
            Err(error) => Err(unwritable(&error)),
            Ok(()) => Ok(()),
        }
    }

    /// Prints the answer of `--json`: one document, once.
    ///
    /// # Errors
    /// As [`answer`](Self::answer).
    pub fn document(&self, document: &Value) -> Result<()> {
        self.printed.set(true);
        self.answer(json::text(document).trim_end())
    }

    /// Prints a table as wide as the terminal; says which columns did not fit, and that `file` has
    /// them.
    ///
    /// # Errors
    /// As [`answer`](Self::answer).
    pub fn table(&self, table: &Table, file: &str) -> Result<()> {
        let shown = table.fit(width(&io::stdout()));
        self.answer(&shown.text)?;
        if !shown.left_out.is_empty() {
            self.message(&format!("no room for {}: {file} has them", shown.left_out.join(", ")));
        }
        Ok(())
    }

    /// Prints the findings of the run `run`, also with `--quiet`, and remembers the run: the
    /// command fails in the end.
    pub fn refute(&self, run: &str, findings: &[Finding]) {
        self.refute_for(run, &findings.iter().map(ToString::to_string).collect::<Vec<_>>());
    }

    /// The same for a run that was refuted where it was made; any other error is none of these.
    pub fn refute_failed(&self, run: &str, error: &Error) {
        if let Error::Refuted { runs } = error {
            self.refute_for(run, runs);
        }
    }

    fn refute_for(&self, run: &str, reasons: &[String]) {
        if !reasons.is_empty() {
            self.refuted.borrow_mut().push(run.to_owned());
            reasons.iter().for_each(|reason| print_message(&format!("refuted: {run}: {reason}")));
        }
    }

    /// Whether any run of the command was refuted.
    ///
    /// # Errors
    /// [`Error::Refuted`] with the runs that were.
    pub fn verdict(&self) -> Result<()> {
        let runs = self.refuted.take();
        if runs.is_empty() { Ok(()) } else { Err(Error::Refuted { runs }) }
    }

    /// Prints an error on stderr, also with `--quiet`; with `--json` also as the document, if none
    /// was printed.
    pub fn error(&self, error: &Error) {
        let mut text = error.to_string();
        if matches!(error, Error::OtherResults { .. }) {
            text += "\nhelp: --force replaces them, --out DIR writes elsewhere";
        }
        if self.json && !self.printed.get() {
            let code = if error.is_request() { 2 } else { 1 };
            // The error itself is reported next, whether or not this can be written.
            let _ = self.document(&serde_json::json!({ "error": text, "exit_code": code }));
        }
        // An error of a case file is already rendered, with its place, below which a mark points at
        // the column.
        if text.starts_with("error: ") {
            let _ = writeln!(io::stderr(), "{text}");
        } else {
            print_message(&format!("error: {text}"));
        }
    }

    /// Prints a wrong command line as the JSON document of an error; its message goes elsewhere.
    pub fn refused(&self, error: &clap::Error) {
        let text = error.to_string();
        let said = text.trim().trim_start_matches("error: ");
        // The error itself is reported next, whether or not this can be written.
        let _ = self.document(&serde_json::json!({ "error": said, "exit_code": 2 }));
    }

    /// Does `work` with a progress bar.
    pub fn with_bar<T>(&self, label: &str, work: impl FnOnce(&Bar) -> T) -> T {
        work(&Bar::new(label, None, self.quiet))
    }

    /// The same for work whose duration can be estimated.
    pub fn with_estimate<T>(&self, label: &str, estimate: DurationEstimate, work: impl FnOnce(&Bar) -> T) -> T {
        work(&Bar::new(label, Some(estimate), self.quiet))
    }
}

/// The error for a stdout that cannot be written.
pub(super) fn unwritable(error: &io::Error) -> Error {
    Error::io("standard output", error.to_string(), false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::residual::Refuted;

    #[test]
    fn a_command_with_a_refuted_run_fails_and_names_it() {
        let ui = Ui::new(true, false, Stdout::Open);
        ui.refute("moreau-jean", &[]);
        assert!(ui.verdict().is_ok());
        let finding = Finding {
            refuted: Refuted::Penetration,
            residual: 26.6,
            tolerance: 1e-6,
            reason: "rounding".into(),
            time_s: 266.0,
            wall: Some("stop".into()),
        };
        ui.refute("event", &[finding]);
        ui.refute_failed("newmark", &Error::Refuted { runs: vec!["the energy".to_owned()] });
        ui.refute_failed("penalty", &unwritable(&io::Error::other("full")));
        let error = ui.verdict().expect_err("two refuted runs");
        let text = error.to_string();
        assert!(!error.is_request() && text.contains("event") && text.contains("newmark"), "{text}");
        assert!(!text.contains("penalty"), "{text}");
    }
}
