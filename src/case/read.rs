//! Cases from files, from text, and from those that come with the crate.

use super::text::{MOST_CASE_BYTES, MOST_TABLE_BYTES, read_text};
use super::{Case, Embedded, build, summary};
use crate::error::{Error, Result, nearest};
use std::path::Path;

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
}
