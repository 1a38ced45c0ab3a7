//! Values of a file, each with its position in the text.

use super::report::Source;
use crate::error::Result;
use std::borrow::Cow;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value of a case or sweep file.
#[derive(Debug)]
pub(crate) enum Value<'a> {
    Number(f64),
    Word(Cow<'a, str>),
    Truth(bool),
    List(Vec<Spanned<Value<'a>>>),
    Table(Vec<Entry<'a>>),
    Date,
}

/// A key and its value.
pub(crate) type Entry<'a> = (Name<'a>, Spanned<Value<'a>>);
pub(crate) type Name<'a> = Spanned<Cow<'a, str>>;

impl<'a> Value<'a> {
    /// The values in the text of `source`.
    pub fn parse(source: &Source<'a>) -> Result<Spanned<Self>> {
        let table = DeTable::parse(source.text).map_err(|error| source.toml(error.clone()).caused_by(error))?;
        let span = table.span();
        Ok(Spanned::new(span.clone(), Self::new(source, span, DeValue::Table(table.into_inner()))?))
    }

    fn new(source: &Source<'a>, span: Range<usize>, value: DeValue<'a>) -> Result<Self> {
        let spanned = |value: Spanned<DeValue<'a>>| {
            let span = value.span();
            Ok(Spanned::new(span.clone(), Self::new(source, span, value.into_inner())?))
        };
        Ok(match value {
            DeValue::String(word) => Self::Word(word),
            DeValue::Integer(x) if x.radix() == 10 => {
                // Of the integer −0 the sign is no part.
                Self::Number(x.as_str().parse().map_or(f64::NAN, |x: f64| x + 0.0))
            }
            DeValue::Integer(x) => match u128::from_str_radix(x.as_str(), x.radix()) {
                Ok(x) => Self::Number(x as f64),
                Err(_) => return Err(source.overflow(span)),
            },
            DeValue::Float(x) => match x.as_str().parse::<f64>() {
                Ok(number) if number.is_finite() || x.as_str().contains(['n', 'N']) => Self::Number(number),
                _ => return Err(source.overflow(span)),
            },
            DeValue::Boolean(truth) => Self::Truth(truth),
            DeValue::Datetime(_) => Self::Date,
            DeValue::Array(list) => Self::List(list.into_iter().map(spanned).collect::<Result<_>>()?),
            DeValue::Table(table) => {
                let entry = |(key, value)| Ok((key, spanned(value)?));
                Self::Table(table.into_iter().map(entry).collect::<Result<_>>()?)
            }
        })
    }

    /// The kind of the value, for messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Word(_) => "text",
            Self::Truth(_) => "true or false",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
            Self::Date => "a date",
        }
    }
}

/// A table of the file and its position. Its keys have the types of their schema, so that a value
/// of another type is not met here.
#[derive(Debug, Clone)]
pub(crate) struct Section<'a> {
    pub span: Range<usize>,
    entries: &'a [Entry<'a>],
}

impl<'a> Section<'a> {
    /// The whole file.
    pub fn root(values: &'a Spanned<Value<'a>>) -> Self {
        Self::of(values).unwrap_or(Self { span: 0..0, entries: &[] })
    }

    /// The table at `value`; `None` for another value.
    pub fn of(value: &'a Spanned<Value<'a>>) -> Option<Self> {
        match value.get_ref() {
            Value::Table(entries) => Some(Self { span: value.span(), entries }),
            _ => None,
        }
    }

    pub fn entries(&self) -> &'a [Entry<'a>] {
        self.entries
    }

    /// The value at `key`.
    pub fn get(&self, key: &str) -> Option<&'a Spanned<Value<'a>>> {
        self.entries.iter().find(|(name, _)| name.get_ref() == key).map(|(_, value)| value)
    }

    /// The position of the value at `key`.
    pub fn span_of(&self, key: &str) -> Option<Range<usize>> {
        self.get(key).map(Spanned::span)
    }

    pub fn number(&self, key: &str) -> Option<Spanned<f64>> {
        number(self.get(key)?)
    }

    /// A number that the table must have, which has been checked; where it is missing all the same,
    /// it is not a number, which nothing accepts.
    pub fn required(&self, key: &str) -> Spanned<f64> {
        self.number(key).unwrap_or_else(|| Spanned::new(self.span.clone(), f64::NAN))
    }

    pub fn numbers(&self, key: &str) -> Option<Spanned<Vec<Spanned<f64>>>> {
        let value = self.get(key)?;
        let Value::List(items) = value.get_ref() else { return None };
        Some(Spanned::new(value.span(), items.iter().filter_map(number).collect()))
    }

    pub fn word(&self, key: &str) -> Option<Spanned<&'a str>> {
        let value = self.get(key)?;
        let Value::Word(word) = value.get_ref() else { return None };
        Some(Spanned::new(value.span(), word))
    }

    /// A word that the table must have, which has been checked; where it is missing all the same,
    /// it is empty, which nothing accepts.
    pub fn required_word(&self, key: &str) -> Spanned<&'a str> {
        self.word(key).unwrap_or_else(|| Spanned::new(self.span.clone(), ""))
    }

    /// The position of `key` where it is true.
    pub fn truth(&self, key: &str) -> Option<Range<usize>> {
        self.get(key).filter(|value| matches!(value.get_ref(), Value::Truth(true))).map(Spanned::span)
    }

    pub fn section(&self, key: &str) -> Option<Section<'a>> {
        Section::of(self.get(key)?)
    }

    /// A table that this one must have, which has been checked; empty where it is missing all the
    /// same.
    pub fn required_section(&self, key: &str) -> Section<'a> {
        self.section(key).unwrap_or_else(|| Section { span: self.span.clone(), entries: &[] })
    }

    #[cfg(feature = "cli")]
    pub fn words(&self, key: &str) -> Option<Vec<String>> {
        let Value::List(items) = self.get(key)?.get_ref() else { return None };
        let word = |item: &Spanned<Value<'_>>| match item.get_ref() {
            Value::Word(word) => Some(word.to_string()),
            _ => None,
        };
        Some(items.iter().filter_map(word).collect())
    }

    /// The tables in double brackets under `key`.
    pub fn sections(&self, key: &str) -> Vec<Section<'a>> {
        match self.get(key).map(Spanned::get_ref) {
            Some(Value::List(tables)) => tables.iter().filter_map(Section::of).collect(),
            _ => Vec::new(),
        }
    }
}

fn number(value: &Spanned<Value<'_>>) -> Option<Spanned<f64>> {
    match value.get_ref() {
        Value::Number(x) => Some(Spanned::new(value.span(), *x)),
        _ => None,
    }
}
