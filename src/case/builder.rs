//! State shared by all parts of the reader of a case.

use super::Written;
use super::case_file::CaseFile;
use super::model::Model;
use super::planes::Planes;
use super::report::Source;
use crate::error::Subject;
use std::ops::Range;

/// Most masses in a chain.
pub(super) const MOST_MASSES: usize = 1_000_000;

/// Reads a case, table by table.
pub(super) struct Builder<'a> {
    pub source: Source<'a>,
    /// Subjects that an error may name, and the positions of their values.
    pub places: Vec<(Subject, Range<usize>)>,
    /// The case file, which opens the files that it names.
    pub document: &'a CaseFile,
    pub model: Model,
    pub planes: Planes,
    /// Where the spans of a beam end, m, in order.
    pub joints: Vec<f64>,
    /// Degrees of freedom of the structure in one plane; of matrices, of both.
    pub n: usize,
    pub static_correction: bool,
    pub written: Written,
}
