//! `supports.csv` and `sectors.csv`, the table of supports, and their part of the summary: force,
//! work of wear, sliding, and the worn volume.

use super::csv::{self, digits};
use super::places::Chosen;
use super::table::Table;
use super::through;
use crate::case::Case;
use crate::error::Result;
use crate::run::Run;
use crate::statistics::{LargestForce, SectorStatistics, SupportForce, SupportStatistics, WearStatistics};
use crate::wear::Worn;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Most rows of the table in the terminal.
const MOST_ROWS: usize = 24;

/// What a work rate without friction is called.
const UPPER: &str = "upper figure";

/// A support of a run.
struct Known<'a> {
    wear: &'a WearStatistics,
    contact: &'a SupportStatistics,
    /// The wear by its work rate, and the depth on the tube where it is deepest, m.
    worn: Option<Worn>,
    deepest: Option<f64>,
}

/// The supports of a run; empty where only the contacts are known.
fn all<'a>(case: &'a Case, run: &'a Run) -> impl Iterator<Item = Known<'a>> {
    let statistics = &run.statistics;
    statistics.wear.iter().zip(&statistics.supports).enumerate().map(|(index, (wear, support))| Known {
        wear,
        contact: support,
        worn: case.archard(index).map(|law| law.worn(wear.work_rate_w)),
        deepest: case.depth_deepest(index, wear),
    })
}

/// Writes `supports.csv` and `sectors.csv` where `place` says, if there are supports.
pub fn write(mut place: impl FnMut(&str) -> Result<PathBuf>, case: &Case, run: &Run) -> Result<()> {
    if run.statistics.wear.is_empty() {
        return Ok(());
    }
    let columns: [csv::Column<'_, Known<'_>>; 24] = [
        ("support", &|one| one.wear.support.clone()),
        ("friction", &|one| digits(Some(one.wear.friction))),
        ("work_rate_is", &|one| kind(one.wear).to_owned()),
        ("contacts", &|one| one.contact.contacts.to_string()),
        ("work_rate_W", &|one| digits(Some(one.wear.work_rate_w))),
        ("work_rate_half_width_95_W", &|one| digits(one.wear.work_rate_half_width_95_w)),
        ("impact_share", &|one| digits(one.wear.impact_share)),
        ("friction_power_W", &|one| digits(Some(one.wear.friction_power_w))),
        ("sliding_m", &|one| digits(Some(one.wear.sliding_m))),
        ("sliding_speed_m_per_s", &|one| digits(one.wear.sliding_speed_m_per_s)),
        ("force_mean_y_N", &|one| digits(one.contact.force.map(|force| force.mean_vector_n[0]))),
        ("force_mean_z_N", &|one| digits(one.contact.force.map(|force| force.mean_vector_n[1]))),
        ("force_mean_N", &|one| digits(one.contact.force.map(|force| force.mean_n))),
        ("force_mean_half_width_95_N", &|one| digits(one.contact.force.and_then(|force| force.mean_half_width_95_n))),
        ("contact_time_ratio", &|one| digits(Some(one.wear.contact_time_ratio))),
        ("peak_force_N", &|one| digits(one.contact.episode_peak_force_n.max)),
        ("force_largest_N", &|one| digits(largest(one).map(|largest| largest.mean_n))),
        ("force_largest_at_s", &|one| digits(largest(one).map(|largest| largest.at_s))),
        ("force_largest_over_s", &|one| digits(largest(one).map(|largest| largest.averaged_over_s))),
        ("worn_volume_m3", &|one| digits(one.worn.and_then(|worn| worn.volume_m3))),
        ("depth_deepest_m", &|one| digits(one.deepest)),
        ("depth_one_scar_m", &|one| digits(one.worn.and_then(|worn| worn.depth_one_scar_m))),
        ("depth_all_round_m", &|one| digits(one.worn.and_then(|worn| worn.depth_all_round_m))),
        ("support_worn_volume_m3", &|one| digits(one.worn.and_then(|worn| worn.support_volume_m3))),
    ];
    csv::records(&place("supports.csv")?, &columns, all(case, run))?;
    let columns: [csv::Column<'_, (&WearStatistics, &SectorStatistics)>; 6] = [
        ("support", &|(support, _)| support.support.clone()),
        ("from_deg", &|(_, sector)| digits(Some(sector.from_deg))),
        ("to_deg", &|(_, sector)| digits(Some(sector.to_deg))),
        ("work_rate_is", &|(support, _)| kind(support).to_owned()),
        ("work_rate_W", &|(_, sector)| digits(Some(sector.work_rate_w))),
        ("impulse_share", &|(_, sector)| digits(Some(sector.impulse_share))),
    ];
    let supports = run.statistics.wear.iter();
    let sectors = supports.flat_map(|support| support.sectors.iter().map(move |sector| (support, sector)));
    csv::records(&place("sectors.csv")?, &columns, sectors)
}

fn largest(support: &Known<'_>) -> Option<LargestForce> {
    support.contact.force_largest
}

/// The kind of work rate of a support.
fn kind(support: &WearStatistics) -> &'static str {
    if support.upper_figure { UPPER } else { "with friction" }
}

/// The table of supports for the terminal; where there are many, those of the largest work rates.
/// `None` without supports.
#[must_use]
pub fn table(case: &Case, run: &Run) -> Option<Table> {
    let supports = Chosen::heaviest(all(case, run), MOST_ROWS, |support| support.wear.work_rate_w).shown;
    supports.first()?;
    let wears = supports.iter().any(|support| support.worn.is_some());
    let mut header = vec![
        "support",
        "work rate (W)",
        "impacts (%)",
        "friction (W)",
        "sliding (m)",
        "mean force (N)",
        "y (N)",
        "z (N)",
    ];
    let of_contact = header.len();
    if wears {
        header.extend(["worn (mm³)", "deepest (mm)", "one scar (mm)", "all round (mm)", "support worn (mm³)"]);
    }
    let row = |Known { wear: support, contact, worn, deepest }: Known<'_>| {
        let mean =
            |of: fn(&SupportForce) -> f64| contact.force.as_ref().map_or_else(|| "-".to_owned(), |f| figures(of(f)));
        let upper = if support.upper_figure { format!(" {UPPER}") } else { String::new() };
        let mut row = vec![
            support.support.clone(),
            format!("{}{upper}", figures(support.work_rate_w)),
            support.impact_share.map_or_else(|| "-".to_owned(), |share| format!("{:.1}", 100.0 * share)),
            figures(support.friction_power_w),
            figures(support.sliding_m),
            mean(|force| force.mean_n),
            mean(|force| force.mean_vector_n[0]),
            mean(|force| force.mean_vector_n[1]),
        ];
        if wears {
            let cell = |x: Option<f64>, unit: f64| x.map_or_else(|| "-".to_owned(), |x| figures(x * unit));
            let part = |of: fn(&Worn) -> Option<f64>, unit: f64| cell(worn.as_ref().and_then(of), unit);
            row.extend([
                part(|worn| worn.volume_m3, 1e9),
                cell(deepest, 1e3),
                part(|worn| worn.depth_one_scar_m, 1e3),
                part(|worn| worn.depth_all_round_m, 1e3),
                part(|worn| worn.support_volume_m3, 1e9),
            ]);
        }
        row
    };
    let rows = supports.into_iter().map(row).collect();
    Some(Table::new(&header, rows).together_from(of_contact))
}

/// Four significant figures.
pub(super) fn figures(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let order = x.abs().log10().floor();
    if (-3.0..6.0).contains(&order) {
        let digits = (3.0 - order).max(0.0) as usize;
        format!("{x:.digits$}")
    } else {
        format!("{x:.3e}")
    }
}

/// Said of a case with a wear coefficient whose time in service is given to studies of wear alone.
pub const NO_SERVICE: &str = "without service in [wear] there are no worn volumes and depths; `signorini wear --years` \
                              follows them over so many years";

/// The remarks below the table of supports, a sentence each.
#[must_use]
pub fn remarks(case: &Case, run: &Run) -> Vec<String> {
    let supports = &run.statistics.wear;
    if supports.is_empty() {
        return Vec::new();
    }
    let mut remarks = vec![
        "work rate: normal force times sliding speed, in the mean over time; impacts: their share of it; friction: \
         the power that it takes out of the motion; mean force: of the normal force, then its vector along y and z"
            .to_owned(),
    ];
    if supports.len() > MOST_ROWS {
        remarks.push(format!(
            "{MOST_ROWS} of {} supports, those of the largest work rates; supports.csv has them all",
            supports.len()
        ));
    }
    if supports.iter().any(|support| support.upper_figure) {
        remarks.push(
            "a work rate without friction is an upper figure: what slides without friction is held back by its own \
             damping alone, and in round supports it may whirl; give `friction` for a figure of wear"
                .to_owned(),
        );
    }
    if let Some(service) = case.wear.service {
        remarks.push(format!(
            "worn in {service:.3e} s of service, by Archard's law; the depth on the tube where it is deepest, in a \
             sector or at a flat, if all of it comes off one scar, and if it comes off evenly all round"
        ));
        if case.is_random() {
            remarks.push(
                "the deepest of one run under random loads is an upper figure: a sector, or flat, counts that is the \
                 deepest by chance; --seeds has the largest of the means of all sectors"
                    .to_owned(),
            );
        }
    }
    remarks.extend(case.lacks_service().then(|| NO_SERVICE.to_owned()));
    remarks
}

/// Warnings of scars deeper than the limit, the wall or the radius of the tube.
#[must_use]
pub fn warnings(case: &Case, run: &Run) -> Vec<String> {
    let one = |(index, Known { worn, .. }): (usize, Known<'_>)| through::warning(case, index, &worn?);
    all(case, run).enumerate().filter_map(one).collect()
}

/// The wear of the supports in the summary; their forces are in its statistics.
#[must_use]
pub fn document(case: &Case, run: &Run) -> Value {
    let support = |Known { wear, worn, deepest, .. }: Known<'_>| {
        // A struct of numbers and texts: this cannot fail.
        let mut value = serde_json::to_value(wear).unwrap_or_default();
        if let (Some(map), Some(worn)) = (value.as_object_mut(), worn) {
            let mut worn = json!(worn);
            worn["depth_deepest_m"] = json!(deepest);
            map.insert("worn".to_owned(), worn);
        }
        value
    };
    all(case, run).map(support).collect()
}
