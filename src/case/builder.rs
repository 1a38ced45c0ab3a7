//! What every part of the reading of a case shares.

use super::Written;
use super::model::Model;
use super::report::Source;
use crate::error::Subject;
use std::ops::Range;

/// Most masses of a chain.
pub(super) const MOST_MASSES: usize = 1_000_000;

/// How the text of a file that a case names is found: its full name and its text, or why there is none.
pub(super) type TableReader<'a> = &'a dyn Fn(&str) -> std::result::Result<(String, String), String>;

/// Reads a case, table by table.
pub(super) struct Builder<'a> {
    pub source: Source<'a>,
    /// What an error may be about, and where its value stands.
    pub places: Vec<(Subject, Range<usize>)>,
    pub tables: TableReader<'a>,
    pub model: Model,
    /// Degrees of freedom of the whole structure.
    pub n: usize,
    pub static_correction: bool,
    pub written: Written,
}
