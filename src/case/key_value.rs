//! Values to which a key can be set.

use crate::error::{Error, Result};
use std::fmt;
use std::str::FromStr;

/// A value of a case file: a number, a word, a list, a table, or true or false. The reader of case
/// files decides which of them a key accepts.
///
/// ```
/// use signorini::case::KeyValue;
///
/// assert_eq!("0.8".parse::<KeyValue>()?.number(), Some(0.8));
/// // A bare word needs no quotes.
/// assert_eq!("clamped".parse::<KeyValue>()?, KeyValue::from("clamped"));
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct KeyValue(pub(super) toml::Value);

impl KeyValue {
    /// The number, if it is one.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self.0 {
            toml::Value::Float(x) => Some(x),
            toml::Value::Integer(x) => Some(x as f64),
            _ => None,
        }
    }

    /// True for a whole number, written as one.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.0.is_integer()
    }
}

impl From<f64> for KeyValue {
    fn from(x: f64) -> Self {
        Self(toml::Value::Float(x))
    }
}

impl From<i64> for KeyValue {
    fn from(x: i64) -> Self {
        Self(toml::Value::Integer(x))
    }
}

impl From<&[f64]> for KeyValue {
    fn from(list: &[f64]) -> Self {
        Self(toml::Value::Array(list.iter().map(|&x| toml::Value::Float(x)).collect()))
    }
}

impl From<bool> for KeyValue {
    fn from(truth: bool) -> Self {
        Self(toml::Value::Boolean(truth))
    }
}

impl From<&str> for KeyValue {
    fn from(word: &str) -> Self {
        Self(toml::Value::String(word.to_owned()))
    }
}

/// Written as in TOML, but words without quotes, as shown in the cell of a table.
impl fmt::Display for KeyValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            toml::Value::String(word) => f.write_str(word),
            toml::Value::Float(x) => write!(f, "{x:?}"),
            other => write!(f, "{other}"),
        }
    }
}

impl FromStr for KeyValue {
    type Err = Error;

    /// Reads TOML, `0.8`, `[1, 2]`, `{ position = 1.2 }`, `"clamped"`; any other text is a word.
    fn from_str(text: &str) -> Result<Self> {
        let text = text.trim();
        let table = toml::from_str::<toml::Table>(&format!("value = {text}\n"));
        let value = table.ok().filter(|table| table.len() == 1).and_then(|mut table| table.remove("value"));
        match value {
            Some(value) => Ok(Self(value)),
            None if text.is_empty() || text.contains(['=', '[', ']', '{', '}', '"', '\n']) => {
                Err(Error::invalid("value", format_args!("{text:?}"), "a number, a word, or a list or table as TOML"))
            }
            None => Ok(Self::from(text)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::KeyValue;

    #[test]
    fn numbers_words_lists_and_tables_are_told_apart() {
        let read = |text: &str| text.parse::<KeyValue>().unwrap();
        assert_eq!(read("1e-3").number(), Some(1e-3));
        assert_eq!(read(" 3 "), KeyValue::from(3));
        assert_eq!(read("true"), KeyValue::from(true));
        assert_eq!(read("generalized-alpha"), KeyValue::from("generalized-alpha"));
        assert_eq!(read("\"0.8\"").0.as_str(), Some("0.8"));
        assert_eq!(read("moreau-jean:theta=0.6".replace("=0.6", "").as_str()).0.as_str(), Some("moreau-jean:theta"));
        assert_eq!(read("[1, 2]").to_string(), "[1, 2]");
        for text in ["", "[1", "a = 1\nb = 2", "{x", "\"a"] {
            assert!(text.parse::<KeyValue>().is_err(), "{text}");
        }
    }

    #[test]
    fn a_number_is_shown_with_all_its_digits() {
        let x = 0.1 + 0.2;
        assert_eq!(KeyValue::from(x).to_string().parse::<f64>().unwrap(), x);
    }
}
