//! Tabulated loads: two columns of a CSV file, as data loggers and spreadsheets write them.

use super::report::Source;
use crate::error::{Error, Result, counted};
use crate::scene::Table;
use std::ops::Range;

/// The two columns of a file that are used, and the format of its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct TableColumns {
    /// Header of the column of times, s.
    pub time: String,
    /// Header of the column of forces.
    pub force: String,
    /// The separator between columns.
    pub delimiter: char,
    /// The decimal sign: a point or a comma.
    pub decimal: char,
    /// Newtons in one unit of the force column.
    pub scale: f64,
    /// Seconds in one unit of the column of times.
    pub time_scale: f64,
}

impl Default for TableColumns {
    fn default() -> Self {
        Self {
            time: "time_s".into(),
            force: "force_N".into(),
            delimiter: ',',
            decimal: '.',
            scale: 1.0,
            time_scale: 1.0,
        }
    }
}

impl TableColumns {
    /// Description of such a file, for messages.
    pub(super) fn expected(&self) -> String {
        let Self { time, force, .. } = self;
        if self.is_plain() {
            format!(
                "expected a header with the columns {time},{force}, and below it rows of finite numbers; \
                 time = \"..\", force = \"..\", delimiter = \";\" and decimal = \",\" beside file read other tables"
            )
        } else {
            let Self { delimiter, decimal, .. } = self;
            format!(
                "expected a header with the columns {time:?} and {force:?}, and below it rows of finite \
                     numbers, with {delimiter:?} \
                     between columns and {decimal:?} as decimal sign"
            )
        }
    }

    fn is_plain(&self) -> bool {
        let plain = Self::default();
        *self == Self { scale: self.scale, time_scale: self.time_scale, ..plain }
    }
}

/// Reads the table in `text`; messages call it `name`.
pub(super) fn read(name: &str, text: &str, columns: &TableColumns) -> Result<Table> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let reader = Reader { source: Source { name, text }, columns };
    let mut rows = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(u8::try_from(columns.delimiter).unwrap_or(b','))
        .from_reader(text.as_bytes());
    let (mut time, mut force) = (Vec::<f64>::new(), Vec::new());
    let (mut found, mut last): (Option<Header>, Option<f64>) = (None, None);
    let mut row = csv::StringRecord::new();
    loop {
        let from = usize::try_from(rows.position().byte()).unwrap_or(usize::MAX);
        match rows.read_record(&mut row) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) => {
                return Err(reader.source.error(from..text.len(), &error.to_string(), &columns.expected()));
            }
        }
        let to = usize::try_from(rows.position().byte()).unwrap_or(usize::MAX);
        let line = line_of(text, from..to);
        let Some(header) = &found else {
            found = Some(reader.header(&row, line)?);
            continue;
        };
        if row.len() != header.count {
            let (n, wanted) = (row.len(), header.count);
            let title = format!("{} in a row of {wanted}", counted(n, "value"));
            return Err(reader.source.error(line, &title, &columns.expected()));
        }
        let t = reader.number(&line, &row, header.time, &columns.time)?;
        if let Some(before) = last.filter(|before| t <= *before) {
            let title = format!("{} is {t:?}", columns.time);
            let at = reader.field(&line, header.time);
            return Err(reader.source.error(at, &title, &format!("expected more than the row before, {before:?}")));
        }
        last = Some(t);
        let t = reader.scaled(&line, header.time, (&columns.time, t), ("time_scale", columns.time_scale, "s"))?;
        let f = reader.number(&line, &row, header.force, &columns.force)?;
        let f = reader.scaled(&line, header.force, (&columns.force, f), ("scale", columns.scale, "N"))?;
        force.push(f);
        time.push(t);
    }
    if time.len() < 2 {
        let title = format!("the table has {}", counted(time.len(), "row"));
        let end = text.trim_end().len();
        return Err(reader.source.error(end..end, &title, &format!("{}; two rows or more", columns.expected())));
    }
    Table::new(time, force)
}

/// The indices of the two columns in a header, and the number of columns.
struct Header {
    time: usize,
    force: usize,
    count: usize,
}

struct Reader<'a> {
    source: Source<'a>,
    columns: &'a TableColumns,
}

impl Reader<'_> {
    fn header(&self, row: &csv::StringRecord, line: Range<usize>) -> Result<Header> {
        let names: Vec<&str> = row.iter().map(str::trim).collect();
        let place = |wanted: &str| {
            let mut places = names.iter().enumerate().filter(|(_, name)| **name == wanted).map(|(i, _)| i);
            match (places.next(), places.next()) {
                (Some(i), None) => Ok(i),
                (Some(_), Some(again)) => {
                    let title = format!("two columns of the table are named {wanted:?}");
                    Err(self.source.error(self.field(&line, again), &title, "expected each name once"))
                }
                (None, _) => Err(self.no_column(wanted, &names, line.clone())),
            }
        };
        Ok(Header { time: place(&self.columns.time)?, force: place(&self.columns.force)?, count: names.len() })
    }

    fn no_column(&self, wanted: &str, names: &[&str], line: Range<usize>) -> Error {
        let listed = listed(names);
        let title = format!("the table has no column {wanted:?}; its header is {listed}");
        // A single column that contains another delimiter: the file is probably written with that
        // delimiter.
        let text = self.source.slice(line.clone());
        let other = [(';', "\";\""), ('\t', "\"\\t\""), ('|', "\"|\""), (',', "\",\"")]
            .into_iter()
            .find(|(sign, _)| names.len() == 1 && *sign != self.columns.delimiter && text.contains(*sign));
        let note =
            other.map(|(_, word)| format!("delimiter = {word} beside file reads columns with {word} between them"));
        self.source.error_with_note(line, &title, &self.columns.expected(), note.as_deref())
    }

    fn number(&self, line: &Range<usize>, row: &csv::StringRecord, index: usize, name: &str) -> Result<f64> {
        let field = row.get(index).unwrap_or_default();
        let written = field.trim();
        let comma = self.columns.decimal == ',';
        // With a decimal comma, a point would separate thousands: it is refused, not guessed.
        let x = if !comma {
            written.parse::<f64>().ok()
        } else if written.contains('.') {
            None
        } else {
            written.replacen(',', ".", 1).parse::<f64>().ok()
        };
        match x.filter(|x| x.is_finite()) {
            Some(x) => Ok(x),
            None => {
                let (sign, other) = if comma { ("comma", '.') } else { ("point", ',') };
                let swapped = written.replacen(other, if comma { "," } else { "." }, 1);
                let reads = swapped != written && swapped.replacen(',', ".", 1).parse::<f64>().is_ok();
                let note = reads.then(|| format!("decimal = \"{other}\" beside file reads numbers written so"));
                let title = format!("{name} is {field:?}");
                let help = format!("expected a finite number with a decimal {sign}");
                Err(self.source.error_with_note(self.field(line, index), &title, &help, note.as_deref()))
            }
        }
    }

    /// The `number` of the column `name` times the `factor` that the key gives, in its unit.
    fn scaled(
        &self,
        line: &Range<usize>,
        index: usize,
        (name, number): (&str, f64),
        (key, factor, unit): (&str, f64, &str),
    ) -> Result<f64> {
        let x = number * factor;
        if x.is_finite() {
            return Ok(x);
        }
        let title = format!("{name} times {key} is {x:?}");
        Err(self.source.error(self.field(line, index), &title, &format!("expected a finite number of {unit}")))
    }

    /// The position of field `index` of the row on `line`; the whole line where quotes prevent
    /// finding it.
    fn field(&self, line: &Range<usize>, index: usize) -> Range<usize> {
        let text = self.source.slice(line.clone());
        let (mut start, mut quoted, mut at) = (0, false, 0);
        for (i, c) in text.char_indices() {
            match c {
                '"' => quoted = !quoted,
                c if c == self.columns.delimiter && !quoted => {
                    if at == index {
                        return line.start + start..line.start + i;
                    }
                    (at, start) = (at + 1, i + c.len_utf8());
                }
                _ => {}
            }
        }
        if at == index { line.start + start..line.end } else { line.clone() }
    }
}

/// Most columns of a header that a message lists.
const MOST_LISTED: usize = 24;

/// The names of a header in quotes; of many, the first ones.
fn listed(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().take(MOST_LISTED).map(|name| format!("{name:?}")).collect();
    let more = names.len().saturating_sub(MOST_LISTED);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("{}{rest}", quoted.join(", "))
}

/// The only line within `span` that is not blank, without its end.
fn line_of(text: &str, span: Range<usize>) -> Range<usize> {
    let slice = text.get(span.clone()).unwrap_or_default();
    let start = span.start + (slice.len() - slice.trim_start_matches(['\r', '\n']).len());
    let end = span.start + slice.trim_end_matches(['\r', '\n']).len();
    start..end.max(start)
}
