//! What the keys of a sweep change in its measures, by the runs of all its rows together: the
//! effect of each key where they are varied one at a time, its share in the variance where they are
//! drawn at random. Over a grid there is neither.

use super::columns::Source;
use super::effects::{self, Effect, effects};
use super::shares::{self, Shares, shares};
use super::table::object;
use crate::error::Result;
use crate::output::csv;
use crate::output::results::Results;
use serde_json::{Map, Value};
use std::path::Path;

/// The names of the tables of sensitivities, and of their files.
pub(crate) const SENSITIVITY_TABLES: [(&str, &str); 2] = [("effects", EFFECTS), ("shares", SHARES)];

const EFFECTS: &str = "effects.csv";
const SHARES: &str = "shares.csv";

/// What the keys of a sweep change in its measures.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Sensitivity {
    /// The effect of each key, by measure and place.
    Effects(Vec<Effect>),
    /// The share of each key in the variance, by measure and place.
    Shares(Vec<Shares>),
}

impl Sensitivity {
    /// By the tables of a whole sweep in `folder`; `None` for one over a grid.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io) for a table that cannot be read.
    pub fn read(folder: &Path, request: &Map<String, Value>) -> Result<Option<Self>> {
        let source = Source::new(folder, request, "");
        Ok(if source.one_at_a_time {
            Some(Self::Effects(effects(&source)?))
        } else if source.random {
            Some(Self::Shares(shares(&source)?))
        } else {
            None
        })
    }

    /// Adds its table to `results`, unless there are no numbers for it; true where it was added.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io) where it cannot be written.
    pub fn write(&self, results: &mut Results) -> Result<bool> {
        let (file, header, lines) = self.table();
        if lines.is_empty() {
            return Ok(false);
        }
        csv::table(&results.place(file)?, header, lines.into_iter())?;
        Ok(true)
    }

    /// The key of its table in a document, and its lines as objects.
    pub fn objects(&self) -> (&'static str, Vec<Value>) {
        let (file, header, lines) = self.table();
        let key = SENSITIVITY_TABLES.iter().find(|(_, of)| *of == file).map_or(file, |(key, _)| key);
        let own = |line: &Vec<String>| object(header.iter().copied(), line.iter().map(String::as_str));
        (key, lines.iter().map(own).collect())
    }

    /// The name of the file of its table, the columns, and the lines.
    fn table(&self) -> (&'static str, &'static [&'static str], Vec<Vec<String>>) {
        match self {
            Self::Effects(all) => (EFFECTS, &effects::HEADER, all.iter().map(Effect::cells).collect()),
            Self::Shares(all) => (SHARES, &shares::HEADER, all.iter().flat_map(Shares::lines).collect()),
        }
    }
}
