//! `realisations.csv`, and the table and remarks of a study of realisations for the terminal.

use super::csv;
use super::places::Chosen;
use super::table::Table;
use crate::case::Case;
use crate::error::Result;
use crate::scene::Scene;
use crate::statistics::ContactPlace;
use crate::study::realisations::{Estimate, Interval, Measure, Realisations};
use serde_json::{Value, json};
use std::path::Path;

/// Name of the file.
pub const FILE: &str = "realisations.csv";

/// Most rows of the table in the terminal.
pub(super) const MOST_ROWS: usize = 24;

/// Width of the tables in the terminal.
pub(super) const WIDTH: usize = 78;

/// The title of what shows the first of `count` realisations alone, and not their means.
#[must_use]
pub(crate) fn titled(title: &str, count: u64) -> String {
    if count > 1 { format!("{title}: draw 1 of {count}") } else { title.to_owned() }
}

/// Writes one row for each realisation and place: the number of the realisation, the place, its
/// measures, and how many findings of the judge refute the realisation. Cells of measures that a
/// place does not have are empty.
pub fn write(path: &Path, study: &Realisations) -> Result<()> {
    let (header, rows) = cells(study);
    csv::table(path, &header, rows.into_iter())
}

/// The header and the rows of [`write`].
#[must_use]
pub fn cells(study: &Realisations) -> (Vec<String>, Vec<Vec<String>>) {
    (header(), rows(study))
}

/// The same for the studies of several methods, with a first column that names them.
pub fn write_methods(path: &Path, studies: &[(String, &Realisations)]) -> Result<()> {
    write_by_method(path, header(), studies, rows)
}

/// Writes the `rows` of several methods, with a column in front that names the method.
pub(super) fn write_by_method(
    path: &Path,
    mut header: Vec<String>,
    studies: &[(String, &Realisations)],
    rows: fn(&Realisations) -> Vec<Vec<String>>,
) -> Result<()> {
    header.insert(0, "method".to_owned());
    let named = |(method, study): &(String, &Realisations)| {
        let method = method.clone();
        rows(study).into_iter().map(move |row| [vec![method.clone()], row].concat())
    };
    csv::table(path, &header, studies.iter().flat_map(named))
}

fn header() -> Vec<String> {
    let mut header = vec!["realisation".to_owned(), "place".to_owned(), "kind".to_owned()];
    header.extend(Measure::ALL.map(|measure| {
        let (name, unit) = (measure.name(), measure.unit().replace('/', "_per_"));
        if unit.is_empty() { name.to_owned() } else { format!("{name}_{unit}") }
    }));
    header.push("findings".to_owned());
    header
}

fn rows(study: &Realisations) -> Vec<Vec<String>> {
    let places = places(study);
    let rows = study.members.iter().flat_map(|member| {
        places.iter().map(move |place| {
            let mut row = vec![member.number.to_string(), place.name.clone(), place.kind.word().to_owned()];
            row.extend(Measure::ALL.map(|measure| csv::digits(member.value(place, measure))));
            row.push(member.findings.len().to_string());
            row
        })
    });
    rows.collect()
}

/// The places of a study, in its order.
fn places(study: &Realisations) -> Vec<&ContactPlace> {
    let mut places: Vec<&ContactPlace> = Vec::new();
    for estimate in &study.estimates {
        if places.last() != Some(&&estimate.place) {
            places.push(&estimate.place);
        }
    }
    places
}

/// The places that the terminal shows: supports, and walls that are no flats of one; where there
/// are many, those of the largest mean forces.
pub(super) fn shown<'a>(study: &'a Realisations, scene: &Scene, most: usize) -> Vec<&'a ContactPlace> {
    let own = places(study).into_iter().filter(|place| place.stands_alone(scene));
    let force = |place: &&ContactPlace| find(study, place, Measure::ForceMean).map_or(0.0, |one| one.mean);
    Chosen::heaviest(own, most, force).shown
}

pub(super) fn find<'a>(study: &'a Realisations, place: &ContactPlace, measure: Measure) -> Option<&'a Estimate> {
    study.estimates.iter().find(|one| one.place == *place && one.measure == measure)
}

/// The table for the terminal; `None` without walls. The components of forces are in the summary
/// only.
#[must_use]
pub fn table(study: &Realisations, scene: &Scene) -> Option<Table> {
    let columns = [Measure::ForceMean, Measure::ForceRms, Measure::ForceLargest, Measure::WorkRate];
    let known = |measure: &Measure| study.estimates.iter().any(|one| one.measure == *measure);
    let columns: Vec<Measure> = columns.into_iter().filter(known).collect();
    let (mut header, mut deviations) = (vec!["place".to_owned()], Vec::new());
    for measure in &columns {
        header.push(format!("{} ({})", measure.words(), measure.unit()));
        if study.count > 1 {
            deviations.push(header.len());
            header.push(format!("deviation ({})", measure.unit()));
        }
    }
    let row = |place: &ContactPlace| {
        let mut row = vec![place.name.clone()];
        for measure in &columns {
            let one = find(study, place, *measure);
            row.push(one.map_or_else(|| "-".to_owned(), |one| with_interval(one.mean, one.half_width_95)));
            let deviation = one.and_then(|one| one.standard_deviation);
            let text = deviation.map_or_else(|| "-".to_owned(), |s| with_interval(s, None));
            row.extend((study.count > 1).then_some(text));
        }
        row
    };
    let rows: Vec<Vec<String>> = shown(study, scene, MOST_ROWS).into_iter().map(row).collect();
    (!rows.is_empty()).then(|| Table::new(&header, rows).within(WIDTH).attached(deviations))
}

/// The remarks below the table, a sentence each.
#[must_use]
pub fn remarks(study: &Realisations, scene: &Scene) -> Vec<String> {
    let count = study.count;
    let mut remarks = vec![match study.interval {
        Interval::StudentOfRealisations => format!(
            "± is the 95 % interval of the mean over {count} realisations, by Student's t; the deviation is that of \
             one realisation"
        ),
        Interval::BatchesOfOneRealisation => "± is a 95 % interval from the batches of one realisation: it does \
             not know what is slower than a batch; --seeds 5 or more gives that of independent realisations"
            .to_owned(),
    }];
    let averaged = scene.walls.iter().any(|wall| wall.law.is_rigid());
    if averaged && study.estimates.iter().any(|one| one.measure == Measure::ForceLargest) {
        remarks.push(
            "the largest force at rigid walls and supports is the largest mean over any stretch of --force-averaging; \
             it grows with the time of a run"
                .to_owned(),
        );
    }
    remarks.extend(without_friction(scene));
    remarks.extend(study.groups_in_words());
    remarks.extend(study.cautioned().sentences());
    remarks
}

/// The seeds of the case as JSON, from which those of each realisation follow.
pub(crate) fn seeds(case: &Case) -> Value {
    case.seeds().into_iter().map(|(key, seed)| json!({ "key": key, "seed": seed })).collect()
}

/// What a work rate without friction is, where `scene` has such a support.
pub(crate) fn without_friction(scene: &Scene) -> Option<String> {
    let smooth = scene.supports.iter().any(|support| support.friction(&scene.walls).sliding == 0.0);
    smooth.then(|| "work rates without friction are upper figures".to_owned())
}

/// Decimals that show two digits of `x`.
fn decimals(x: f64) -> usize {
    let digits = 1.0 - x.abs().log10().floor();
    if digits.is_finite() { digits.clamp(0.0, 12.0) as usize } else { 1 }
}

pub(super) fn with_decimals(x: f64, decimals: usize) -> String {
    // Where rounding would show −0.
    let x = if x.abs() < 0.5 * 10_f64.powi(-(decimals as i32)) { 0.0 } else { x };
    format!("{x:.decimals$}")
}

/// `x` with so many decimals, or with three digits and a power of ten where these would show fewer
/// than two of its digits.
pub(super) fn in_column(x: f64, decimals: usize) -> String {
    let shown = x == 0.0 || x.abs() >= 10_f64.powi(1 - decimals as i32);
    if shown { with_decimals(x, decimals) } else { format!("{x:.2e}") }
}

/// A half width below this share of the value is rounding: the value has no interval.
const EXACT: f64 = 1e-12;

/// Below this size numbers are written with a power of ten.
const SMALL: f64 = 1e-4;

/// A value with two digits of its half width, or with three of its own.
pub(crate) fn with_interval(x: f64, half: Option<f64>) -> String {
    let half = half.filter(|half| *half > EXACT * x.abs());
    let size = x.abs().max(half.unwrap_or(0.0));
    if !(f64::MIN_POSITIVE..SMALL).contains(&size) {
        return in_decimals(x, half);
    }
    let power = size.log10().floor();
    let scaled = |x: f64| x / 10_f64.powf(power);
    let digits = in_decimals(scaled(x), half.map(scaled));
    if half.is_some() { format!("({digits})e{power}") } else { format!("{digits}e{power}") }
}

fn in_decimals(x: f64, half: Option<f64>) -> String {
    match half {
        Some(half) => {
            let decimals = decimals(half);
            format!("{} ± {}", with_decimals(x, decimals), with_decimals(half, decimals))
        }
        None => with_decimals(x, decimals(x) + 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_number_of_a_column_is_not_shown_as_zero() {
        assert_eq!([0.0, 12.34567, -0.001].map(|x| in_column(x, 4)), ["0.0000", "12.3457", "-0.0010"]);
        assert_eq!([9.99e-4, -3.21e-7].map(|x| in_column(x, 4)), ["9.99e-4", "-3.21e-7"]);
    }

    #[test]
    fn numbers_have_the_digits_of_their_interval() {
        for (x, half, text) in [
            (6.40321, Some(0.1234), "6.40 ± 0.12"),
            (-0.0004, Some(0.1234), "0.00 ± 0.12"),
            (1234.5, Some(56.7), "1234 ± 57"),
            (0.001_234_5, None, "0.00123"),
            (0.0, Some(0.0), "0.00"),
            (2.5e-4, Some(1.3e-5), "0.000250 ± 0.000013"),
            (2.5e-5, Some(1.3e-6), "(2.50 ± 0.13)e-5"),
            (-7.4549e-13, Some(7.41e-14), "(-7.45 ± 0.74)e-13"),
            (1e-19, Some(3.2e-8), "(0.0 ± 3.2)e-8"),
            (2.65e-8, None, "2.65e-8"),
            // A given force, whose mean is it to rounding.
            (2.0, Some(4e-16), "2.00"),
        ] {
            assert_eq!(with_interval(x, half), text);
        }
    }
}
