//! The choice of solver.

use crate::error::{Error, named};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The solver of the programme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Backend {
    /// One unknown: [`Backend::Clamp`]; several: [`Backend::Condensed`].
    #[default]
    Auto,
    /// The exact solution of the scalar programme. One unknown only.
    Clamp,
    /// Block principal pivoting on the Delassus operator: exact, warm-started.
    Condensed,
    /// The interior-point solver Clarabel, whose active set is then solved for exactly.
    Clarabel,
}

impl Backend {
    /// Every choice, in the order in which they are listed to users.
    pub const ALL: [Self; 4] = [Self::Auto, Self::Clamp, Self::Condensed, Self::Clarabel];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Clamp => "clamp",
            Self::Condensed => "condensed",
            Self::Clarabel => "clarabel",
        }
    }
}

impl fmt::Display for Backend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Backend {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        named("QP solver", name, Self::ALL.map(|backend| (backend.name(), backend)))
    }
}
