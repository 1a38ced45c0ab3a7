//! Reads the tables `[[load]]`.

use super::builder::Builder;
use super::file;
use super::table::{self, TableColumns};
use super::value::{Number, Section, Value};
use crate::error::{Result, Subject};
use crate::scene::Load;
use toml::Spanned;

impl Builder<'_> {
    /// The load in table `index`.
    pub fn load(&mut self, index: usize, load: Section<file::Load>) -> Result<Load> {
        let key = |what: &'static str| Subject::nth("load", index).part(what);
        let file::Load { at, direction, constant, harmonic, impulse, table } = load.value;
        self.places.push((Subject::nth("load", index), load.span.clone()));
        let given: Vec<_> = [
            ("constant", constant.as_ref().map(|s| s.span.clone())),
            ("harmonic", harmonic.as_ref().map(|s| s.span.clone())),
            ("impulse", impulse.as_ref().map(|s| s.span.clone())),
            ("table", table.as_ref().map(|s| s.span.clone())),
        ]
        .into_iter()
        .filter_map(|(kind, span)| Some((kind, span?)))
        .collect();
        if let [(first, _), (second, span), ..] = given.as_slice() {
            return Err(self.source.error(
                span.clone(),
                &format!("load {} has two kinds, `{first}` and `{second}`", index + 1),
                "expected one kind in each [[load]]; loads add up, so write a second [[load]]",
            ));
        }
        let owner = format!("load {}", index + 1);
        let mut sites = self.sites((&owner, Subject::nth("load", index)), at.as_ref(), load.span.clone(), true)?;
        let site = sites.pop().ok_or_else(|| self.refuse(load.span.clone(), &owner, "a place"))?;
        let direction = direction.map(|value| self.angle(&owner, &value)).transpose()?;
        let site = self.towards(site, direction.as_ref(), &owner, &load.span)?;
        self.written.loads.push(site.place.clone());
        self.written.tables.push(None);
        let on = |load: Load| Load { at: site.row.clone(), ..load };
        if let Some(Section { value: constant, .. }) = constant {
            return Ok(on(Load::constant(self.number(key("force"), &constant.force))));
        }
        if let Some(Section { value: sine, .. }) = harmonic {
            let amplitude = self.number(key("amplitude"), &sine.amplitude);
            let frequency = self.number(key("frequency"), &sine.frequency);
            let phase = self.optional(key("phase"), sine.phase.as_ref()).unwrap_or(0.0);
            return Ok(on(Load::harmonic(amplitude, frequency, phase)));
        }
        if let Some(Section { value: blow, .. }) = impulse {
            let impulse = self.number(key("impulse"), &blow.impulse);
            let time = self.optional(key("time"), blow.time.as_ref()).unwrap_or(0.0);
            return Ok(on(Load::impulse(impulse, time)));
        }
        let Some(Section { value: table, .. }) = table else {
            let help = "expected one of constant = { force }, harmonic = { amplitude, frequency, phase }, \
                        impulse = { impulse, time }, table = { file }";
            return Err(self.source.error(load.span, &format!("load {} has no kind", index + 1), help));
        };
        let columns = self.columns(&owner, &table)?;
        let file = table.file.get_ref();
        let (path, text) = self.open(file).map_err(|reason| {
            let help = format!("{}; its path is relative to the case file", columns.expected());
            let help = help.replacen("expected ", "expected a CSV file: ", 1);
            self.source.error(table.file.span(), &format!("{owner}: table {file:?}: {reason}"), &help)
        })?;
        let read = table::read(&path, &text, &columns)?;
        if let Some(table) = self.written.tables.last_mut() {
            *table = Some((file.clone(), columns));
        }
        Ok(on(Load::table(read)))
    }

    /// The direction of a load.
    fn angle(&self, owner: &str, direction: &Spanned<Value>) -> Result<Spanned<Number>> {
        match direction.get_ref() {
            Value::Number(x) => Ok(Spanned::new(direction.span(), Number(*x))),
            _ => Err(self.refuse(direction.span(), &format!("{owner}: direction"), "a finite number, in deg")),
        }
    }

    /// The columns of its file that a table refers to, and the format of the numbers.
    fn columns(&mut self, owner: &str, table: &file::Table) -> Result<TableColumns> {
        let plain = TableColumns::default();
        let name = |word: &Option<Spanned<String>>, key: &str, plain: String| match word {
            Some(name) if name.get_ref().trim().is_empty() => {
                Err(self.refuse(name.span(), &format!("{owner}: table: {key}"), "the header of a column"))
            }
            Some(name) => Ok(name.get_ref().trim().to_owned()),
            None => Ok(plain),
        };
        let (time, force) = (name(&table.time, "time", plain.time)?, name(&table.force, "force", plain.force)?);
        if let (Some(word), true) = (table.force.as_ref().or(table.time.as_ref()), time == force) {
            return Err(self.refuse(
                word.span(),
                &format!("{owner}: table: force"),
                "another column than that of time",
            ));
        }
        let sign = |word: &Option<Spanned<String>>, key: &str, plain: char, of: &[char], expected: &str| {
            let Some(word) = word else { return Ok(plain) };
            let mut signs = word.get_ref().chars();
            match (signs.next(), signs.next()) {
                (Some(sign), None) if of.contains(&sign) => Ok(sign),
                _ => Err(self.refuse(word.span(), &format!("{owner}: table: {key}"), expected)),
            }
        };
        let delimiters = "one of \",\", \";\", \"\\t\", \"|\", \" \"";
        let delimiter = sign(&table.delimiter, "delimiter", plain.delimiter, &[',', ';', '\t', '|', ' '], delimiters)?;
        let decimal = sign(&table.decimal, "decimal", plain.decimal, &['.', ','], "\".\" or \",\"")?;
        if let (Some(word), true) = (table.decimal.as_ref().or(table.delimiter.as_ref()), decimal == delimiter) {
            let expected = "another sign than the delimiter: delimiter = \";\" beside it";
            return Err(self.refuse(word.span(), &format!("{owner}: table: decimal"), expected));
        }
        let scale = table.scale.as_ref().map_or(plain.scale, |scale| scale.get_ref().0);
        match &table.scale {
            Some(number) if !scale.is_finite() || scale == 0.0 => {
                let expected = "a finite number other than 0: how many N one unit of the column is";
                Err(self.refuse(number.span(), &format!("{owner}: table: scale"), expected))
            }
            _ => Ok(TableColumns { time, force, delimiter, decimal, scale }),
        }
    }
}
