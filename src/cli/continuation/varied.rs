//! A key whose value changes along the branches.

use crate::case::{CaseFile, Key};
use crate::error::{Error, Result};

/// The key, its value in the case and its range.
pub(super) struct Varied {
    pub key: Key,
    pub value: f64,
    pub range: [f64; 2],
}

impl Varied {
    /// The key `key` and its range, which the two `options` give.
    pub(super) fn new(file: &CaseFile, options: [&'static str; 2], key: &str, range: &str) -> Result<Self> {
        let key: Key = key.parse()?;
        let [by, option] = options;
        changes_orbits(by, &key)?;
        let (value, limits) = (start_value(file, by, &key)?, limits(option, range)?);
        if !(limits[0]..=limits[1]).contains(&value) {
            let expected = format!("a range with the case's value of the key, {value:?}, in it");
            return Err(Error::invalid(option, range, expected));
        }
        Ok(Self { key, value, range: limits })
    }

    /// Its column: its last word and its unit, as in a sweep.
    pub(super) fn column(&self) -> String {
        let text = self.key.to_string();
        let word = text.rsplit('.').next().unwrap_or_default();
        self.key.unit().map_or_else(|| word.to_owned(), |unit| format!("{word}_{unit}"))
    }

    /// The key as the label of an axis.
    pub(super) fn label(&self) -> String {
        let unit = self.key.unit().map_or("–".to_owned(), |unit| unit.replace("_per_", "/").replace('_', " "));
        format!("{} ({unit})", self.key)
    }
}

/// The case's value of the key that the option `by` gives.
fn start_value(file: &CaseFile, by: &'static str, key: &Key) -> Result<f64> {
    let found = file.get(key)?;
    let text = found.as_ref().map(ToString::to_string);
    match text.as_deref().map(str::parse::<f64>) {
        Some(Ok(value)) => Ok(value),
        Some(Err(_)) => Err(Error::invalid(by, format!("{key} = {}", text.unwrap_or_default()), "the key of a number")),
        None => Err(Error::invalid(
            by,
            format!("{key}, which the case leaves out or has several values of"),
            format!("a key with one value in the case; --set '{key}=…' gives it one"),
        )),
    }
}

/// The two ends of a range.
fn limits(option: &'static str, text: &str) -> Result<[f64; 2]> {
    let wrong = || Error::invalid(option, format_args!("{text:?}"), "A:B, two numbers, the first below the second");
    let (low, high) = text.split_once(':').ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(wrong);
    let (low, high) = (number(low)?, number(high)?);
    if low < high { Ok([low, high]) } else { Err(wrong()) }
}

/// Tables of a case on which no periodic orbit depends: how long and from where it is run, and what
/// is recorded of the run.
const NO_PART_OF_ORBITS: [&str; 6] = ["initial", "penalty", "probe", "statistics", "time", "wear"];

/// Refuses a key over which nothing changes.
fn changes_orbits(argument: &'static str, key: &Key) -> Result<()> {
    let key = key.to_string();
    if NO_PART_OF_ORBITS.contains(&key.split('.').next().unwrap_or_default()) {
        let expected = format!("a key on which orbits depend: none of {}", NO_PART_OF_ORBITS.join(", "));
        return Err(Error::invalid(argument, key, expected));
    }
    Ok(())
}
