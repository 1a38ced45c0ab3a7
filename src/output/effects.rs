//! What one per cent more of a key changes: keys, numbers with their derivatives, and their table.

use super::table::Table;
use crate::error::amount;

/// A key by which a run or an orbit is differentiated.
#[derive(Debug, Clone, PartialEq)]
pub struct DerivativeKey {
    /// Its path in the case file.
    pub key: String,
    /// Its value.
    pub value: f64,
    /// Its unit as in column names; `None` for a number without one.
    pub unit: Option<&'static str>,
    /// The error of the derivative of the scene, as a share.
    pub error: f64,
}

/// A number with its derivatives by the keys.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Effect {
    /// The wall it is about; empty where it is about none.
    pub wall: String,
    pub words: String,
    pub unit: &'static str,
    pub value: f64,
    /// Per unit of each key.
    pub by: Vec<f64>,
    /// Its changes are told in its unit, of which 1 is a large change, and not as shares of it.
    pub absolute: bool,
}

/// The share of a key by which the table changes it.
const SHARE: f64 = 0.01;

/// The change by that share from which on a number need not change as its derivative says.
const MUCH: f64 = 0.1;

/// A larger error of the derivative of a scene, as a share, is told.
const INEXACT: f64 = 1e-12;

impl DerivativeKey {
    /// The header of the derivative of a number by the key; `unit` is empty for one without.
    pub(super) fn header(&self, what: &str, unit: &str) -> String {
        let per = self.unit.map_or_else(String::new, |unit| format!("_per_{unit}"));
        let unit = if unit.is_empty() { String::new() } else { format!("_{unit}") };
        format!("{what}_by_{}{unit}{per}", self.key.replace(['.', '-'], "_"))
    }
}

impl Effect {
    /// What its changes are shares of.
    fn scale(&self) -> f64 {
        if self.absolute { 1.0 } else { self.value }
    }
}

/// The share of each key by which the table changes it: 1 %, or where that would change a number of
/// the table by much, so that it need not change it as the derivative says, a tenth, a hundredth, …
/// of it.
fn shares(keys: &[DerivativeKey], effects: &[Effect]) -> Vec<f64> {
    let share = |(number, key): (usize, &DerivativeKey)| {
        let changes = effects.iter().filter_map(|one| Some(key.value * one.by.get(number)? / one.scale()));
        let largest = changes.filter(|change| change.is_finite()).fold(0.0, |most: f64, x| most.max(x.abs()));
        if SHARE * largest <= MUCH {
            return SHARE;
        }
        // The power of ten below that which makes the largest change 1 %.
        10.0_f64.powi((SHARE / largest).log10().floor() as i32)
    };
    keys.iter().enumerate().map(share).collect()
}

/// The number of decimals that a share, a power of ten, has in per cent.
fn decimals(share: f64) -> usize {
    (SHARE / share).log10().round().max(0.0) as usize
}

/// A share in per cent, in words.
fn in_per_cent(share: f64) -> String {
    format!("{:.*} %", decimals(share), 100.0 * share)
}

/// What 1 % more of each key changes, or a smaller share; `None` without numbers.
pub(super) fn table(keys: &[DerivativeKey], effects: &[Effect]) -> Option<Table> {
    let shares = shares(keys, effects);
    let mut header = vec!["wall".to_owned(), "number".to_owned(), "value".to_owned()];
    header.extend(keys.iter().zip(&shares).map(|(key, &share)| match key.value == 0.0 {
        true => format!("per unit of {}", key.key),
        false => format!("{} more of {}", in_per_cent(share), key.key),
    }));
    let row = |one: &Effect| {
        let cell = |((key, share), by): ((&DerivativeKey, &f64), &f64)| {
            let unit = if key.value == 0.0 { 1.0 } else { share * key.value };
            let change = 100.0 * unit * by / one.value;
            match (by.is_finite(), key.value != 0.0 && change.is_finite() && !one.absolute) {
                (false, _) => "none".to_owned(),
                (true, true) => format!("{change:+.*} %", 3 + decimals(*share)),
                // A sum with 0 turns −0 into 0.
                (true, false) => format!("{:+.3e} {}", unit * by + 0.0, one.unit).trim_end().to_owned(),
            }
        };
        let value = format!("{} {}", amount(one.value, 5), one.unit).trim_end().to_owned();
        let own = [one.wall.clone(), one.words.clone(), value];
        own.into_iter().chain(keys.iter().zip(&shares).zip(&one.by).map(cell)).collect()
    };
    let rows: Vec<Vec<String>> = effects.iter().map(row).collect();
    (!rows.is_empty()).then(|| Table::new(&header, rows))
}

/// Which keys the table changes by less than 1 %, a sentence each.
pub(super) fn remarks(keys: &[DerivativeKey], effects: &[Effect]) -> Vec<String> {
    let smaller = keys.iter().zip(shares(keys, effects)).filter(|(key, share)| key.value != 0.0 && *share < SHARE);
    let remark = |(key, share): (&DerivativeKey, f64)| {
        format!(
            "by its derivatives 1 % more of {} would change a number of the table by more than {:.0} %, which is no \
             small change: the table has what {} more changes",
            key.key,
            100.0 * MUCH,
            in_per_cent(share)
        )
    };
    smaller.map(remark).collect()
}

/// Of which keys the derivative of the scene is known to fewer digits, a sentence each.
pub(super) fn inexact(keys: &[DerivativeKey]) -> impl Iterator<Item = String> {
    keys.iter().filter(|key| key.error > INEXACT).map(|key| {
        format!("the derivative of the scene with respect to {} errs by {:.0e} of itself", key.key, key.error)
    })
}
