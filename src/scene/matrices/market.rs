//! Matrices in the Matrix Market format (Boisvert, Pozo & Remington 1996, NISTIR 5935).

use super::pairs::{Entry, symmetric};
use super::{MOST_ENTRIES, MOST_ROWS, MatrixLine, TextError, at_end, lines};
use crate::linear::Symmetric;

const HEADER: &str = "%%MatrixMarket matrix coordinate|array real|integer general|symmetric";

/// Reads a matrix in Matrix Market format, coordinate or array, real or integer, general or
/// symmetric. The triangles of a general one must agree to 1e-8 of the entry or of √|aᵢᵢ aⱼⱼ|;
/// their mean is taken. Entries of a symmetric coordinate matrix may stand in either triangle, each
/// once; those of a symmetric array are the lower triangle, column by column.
///
/// # Errors
/// [`TextError`] with the line that violates this.
pub fn read_matrix_market(text: &str) -> Result<Symmetric, TextError> {
    let mut lines = lines(text);
    let header = lines.next().ok_or_else(|| at_end(text, "an empty text", HEADER))?;
    let (coordinate, half) = kind(&header)?;
    let mut body = lines.filter(|line| !line.text.trim().is_empty() && !line.text.trim_start().starts_with('%'));
    let shape = if coordinate { "rows, columns and number of entries" } else { "rows and columns" };
    let size = body.next().ok_or_else(|| at_end(text, "no line of sizes", format!("{shape} below the header")))?;
    let sizes = whole_numbers(&size, if coordinate { 3 } else { 2 }, shape)?;
    let (n, columns) = (sizes[0], sizes[1]);
    if n != columns || n == 0 {
        return Err(size.error(format!("a matrix of {n} × {columns}"), "a square matrix, 1 × 1 or more"));
    }
    if n > MOST_ROWS {
        return Err(size.error(format!("a matrix of {n} × {n}"), format!("at most {MOST_ROWS} rows")));
    }
    let count = if coordinate {
        sizes[2]
    } else if half {
        n * (n + 1) / 2
    } else {
        n * n
    };
    if count > MOST_ENTRIES {
        return Err(size.error(format!("{count} entries"), format!("at most {MOST_ENTRIES}")));
    }
    let mut entries = Vec::new();
    // Arrays are stored column by column.
    let (mut row, mut column) = (0, 0);
    for line in body {
        if entries.len() == count {
            return Err(line.error(format!("an entry after the last of {count}"), "as many entries as announced"));
        }
        if coordinate {
            entries.push(triplet(line, n)?);
            continue;
        }
        let value = line.number(line.text.trim())?;
        entries.push(Entry { row, column, value, line });
        row += 1;
        if row == n {
            column += 1;
            row = if half { column } else { 0 };
        }
    }
    if entries.len() < count {
        return Err(at_end(text, format!("{} entries of {count}", entries.len()), "as many entries as announced"));
    }
    symmetric(n, entries, half)
}

/// Whether the format is coordinate, and whether it stores one triangle only.
fn kind(header: &MatrixLine<'_>) -> Result<(bool, bool), TextError> {
    let words: Vec<&str> = header.text.split_whitespace().collect();
    let is = |word: &str, name: &str| word.eq_ignore_ascii_case(name);
    let [banner, object, format, field, symmetry] = words.as_slice() else {
        return Err(header.error("no header of five words", HEADER));
    };
    if !is(banner, "%%MatrixMarket") || !is(object, "matrix") {
        return Err(header.error(format!("{banner} {object} in the header"), HEADER));
    }
    if !is(format, "coordinate") && !is(format, "array") {
        return Err(header.error_at(format, format!("the format {format:?}"), "coordinate or array"));
    }
    if !["real", "integer", "double"].iter().any(|name| is(field, name)) {
        return Err(header.error_at(field, format!("the field {field:?}"), "real or integer"));
    }
    if !is(symmetry, "general") && !is(symmetry, "symmetric") {
        return Err(header.error_at(symmetry, format!("the symmetry {symmetry:?}"), "general or symmetric"));
    }
    Ok((is(format, "coordinate"), is(symmetry, "symmetric")))
}

fn whole_numbers(line: &MatrixLine<'_>, count: usize, what: &str) -> Result<Vec<usize>, TextError> {
    let expected = || format!("{count} whole numbers: {what}");
    let fields: Vec<&str> = line.text.split_whitespace().collect();
    if fields.len() != count {
        return Err(line.error(format!("{} values", fields.len()), expected()));
    }
    let parse = |field: &&str| {
        field.parse::<usize>().map_err(|_| line.error_at(field, format!("{field:?} is no whole number"), expected()))
    };
    fields.iter().map(parse).collect()
}

/// Row, column (from 1) and value.
fn triplet(line: MatrixLine<'_>, n: usize) -> Result<Entry<'_>, TextError> {
    let expected = || format!("row and column from 1 to {n}, and a value");
    let fields: Vec<&str> = line.text.split_whitespace().collect();
    let [row, column, value] = fields.as_slice() else {
        return Err(line.error(format!("{} values", fields.len()), expected()));
    };
    let index = |field: &str| match field.parse::<usize>() {
        Ok(i) if (1..=n).contains(&i) => Ok(i - 1),
        _ => Err(line.error_at(field, format!("{field:?} is no row or column"), expected())),
    };
    Ok(Entry { row: index(row)?, column: index(column)?, value: line.number(value)?, line })
}
