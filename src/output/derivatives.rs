//! `derivatives.csv`, `output-derivatives.csv`, and the table of what one per cent more of a key
//! changes.

use super::csv::{self, digits};
use super::effects::{self, DerivativeKey, Effect};
use super::table::Table;
use crate::error::Result;
use crate::order::sort_by_number;
use crate::scene::Scene;
use crate::study::derivatives::{Derivatives, Measured};
use crate::study::horizon::LARGEST_GROWTH;
use crate::variation::{MeanDerivative, NoDerivative};
use serde_json::{Value, json};
use std::path::Path;

/// The table of contacts.
pub const FILE: &str = "derivatives.csv";

/// The table of the states at the output times.
pub const STATES_FILE: &str = "output-derivatives.csv";

/// The numbers of a contact that are differentiated, with their units.
const NUMBERS: [(&str, &str); 5] =
    [("start", "s"), ("end", "s"), ("approach_speed", "m_per_s"), ("departure_speed", "m_per_s"), ("impulse", "N_s")];

/// Writes the contacts, one per row, by their starts, with the derivatives of start, end, approach
/// speed, departure speed and impulse by each key:
/// `impulse_by_wall_stop_stiffness_N_s_per_N_per_m`. Cells of what is not known are empty, also
/// those by a key from where the derivatives by it alone end.
pub fn write(path: &Path, scene: &Scene, keys: &[DerivativeKey], derivatives: &Derivatives) -> Result<()> {
    let mut header: Vec<String> = csv::CONTACT.iter().copied().chain(["growth"]).map(str::to_owned).collect();
    header.extend(keys.iter().flat_map(|key| NUMBERS.map(|(what, unit)| key.header(what, unit))));
    // In the order of contacts.csv.
    let mut contacts: Vec<_> = derivatives.contacts.iter().collect();
    sort_by_number(&mut contacts, |a| a.contact.start);
    let rows = contacts.into_iter().map(|one| {
        let mut row = csv::contact_cells(name(scene, one.contact.wall), one.contact);
        row.push(digits(Some(one.growth)));
        for key in 0..keys.len() {
            let lists = [one.start_by, one.end_by, one.approach_speed_by, one.departure_speed_by, one.impulse_by];
            // A sum with 0 turns −0 into 0.
            row.extend(lists.map(|list| digits(list.get(key).map(|x| x + 0.0).filter(|x| x.is_finite()))));
        }
        row
    });
    csv::table(path, &header, rows)
}

/// Writes displacement and velocity of each probe at the output times of the scene, with their
/// derivatives by each key: `displacement_tip_by_wall_stop_stiffness_m_per_N_per_m`. Cells of what
/// is not known are empty.
pub fn write_states(path: &Path, scene: &Scene, keys: &[DerivativeKey], derivatives: &Derivatives) -> Result<()> {
    let names: Vec<&str> = scene.probes.iter().map(|probe| &*probe.name).collect();
    let mut header = vec!["time_s".to_owned()];
    for (what, unit) in csv::probe_numbers(&names).into_iter().flatten() {
        header.push(format!("{what}_{unit}"));
        header.extend(keys.iter().map(|key| key.header(&what, unit)));
    }
    let motion = &derivatives.motion;
    let cell = |list: &[f64], index: usize| digits(list.get(index).copied().filter(|x| x.is_finite()));
    let rows = motion.time.iter().enumerate().map(|(row, &time)| {
        let mut cells = vec![digits(Some(time))];
        for state in (0..names.len()).map(|probe| row * names.len() + probe) {
            for (values, by) in
                [(&motion.displacement, &motion.displacement_by), (&motion.velocity, &motion.velocity_by)]
            {
                cells.push(cell(values, state));
                cells.extend((0..keys.len()).map(|key| cell(by, state * keys.len() + key)));
            }
        }
        cells
    });
    csv::table(path, &header, rows)
}

fn name(scene: &Scene, wall: usize) -> String {
    scene.wall_name(wall).unwrap_or_default().to_owned()
}

/// What 1 % more of each key changes, or a smaller share; `None` without contacts.
#[must_use]
pub fn table(scene: &Scene, keys: &[DerivativeKey], derivatives: &Derivatives) -> Option<Table> {
    effects::table(keys, &effects_of(scene, derivatives))
}

/// The numbers of the table.
fn effects_of(scene: &Scene, derivatives: &Derivatives) -> Vec<Effect> {
    let effect = |one: Measured| Effect {
        wall: name(scene, one.wall),
        words: one.words.to_owned(),
        unit: one.unit,
        value: one.value,
        by: one.derivative,
        absolute: false,
    };
    derivatives.measured().into_iter().map(effect).collect()
}

/// What a reader of the derivatives must know, a sentence each, beside statistics `from` that time
/// (s) on.
#[must_use]
pub fn remarks(scene: &Scene, from: f64, keys: &[DerivativeKey], derivatives: &Derivatives) -> Vec<String> {
    let mut remarks = Vec::new();
    if from > 0.0 {
        remarks.push(format!(
            "derivatives, and the numbers beside them, are those of the whole run; the statistics begin at {from} s"
        ));
    }
    let (counted, all) = (derivatives.predictable().count(), derivatives.contacts.len());
    if all == 0 && derivatives.open == 0 && derivatives.ended.is_none() {
        remarks.push(format!(
            "{FILE} has no rows, since the motion meets no wall; summary.json has the derivatives of its means, and \
             times in `[output]` add those of displacement and velocity"
        ));
    }
    if counted < all {
        remarks.push(format!(
            "the table counts the first {counted} contacts: after them a small change has grown by more than \
             {LARGEST_GROWTH:.0}, and one of 1 % is no longer small; {FILE} has {all}"
        ));
    }
    remarks.extend(effects::remarks(keys, &effects_of(scene, derivatives)));
    let lost = keys.iter().zip(&derivatives.lost).filter_map(|(key, lost)| Some((key, lost.as_ref()?)));
    remarks.extend(lost.map(|(key, reason)| reason.by(&key.key)));
    if derivatives.lost.iter().any(Option::is_none) {
        remarks.extend(derivatives.ended.as_ref().map(ToString::to_string));
    }
    if derivatives.ended.is_none() && derivatives.open > 0 {
        let open = derivatives.open;
        let contacts = if open == 1 { "1 contact that is" } else { &format!("{open} contacts that are") };
        remarks.push(format!("{FILE} has no row for {contacts} still open at the end"));
    }
    remarks.extend(effects::inexact(keys));
    remarks
}

/// Means over the whole run with their derivatives, as JSON.
fn means_document(scene: &Scene, means: &MeanDerivative) -> Value {
    let rows = |unit: &str, names: Vec<&str>, values: &[f64], by: &[Vec<f64>]| {
        let all = names.into_iter().zip(values).zip(by);
        let rows =
            all.map(|((name, value), by)| json!({ "name": name, "unit": unit, "value": value, "derivative": by }));
        rows.collect::<Vec<Value>>()
    };
    let probes = || scene.probes.iter().map(|probe| &*probe.name).collect();
    let walls = (0..scene.walls.len()).map(|wall| scene.wall_name(wall).unwrap_or_default()).collect();
    json!({
        "displacement_mean": rows("m", probes(), &means.displacement, &means.displacement_by),
        "displacement_rms": rows("m", probes(), &means.rms, &means.rms_by),
        "force_mean": rows("N", walls, &means.force, &means.force_by),
    })
}

/// The same as JSON.
#[must_use]
pub fn document(scene: &Scene, keys: &[DerivativeKey], derivatives: &Derivatives) -> Value {
    let all = derivatives.measured();
    let measured = all.iter().map(|one| {
        json!({
            "wall": name(scene, one.wall),
            "name": one.name,
            "unit": one.unit,
            "value": one.value,
            "derivative": one.derivative,
        })
    });
    let ended = derivatives.ended.as_ref();
    json!({
        "keys": keys
            .iter()
            .zip(&derivatives.lost)
            .map(|(key, lost)| {
                let lost = lost.as_ref();
                json!({
                    "key": key.key,
                    "value": key.value,
                    "unit": key.unit,
                    "error": key.error,
                    "ended_s": lost.map(NoDerivative::time),
                    "ended": lost.map(|lost| lost.by(&key.key)),
                })
            })
            .collect::<Vec<_>>(),
        "contacts": derivatives.contacts.len(),
        "predictable_contacts": derivatives.predictable().count(),
        "measured": measured.collect::<Vec<_>>(),
        "means": derivatives.means.as_ref().map(|means| means_document(scene, means)),
        "growth": derivatives.growth,
        "ended_s": ended.map(NoDerivative::time),
        "ended": ended.map(ToString::to_string),
    })
}
