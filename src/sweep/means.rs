//! The means over realisations, as a table for the terminal.

use super::columns::{Source, half_width_of, short};
use super::picture::Picture;
use super::seeds::in_words;
use super::table::{SEEDS, TABLE, Table, label};
use crate::error::Result;
use crate::output::realisations::with_interval;
use crate::output::table;
use crate::study::realisations::RealisationCount;
use serde_json::{Map, Value};
use std::path::Path;

/// Most rows of the table.
const MOST_ROWS: usize = 30;

/// A column of the table in the terminal.
enum Shown {
    /// A column as it is.
    Cell(usize),
    /// A mean, and the half width of its interval.
    Mean(usize, Option<usize>),
}

/// The means of the rows in `folder`, of the request `request`, each with the half width of its
/// interval, and what a reader must know of them; `None` for rows without realisations, and for
/// more rows than a terminal shows.
///
/// # Errors
/// [`Error::Io`](crate::Error::Io) for a table that cannot be read.
pub(crate) fn means(folder: &Path, request: &Map<String, Value>) -> Result<Option<(table::Table, String)>> {
    let source = Source::new(folder, request, "");
    let Some(count) = source.seeds else { return Ok(None) };
    let table = Table::open(&folder.join(TABLE))?;
    let (seeds, row) = (table.column(SEEDS)?, table.column("row")?);
    let (mut header, mut columns) = (Vec::new(), Vec::new());
    if source.axes.len() > 1 {
        header.push("Row".to_owned());
        columns.push(Shown::Cell(row));
    }
    for axis in &source.axes {
        header.push(label(&axis.column));
        columns.push(Shown::Cell(table.column(&axis.column)?));
    }
    for (measure, names) in Picture::default().measures(None, &source)? {
        for name in names {
            header.push(label(&name));
            columns.push(Shown::Mean(table.column(&name)?, table.column(&half_width_of(&name, &measure)).ok()));
        }
    }
    let (mut rows, mut whole) = (Vec::new(), true);
    table.each(|line| {
        let cell = |column: &Shown| match *column {
            Shown::Cell(at) => short(line.text(at)),
            Shown::Mean(mean, half) => {
                let half = half.and_then(|half| line.number(half));
                line.number(mean).map_or_else(|| "-".to_owned(), |mean| with_interval(mean, half))
            }
        };
        whole &= matches!(count, RealisationCount::Exactly(count) if line.number(seeds) == Some(count as f64));
        let mut cells: Vec<String> = columns.iter().map(cell).collect();
        cells.insert(1, line.text(seeds).to_owned());
        rows.push(cells);
    })?;
    if rows.is_empty() || rows.len() > MOST_ROWS {
        return Ok(None);
    }
    // How many realisations there are in the means matters where it is not the same in all rows.
    header.insert(1, "Seeds".to_owned());
    if whole {
        header.remove(1);
        rows.iter_mut().for_each(|cells| drop(cells.remove(1)));
    }
    let remark = format!(
        "± is the half width of the 95 % interval of the mean over {}, by Student's t; their seeds \
         are the same in every row",
        in_words(count)
    );
    Ok(Some((table::Table::new(&header, rows), remark)))
}
