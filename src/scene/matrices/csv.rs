//! Matrices as rows of numbers.

use super::pairs::{Entry, symmetric};
use super::{MOST_ENTRIES, TextError, at_end, lines};
use crate::linear::Symmetric;

const FORMAT: &str = "n rows of n numbers with commas between them, without a header";

/// Reads n lines of n numbers with commas between them; blank lines are ignored. The two triangles
/// must agree to 1e-8 of the entry or of √|aᵢᵢ aⱼⱼ|; their mean is taken.
///
/// # Errors
/// [`TextError`] with the line that violates this.
pub fn read_csv(text: &str) -> Result<Symmetric, TextError> {
    let mut entries: Vec<Entry<'_>> = Vec::new();
    let (mut row, mut n) = (0, 0);
    for line in lines(text).filter(|line| !line.text.trim().is_empty()) {
        let columns = line.text.split(',').count();
        if row == 0 {
            n = columns;
            if n.saturating_mul(n) > MOST_ENTRIES {
                let most = MOST_ENTRIES.isqrt();
                return Err(line.error(format!("{n} columns"), format!("at most {most}; larger ones as Matrix Market")));
            }
        }
        if columns != n {
            return Err(line.error(format!("{columns} values in row {}", row + 1), format!("{n}, as in the first row")));
        }
        if row == n {
            return Err(line.error(format!("row {} of a matrix of {n} columns", row + 1), FORMAT));
        }
        for (column, field) in line.text.split(',').enumerate() {
            let value =
                line.number(field.trim()).map_err(|error| TextError { expected: FORMAT.to_owned(), ..error })?;
            entries.push(Entry { row, column, value, line });
        }
        row += 1;
    }
    if row == 0 || row < n {
        return Err(at_end(text, format!("{row} rows of {n} values"), FORMAT));
    }
    symmetric(n, entries, false)
}
