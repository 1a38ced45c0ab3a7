//! Reads cases from files, from text, and from the built-in cases.

use super::case_file::CaseFile;
use super::{Case, Embedded};
use crate::error::Result;
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

    /// The built-in case of that name.
    ///
    /// # Errors
    /// [`crate::Error::Unknown`], listing the names that exist.
    pub fn embedded(name: &str) -> Result<Self> {
        Embedded::named(name)?.case()
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
