//! A table of a sweep file.

use crate::case::{KeyValue, Section, Source, Value};
use crate::error::Result;
use toml::Spanned;

/// Largest whole number that a file can give exactly.
pub(super) const MOST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// A table of a sweep file, and its text.
pub(super) struct Part<'a> {
    pub source: &'a Source<'a>,
    pub table: Section<'a>,
}

impl Part<'_> {
    /// The whole number at `key`, at most `most`.
    ///
    /// # Errors
    /// [`Error::Case`] for another number.
    pub fn whole_number(&self, key: &str, most: f64) -> Result<Option<u64>> {
        let Some(number) = self.table.number(key) else { return Ok(None) };
        match *number.get_ref() {
            x if x.fract() == 0.0 && (0.0..=most).contains(&x) => Ok(Some(x as u64)),
            x => {
                let help = format!("expected a whole number from 0 to {most:?}");
                Err(self.source.error(number.span(), &format!("{key} is {x:?}"), &help))
            }
        }
    }

    /// The value as a key of a case takes it.
    pub fn value(&self, value: &Spanned<Value<'_>>) -> Result<KeyValue> {
        self.source.text.get(value.span()).unwrap_or_default().parse()
    }

    pub fn word(&self, key: &str) -> Option<String> {
        self.table.word(key).map(|word| (*word.get_ref()).to_owned())
    }

    pub fn number(&self, key: &str) -> Option<f64> {
        self.table.number(key).map(Spanned::into_inner)
    }
}
