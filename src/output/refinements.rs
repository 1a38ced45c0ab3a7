//! Means that need not converge as steps and modes are refined, beside what refinements make of
//! them: a table for the terminal.

use super::realisations::{MOST_ROWS, WIDTH, find, shown};
use super::table::Table;
use crate::error::amount;
use crate::scene::Scene;
use crate::study::realisations::{Estimate, Measure, Realisations};

/// What the table shows.
pub const REMARK: &str = "impact shares, sliding, contacts and impact power need not converge as steps and modes are \
    refined, and are not judged: the mean of the realisations that were run again, then the same refined";

/// A row for each place and each of its means that need not converge; `None` where no realisation
/// was run again.
#[must_use]
pub fn table(study: &Realisations, scene: &Scene) -> Option<Table> {
    let measures = Measure::ALL.into_iter().filter(|measure| !measure.converges()).collect::<Vec<_>>();
    let own = |place| measures.iter().filter_map(move |measure| find(study, place, *measure));
    let rows: Vec<&Estimate> = shown(study, scene, MOST_ROWS / 4).into_iter().flat_map(own).collect();
    let checks = study.checks.iter().filter(|check| check.refuted.is_empty()).map(|check| check.refined);
    let checks: Vec<_> = checks.collect();
    if rows.is_empty() || checks.is_empty() {
        return None;
    }
    let mut header: Vec<String> = ["place", "mean of"].map(str::to_owned).to_vec();
    header.extend(checks.iter().map(|refined| refined.to_string()));
    let row = |one: &Estimate| {
        let unit = if one.unit.is_empty() { String::new() } else { format!(" ({})", one.unit) };
        let mut row = vec![one.place.name.clone(), format!("{}{unit}", one.measure.words())];
        row.extend(checks.iter().map(|refined| {
            let told = one.refinements.iter().find(|told| told.refined == *refined);
            told.map_or_else(|| "-".to_owned(), |told| format!("{} → {}", amount(told.own, 3), amount(told.then, 3)))
        }));
        row
    };
    Some(Table::new(&header, rows.into_iter().map(row).collect()).within(WIDTH))
}
