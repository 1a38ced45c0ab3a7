//! A key whose value changes along the branches.

use crate::case::{CaseFile, Key};
use crate::error::{Error, Result};

/// A key and the range of its values, as they are asked for.
#[derive(Debug, Clone, Copy)]
pub struct KeyRange<'a> {
    /// What errors call the key and the range.
    pub names: [&'static str; 2],
    /// The key.
    pub key: &'a str,
    /// The range.
    pub range: [f64; 2],
}

/// The key, its value in the case and its range.
#[derive(Debug)]
pub struct Varied {
    /// The key.
    pub key: Key,
    /// What errors call it.
    pub called: &'static str,
    /// The case's value.
    pub value: f64,
    /// The range of its values.
    pub range: [f64; 2],
}

impl Varied {
    /// The key that is asked for, of the case in `file`.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a key on which no orbit depends, or that has no one number in the
    /// case, and for a range without that number in it.
    pub fn new(file: &CaseFile, asked: &KeyRange<'_>) -> Result<Self> {
        let KeyRange { names: [called, of_range], range, .. } = *asked;
        let key: Key = asked.key.parse()?;
        check_changes_orbits(called, asked.key)?;
        let value = start_value(file, called, &key)?;
        let [low, high] = range;
        let wrong = |expected: String| Error::invalid(of_range, format_args!("{low}:{high}"), expected);
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(wrong("two finite numbers, the first below the second".to_owned()));
        }
        if !(low..=high).contains(&value) {
            return Err(wrong(format!("a range with the case's value of the key, {value:?}, in it")));
        }
        Ok(Self { key, called, value, range })
    }

    /// Its column: its last word and its unit, as in a sweep.
    #[must_use]
    pub fn column(&self) -> String {
        let text = self.key.to_string();
        let word = text.rsplit('.').next().unwrap_or_default();
        self.key.unit().map_or_else(|| word.to_owned(), |unit| format!("{word}_{unit}"))
    }

    /// The key as the label of an axis.
    #[must_use]
    pub fn label(&self) -> String {
        let unit = self.key.unit().map_or("–".to_owned(), |unit| unit.replace("_per_", "/").replace('_', " "));
        format!("{} ({unit})", self.key)
    }
}

/// The case's value of the key, which errors call `by`.
fn start_value(file: &CaseFile, by: &'static str, key: &Key) -> Result<f64> {
    let found = file.get(key)?;
    let text = found.as_ref().map(ToString::to_string);
    match text.as_deref().map(str::parse::<f64>) {
        Some(Ok(value)) => Ok(value),
        Some(Err(_)) => Err(Error::invalid(by, format!("{key} = {}", text.unwrap_or_default()), "the key of a number")),
        None => Err(Error::invalid(
            by,
            format!("{key}, which the case leaves out or has several values of"),
            format!("a key with one value in the case: set {key} to a number"),
        )),
    }
}

/// Tables of a case on which no periodic orbit depends: how long and from where it is run, and what
/// is recorded of the run.
const NO_PART_OF_ORBITS: [&str; 6] = ["initial", "penalty", "probe", "statistics", "time", "wear"];

/// Refuses a key of a case or a scene on which no periodic orbit depends; errors call it
/// `argument`.
///
/// # Errors
/// [`Error::Invalid`] for the key of a start, a time or a probe, for one.
pub fn check_changes_orbits(argument: &'static str, key: &str) -> Result<()> {
    if key.split_once('.').is_some_and(|(table, _)| NO_PART_OF_ORBITS.contains(&table)) {
        let expected = format!("a key on which orbits depend: none of {}", NO_PART_OF_ORBITS.join(", "));
        return Err(Error::invalid(argument, key, expected));
    }
    Ok(())
}
