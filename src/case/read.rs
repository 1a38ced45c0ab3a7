//! Reads cases from files, from text, and from the built-in cases.

use super::case_file::CaseFile;
use super::{Case, Embedded, Key, KeyValue, build};
use crate::error::{Error, Result};
use crate::scene::State;
use std::path::Path;

impl Case {
    /// Reads a case file; tables are looked for in the same folder. From the `summary.json` of a
    /// run it reads the case of that run, provided that the files which the run read are unchanged.
    ///
    /// # Errors
    /// [`crate::Error::Io`] where the file cannot be read, [`crate::Error::Case`] where its content
    /// is invalid.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        CaseFile::read(path)?.case()
    }

    /// Reads a case from its text. `name` is used in messages and gives the case its name; tables
    /// are looked for in `folder`.
    ///
    /// # Errors
    /// [`crate::Error::Case`], with the position: file, line, column, key, and what would be
    /// accepted.
    pub fn parse(text: &str, name: &str, folder: impl AsRef<Path>) -> Result<Self> {
        CaseFile::from_text(text, name, folder).case()
    }

    /// The case of the same document with `value` at `key`, built anew; see [`Key`] for keys.
    ///
    /// ```
    /// use signorini::case::Case;
    ///
    /// let case = Case::embedded("tube-loose-supports")?.with("system.modes", 4)?;
    /// assert_eq!(case.scene.system.degrees_of_freedom(), 4);
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`CaseFile::set`] and [`CaseFile::case`].
    pub fn with(&self, key: &str, value: impl Into<KeyValue>) -> Result<Self> {
        let mut document = self.document.clone();
        document.set(&key.parse::<Key>()?, &value.into())?;
        document.case()
    }

    /// The built-in case of that name.
    ///
    /// # Errors
    /// [`crate::Error::Unknown`], listing the names that exist.
    pub fn embedded(name: &str) -> Result<Self> {
        Embedded::named(name)?.case()
    }
}

impl CaseFile {
    /// Builds the case. The files that it names are read once and kept.
    ///
    /// # Errors
    /// [`crate::Error::Case`], with file, line, column and key, and what would be accepted.
    pub fn case(&self) -> Result<Case> {
        build::case(self, None).map_err(|error| self.in_lines_of_its_text(error))
    }

    /// `error` of the changed document, shown at the lines of the text, where the text has it as
    /// well: the user knows those.
    fn in_lines_of_its_text(&self, error: Error) -> Error {
        let title = |error: &Error| error.to_string().lines().next().map(str::to_owned);
        let own = self.as_written().and_then(|file| build::case(&file, None).err());
        own.filter(|own| title(own) == title(&error)).unwrap_or(error)
    }

    /// Builds the case with `start` in place of its own initial state, if `start` has as many
    /// degrees of freedom (a case reduced to modes has as many as modes, and its own initial state
    /// must be valid too). If the start lies behind a rigid wall, the body is moved to the wall and
    /// keeps its velocity.
    ///
    /// # Errors
    /// As [`CaseFile::case`].
    pub fn case_from(&self, start: &State) -> Result<Case> {
        build::case(self, Some(start))
    }
}

impl Embedded {
    /// The case that the text holds.
    ///
    /// # Errors
    /// Never for the built-in texts, which the tests read.
    pub fn case(&self) -> Result<Case> {
        CaseFile::of_embedded(*self).case()
    }
}
