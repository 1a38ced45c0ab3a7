//! Worn volume and depths over the realisations of a case, by its law of wear: a table for the
//! terminal, and their part of the summary.

use super::realisations::{MOST_ROWS, WIDTH, with_interval};
use super::table::Table;
use super::through;
use crate::case::Case;
use crate::scene::Support;
use crate::statistics::WearStatistics;
use crate::study::realisations::{Deepest, Realisations, mean_of};
use crate::wear::{WearWork, Worn};
use serde_json::{Value, json};

/// A quantity: its name, its unit, its heading in the table, and the number of its units in one
/// unit of the table.
const QUANTITIES: [(&str, &str, &str, f64); 5] = [
    ("worn_volume", "m³", "worn (mm³)", 1e9),
    ("depth_deepest", "m", "deepest (mm)", 1e3),
    ("depth_one_scar", "m", "one scar (mm)", 1e3),
    ("depth_all_round", "m", "all round (mm)", 1e3),
    ("support_worn_volume", "m³", "support worn (mm³)", 1e9),
];

/// Mean, standard deviation and half width; `None` where a realisation has no value.
type Mean = Option<(f64, Option<f64>, Option<f64>)>;

/// The means at support number `index`: depths are those of the mean work rates, and of the deepest
/// one that of [`Deepest`], over its sectors or flats.
fn means_at(case: &Case, index: usize, wear: &[&WearStatistics]) -> Option<[Mean; QUANTITIES.len()]> {
    let law = case.archard(index)?;
    let worn: Vec<Worn> = wear.iter().map(|wear| law.worn(wear.work_rate_w)).collect();
    let mean = |of: fn(&Worn) -> Option<f64>| {
        let values: Option<Vec<f64>> = worn.iter().map(of).collect();
        values.filter(|values| !values.is_empty()).map(|values| mean_of(&values))
    };
    let rates: Vec<WearWork> = wear.iter().map(|wear| wear.rates()).collect();
    let depths = case.depths_about_mean(index, &rates);
    let deepest = (!depths.is_empty()).then(|| Deepest::of(&depths)).filter(|found| !found.value.is_nan());
    let scars = case.scars_about_mean(index, &rates).concat();
    Some([
        mean(|worn| worn.volume_m3),
        deepest.map(|found| (found.value, found.deviation, found.half_width_95)),
        (!scars.is_empty()).then(|| mean_of(&scars)),
        mean(|worn| worn.depth_all_round_m),
        mean(|worn| worn.support_volume_m3),
    ])
}

/// The means at each support that has a law of wear and any value.
fn means<'a>(case: &'a Case, study: &Realisations) -> Vec<(&'a str, [Mean; QUANTITIES.len()])> {
    let at = |index: usize| {
        let wear: Option<Vec<&WearStatistics>> = study.members.iter().map(|member| member.wear.get(index)).collect();
        means_at(case, index, &wear?)
    };
    let supports = case.scene.supports.iter().enumerate();
    let all = supports.filter_map(|(index, support)| Some((support.name.as_str(), at(index)?)));
    all.filter(|(_, means): &(_, [Mean; QUANTITIES.len()])| means.iter().any(Option::is_some)).collect()
}

/// The table for the terminal; `None` where nothing wears.
#[must_use]
pub fn table(case: &Case, study: &Realisations) -> Option<Table> {
    let means = means(case, study);
    let row = |(support, means): &(&str, [Mean; QUANTITIES.len()])| {
        let cell = |(mean, (.., unit)): (&Mean, (&str, &str, &str, f64))| {
            let cell =
                |(mean, _, half): &(f64, _, Option<f64>)| with_interval(mean * unit, half.map(|half| half * unit));
            mean.as_ref().map_or_else(|| "-".to_owned(), cell)
        };
        std::iter::once((*support).to_owned()).chain(means.iter().zip(QUANTITIES).map(cell)).collect()
    };
    let header: Vec<&str> = std::iter::once("place").chain(QUANTITIES.map(|(_, _, heading, _)| heading)).collect();
    let rows: Vec<Vec<String>> = means.iter().take(MOST_ROWS).map(row).collect();
    (!rows.is_empty()).then(|| Table::new(&header, rows).within(WIDTH))
}

/// Warnings where the means of several realisations are deeper than the limit, the wall or the
/// radius of the tube: those of one realisation are its run's own.
#[must_use]
pub fn warnings(case: &Case, study: &Realisations) -> Vec<String> {
    if study.count < 2 {
        return Vec::new();
    }
    let all = means(case, study);
    let of = |(index, support): (usize, &Support)| {
        let (_, [volume, _, scar, round, _]) = *all.iter().find(|(name, _)| *name == support.name)?;
        let [volume_m3, depth_one_scar_m, depth_all_round_m] =
            [volume, scar, round].map(|mean| mean.map(|(mean, ..)| mean));
        let worn = Worn { volume_m3, depth_one_scar_m, depth_all_round_m, support_volume_m3: None };
        through::warning(case, index, &worn).map(|words| format!("in the mean over the realisations {words}"))
    };
    case.scene.supports.iter().enumerate().filter_map(of).collect()
}

/// What the table tells, a sentence each.
#[must_use]
pub fn remarks(case: &Case, study: &Realisations) -> Vec<String> {
    let deepest = "deepest is the largest of the means of all sectors, or flats, with what taking the largest adds \
                   in its half width, by the jackknife over the realisations";
    let one = "deepest of one realisation is an upper figure: a sector, or flat, counts that is the deepest by chance";
    let has_depth = means(case, study).iter().any(|(_, [_, deepest, ..])| deepest.is_some());
    let deepest = has_depth.then(|| if study.count > 1 { deepest } else { one }.to_owned());
    let within = "worn volume and depths: within the service of the case, by Archard's law".to_owned();
    std::iter::once(within).chain(deepest).collect()
}

/// The means as entries of the form of the study's own estimates; their errors are not judged.
#[must_use]
pub fn document(case: &Case, study: &Realisations) -> Value {
    let entries = means(case, study).into_iter().flat_map(|(support, means)| {
        means.into_iter().zip(QUANTITIES).filter_map(move |(mean, (measure, unit, ..))| {
            let (mean, deviation, half_width) = mean?;
            Some(json!({
                "place": support,
                "kind": "support",
                "measure": measure,
                "unit": unit,
                "mean": mean,
                "standard_deviation": deviation,
                "half_width_95": half_width,
                "error": null,
            }))
        })
    });
    entries.collect()
}
