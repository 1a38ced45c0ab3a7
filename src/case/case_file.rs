//! A case file that is not built yet, so that its values can still be changed by their keys.

use super::key::Key;
use super::key_value::KeyValue;
use super::report::Source;
use super::text::{MOST_CASE_BYTES, MOST_TABLE_BYTES, read_text};
use super::{Embedded, changes, summary};
use crate::error::{Error, Result, escaped, nearest};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
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
/// assert_eq!(file.case()?.scene.walls[0].position(), 6e-3);
///
/// file.set(&"wall.*.restitution".parse()?, &2.0.into())?;
/// assert!(file.case().unwrap_err().to_string().contains("expected a number from 0 to 1"));
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct CaseFile {
    /// Its name in messages, without control characters.
    shown: String,
    text: Arc<str>,
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

    /// The file that is taken for the case `name` in `folder`: the one of that name; else, for a
    /// name without an extension, NAME.toml.
    #[cfg(feature = "cli")]
    pub(crate) fn found(folder: &Path, name: &str) -> Option<PathBuf> {
        let file = Path::new(name);
        // `..` and `.toml` do not get an extension.
        let bare = file.extension().is_none() && file.file_name().is_some();
        let files = [folder.join(name), folder.join(format!("{name}.toml"))];
        files.into_iter().take(if bare { 2 } else { 1 }).find(|file| file.is_file())
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
        let (shown, text) = (escaped(name).into_owned(), text.into());
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

    /// Removes the value at `key`, so that its default holds; nothing where the file leaves it out.
    ///
    /// # Errors
    /// As [`CaseFile::set`].
    #[cfg(feature = "cli")]
    pub(crate) fn remove(&mut self, key: &Key) -> Result<()> {
        if self.get(key)?.is_some() {
            let mut table = self.table()?;
            changes::remove(&mut table, key);
            self.changed = Some(table);
            self.changes.push(format!("{key} left out"));
        }
        Ok(())
    }

    /// The key of the restitution of each rigid wall and support.
    ///
    /// # Errors
    /// [`Error::Case`] for a text that is not TOML.
    #[cfg(feature = "cli")]
    pub(crate) fn restitutions(&self) -> Result<Vec<Key>> {
        let table = self.table()?;
        let entries = ["wall", "support"].into_iter().flat_map(|list| {
            let all = table.get(list).and_then(toml::Value::as_array).into_iter().flatten();
            all.filter(|entry| entry.get("stiffness").is_none())
                .filter_map(move |entry| Some(format!("{list}.{}.restitution", entry.get("name")?.as_str()?)))
        });
        entries.map(|key| key.parse()).collect()
    }

    /// Its values, with the changes made so far, as JSON.
    ///
    /// # Errors
    /// [`Error::Case`] for a text that is not TOML.
    #[cfg(feature = "cli")]
    pub(crate) fn json(&self) -> Result<serde_json::Value> {
        serde_json::to_value(self.table()?).map_err(|error| self.unwritable(error))
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

    /// Its values, with the changes made so far.
    pub(super) fn table(&self) -> Result<toml::Table> {
        if let Some(table) = &self.changed {
            return Ok(table.clone());
        }
        let source = Source { name: &self.shown, text: &self.text };
        toml::from_str(&self.text).map_err(|error: toml::de::Error| source.toml(error.clone()).caused_by(error))
    }

    /// The text, with the changes made so far, from which the case is built.
    ///
    /// # Errors
    /// Only for values that TOML cannot write.
    pub fn text(&self) -> Result<String> {
        self.effective().map(Cow::into_owned)
    }

    /// The same, borrowed where nothing was changed.
    pub(super) fn effective(&self) -> Result<Cow<'_, str>> {
        match &self.changed {
            Some(table) => toml::to_string(table).map(Cow::Owned).map_err(|error| self.unwritable(error)),
            None => Ok(Cow::Borrowed(&self.text)),
        }
    }

    fn unwritable(&self, error: impl std::error::Error + Send + Sync + 'static) -> Error {
        Error::Case { report: format!("error: {}: {error}", self.shown), cause: None }.caused_by(error)
    }

    /// The same file with another text, which includes `changes`.
    pub(super) fn rewritten(&self, text: String, changes: Vec<String>) -> Self {
        let (shown, files, read) = (self.shown.clone(), self.files.clone(), Arc::clone(&self.read));
        Self {
            shown,
            text: text.into(),
            changed: None,
            changes: self.changes.iter().cloned().chain(changes).collect(),
            files,
            read,
        }
    }

    /// The same file without the changes of its values; `None` where there are none.
    pub(super) fn as_written(&self) -> Option<Self> {
        self.changed.is_some().then(|| Self { changed: None, changes: Vec::new(), ..self.clone() })
    }

    /// Name of the case: that of the file without folder and extension.
    #[must_use]
    pub fn name(&self) -> &str {
        Path::new(&self.shown).file_stem().and_then(|stem| stem.to_str()).unwrap_or("case")
    }

    /// Its name in messages, with the changes made so far.
    pub(super) fn name_with_changes(&self) -> Cow<'_, str> {
        match self.changes.as_slice() {
            [] => Cow::Borrowed(&self.shown),
            changes => escaped(&format!("{}, changed by {}", self.shown, changes.join(", "))).into_owned().into(),
        }
    }

    /// Path and text of the file that the case calls `name`, or why it cannot be read.
    pub(super) fn open(&self, name: &str) -> std::result::Result<(String, String), String> {
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

/// Case files are equal if their values are, however they are written.
impl PartialEq for CaseFile {
    fn eq(&self, other: &Self) -> bool {
        self.table().ok() == other.table().ok()
    }
}

/// What goes to another process or machine: the text with its changes, and the files read so far,
/// of which a built case has read all.
#[derive(Serialize, Deserialize)]
struct Packed {
    shown: String,
    text: String,
    changes: Vec<String>,
    read: BTreeMap<String, (String, String)>,
}

impl Serialize for CaseFile {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let text = self.text().map_err(serde::ser::Error::custom)?;
        let read = self.read.lock().unwrap_or_else(PoisonError::into_inner).clone();
        Packed { shown: self.shown.clone(), text, changes: self.changes.clone(), read }.serialize(serializer)
    }
}

/// Files that it had not read are looked for in the working folder.
impl<'de> Deserialize<'de> for CaseFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        let Packed { shown, text, changes, read } = Packed::deserialize(deserializer)?;
        let file = Self::new(&text, &shown, Files::In(PathBuf::new()));
        Ok(Self { changes, read: Arc::new(Mutex::new(read)), ..file })
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
