//! A row as the lines of its tables.

use super::basin::described;
use super::plan::Plan;
use super::row::Row;
use super::sample::Sample;
use super::scars::rates_cell;
use super::table::line_of;
use crate::output::csv::digits;

impl Plan {
    /// The line of `row` in `sweep.csv`, or of its realisation in `realisations.csv` with work
    /// rates in the place of depths, with the line break.
    pub(super) fn line(&self, row: &Row) -> Vec<u8> {
        let mut cells = numbers(row);
        cells.extend(row.direction.map(str::to_owned));
        // Integers and words as they are, other numbers with all their digits.
        cells.extend(row.values.iter().map(|value| match value.number() {
            Some(x) if value.is_whole() => format!("{x}"),
            Some(x) => digits(Some(x)),
            None => flat(&value.to_string()),
        }));
        cells.extend([row.status.to_string(), flat(&row.error)]);
        cells.extend(row.measures.iter().map(|value| digits(*value)));
        cells.extend(row.rates.iter().map(|rates| rates_cell(rates.as_ref())));
        line_of(&cells)
    }

    /// The lines of its instants in `samples.csv`; for a row with an attractor, the description of
    /// the attractor.
    pub(super) fn sample_lines(&self, row: &Row) -> Vec<u8> {
        if let Some(attractor) = &row.attractor {
            return line_of(&described(attractor, &self.base.scene));
        }
        let mut lines = Vec::new();
        for sample in &row.samples {
            let mut cells = numbers(row);
            match sample {
                Sample::Impact { wall, start, phase, approach, departure, impulse } => {
                    cells.push(wall.clone());
                    let numbers = [Some(*start), *phase, Some(*approach), *departure, Some(*impulse)];
                    cells.extend(numbers.map(digits));
                }
                Sample::Strobe { time, seen } => {
                    cells.push(digits(Some(*time)));
                    cells.extend(seen.iter().flatten().map(|x| digits(Some(*x))));
                }
            }
            lines.extend(line_of(&cells));
        }
        lines
    }
}

/// The cells that name `row`: its number, and that of its realisation.
fn numbers(row: &Row) -> Vec<String> {
    std::iter::once(row.number).chain(row.realisation).map(|number| number.to_string()).collect()
}

fn flat(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}
