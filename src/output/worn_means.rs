//! Worn volume and depths over the realisations of a case, by its law of wear: a table for the
//! terminal, and their part of the summary.

use super::realisations::{MOST_ROWS, WIDTH, with_interval};
use super::table::Table;
use crate::case::Case;
use crate::statistics::WearStatistics;
use crate::study::realisations::{Realisations, mean_of};
use serde_json::{Value, json};

/// A quantity: its name, its unit, its heading in the table, and the number of its units in one
/// unit of the table.
const QUANTITIES: [(&str, &str, &str, f64); 4] = [
    ("worn_volume", "m³", "worn (mm³)", 1e9),
    ("depth_deepest", "m", "deepest (mm)", 1e3),
    ("depth_one_scar", "m", "one scar (mm)", 1e3),
    ("depth_all_round", "m", "all round (mm)", 1e3),
];

/// Mean, standard deviation and half width; `None` where a realisation has no value.
type Mean = Option<(f64, Option<f64>, Option<f64>)>;

/// The quantities at support number `index` in one realisation.
fn quantities(case: &Case, index: usize, wear: &WearStatistics) -> Option<[Option<f64>; QUANTITIES.len()]> {
    let worn = case.archard(index)?.worn(wear.work_rate_w);
    Some([worn.volume_m3, case.depth_deepest(index, wear), worn.depth_one_scar_m, worn.depth_all_round_m])
}

/// The means at each support that has a law of wear and any value.
fn means<'a>(case: &'a Case, study: &Realisations) -> Vec<(&'a str, [Mean; QUANTITIES.len()])> {
    let at = |index: usize| {
        let members = study.members.iter().map(|member| quantities(case, index, member.wear.get(index)?));
        let members: Vec<_> = members.collect::<Option<_>>()?;
        Some(std::array::from_fn(|which| {
            let values: Option<Vec<f64>> = members.iter().map(|values| values[which]).collect();
            values.filter(|values| !values.is_empty()).map(|values| mean_of(&values))
        }))
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
