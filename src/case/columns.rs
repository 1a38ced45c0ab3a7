//! Reads the columns of its file to which a table refers.

use super::builder::Builder;
use super::table::TableColumns;
use super::value::Number;
use crate::error::Result;
use toml::Spanned;

/// The keys of the case file for the columns of a table: times and values.
pub(super) struct Given<'a> {
    pub time: &'a Option<Spanned<String>>,
    pub value: &'a Option<Spanned<String>>,
    pub delimiter: &'a Option<Spanned<String>>,
    pub decimal: &'a Option<Spanned<String>>,
    pub scale: &'a Option<Spanned<Number>>,
}

impl Builder<'_> {
    /// Path and text of the file of a table.
    pub fn table_file(
        &mut self,
        owner: &str,
        file: &Spanned<String>,
        columns: &TableColumns,
    ) -> Result<(String, String)> {
        let name = file.get_ref();
        self.open(name).map_err(|reason| {
            let help = format!("{}; its path is relative to the case file", columns.expected());
            let help = help.replacen("expected ", "expected a CSV file: ", 1);
            // For a table of a load, the name of the file is added; other owners include it
            // already.
            let title = match owner.strip_suffix(": table") {
                Some(load) => format!("{load}: table {name:?}: {reason}"),
                None => format!("{owner} {name:?}: {reason}"),
            };
            self.source.error(file.span(), &title, &help)
        })
    }

    /// The columns of its file that a table refers to, and the format of the numbers. `word` is the
    /// key of the values, and their unit.
    pub fn columns(
        &self,
        owner: &str,
        word: (&str, &str),
        plain: TableColumns,
        given: &Given<'_>,
    ) -> Result<TableColumns> {
        let (values, unit) = word;
        let name = |word: &Option<Spanned<String>>, key: &str, plain: String| match word {
            Some(name) if name.get_ref().trim().is_empty() => {
                Err(self.refuse(name.span(), &format!("{owner}: {key}"), "the header of a column"))
            }
            Some(name) => Ok(name.get_ref().trim().to_owned()),
            None => Ok(plain),
        };
        let (time, force) = (name(given.time, "time", plain.time)?, name(given.value, values, plain.force)?);
        if let (Some(word), true) = (given.value.as_ref().or(given.time.as_ref()), time == force) {
            return Err(self.refuse(word.span(), &format!("{owner}: {values}"), "another column than that of time"));
        }
        let sign = |word: &Option<Spanned<String>>, key: &str, plain: char, of: &[char], expected: &str| {
            let Some(word) = word else { return Ok(plain) };
            let mut signs = word.get_ref().chars();
            match (signs.next(), signs.next()) {
                (Some(sign), None) if of.contains(&sign) => Ok(sign),
                _ => Err(self.refuse(word.span(), &format!("{owner}: {key}"), expected)),
            }
        };
        let delimiters = "one of \",\", \";\", \"\\t\", \"|\", \" \"";
        let delimiter = sign(given.delimiter, "delimiter", plain.delimiter, &[',', ';', '\t', '|', ' '], delimiters)?;
        let decimal = sign(given.decimal, "decimal", plain.decimal, &['.', ','], "\".\" or \",\"")?;
        if let (Some(word), true) = (given.decimal.as_ref().or(given.delimiter.as_ref()), decimal == delimiter) {
            let expected = "another sign than the delimiter: delimiter = \";\" beside it";
            return Err(self.refuse(word.span(), &format!("{owner}: decimal"), expected));
        }
        let scale = given.scale.as_ref().map_or(plain.scale, |scale| scale.get_ref().0);
        match given.scale {
            Some(number) if !scale.is_finite() || scale == 0.0 => {
                let expected = format!("a finite number other than 0: how many {unit} one unit of the column is");
                Err(self.refuse(number.span(), &format!("{owner}: scale"), &expected))
            }
            _ => Ok(TableColumns { time, force, delimiter, decimal, scale }),
        }
    }
}
