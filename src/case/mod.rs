//! Case files: a scene, its times and its penalty as TOML, with errors that point at line and column.
//!
//! ```
//! use signorini::case::Case;
//!
//! let case = Case::embedded("rigid-walls-sine")?;
//! assert_eq!(case.scene.walls.len(), 2);
//! assert_eq!(case.time.step, 1e-4);
//! # Ok::<(), signorini::Error>(())
//! ```
//!
#![doc = include_str!("../../cases/README.md")]

mod accepted;
mod build;
mod damping;
mod digest;
mod embedded;
mod file;
mod initial;
mod loads;
mod modal;
mod model;
mod notes;
mod penalty;
mod place;
mod report;
mod summary;
mod system;
mod table;
mod truncated;
mod value;
mod walls;
mod written;

pub use embedded::Embedded;
pub use model::{Model, Place};
pub use penalty::PenaltyOptions;
pub use table::TableColumns;
pub use truncated::Truncated;
pub use written::{FileRead, Written};

use crate::error::{Error, Result, nearest};
use crate::scene::{Condensation, Scene};
use crate::time::TimeOptions;
use std::fs;
use std::io::Read;
use std::path::Path;

/// What a case file holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Name of the file without folder and extension.
    pub name: String,
    /// One line that says what the case is.
    pub title: Option<String>,
    /// Where the case comes from.
    pub source: Option<String>,
    /// What its system was made from.
    pub model: Model,
    /// Where each wall sits, in the scene's order.
    pub places: Vec<Place>,
    /// What is simulated, in modal coordinates where the case is cut to modes; its duration is `time.end`.
    pub scene: Scene,
    /// What of the file's degrees of freedom has no mass and was condensed, before any cut; none where all have mass.
    pub condensation: Option<Condensation>,
    /// What it was cut from, and what that cost; none for a case that runs in full.
    pub truncated: Option<Truncated>,
    /// Step, recording and statistics.
    pub time: TimeOptions,
    /// What penalty runs use.
    pub penalty: PenaltyOptions,
    /// What the file said that the scene no longer shows.
    pub written: Written,
}

impl Case {
    /// Reads a case file; tables are looked for beside it. From the `summary.json` of a run it reads the case of that run again, provided that
    /// the files which it read are the same still.
    ///
    /// # Errors
    /// [`Error::Io`] where the file cannot be read, [`Error::Case`] where it makes no sense.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let json = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"));
        let text = read_text(path, if json { MOST_TABLE_BYTES } else { MOST_CASE_BYTES }).map_err(|reason| {
            let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or_default();
            let hint = match Embedded::named(stem) {
                Ok(embedded) => format!("`signorini new {}` writes the case of that name", embedded.name),
                Err(_) => {
                    let known = Embedded::all().iter().map(|case| case.name);
                    nearest(stem, known).map_or_else(
                        || {
                            "a case file is a TOML text; `signorini new rigid-walls-sine` writes one to start from"
                                .into()
                        },
                        |near| format!("did you mean {near}? It is a built-in case; `signorini new` lists them all"),
                    )
                }
            };
            let shown = if path.as_os_str().is_empty() { "\"\"".to_owned() } else { path.display().to_string() };
            Error::Io { path: shown, reason: format!("{reason}\nhelp: {hint}"), request: true }
        })?;
        if json {
            return summary::read(&text, path);
        }
        Self::parse(&text, &path.display().to_string(), path.parent().unwrap_or(Path::new("")))
    }

    /// Reads a case from its text. Messages call it `name`, the case takes its own name from there, and tables are
    /// looked for in `folder`.
    ///
    /// # Errors
    /// [`Error::Case`], which shows the place: file, line, column, key, and what would be accepted.
    pub fn parse(text: &str, name: &str, folder: impl AsRef<Path>) -> Result<Self> {
        let folder = folder.as_ref();
        build::case(text, name, &|file| {
            let path = folder.join(file);
            let text = read_text(&path, MOST_TABLE_BYTES)?;
            Ok((path.display().to_string(), text))
        })
    }

    /// The case of that name that comes with the crate.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the names there are.
    pub fn embedded(name: &str) -> Result<Self> {
        Embedded::named(name)?.case()
    }

    /// Checks the case as [`Case::parse`] does: for a case whose values were changed since.
    ///
    /// # Errors
    /// [`Error::Invalid`] for the first value that makes no sense.
    pub fn validate(&self) -> Result<()> {
        self.scene.validate()?;
        self.time.validate(self.scene.duration)?;
        let rows = self.scene.duration / self.time.sample.map_or(self.time.step, |s| s.max(self.time.step));
        let columns = 1 + 2 * (self.scene.probes.len() + self.scene.walls.len());
        if rows * columns as f64 > MOST_VALUES {
            let least = self.scene.duration * columns as f64 / MOST_VALUES;
            let value = self.time.sample.map_or("left out".to_owned(), |sample| format!("{sample:?}"));
            let expected =
                format!("at least {least:.1e} s: a row has {columns} values, and a table at most {MOST_VALUES:e}");
            return Err(Error::invalid("time.sample", value, expected));
        }
        self.penalty.validate(&self.scene.walls)
    }
}

/// Most values of a trajectory: rows times columns.
const MOST_VALUES: f64 = 2e8;
/// Largest case file, bytes.
const MOST_CASE_BYTES: u64 = 1 << 20;
/// Largest table file, bytes.
const MOST_TABLE_BYTES: u64 = 1 << 28;

/// The text of a file, or why there is none.
fn read_text(path: &Path, most: u64) -> std::result::Result<String, String> {
    let said = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => "no such file".to_owned(),
        std::io::ErrorKind::PermissionDenied => "not allowed to read it".to_owned(),
        _ => error.to_string(),
    };
    let meta = fs::metadata(path).map_err(said)?;
    if meta.is_dir() {
        return Err("a folder, not a file".to_owned());
    }
    if !meta.is_file() {
        return Err("not a regular file".to_owned());
    }
    let mut bytes = Vec::new();
    fs::File::open(path).and_then(|file| file.take(most + 1).read_to_end(&mut bytes)).map_err(said)?;
    if bytes.len() as u64 > most {
        return Err(format!("more than {most} bytes"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let line = error.as_bytes().iter().take(error.utf8_error().valid_up_to()).filter(|b| **b == b'\n').count() + 1;
        format!("line {line} is not UTF-8 text")
    })
}
