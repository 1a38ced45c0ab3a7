//! Checks that a file has the keys of a schema, and values of their types.

use super::key_entry::{KeyEntry, Kind};
use super::report::Source;
use super::schema::{Schema, elsewhere};
use super::value::{Name, Section, Value};
use crate::error::{Error, Result, nearest};
use toml::Spanned;

/// The values in the text of `source`, which has the keys of `schema`.
pub(crate) fn read<'a>(source: &Source<'a>, schema: &Schema) -> Result<Spanned<Value<'a>>> {
    let values = Value::parse(source)?;
    Check { source, schema }.table(&Section::root(&values), "")?;
    Ok(values)
}

struct Check<'a> {
    source: &'a Source<'a>,
    schema: &'a Schema,
}

impl Check<'_> {
    /// Checks the table `section` with the path `table`, and all tables within it.
    fn table(&self, section: &Section<'_>, table: &str) -> Result<()> {
        for (name, value) in section.entries() {
            match self.schema.children(table).find(|entry| entry.word == name.get_ref()) {
                Some(entry) => self.value(entry, value)?,
                None => return Err(self.unknown(name, table)),
            }
        }
        match self.schema.children(table).find(|entry| entry.is_required() && section.get(entry.word).is_none()) {
            Some(missing) => {
                let title = format!("`{}` is missing in {}", missing.word, self.place(table));
                Err(self.source.error(section.span.clone(), &title, &self.expected(missing)))
            }
            None => Ok(()),
        }
    }

    fn value(&self, entry: &KeyEntry, value: &Spanned<Value<'_>>) -> Result<()> {
        match (entry.kind, value.get_ref()) {
            (Kind::Any, _)
            | (Kind::Number, Value::Number(_))
            | (Kind::Word, Value::Word(_))
            | (Kind::Truth, Value::Truth(_)) => Ok(()),
            (Kind::Numbers, Value::List(items)) => {
                let other = items.iter().find(|item| !matches!(item.get_ref(), Value::Number(_)));
                other.map_or(Ok(()), |other| Err(self.mistyped(entry, "a number", other)))
            }
            (Kind::Words, Value::List(items)) => {
                let other = items.iter().find(|item| !matches!(item.get_ref(), Value::Word(_)));
                other.map_or(Ok(()), |other| Err(self.mistyped(entry, "text", other)))
            }
            (Kind::Tables, Value::List(tables)) => tables.iter().try_for_each(|table| match Section::of(table) {
                Some(section) => self.table(&section, entry.key),
                None => Err(self.mistyped(entry, "a table", table)),
            }),
            (Kind::Table | Kind::Inline, _) => match Section::of(value) {
                Some(section) => self.table(&section, entry.key),
                None => Err(self.mistyped(entry, "a table", value)),
            },
            (Kind::Number, _) => Err(self.mistyped(entry, "a number", value)),
            (Kind::Word, _) => Err(self.mistyped(entry, "text", value)),
            (Kind::Truth, _) => Err(self.mistyped(entry, "true or false", value)),
            (Kind::Numbers | Kind::Words | Kind::Tables, _) => Err(self.mistyped(entry, "a list", value)),
        }
    }

    fn mistyped(&self, entry: &KeyEntry, wanted: &str, value: &Spanned<Value<'_>>) -> Error {
        let title = format!("`{}` takes {wanted}, not {}", entry.key, value.get_ref().kind());
        self.source.error(value.span(), &title, &self.expected(entry))
    }

    fn unknown(&self, name: &Name<'_>, table: &str) -> Error {
        let known = self.schema.children(table).map(|entry| entry.word);
        let other = elsewhere(&format!("{table}.{}", name.get_ref())).map(str::to_owned);
        let meant = match nearest(name.get_ref(), known.clone()).filter(|_| other.is_none()) {
            Some(near) => format!("; did you mean `{near}`?"),
            None => String::new(),
        };
        let title = format!("unknown key `{}` in {}{meant}", name.get_ref(), self.place(table));
        let help = other.unwrap_or_else(|| known.collect::<Vec<_>>().join(", "));
        self.source.error(name.span(), &title, &format!("expected {help}"))
    }

    fn place(&self, table: &str) -> String {
        if table.is_empty() { self.schema.file.to_owned() } else { format!("`{table}`") }
    }

    fn expected(&self, entry: &KeyEntry) -> String {
        format!("expected {}", self.schema.help(entry))
    }
}
