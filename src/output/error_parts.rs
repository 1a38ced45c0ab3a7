//! `errors.csv`: the errors of means over realisations in parts, and their table and remarks for
//! the terminal.

use super::csv::{self, digits};
use super::realisations::{self, MOST_ROWS, WIDTH, find, shown, with_decimals, with_interval};
use super::results::Results;
use super::table::Table;
use crate::error::Result;
use crate::scene::Scene;
use crate::study::realisations::{
    Check, ErrorPart, ErrorParts, Estimate, Measure, RealisationStudy, Realisations, Refined,
};
use std::path::Path;

/// Name of the file.
pub const FILE: &str = "errors.csv";

/// Most places for which the terminal has a sentence.
const MOST_LINES: usize = 4;

/// The parts of an error that have a mean, with their names.
type Part = (&'static str, fn(&ErrorParts) -> Option<ErrorPart>);
const PARTS: [Part; 3] =
    [("start", |error| Some(error.start)), ("step", |error| error.step), ("modes", |error| error.modes)];

/// True where the error of any mean is known.
#[must_use]
pub fn has_any(study: &Realisations) -> bool {
    study.estimates.iter().any(|one| one.error.is_some())
}

/// Writes one row for each judged mean: the place, the measure, the mean with the half width of its
/// interval (the error of sampling), the total error, and the other parts with theirs. Cells of
/// parts that are not known are empty.
pub fn write(path: &Path, study: &Realisations) -> Result<()> {
    csv::table(path, &columns(), cells(study).into_iter())
}

/// The same for the studies of several methods, with a first column that names them.
pub fn write_methods(path: &Path, studies: &[(String, &Realisations)]) -> Result<()> {
    realisations::write_by_method(path, columns(), studies, cells)
}

fn columns() -> Vec<String> {
    let mut header = ["place", "kind", "measure", "unit", "mean", "half_width_95", "error"].map(str::to_owned).to_vec();
    header.extend(PARTS.iter().flat_map(|(name, _)| [(*name).to_owned(), format!("{name}_half_width_95")]));
    header
}

fn cells(study: &Realisations) -> Vec<Vec<String>> {
    let row = |one: &Estimate| {
        let error = one.error?;
        let mut row = vec![one.place.name.clone(), one.place.kind.word().to_owned()];
        row.extend([one.measure.name(), one.unit].map(str::to_owned));
        row.extend([Some(one.mean), one.half_width_95, Some(error.total)].map(digits));
        for (_, part) in PARTS {
            let part = part(&error);
            row.extend([part.map(|part| part.mean), part.map(|part| part.half_width_95)].map(digits));
        }
        Some(row)
    };
    study.estimates.iter().filter_map(row).collect()
}

/// Writes `realisations.csv` of a study, and `errors.csv` where errors are known.
pub fn write_study(results: &mut Results, study: &RealisationStudy) -> Result<()> {
    realisations::write(&results.place(realisations::FILE)?, &study.realisations)?;
    if has_any(&study.realisations) {
        write(&results.place(FILE)?, &study.realisations)?;
    }
    Ok(())
}

/// The table for the terminal, in per cent of the means: a row for each support and wall, and each
/// of its judged means; `None` where no error is known.
#[must_use]
pub fn table(study: &Realisations, scene: &Scene) -> Option<Table> {
    table_of(&[(None, study)], scene)
}

/// The same for several methods, a row for each, without the error of sampling: it is the half
/// width of the means.
#[must_use]
pub fn table_of_methods(studies: &[(String, &Realisations)], scene: &Scene) -> Option<Table> {
    let named: Vec<_> = studies.iter().map(|(method, study)| (Some(method.as_str()), *study)).collect();
    table_of(&named, scene)
}

/// What the parts are in the table of several methods.
pub const REMARK_OF_METHODS: &str = "errors: start: second half of the window less the first; step: the change by half \
    the step, twice or 4/3 of it by the order of the method; modes: the change by more modes; the error is the sum of \
    their sizes and the root of the sum of all squared ±, that of the mean among them";

fn table_of(studies: &[(Option<&str>, &Realisations)], scene: &Scene) -> Option<Table> {
    let first = studies.first()?.1;
    let mut judged: Vec<(Option<&str>, &Estimate, ErrorParts)> = Vec::new();
    for place in shown(first, scene, MOST_ROWS / 3) {
        for what in [Measure::WorkRate, Measure::ForceMean, Measure::ForceRms] {
            judged.extend(studies.iter().filter_map(|(method, study)| {
                find(study, place, what).and_then(|one| Some((*method, one, one.error?)))
            }));
        }
    }
    let parts: Vec<Part> =
        PARTS.into_iter().filter(|(_, part)| judged.iter().any(|(_, _, error)| part(error).is_some())).collect();
    let methods = studies.iter().any(|(method, _)| method.is_some());
    let names = ["place", "mean of", "method"];
    let mut header: Vec<String> = names.iter().take(if methods { 3 } else { 2 }).map(|&name| name.to_owned()).collect();
    header.push("error (%)".to_owned());
    header.extend(parts.iter().map(|(name, _)| format!("{name} (%)")));
    header.extend((!methods).then(|| "sampling (%)".to_owned()));
    let row = |(method, one, error): &(Option<&str>, &Estimate, ErrorParts)| {
        let none = || "-".to_owned();
        let mut row = vec![one.place.name.clone(), one.measure.words().to_owned()];
        row.extend(method.map(str::to_owned));
        row.push(share(error.total, one).map_or_else(none, per_cent));
        for (_, part) in &parts {
            row.push(part(error).and_then(|part| interval(&part, one)).unwrap_or_else(none));
        }
        let sampling = share(error.sampling_half_width_95, one);
        row.extend((!methods).then(|| sampling.map_or_else(none, |half| format!("± {}", per_cent(half)))));
        row
    };
    let rows: Vec<Vec<String>> = judged.iter().map(row).collect();
    (!rows.is_empty()).then(|| Table::new(&header, rows).within(WIDTH))
}

/// The remarks below the table, a sentence each.
#[must_use]
pub fn remarks(study: &Realisations, scene: &Scene) -> Vec<String> {
    let mut remarks: Vec<String> = study.checks.iter().filter_map(refuted).collect();
    if !has_any(study) {
        return remarks;
    }
    remarks.push(format!(
        "start: second half of the window less the first{}; the error is the sum of their sizes and the root of the \
         sum of all squared ±",
        study.checks.iter().filter(|check| check.refuted.is_empty()).map(how).collect::<String>()
    ));
    let fewer: Vec<&Check> = study.checks.iter().filter(|check| check.count < study.count).collect();
    remarks.extend(match fewer.as_slice() {
        [] => None,
        [first, ..] if study.checks.iter().all(|check| check.count == first.count) => {
            Some(format!("step and modes are from the first {} of {} realisations", first.count, study.count))
        }
        // The search for a step checks more realisations with half the step than with more modes.
        [first, ..] => Some(format!(
            "with {} the first {} of {} realisations are run again",
            first.refined, first.count, study.count
        )),
    });
    let main = [Measure::WorkRate, Measure::ForceMean];
    let verdict = |place| main.into_iter().find_map(|what| verdict(find(study, place, what)?));
    remarks.extend(shown(study, scene, MOST_LINES).into_iter().filter_map(verdict));
    remarks
}

/// What a check compares, as a part of a sentence.
fn how(check: &Check) -> String {
    match check.refined {
        Refined::HalfStep { order, .. } => {
            let factor = if order == 1 { "twice" } else { "4/3 of" };
            format!("; step: {factor} the change by half the step")
        }
        Refined::MoreModes { .. } => format!("; modes: the change by {}", check.refined),
    }
}

/// That nothing follows from a check with refuted runs.
pub(crate) fn refuted(check: &Check) -> Option<String> {
    let (what, count, refuted) = (check.refined, check.count, check.refuted.len());
    (refuted > 0).then(|| {
        format!("with {what} {refuted} of {count} realisations are refuted: that part of the errors is not known")
    })
}

/// What is known of the error of a mean, in a sentence; `None` where there is none, and for a mean
/// of 0.
fn verdict(one: &Estimate) -> Option<String> {
    let error = one.error?;
    let mean = with_interval(one.mean, one.half_width_95);
    let (place, what, unit) = (&one.place.name, one.measure.words(), one.unit);
    let mut text = format!("{place}: {what} {mean} {unit}, error {} %: ", per_cent(share(error.total, one)?));
    for (name, part) in PARTS {
        let Some(part) = part(&error) else { continue };
        text += &if part.is_seen() {
            format!("{name} seen, {} %, ", interval(&part, one)?)
        } else {
            format!("{name} not seen, at most {} %, ", per_cent(share(part.at_most(), one)?))
        };
    }
    Some(text + &format!("sampling ± {} %", per_cent(share(error.sampling_half_width_95, one)?)))
}

/// `x` in per cent of the mean of `one`; `None` where that is 0.
fn share(x: f64, one: &Estimate) -> Option<f64> {
    let share = 100.0 * x / one.mean.abs();
    share.is_finite().then_some(share)
}

/// Per cent with two digits, and no more than two decimals.
fn per_cent(x: f64) -> String {
    let decimals = if x.abs() >= 9.95 {
        0
    } else if x.abs() >= 0.095 {
        1
    } else {
        2
    };
    with_decimals(x, decimals)
}

/// A part in per cent of the mean, with its interval.
fn interval(part: &ErrorPart, one: &Estimate) -> Option<String> {
    let half = per_cent(share(part.half_width_95, one)?);
    let decimals = half.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    Some(format!("{} ± {half}", with_decimals(share(part.mean, one)?, decimals)))
}
