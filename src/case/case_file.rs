//! A case file that is not built yet, so that its values can still be changed by their keys.

use super::key::Key;
use super::key_value::KeyValue;
use super::text::{MOST_CASE_BYTES, MOST_TABLE_BYTES, read_text};
use super::{Case, Embedded, build, changes, summary};
use crate::error::{Error, Result, escaped, nearest};
use crate::scene::State;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The text of a case file, and the location of the files that it names; [`CaseFile::case`] builds
/// it.
///
/// A value that is set by its key goes through the same reader as the file: whatever a file can
/// contain can be set.
///
/// ```
/// use signorini::case::CaseFile;
///
/// let mut file = CaseFile::embedded("rigid-walls-sine")?;
/// file.set(&"wall.upper.position".parse()?, &6e-3.into())?;
/// assert_eq!(file.case()?.scene.walls[0].position, 6e-3);
///
/// file.set(&"wall.*.restitution".parse()?, &2.0.into())?;
/// assert!(file.case().unwrap_err().to_string().contains("expected a number from 0 to 1"));
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct CaseFile {
    /// Its name in messages, without control characters.
    shown: String,
    text: String,
    /// Its values, once some have been changed.
    changed: Option<toml::Table>,
    /// The changes, in words.
    changes: Vec<String>,
    files: Files,
    /// Files that have been read: path and text, by the name used in the case.
    read: Arc<Mutex<BTreeMap<String, (String, String)>>>,
}

/// Location of the files that a case names.
#[derive(Debug, Clone)]
enum Files {
    /// In this folder.
    In(PathBuf),
    /// Built into the crate.
    Embedded(Embedded),
    /// At the paths listed in the summary of a run, if unchanged since.
    Of(Arc<serde_json::Value>),
}

impl CaseFile {
    /// Reads a case file, or the case in the `summary.json` of a run; tables are looked for in the
    /// same folder.
    ///
    /// # Errors
    /// [`Error::Io`] where the file cannot be read.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let json = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"));
        let text = read_text(path, if json { MOST_TABLE_BYTES } else { MOST_CASE_BYTES })
            .map_err(|reason| unreadable(path, &reason))?;
        if json {
            let (name, text, summary) = summary::read(&text, path)?;
            return Ok(Self::new(&text, &name, Files::Of(Arc::new(summary))));
        }
        Ok(Self::from_text(&text, &path.display().to_string(), path.parent().unwrap_or(Path::new(""))))
    }

    /// The built-in case of that name.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the names that exist.
    pub fn embedded(name: &str) -> Result<Self> {
        Ok(Self::of_embedded(*Embedded::named(name)?))
    }

    /// A case file from its text. `name` is used in messages and gives the case its name; tables
    /// are looked for in `folder`.
    #[must_use]
    pub fn from_text(text: &str, name: &str, folder: impl AsRef<Path>) -> Self {
        Self::new(text, name, Files::In(folder.as_ref().to_owned()))
    }

    pub(super) fn of_embedded(embedded: Embedded) -> Self {
        Self::new(embedded.text, &format!("{}.toml", embedded.name), Files::Embedded(embedded))
    }

    fn new(text: &str, name: &str, files: Files) -> Self {
        let (shown, text) = (escaped(name).into_owned(), text.to_owned());
        Self { shown, text, changed: None, changes: Vec::new(), files, read: Arc::default() }
    }

    /// Changes the value at `key`. Whether the key accepts it is checked when the case is built.
    ///
    /// # Errors
    /// [`Error::Case`] for a text that is not TOML, [`Error::Unknown`] for a wall, load or probe
    /// that the file does not have, and [`Error::Invalid`] for an entry of a list that it does not
    /// have.
    pub fn set(&mut self, key: &Key, value: &KeyValue) -> Result<()> {
        self.put(key, value)?;
        self.changes.push(format!("{key} = {value}"));
        Ok(())
    }

    fn put(&mut self, key: &Key, value: &KeyValue) -> Result<()> {
        let mut table = match self.changed.take() {
            Some(table) => table,
            None => self.table()?,
        };
        let done = changes::set(&mut table, key, value);
        self.changed = Some(table);
        done
    }

    /// The value at `key` in the file; `None` where the file leaves it out, or where `*` refers to
    /// several values that differ.
    ///
    /// # Errors
    /// [`Error::Case`] for a text that is not TOML.
    pub fn get(&self, key: &Key) -> Result<Option<KeyValue>> {
        match &self.changed {
            Some(table) => Ok(changes::get(table, key)),
            None => Ok(changes::get(&self.table()?, key)),
        }
    }

    fn table(&self) -> Result<toml::Table> {
        // The reader of case files has the better message for a text that is not TOML.
        toml::from_str(&self.text).or_else(|error| {
            self.case()?;
            Err(Error::Case { report: error.to_string(), cause: None }.caused_by(error))
        })
    }

    /// The text, with the changes made so far, from which the case is built.
    ///
    /// # Errors
    /// Only for values that TOML cannot write.
    pub fn text(&self) -> Result<String> {
        match &self.changed {
            Some(table) => toml::to_string(table).map_err(|error| {
                let report = format!("error: {}: {error}", self.shown);
                Error::Case { report, cause: None }.caused_by(error)
            }),
            None => Ok(self.text.clone()),
        }
    }

    /// The same file with another text, which includes `changes`.
    pub(super) fn rewritten(&self, text: String, changes: Vec<String>) -> Self {
        let (shown, files, read) = (self.shown.clone(), self.files.clone(), Arc::clone(&self.read));
        Self { shown, text, changed: None, changes: self.changes.iter().cloned().chain(changes).collect(), files, read }
    }

    /// Name of the case: that of the file without folder and extension.
    #[must_use]
    pub fn name(&self) -> &str {
        Path::new(&self.shown).file_stem().and_then(|stem| stem.to_str()).unwrap_or("case")
    }

    /// Builds the case. The files that it names are read once and kept.
    ///
    /// # Errors
    /// [`Error::Case`], with the position: file, line, column, key, and what would be accepted.
    pub fn case(&self) -> Result<Case> {
        self.build(None)
    }

    /// Builds the case with `start` in place of its own initial state, if `start` has as many
    /// degrees of freedom (a case reduced to modes has as many as modes, and its own initial state
    /// must be valid too). If the start lies behind a rigid wall, the body is moved to the wall and
    /// keeps its velocity.
    ///
    /// # Errors
    /// As [`CaseFile::case`].
    pub fn case_from(&self, start: &State) -> Result<Case> {
        self.build(Some(start))
    }

    fn build(&self, start: Option<&State>) -> Result<Case> {
        let tables = |file: &str| self.open(file);
        if self.changes.is_empty() {
            return build::case(&self.text, &self.shown, &tables, start);
        }
        let shown = format!("{}, changed by {}", self.shown, self.changes.join(", "));
        let text = if self.changed.is_some() { &self.text()? } else { &self.text };
        let case = build::case(text, &escaped(&shown), &tables, start)?;
        Ok(Case { name: self.name().to_owned(), ..case })
    }

    /// Path and text of the file that the case calls `name`, or why it cannot be read.
    fn open(&self, name: &str) -> std::result::Result<(String, String), String> {
        // A panic in another thread leaves the map valid.
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = read.get(name) {
            return Ok(known.clone());
        }
        let found = match &self.files {
            Files::In(folder) => {
                let path = folder.join(name);
                (path.display().to_string(), read_text(&path, MOST_TABLE_BYTES)?)
            }
            Files::Embedded(embedded) => {
                let table = embedded.tables.iter().find(|(table, _)| *table == name);
                let (name, text) = table.ok_or_else(|| "no such file".to_owned())?;
                ((*name).to_owned(), (*text).to_owned())
            }
            Files::Of(summary) => summary::open(summary, name)?,
        };
        read.insert(name.to_owned(), found.clone());
        Ok(found)
    }
}

/// The error for a case file that does not exist at `path`, with what could have been meant.
fn unreadable(path: &Path, reason: &str) -> Error {
    let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or_default();
    let hint = match Embedded::named(stem) {
        Ok(embedded) => format!("`signorini new {}` writes the case of that name", embedded.name),
        Err(_) => {
            let known = Embedded::all().iter().map(|case| case.name);
            nearest(stem, known).map_or_else(
                || "a case file is a TOML text; `signorini new rigid-walls-sine` writes one to start from".into(),
                |near| format!("did you mean {near}? It is a built-in case; `signorini new` lists them all"),
            )
        }
    };
    let shown = if path.as_os_str().is_empty() { "\"\"".to_owned() } else { path.display().to_string() };
    Error::io(shown, format!("{reason}\nhelp: {hint}"), true)
}
