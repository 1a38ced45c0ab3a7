//! Output of the tool: data on stdout, messages and progress on stderr; control characters of
//! names and paths are escaped in both.

use super::pace::Pace;
use super::watch::Watch;
use crate::error::{Error, Result, escaped_lines};
use crate::output::json;
use crate::output::table::Table;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::Value;
use std::cell::{Cell, RefCell};
use std::io::{self, IsTerminal, Write};
use std::os::fd::AsFd;
use std::time::{Duration, Instant};

/// After this time a progress bar appears, and a line says how long the work will take.
const PATIENCE: Duration = Duration::from_secs(1);

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
    /// The last line of the command.
    last: RefCell<Option<String>>,
}

impl Ui {
    /// Quiet, JSON, or neither.
    #[must_use]
    pub fn new(quiet: bool, json: bool, stdout: Stdout) -> Self {
        Self { quiet, json, stdout, printed: Cell::new(false), deserted: Cell::new(false), last: RefCell::new(None) }
    }

    /// True if the answer is a JSON document.
    #[must_use]
    pub fn json(&self) -> bool {
        self.json
    }

    /// Prints text on stderr, unless quiet; on a terminal its lines break between words.
    pub fn message(&self, text: &str) {
        if !self.quiet {
            // If stderr is closed, the message is lost.
            let _ = writeln!(io::stderr(), "{}", wrapped(&escaped_lines(text), width(&io::stderr())));
        }
    }

    /// Keeps `text` for the last line of the command, in place of what was kept before.
    pub fn close_with(&self, text: String) {
        self.last.replace(Some(text));
    }

    /// Prints the line kept for the end.
    pub fn close(&self) {
        if let Some(text) = self.last.take() {
            self.message(&text);
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

    /// Prints text on stderr, also with `--quiet`.
    pub fn alarm(&self, text: &str) {
        let _ = writeln!(io::stderr(), "{}", wrapped(&escaped_lines(text), width(&io::stderr())));
    }

    /// The same while `progress` shows a bar.
    pub fn beside(&self, progress: &Progress, text: &str) {
        match progress.bar.as_ref().filter(|bar| !bar.is_hidden()) {
            Some(bar) => bar.suspend(|| self.message(text)),
            None => self.message(text),
        }
    }

    /// Prints an error on stderr, also with `--quiet`; with `--json` also as the document, if none
    /// was printed.
    pub fn error(&self, error: &Error) {
        let text = error.to_string();
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
            self.alarm(&format!("error: {text}"));
        }
    }

    /// A bar of `total` units that appears on stderr after a second, if that is a terminal and
    /// `--quiet` is not given.
    #[must_use]
    pub fn progress(&self, label: &str, total: u64) -> Progress {
        let bar = (!self.quiet && io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
            let style = ProgressStyle::with_template("{msg:20} {wide_bar} {percent:>3} % {eta}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.set_message(label.to_owned());
            bar
        });
        Progress { bar, total, watch: None, started: Instant::now() }
    }

    /// The same for work whose pace is known: after a second, a line says how long it will take,
    /// and why.
    #[must_use]
    pub fn paced(&self, label: &str, total: u64, pace: Pace) -> Progress {
        let progress = self.progress(label, total);
        let bar = progress.bar.clone();
        let say = move |line: &str| {
            let line = wrapped(line, width(&io::stderr()));
            match &bar {
                Some(bar) => bar.suspend(|| drop(writeln!(io::stderr(), "{line}"))),
                None => drop(writeln!(io::stderr(), "{line}")),
            }
        };
        Progress { watch: (!self.quiet).then(|| Watch::new(pace, PATIENCE, say)), ..progress }
    }
}

/// The error for a stdout that cannot be written.
pub(super) fn unwritable(error: &io::Error) -> Error {
    Error::io("standard output", error.to_string(), false)
}

/// Columns of text that `stream` has: `COLUMNS`, else those of the terminal; `None` for a file or a
/// pipe, which take any width.
fn width(stream: &impl AsFd) -> Option<usize> {
    let asked = std::env::var("COLUMNS").ok().and_then(|text| text.trim().parse::<usize>().ok()).filter(|&n| n > 0);
    asked.or_else(|| terminal_size::terminal_size_of(stream).map(|(width, _)| usize::from(width.0)))
}

/// The text with its lines broken between words, so that none has more than `width` columns unless
/// a single word has. A line that goes on is indented by two columns more than it began with.
fn wrapped(text: &str, width: Option<usize>) -> String {
    let Some(width) = width else { return text.to_owned() };
    let mut lines: Vec<String> = Vec::new();
    for line in text.split('\n') {
        if line.chars().count() <= width {
            lines.push(line.to_owned());
            continue;
        }
        let begin = line.chars().take_while(|c| *c == ' ').count();
        let (mut now, mut columns, mut words) = (" ".repeat(begin), begin, 0);
        for word in line.split_whitespace() {
            let length = word.chars().count();
            if words > 0 && columns + 1 + length > width {
                lines.push(std::mem::replace(&mut now, " ".repeat(begin + 2)));
                (columns, words) = (begin + 2, 0);
            }
            if words > 0 {
                now.push(' ');
                columns += 1;
            }
            now.push_str(word);
            (columns, words) = (columns + length, words + 1);
        }
        lines.push(now);
    }
    lines.join("\n")
}

/// Progress of work; shared between threads by reference.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    total: u64,
    /// Reports how long the work takes; `None` where that is not wanted.
    watch: Option<Watch>,
    started: Instant,
}

impl Progress {
    /// Sets the amount of work done.
    pub fn set(&self, done: u64) {
        self.share(done as f64 / self.total.max(1) as f64);
    }

    /// Sets the share of the work done.
    pub fn share(&self, share: f64) {
        if let Some(watch) = &self.watch {
            watch.share(share);
        }
        let Some(bar) = &self.bar else { return };
        if bar.is_hidden() && self.started.elapsed() > PATIENCE {
            bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        bar.set_position((share * self.total as f64) as u64);
    }

    /// Removes the bar; no estimate is printed any more.
    pub fn finish(self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn lines_break_between_words_and_a_word_that_is_too_long_stays_whole() {
        let text = "note: the body stays on the wall\n  and an indented line of seven words";
        assert_eq!(wrapped(text, None), text);
        let lines = "note: the body\n  stays on the\n  wall\n  and an\n    indented\n    line of\n    seven words";
        assert_eq!(wrapped(text, Some(15)), lines);
        assert_eq!(wrapped("results in /a/very/long/path", Some(12)), "results in\n  /a/very/long/path");
        assert_eq!(wrapped("θ = ½ and φ", Some(5)), "θ = ½\n  and\n  φ");
    }
}
