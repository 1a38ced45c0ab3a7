//! Reads the columns of its file to which a table refers.

use super::builder::Builder;
use super::table::TableColumns;
use super::value::Section;
use crate::error::Result;
use toml::Spanned;

impl Builder<'_> {
    /// Path and text of the file of a table.
    pub fn table_file(
        &mut self,
        owner: &str,
        file: &Spanned<&str>,
        columns: &TableColumns,
    ) -> Result<(String, String)> {
        let expected = columns.expected().replacen("expected ", "expected a CSV file: ", 1);
        self.open(owner, file.get_ref(), file.span(), &expected)
    }

    /// The columns of its file that a table refers to, and the format of the numbers. `word` is the
    /// key of the values, and their unit.
    pub fn columns(
        &self,
        owner: &str,
        word: (&str, &str),
        plain: TableColumns,
        table: &Section<'_>,
    ) -> Result<TableColumns> {
        let (values, unit) = word;
        let name = |key: &str, plain: String| match table.word(key) {
            Some(name) if name.get_ref().trim().is_empty() => {
                Err(self.refuse(name.span(), &format!("{owner}: {key}"), "the header of a column"))
            }
            Some(name) => Ok(name.get_ref().trim().to_owned()),
            None => Ok(plain),
        };
        let (time, force) = (name("time", plain.time)?, name(values, plain.force)?);
        if let (Some(at), true) = (table.span_of(values).or(table.span_of("time")), time == force) {
            return Err(self.refuse(at, &format!("{owner}: {values}"), "another column than that of time"));
        }
        let sign = |key: &str, plain: char, of: &[char], expected: &str| {
            let Some(word) = table.word(key) else { return Ok(plain) };
            let mut signs = word.get_ref().chars();
            match (signs.next(), signs.next()) {
                (Some(sign), None) if of.contains(&sign) => Ok(sign),
                _ => Err(self.refuse(word.span(), &format!("{owner}: {key}"), expected)),
            }
        };
        let delimiters = "one of \",\", \";\", \"\\t\", \"|\", \" \"";
        let delimiter = sign("delimiter", plain.delimiter, &[',', ';', '\t', '|', ' '], delimiters)?;
        let decimal = sign("decimal", plain.decimal, &['.', ','], "\".\" or \",\"")?;
        if let (Some(at), true) = (table.span_of("decimal").or(table.span_of("delimiter")), decimal == delimiter) {
            let expected = "another sign than the delimiter: delimiter = \";\" beside it";
            return Err(self.refuse(at, &format!("{owner}: decimal"), expected));
        }
        let factor = |key: &str, plain: f64, takes: fn(f64) -> bool, expected: &str| {
            let x = table.number(key).map_or(plain, Spanned::into_inner);
            match table.span_of(key) {
                Some(at) if !takes(x) => Err(self.refuse(at, &format!("{owner}: {key}"), expected)),
                _ => Ok(x),
            }
        };
        let scale = format!("a finite number: how many {unit} one unit of the column is");
        let scale = factor("scale", plain.scale, f64::is_finite, &scale)?;
        let seconds = "a finite number above 0: how many s one unit of the column of times is";
        let time_scale = factor("time_scale", plain.time_scale, |x| x.is_finite() && x > 0.0, seconds)?;
        Ok(TableColumns { time, force, delimiter, decimal, scale, time_scale })
    }
}
