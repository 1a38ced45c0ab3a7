//! Symmetric matrices from text; `rows.rs` has `Symmetric::from_rows`.
//!
//! | function | what it reads |
//! |---|---|
//! | [`read_matrix_market`] | Matrix Market, coordinate or array |
//! | [`read_csv`] | all rows of numbers, without a header |

mod csv;
mod market;
mod pairs;
mod rows;

pub use csv::read_csv;
pub use market::read_matrix_market;

use std::fmt;
use std::ops::Range;

/// The largest size n of a matrix that is read.
pub const MOST_ROWS: usize = 200_000;
/// The most entries of a matrix that are read.
pub const MOST_ENTRIES: usize = 4_000_000;

/// An error in the text of a matrix, and its position.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextError {
    /// Line, from 1.
    pub line: usize,
    /// The bytes of the text in question, on that line.
    pub span: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// What would be accepted.
    pub expected: String,
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}; expected {}", self.line, self.message, self.expected)
    }
}

impl std::error::Error for TextError {}

/// A line of a text: its number from 1, the byte at which it starts, and its text without the line
/// end.
#[derive(Debug, Clone, Copy)]
struct MatrixLine<'a> {
    number: usize,
    start: usize,
    text: &'a str,
}

impl<'a> MatrixLine<'a> {
    fn error(&self, message: impl Into<String>, expected: impl Into<String>) -> TextError {
        self.error_at(self.text, message, expected)
    }

    /// An error at `part`, a slice of this line.
    fn error_at(&self, part: &str, message: impl Into<String>, expected: impl Into<String>) -> TextError {
        let offset = (part.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize).min(self.text.len());
        let start = self.start + offset;
        let end = start + part.len().min(self.text.len() - offset);
        TextError { line: self.number, span: start..end, message: message.into(), expected: expected.into() }
    }

    /// A finite number; Fortran writes the exponent of a double after a D.
    fn number(&self, field: &'a str) -> Result<f64, TextError> {
        let fortran = |_| field.replace(['D', 'd'], "E").parse::<f64>();
        match field.parse::<f64>().or_else(fortran) {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err(self.error_at(field, format!("{field:?} is no finite number"), "a finite number")),
        }
    }
}

/// The lines of `text`, without a byte-order mark.
fn lines(text: &str) -> impl Iterator<Item = MatrixLine<'_>> {
    let mark = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let mut start = mark;
    text[mark..].split_inclusive('\n').enumerate().map(move |(index, raw)| {
        let line = MatrixLine { number: index + 1, start, text: raw.trim_end_matches(['\n', '\r']) };
        start += raw.len();
        line
    })
}

/// An error at the end of `text`.
fn at_end(text: &str, message: impl Into<String>, expected: impl Into<String>) -> TextError {
    let end = text.trim_end().len();
    let line = text[..end].matches('\n').count() + 1;
    TextError { line, span: end..end, message: message.into(), expected: expected.into() }
}
