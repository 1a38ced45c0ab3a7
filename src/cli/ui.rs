//! What the tool says and where: data on stdout, messages and progress on stderr.

use crate::error::Error;
use comfy_table::{ContentArrangement, Table, presets};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

/// A run that takes longer than this shows a bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// How the tool was asked to speak.
#[derive(Debug, Clone, Copy)]
pub struct Ui {
    quiet: bool,
    json: bool,
}

impl Ui {
    /// Quiet, or in JSON, or neither.
    #[must_use]
    pub fn new(quiet: bool, json: bool) -> Self {
        Self { quiet, json }
    }

    /// True if tables are to be JSON.
    #[must_use]
    pub fn json(&self) -> bool {
        self.json
    }

    /// A line on stderr, unless quiet.
    pub fn message(&self, text: &str) {
        if !self.quiet {
            // A closed stderr leaves nobody to tell.
            let _ = writeln!(std::io::stderr(), "{text}");
        }
    }

    /// Text on stdout: the answer itself.
    pub fn answer(&self, text: &str) {
        let _ = writeln!(std::io::stdout(), "{text}");
    }

    /// An error on stderr, quiet or not.
    pub fn error(&self, error: &Error) {
        let text = error.to_string();
        // A case file's error comes rendered, with its place.
        let head = if text.starts_with("error: ") { "" } else { "error: " };
        let _ = writeln!(std::io::stderr(), "{head}{text}");
    }

    /// A table on stdout, or an array of objects keyed by the headers with `--json`. The first column holds names.
    pub fn table(&self, headers: &[&str], rows: &[Vec<String>]) {
        if self.json {
            let object = |row: &Vec<String>| {
                // The first column names things, and a name such as `1e5` stays one.
                let cell = |(column, text): (usize, &String)| match text.parse::<f64>() {
                    Ok(_) if column > 0 && text.parse::<u64>().is_ok() => {
                        serde_json::json!(text.parse::<u64>().unwrap_or(0))
                    }
                    Ok(number) if number.is_finite() && column > 0 => serde_json::json!(number),
                    _ if text.is_empty() => serde_json::Value::Null,
                    _ => serde_json::json!(text),
                };
                let cells = row.iter().enumerate().map(cell);
                headers.iter().zip(cells).map(|(h, c)| ((*h).to_owned(), c)).collect::<serde_json::Map<_, _>>()
            };
            let rows: Vec<_> = rows.iter().map(object).collect();
            self.answer(&serde_json::to_string_pretty(&rows).unwrap_or_default());
            return;
        }
        let mut table = Table::new();
        table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
        table.set_header(headers.iter().copied());
        for row in rows {
            table.add_row(row);
        }
        self.answer(&table.trim_fmt());
    }

    /// A bar of `total` units that appears on stderr after a second, if that is a terminal and nobody asked for quiet.
    #[must_use]
    pub fn progress(&self, label: &str, total: u64) -> Progress {
        let bar = (!self.quiet && std::io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
            let style = ProgressStyle::with_template("{msg:20} {wide_bar} {percent:>3} % {eta}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.set_message(label.to_owned());
            bar
        });
        Progress { bar, started: Instant::now() }
    }
}

/// A bar under way; shared between threads by reference.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    started: Instant,
}

impl Progress {
    /// Tells how much is done.
    pub fn set(&self, done: u64) {
        let Some(bar) = &self.bar else { return };
        if bar.is_hidden() && self.started.elapsed() > PATIENCE {
            bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        bar.set_position(done);
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
