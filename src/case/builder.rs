//! State shared by all parts of the reader of a case.

use super::Written;
use super::model::Model;
use super::planes::Planes;
use super::report::Source;
use crate::error::Subject;
use std::ops::Range;

/// Most masses in a chain.
pub(super) const MOST_MASSES: usize = 1_000_000;

/// Finds a file that a case names: its full name and its text, or why it cannot be read.
pub(super) type TableReader<'a> = &'a dyn Fn(&str) -> std::result::Result<(String, String), String>;

/// Reads a case, table by table.
pub(super) struct Builder<'a> {
    pub source: Source<'a>,
    /// Subjects that an error may name, and the positions of their values.
    pub places: Vec<(Subject, Range<usize>)>,
    pub tables: TableReader<'a>,
    pub model: Model,
    pub planes: Planes,
    /// Degrees of freedom of the structure in one plane; of matrices, of both.
    pub n: usize,
    pub static_correction: bool,
    pub written: Written,
}
