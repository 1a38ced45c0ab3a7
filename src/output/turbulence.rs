//! `turbulence.csv` and `turbulence-pairs.csv`: the forces of turbulence on modes that were asked
//! for, against those that a run applied.

use super::csv::{self, digits};
use crate::case::Case;
use crate::error::Result;
use crate::scene::Turbulence;
use crate::statistics::{Pair, Recovered};
use std::f64::consts::TAU;
use std::path::PathBuf;

/// The files.
pub const FILES: [&str; 2] = ["turbulence.csv", "turbulence-pairs.csv"];

/// A field and its forces.
type Found<'a> = (String, &'a [f64], Recovered);

/// Writes the files where `place` says, if the case has turbulence.
pub(super) fn write(mut place: impl FnMut(&str) -> Result<PathBuf>, case: &Case) -> Result<()> {
    let found = recovered(case)?;
    if found.is_empty() {
        return Ok(());
    }
    type At<'a> = (&'a Found<'a>, usize, usize);
    let density = |(found, mode, k): &At<'_>, which: usize| {
        digits(found.2.densities.get(*mode).and_then(|of| of[which].get(*k)).copied())
    };
    let columns: [csv::Column<'_, At<'_>>; 7] = [
        ("turbulence", &|(found, ..)| found.0.clone()),
        ("mode", &|(found, mode, _)| number(found, *mode)),
        ("mode_frequency_Hz", &|(found, mode, _)| frequency(found, *mode)),
        ("frequency_Hz", &|(found, _, k)| digits(found.2.frequencies.get(*k).copied())),
        ("asked_N2_per_Hz", &|at| density(at, 0)),
        ("recovered_N2_per_Hz", &|at| density(at, 1)),
        ("scatter_N2_per_Hz", &|(found, mode, k)| {
            digits(found.2.densities.get(*mode).and_then(|of| of[0].get(*k)).map(|asked| found.2.scatter * asked))
        }),
    ];
    let rows = found.iter().flat_map(|one| {
        let modes = 0..one.2.modes.len();
        modes.flat_map(move |mode| (0..one.2.frequencies.len()).map(move |k| (one, mode, k)))
    });
    csv::records(&place(FILES[0])?, &columns, rows)?;
    let columns: [csv::Column<'_, (&Found<'_>, Pair)>; 6] = [
        ("turbulence", &|(found, _)| found.0.clone()),
        ("mode", &|(found, pair)| number(found, pair.modes[0])),
        ("other_mode", &|(found, pair)| number(found, pair.modes[1])),
        ("asked_correlation", &|(_, pair)| digits(Some(pair.asked))),
        ("recovered_correlation", &|(_, pair)| digits(Some(pair.recovered))),
        ("scatter", &|(_, pair)| digits(Some(pair.scatter))),
    ];
    let rows = found.iter().flat_map(|one| one.2.pairs.iter().map(move |pair| (one, *pair)));
    csv::records(&place(FILES[1])?, &columns, rows)
}

/// The number of a mode of the case, from 1.
fn number((_, _, found): &Found<'_>, mode: usize) -> String {
    found.modes.get(mode).map_or_else(String::new, |mode| (mode + 1).to_string())
}

/// Its frequency, Hz.
fn frequency((_, omega, found): &Found<'_>, mode: usize) -> String {
    digits(found.modes.get(mode).and_then(|mode| omega.get(*mode)).map(|omega| omega / TAU))
}

/// The fields of `case`, by the numbers of their tables and along y or z where a table has two.
fn recovered(case: &Case) -> Result<Vec<Found<'_>>> {
    let Some(truncated) = &case.truncated else { return Ok(Vec::new()) };
    let modes = &truncated.reduction.modes;
    let fields = &truncated.whole.turbulence;
    // Their loads come after all others, field by field.
    let mut loads = case.scene.loads.as_slice();
    let mut found = Vec::new();
    for field in fields.iter().rev() {
        let recovered = Recovered::of(field, modes, loads, case.scene.duration)?;
        loads = loads.get(..loads.len().saturating_sub(recovered.modes.len())).unwrap_or_default();
        found.push((name(field, fields), modes.omega.as_slice(), recovered));
    }
    found.reverse();
    Ok(found)
}

fn name(field: &Turbulence, all: &[Turbulence]) -> String {
    let number = field.number();
    let way = if field.is_first() { "along y" } else { "along z" };
    let two = all.iter().filter(|other| other.number() == number).count() > 1;
    if two { format!("{number} {way}") } else { number.to_string() }
}
