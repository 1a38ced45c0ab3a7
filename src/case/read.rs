//! Cases from files, from text, and from those that come with the crate.

use super::case_file::CaseFile;
use super::{Case, Embedded};
use crate::error::Result;
use std::path::Path;

impl Case {
    /// Reads a case file; tables are looked for beside it. From the `summary.json` of a run it reads the case of that run again, provided that
    /// the files which it read are the same still.
    ///
    /// # Errors
    /// [`crate::Error::Io`] where the file cannot be read, [`crate::Error::Case`] where it makes no sense.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        CaseFile::read(path)?.case()
    }

    /// Reads a case from its text. Messages call it `name`, the case takes its own name from there, and tables are
    /// looked for in `folder`.
    ///
    /// # Errors
    /// [`crate::Error::Case`], which shows the place: file, line, column, key, and what would be accepted.
    pub fn parse(text: &str, name: &str, folder: impl AsRef<Path>) -> Result<Self> {
        CaseFile::from_text(text, name, folder).case()
    }

    /// The case of that name that comes with the crate.
    ///
    /// # Errors
    /// [`crate::Error::Unknown`], listing the names there are.
    pub fn embedded(name: &str) -> Result<Self> {
        Embedded::named(name)?.case()
    }
}

impl Embedded {
    /// The case that the text holds.
    ///
    /// # Errors
    /// None for the texts that come with the crate, which its tests read.
    pub fn case(&self) -> Result<Case> {
        CaseFile::of_embedded(*self).case()
    }
}
