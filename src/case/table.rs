//! Tabulated loads: CSV files with the header `time_s,force_N`.

use super::report::Source;
use crate::error::Result;
use crate::scene::Table;
use std::ops::Range;

const HEADER: [&str; 2] = ["time_s", "force_N"];
const FORMAT: &str = "expected the header time_s,force_N, and below it rows of two finite numbers";

/// Reads the table in `text`; messages call it `name`.
pub(super) fn read(name: &str, text: &str) -> Result<Table> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = Source { name, text };
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
    let (mut time, mut force) = (Vec::<f64>::new(), Vec::new());
    let mut header = true;
    let mut row = csv::StringRecord::new();
    loop {
        let from = usize::try_from(reader.position().byte()).unwrap_or(usize::MAX);
        match reader.read_record(&mut row) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) => return Err(source.error(from..text.len(), &error.to_string(), FORMAT)),
        }
        let to = usize::try_from(reader.position().byte()).unwrap_or(usize::MAX);
        let line = line_of(text, from..to);
        let fields: Vec<&str> = row.iter().collect();
        if header {
            if fields != HEADER {
                let title = format!("the header of the table is {:?}", source.slice(line.clone()));
                return Err(source.error(line, &title, FORMAT));
            }
            header = false;
            continue;
        }
        let [t, f] = fields.as_slice() else {
            let title = format!("{} value{} in a row of two", fields.len(), if fields.len() == 1 { "" } else { "s" });
            return Err(source.error(line, &title, FORMAT));
        };
        let t = number(&source, &line, HEADER[0], t)?;
        if let Some(before) = time.last().filter(|before| t <= **before) {
            let title = format!("time_s is {t:?}");
            return Err(source.error(line, &title, &format!("expected more than the row before, {before:?}")));
        }
        force.push(number(&source, &line, HEADER[1], f)?);
        time.push(t);
    }
    if time.len() < 2 {
        let title = format!("the table has {} row{}", time.len(), if time.len() == 1 { "" } else { "s" });
        let end = text.trim_end().len();
        return Err(source.error(end..end, &title, &format!("{FORMAT}; two rows or more")));
    }
    Table::new(time, force)
}

fn number(source: &Source<'_>, line: &Range<usize>, column: &str, field: &str) -> Result<f64> {
    match field.trim().parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => {
            let offset = source.slice(line.clone()).find(',').map_or(0, |comma| comma + 1);
            let start = if column == HEADER[0] { line.start } else { line.start + offset };
            let end = if column == HEADER[0] && offset > 0 { line.start + offset - 1 } else { line.end };
            Err(source.error(start..end, &format!("{column} is {field:?}"), "expected a finite number"))
        }
    }
}

/// The one line within `span` that is not blank, without its end.
fn line_of(text: &str, span: Range<usize>) -> Range<usize> {
    let slice = text.get(span.clone()).unwrap_or_default();
    let start = span.start + (slice.len() - slice.trim_start_matches(['\r', '\n']).len());
    let end = span.start + slice.trim_end_matches(['\r', '\n']).len();
    start..end.max(start)
}
