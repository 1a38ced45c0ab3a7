//! `history.csv` and `years.csv` of histories of wear, their table, document and pictures.

use super::colours::Places;
use super::csv;
use super::figure::{Curve, Figure, Mark, Panel};
use super::realisations::with_interval;
use super::results::Results;
use super::table::Table;
use super::wear_remarks;
use crate::case::Case;
use crate::error::Result;
use crate::study::wear_history::{WearHistories, WearPoint, WearQuantity, YEAR, mean};
use serde_json::{Map, Value, json};

/// A quantity of a support that changes over the years: its column, its words with the unit of
/// tables (none where it is in the files alone), what one of these is in SI units, and what it is.
struct Quantity {
    column: &'static str,
    words: &'static str,
    unit: f64,
    value: WearQuantity,
}

const QUANTITIES: [Quantity; 5] = [
    Quantity { column: "gap", words: "gap (mm)", unit: 1e-3, value: WearQuantity::Gap },
    Quantity { column: "depth_deepest", words: "deepest (mm)", unit: 1e-3, value: WearQuantity::DepthDeepest },
    Quantity { column: "depth_all_round", words: "all round (mm)", unit: 1e-3, value: WearQuantity::DepthAllRound },
    Quantity { column: "depth_one_scar", words: "", unit: 1e-3, value: WearQuantity::DepthOneScar },
    Quantity { column: "work_rate", words: "work rate (W)", unit: 1.0, value: WearQuantity::WorkRate },
];

/// The quantities of the table for people: the others are in the files alone.
fn shown() -> impl Iterator<Item = &'static Quantity> {
    QUANTITIES.iter().filter(|quantity| !quantity.words.is_empty())
}

impl Quantity {
    fn unit(&self) -> &'static str {
        if self.unit == 1.0 { "W" } else { "m" }
    }
}

/// Writes `history.csv`, one row a history, time and support, and `years.csv`, the means over the
/// histories with the half widths of their 95 % intervals.
pub fn write(results: &mut Results, found: &WearHistories) -> Result<()> {
    for (name, (header, rows)) in [("history.csv", history(found)), ("years.csv", years(found))] {
        csv::table(&results.place(name)?, &header, rows.into_iter())?;
    }
    Ok(())
}

/// The columns of `years.csv` that have the means of its quantities.
pub(crate) fn columns() -> Vec<String> {
    QUANTITIES.iter().map(|quantity| format!("{}_{}", quantity.column, quantity.unit())).collect()
}

/// The header and the rows of `history.csv`.
#[must_use]
pub fn history(found: &WearHistories) -> (Vec<String>, Vec<Vec<String>>) {
    let mut header: Vec<String> = ["history", "year", "place"].map(str::to_owned).to_vec();
    header.extend(columns());
    header.extend(["shift_y_m", "shift_z_m", "work_J"].map(str::to_owned));
    let mut rows = Vec::new();
    for point in &found.points {
        for (history, states) in point.histories.iter().enumerate() {
            for (name, state) in found.supports.iter().zip(states) {
                let mut row = vec![(history + 1).to_string(), csv::digits(Some(point.time_s / YEAR)), name.clone()];
                row.extend(QUANTITIES.map(|quantity| csv::digits(Some(quantity.value.of(state)).filter(finite))));
                let [y, z] = state.shift_m;
                row.extend([y, z, state.work_j].map(|x| csv::digits(Some(x))));
                rows.push(row);
            }
        }
    }
    (header, rows)
}

/// The columns of `years.csv` after year and place: means, and the half widths of their intervals.
fn mean_columns() -> Vec<String> {
    let both = |quantity: &Quantity| {
        let (column, unit) = (quantity.column, quantity.unit());
        [format!("{column}_{unit}"), format!("{column}_half_width_95_{unit}")]
    };
    QUANTITIES.iter().flat_map(both).collect()
}

/// Year, place and [`mean_columns`] of each point and support; `None` for what is not finite.
fn means(found: &WearHistories) -> impl Iterator<Item = (f64, &String, Vec<Option<f64>>)> {
    let of = |(point, support): (&WearPoint, usize)| {
        let both = |quantity: &Quantity| {
            let (mean, half) = mean(point, support, quantity.value);
            [Some(mean).filter(finite), half.filter(finite)]
        };
        QUANTITIES.iter().flat_map(both).collect()
    };
    found.points.iter().flat_map(move |point| {
        let places = found.supports.iter().enumerate();
        places.map(move |(support, name)| (point.time_s / YEAR, name, of((point, support))))
    })
}

/// The header and the rows of `years.csv`.
#[must_use]
pub fn years(found: &WearHistories) -> (Vec<String>, Vec<Vec<String>>) {
    let header = [vec!["year".to_owned(), "place".to_owned()], mean_columns()].concat();
    let row = |(year, place, values): (f64, &String, Vec<Option<f64>>)| {
        let cells = values.into_iter().map(csv::digits);
        [csv::digits(Some(year)), place.clone()].into_iter().chain(cells).collect()
    };
    (header, means(found).map(row).collect())
}

/// The same as JSON: an object for each row.
fn years_document(found: &WearHistories) -> Vec<Value> {
    let columns = mean_columns();
    let row = |(year, place, values): (f64, &String, Vec<Option<f64>>)| {
        let mut row = Map::from_iter([("year".to_owned(), json!(year)), ("place".to_owned(), json!(place))]);
        row.extend(columns.iter().cloned().zip(values.into_iter().map(|value| json!(value))));
        Value::Object(row)
    };
    means(found).map(row).collect()
}

fn finite(x: &f64) -> bool {
    x.is_finite()
}

/// The means over the years, a block of rows for each support.
#[must_use]
pub fn table(found: &WearHistories) -> Table {
    let mut header = vec!["support", "year"];
    header.extend(shown().map(|quantity| quantity.words));
    let end = found.points.last().map_or(0.0, |point| point.time_s / YEAR);
    // Four figures of the last year, or more that tell the rows apart.
    let years = |decimals: usize| -> Vec<String> {
        found.points.iter().map(|point| format!("{:.decimals$}", point.time_s / YEAR)).collect()
    };
    let fewest = (3.0 - end.log10().floor()).clamp(0.0, 9.0) as usize;
    let tells = |decimals: &usize| years(*decimals).windows(2).all(|pair| pair[0] != pair[1]);
    let years = years((fewest..fewest + 3).find(tells).unwrap_or(fewest + 3));
    let mut rows = Vec::new();
    for (support, name) in found.supports.iter().enumerate() {
        for (point, year) in found.points.iter().zip(&years) {
            let mut row = vec![name.clone(), year.clone()];
            row.extend(shown().map(|quantity| {
                let (mean, half) = mean(point, support, quantity.value);
                let of = |x: f64| x / quantity.unit;
                if mean.is_finite() { with_interval(of(mean), half.map(of)) } else { "through".to_owned() }
            }));
            rows.push(row);
        }
    }
    Table::new(&header, rows)
}

/// The pictures: gap and depth over the years, a curve with its interval for each support.
#[must_use]
pub fn figure(case: &Case, found: &WearHistories) -> String {
    let colours = Places::of(&case.scene);
    let panel = |words: &str, value: WearQuantity| {
        let mut panel = Panel::new(words);
        for (support, name) in found.supports.iter().enumerate() {
            let means: Vec<_> = found.points.iter().map(|point| (point.time_s, mean(point, support, value))).collect();
            let points = means.iter().map(|(time, (mean, _))| (time / YEAR, 1e3 * mean));
            let halves = means.iter().map(|(_, (_, half))| 1e3 * half.unwrap_or(f64::NAN));
            panel = panel.curve(Curve::new(name.clone(), points).marked().banded(halves).colour(colours.colour(name)));
        }
        panel
    };
    let mut depth = panel("deepest wear of the tube (mm)", WearQuantity::DepthDeepest);
    let deepest = found.points.last().map_or(0.0, |point| {
        (0..found.supports.len()).map(|support| mean(point, support, WearQuantity::DepthDeepest).0).fold(0.0, f64::max)
    });
    if let Some(limit) = case.wear.limit.filter(|limit| *limit < NEAR * deepest) {
        depth = depth.mark(Mark::wall(1e3 * limit, "limit"));
    }
    let title = case.heading();
    let figure = Figure::new(title, "time in service (years)");
    figure.panel(panel("gap (mm)", WearQuantity::Gap)).panel(depth).to_svg()
}

/// A limit further away than this multiple of the depth is not drawn.
const NEAR: f64 = 3.0;

/// The histories as JSON.
#[must_use]
pub fn document(case: &Case, found: &WearHistories) -> Value {
    json!({
        "command": "wear",
        "case": case.name,
        "histories": found,
        "years": years_document(found),
        "limits": limits(case, found),
        "fluid_elastic": case.fluid_elastic,
        "remarks": wear_remarks::remarks(case, found),
    })
}

/// When the depth of each support reaches the limit of the case, as JSON, by its mean and in each
/// history; null where it does not. Where it does so after the end of the histories only, the time
/// at their last rates, null else.
#[must_use]
pub fn limits(case: &Case, found: &WearHistories) -> Vec<Value> {
    let limit = case.wear.limit;
    let limits = found.supports.iter().enumerate().map(|(support, name)| {
        let mut own = Map::from_iter([("place".to_owned(), json!(name)), ("limit_m".to_owned(), json!(limit))]);
        let mut add = |depth: &str, value: WearQuantity| {
            let in_years = |time: Option<f64>| time.map(|time| time / YEAR);
            let reached = limit.map(|limit| found.limit_reached(support, limit, value));
            let mean = reached.as_ref().and_then(|one| one.mean);
            let later = reached.as_ref().and_then(|one| one.at_last_rate);
            let each = reached.as_ref().map_or(&[][..], |one| &one.histories);
            let each: Vec<Option<f64>> = each.iter().copied().map(in_years).collect();
            own.insert(format!("limit_{depth}_years"), json!(in_years(mean.map(|found| found.time_s))));
            own.insert(
                format!("limit_{depth}_half_width_95_years"),
                json!(in_years(mean.and_then(|found| found.half_width_95_s))),
            );
            own.insert(format!("limit_{depth}_years_of_histories"), json!(each));
            own.insert(format!("limit_{depth}_years_at_last_rate"), json!(in_years(later.map(|found| found.time_s))));
            let half_width = in_years(later.and_then(|found| found.half_width_95_s));
            own.insert(format!("limit_{depth}_half_width_95_years_at_last_rate"), json!(half_width));
        };
        add("deepest", WearQuantity::DepthDeepest);
        add("all_round", WearQuantity::DepthAllRound);
        add("one_scar", WearQuantity::DepthOneScar);
        Value::Object(own)
    });
    limits.collect()
}
