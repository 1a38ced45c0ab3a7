//! The key that an axis of a sweep changes.

use crate::case::Key;
use crate::error::{Error, Result};
use std::fmt;
use std::str::FromStr;

/// What an axis changes.
#[derive(Debug, Clone, PartialEq)]
pub enum Target {
    /// A value of the case file.
    Case(Key),
    /// The scheme: `run.scheme`.
    Scheme,
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Case(key) => key.fmt(f),
            Self::Scheme => f.write_str(SCHEME),
        }
    }
}

impl FromStr for Target {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        if text.trim() == SCHEME { Ok(Self::Scheme) } else { text.parse().map(Self::Case) }
    }
}

/// The key of the scheme.
const SCHEME: &str = "run.scheme";

impl Target {
    /// Unit of its values, as column names write it; `None` for a number without one.
    pub(super) fn unit(&self) -> Option<&'static str> {
        if let Self::Case(key) = self { key.unit() } else { None }
    }

    /// True for the seed of a random load or of turbulence: `load.1.random.seed`,
    /// `turbulence.1.seed`.
    pub(super) fn is_seed(&self) -> bool {
        matches!(self, Self::Case(key) if key.word() == "seed")
    }

    /// True for the time step.
    pub(super) fn is_step(&self) -> bool {
        matches!(self, Self::Case(key) if key.to_string() == "time.step")
    }

    /// Name of the column of its values: the last word of the key, or the whole key.
    pub(super) fn column(&self, whole: bool) -> String {
        let name = match self {
            Self::Case(key) if whole => key.to_string().replace('*', "all").replace(['.', '-'], "_"),
            Self::Case(key) => key.word().to_owned(),
            Self::Scheme => "scheme".to_owned(),
        };
        with_unit(&name, self.unit())
    }
}

/// `name` with its unit, as columns are named.
pub(super) fn with_unit(name: &str, unit: Option<&str>) -> String {
    unit.map_or_else(|| name.to_owned(), |unit| format!("{name}_{unit}"))
}
