//! `derivatives.csv` and `multipliers.csv` of a periodic orbit, and the table of what one per cent
//! more of a key changes.

use super::csv::{self, digits};
use super::derivatives::FILE;
use super::effects::{self, DerivativeKey, Effect};
use super::table::Table;
use crate::error::Result;
use crate::scene::Scene;
use crate::study::orbit_derivatives::{Differentiated, EventDerivative, MultiplierDerivative, OrbitDerivatives};
use serde_json::{Value, json};
use std::path::Path;

/// The table of multipliers.
pub const MULTIPLIERS_FILE: &str = "multipliers.csv";

/// Writes the events, one per row, with their numbers and the derivatives of these by each key:
/// `speed_by_wall_stop_restitution_m_per_s`.
pub fn write(path: &Path, scene: &Scene, keys: &[DerivativeKey], found: &OrbitDerivatives) -> Result<()> {
    let Some(first) = found.events.first() else {
        return csv::table(path, &["wall".to_owned(), "kind".to_owned()], std::iter::empty::<Vec<String>>());
    };
    let mut header = vec!["wall".to_owned(), "kind".to_owned()];
    header.extend(first.numbers.iter().map(|one| format!("{}_{}", one.name, one.unit)));
    header.extend(keys.iter().flat_map(|key| first.numbers.iter().map(|one| key.header(one.name, one.unit))));
    let rows = found.events.iter().map(|event| {
        let number = |x: f64| digits(Some(x).filter(|x| x.is_finite()));
        let mut row = vec![scene.wall_name(event.wall).unwrap_or_default().to_owned(), event.kind.to_owned()];
        row.extend(event.numbers.iter().map(|one| number(one.value)));
        row.extend((0..keys.len()).flat_map(|key| event.numbers.iter().map(move |one| number(by(one, key)))));
        row
    });
    csv::table(path, &header, rows)
}

/// Writes the multipliers, real and imaginary part, with their derivatives by each key.
pub fn write_multipliers(path: &Path, keys: &[DerivativeKey], multipliers: &[MultiplierDerivative]) -> Result<()> {
    let parts = ["real", "imaginary"];
    let mut header: Vec<String> = parts.iter().map(|part| (*part).to_owned()).collect();
    header.extend(keys.iter().flat_map(|key| parts.map(|part| key.header(part, ""))));
    let rows = multipliers.iter().map(|one| {
        let numbers = one.value.iter().chain(one.by.iter().flatten());
        numbers.map(|x| digits(Some(x + 0.0).filter(|x| x.is_finite()))).collect::<Vec<_>>()
    });
    csv::table(path, &header, rows)
}

fn by(number: &Differentiated, key: usize) -> f64 {
    // A sum with 0 turns −0 into 0.
    number.by.get(key).map_or(f64::NAN, |x| x + 0.0)
}

/// The numbers of the table: of each event, and the modulus of the largest multiplier.
fn effects_of(scene: &Scene, found: &OrbitDerivatives) -> Vec<Effect> {
    let several = found.events.len() > 1;
    let of_event = |(index, event): (usize, &EventDerivative)| {
        let number = if several { format!(" of event {}", index + 1) } else { String::new() };
        let effect = move |one: &Differentiated| Effect {
            wall: scene.wall_name(event.wall).unwrap_or_default().to_owned(),
            words: format!("{}{number}", one.name.replace('_', " ")),
            unit: unit(one),
            value: one.value,
            by: one.by.clone(),
            absolute: one.unit == "cycles",
        };
        event.numbers.iter().map(effect).collect::<Vec<_>>()
    };
    let mut effects: Vec<Effect> = found.events.iter().enumerate().flat_map(of_event).collect();
    if let Some(MultiplierDerivative { value: [re, im], by }) = found.multipliers.iter().flatten().next() {
        let modulus = re.hypot(*im);
        effects.push(Effect {
            wall: String::new(),
            words: "largest |multiplier|".to_owned(),
            unit: "",
            value: modulus,
            by: by.iter().map(|[a, b]| (re * a + im * b) / modulus).collect(),
            absolute: false,
        });
    }
    effects
}

/// The unit of a number in words.
fn unit(number: &Differentiated) -> &'static str {
    match number.unit {
        "m_per_s" => "m/s",
        "N_s" => "N s",
        own => own,
    }
}

/// What 1 % more of each key changes, or a smaller share; `None` for an orbit without events and
/// multipliers.
#[must_use]
pub fn table(scene: &Scene, keys: &[DerivativeKey], found: &OrbitDerivatives) -> Option<Table> {
    effects::table(keys, &effects_of(scene, found))
}

/// What a reader of the derivatives must know, a sentence each.
#[must_use]
pub fn remarks(scene: &Scene, keys: &[DerivativeKey], found: &OrbitDerivatives) -> Vec<String> {
    let longer = keys.iter().zip(&found.forcing_period).filter(|(_, longer)| **longer != 0.0);
    let longer = longer.map(|(key, longer)| {
        let per = key.unit.map_or_else(String::new, |unit| format!(" per {}", unit.replace("_per_", "/")));
        format!("{} changes the period of the load by {longer:.6e} s{per}; phases are shares of it", key.key)
    });
    let mut remarks = effects::remarks(keys, &effects_of(scene, found));
    if found.events.is_empty() {
        remarks.push(format!("{FILE} has no rows, since the orbit meets no wall"));
    }
    remarks.extend(longer);
    remarks.extend(effects::inexact(keys));
    remarks
}

/// The same as JSON.
#[must_use]
pub fn document(scene: &Scene, keys: &[DerivativeKey], found: &OrbitDerivatives) -> Value {
    let numbers =
        |one: &Differentiated| json!({ "name": one.name, "unit": one.unit, "value": one.value, "derivative": one.by });
    let events = found.events.iter().map(|event| {
        json!({
            "wall": scene.wall_name(event.wall),
            "kind": event.kind,
            "numbers": event.numbers.iter().map(numbers).collect::<Vec<_>>(),
        })
    });
    let multiplier = |one: &MultiplierDerivative| json!({ "value": one.value, "derivative": one.by });
    let keys =
        keys.iter().map(|key| json!({ "key": key.key, "value": key.value, "unit": key.unit, "error": key.error }));
    json!({
        "keys": keys.collect::<Vec<_>>(),
        "forcing_period_s": found.forcing_period,
        "events": events.collect::<Vec<_>>(),
        "multipliers": found.multipliers.as_ref().map(|all| all.iter().map(multiplier).collect::<Vec<_>>()),
    })
}
