//! Combines the entries of both triangles into one symmetric matrix.

use super::{MatrixLine, TextError};
use crate::linear::Symmetric;

/// Tolerance between an entry and its mirror across the diagonal, relative to the larger or to
/// √|aᵢᵢ aⱼⱼ|. Products VᵀKV of assembled matrices with shapes have the rounding of the largest
/// entries of K in all of theirs: 3e-10 of √|aᵢᵢ aⱼⱼ| with 200 beam elements.
const SYMMETRIC: f64 = 1e-8;

/// True if two entries that mirror each other are the same but for rounding, with the two
/// `diagonal` entries of their rows.
pub(super) fn agree([a, b]: [f64; 2], diagonal: [f64; 2]) -> bool {
    let scale = (diagonal[0] * diagonal[1]).abs().sqrt();
    (a - b).abs() <= SYMMETRIC * a.abs().max(b.abs()).max(scale)
}

/// One entry and the line it was read from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry<'a> {
    pub row: usize,
    pub column: usize,
    pub value: f64,
    pub line: MatrixLine<'a>,
}

/// The matrix of `entries`, with each position given once. If not `half`, both triangles are given
/// and must agree; their mean is used.
pub(super) fn symmetric(n: usize, mut entries: Vec<Entry<'_>>, half: bool) -> Result<Symmetric, TextError> {
    let place = |e: &Entry<'_>| (e.row.max(e.column), e.row.min(e.column));
    let mut diagonal = vec![0.0; n];
    for entry in entries.iter().filter(|e| e.row == e.column) {
        diagonal[entry.row] = entry.value;
    }
    // Sorted so that pairs are adjacent, in the order of their lines.
    entries.sort_by_key(|e| (place(e), e.line.number));
    let mut merged = Vec::with_capacity(entries.len());
    let mut rest = entries.as_slice();
    while let Some((first, after)) = rest.split_first() {
        let same = after.iter().take_while(|e| place(e) == place(first)).count();
        let named = |e: &Entry<'_>| format!("the entry of row {}, column {}", e.row + 1, e.column + 1);
        let mirrors = |value: f64| agree([first.value, value], [diagonal[first.row], diagonal[first.column]]);
        let twin = after.first().filter(|_| same > 0);
        if let Some(twin) = twin {
            let repeated = after[..same].iter().find(|e| half || (e.row, e.column) == (first.row, first.column));
            if let Some(again) = repeated.or_else(|| after[..same].get(1)) {
                let expected = if half { "each entry once, in one triangle" } else { "each entry once" };
                return Err(again.line.error(format!("{} comes a second time", named(again)), expected));
            }
            if !mirrors(twin.value) {
                let message = format!("{} is {:?}", named(twin), twin.value);
                let expected = format!(
                    "{:?} as across the diagonal, on line {}: a matrix symmetric to {SYMMETRIC:?} of the entry or of \
                     √|a_ii a_jj|",
                    first.value, first.line.number
                );
                return Err(twin.line.error(message, expected));
            }
            merged.push((first.row, first.column, 0.5 * (first.value + twin.value)));
        } else {
            if !half && first.row != first.column && !mirrors(0.0) {
                let message = format!(
                    "{} is {:?}, and its mirror entry across the diagonal is missing",
                    named(first),
                    first.value
                );
                return Err(first.line.error(message, "both entries of a pair, or the header word symmetric"));
            }
            merged.push((first.row, first.column, first.value));
        }
        rest = &after[same..];
    }
    Ok(Symmetric::from_entries(n, merged))
}
