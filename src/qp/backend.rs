//! The choice of solver.

use crate::error::names;
use serde::{Deserialize, Serialize};

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

names!(Backend: "QP solver",
    Auto => "auto", Clamp => "clamp", Condensed => "condensed", Clarabel => "clarabel");
