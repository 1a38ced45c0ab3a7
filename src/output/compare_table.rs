//! A comparison for the terminal: a short table, and the table of all quantities.

use super::cheapest::time;
use super::compare::{largest_force, peak};
use super::realisations::in_column;
use super::table::Table;
use crate::case::Case;
use crate::run::Run;
use crate::scheme::Scheme;
use crate::statistics::{ContactSite, PlaceKind};
use crate::study::compare::{Comparison, Row};
use crate::study::difference::largest;

/// Most walls that get rows of their own in the table of all quantities; above that it shows sums
/// over all walls.
const MOST_WALLS: usize = 4;

/// Widest short table, in characters.
const WIDEST: usize = 60;

/// The short table: one row per method.
#[must_use]
pub fn overview(case: &Case, comparison: &Comparison) -> Table {
    let refuted = comparison.rows.iter().any(is_refuted);
    let error_heading = format!("error / {}", length_word(case));
    let mut header = vec!["method", &error_heading, "contacts", "largest force (N)", "time"];
    if refuted {
        header.push("judge");
    }
    let line = |row: &Row| {
        let Ok(run) = &row.outcome else {
            return vec![row.method.to_string(), "failed".into()];
        };
        let taken = row.step_ns.map(|ns| time(1e-9 * ns * run.counters.steps as f64));
        let error = if row.method.scheme.is_exact() { "exact".into() } else { error(row) };
        let mut line = vec![row.method.to_string(), error, contacts(run).to_string()];
        line.extend([force(largest_force(run)), taken.unwrap_or_else(|| "-".into())]);
        if refuted {
            line.push(if is_refuted(row) { "REFUTED" } else { "kept" }.into());
        }
        line
    };
    Table::new(&header, comparison.rows.iter().map(line).collect()).within(WIDEST)
}

fn is_refuted(row: &Row) -> bool {
    row.outcome.as_ref().is_ok_and(|run| !run.findings.is_empty())
}

fn short(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") }
}

/// The length of which errors of the displacement are shares.
#[must_use]
pub fn length_word(case: &Case) -> &'static str {
    if case.scene.gap().is_some() { "gap" } else { "max |u|" }
}

/// The error of the displacement over its length.
fn error(row: &Row) -> String {
    let none = || if row.method.scheme.is_exact() { "reference" } else { "-" };
    row.error.map_or_else(|| none().to_owned(), short)
}

/// The contacts of a run at all walls and supports.
pub(super) fn contacts(run: &Run) -> usize {
    run.statistics.walls.iter().map(|wall| wall.contacts).sum()
}

/// A force in words, N.
pub(super) fn force(newtons: Option<f64>) -> String {
    newtons.map_or_else(|| "-".to_owned(), |newtons| in_column(newtons, 2))
}

/// The impulse of a wall, signed, or Σ|p| of a round support, in words, N s.
fn impulse(site: &ContactSite<'_>, run: &Run) -> String {
    let impulse = run.statistics.impulse(site.wall);
    let sign = if site.kind == PlaceKind::Wall && impulse > 0.0 { "+" } else { "" };
    format!("{sign}{}", in_column(impulse, 3))
}

/// The work rate of a support in words, mW.
fn work_rate(run: &Run, support: &str) -> String {
    let own = run.statistics.wear.iter().find(|wear| wear.support == support);
    own.map_or_else(|| "-".to_owned(), |wear| in_column(1e3 * wear.work_rate_w, 4))
}

/// All quantities, one column per method, since there are more quantities than methods.
#[must_use]
pub fn all_quantities(case: &Case, comparison: &Comparison) -> Table {
    let methods: Vec<String> = comparison.rows.iter().map(|row| row.method.to_string()).collect();
    let header: Vec<&str> = std::iter::once("").chain(methods.iter().map(String::as_str)).collect();
    let mut rows = Vec::new();
    let mut quantity = |name: &str, of: &dyn Fn(&Row, &Run) -> String| {
        let cell = |row: &Row| row.outcome.as_ref().map_or_else(|_| "failed".to_owned(), |run| of(row, run));
        rows.push(std::iter::once(name.to_owned()).chain(comparison.rows.iter().map(cell)).collect());
    };
    let dash = || "-".to_owned();
    let exact = |row: &Row| row.method.scheme.is_exact();
    if comparison.rows.iter().any(is_refuted) {
        quantity("judge", &|_, run| if run.findings.is_empty() { "kept".into() } else { "REFUTED".to_owned() });
    }
    quantity("step (s)", &|row, run| if exact(row) { "exact".into() } else { format!("{:.3e}", run.grid.step) });
    quantity("restitution", &|row, _| row.restitution.map_or_else(dash, |e| format!("{:.3}", e.median)));
    let spread = |row: &Row| row.restitution.filter(|e| e.largest - e.least >= 5e-4);
    if comparison.rows.iter().any(|row| spread(row).is_some()) {
        quantity("  from", &|row, _| spread(row).map_or_else(dash, |e| format!("{:.2}", e.least)));
        quantity("  to", &|row, _| spread(row).map_or_else(dash, |e| format!("{:.2}", e.largest)));
    }
    quantity(&format!("error / {}", length_word(case)), &|row, _| error(row));
    quantity("agrees until (s)", &|row, _| {
        row.agrees_until.map_or_else(dash, |t| {
            if t >= comparison.horizon.max(case.scene.duration) { "end".into() } else { format!("{t:.3}") }
        })
    });
    quantity("max |u| (mm)", &|_, run| in_column(1e3 * largest(run.trajectory.displacements()), 4));
    quantity("penetration (mm)", &|_, run| short(1e3 * run.residuals.penetration_m));
    quantity("largest force (N)", &|_, run| force(largest_force(run)));
    // Of rigid impacts, which have an impulse and no finite force, there is none.
    quantity("peak force (N)", &|_, run| force(peak(case, run)));
    let all: Vec<ContactSite<'_>> = ContactSite::all(&case.scene).collect();
    if all.len() > MOST_WALLS {
        quantity("Σ|impulse| (N s)", &|_, run| {
            in_column(all.iter().map(|site| run.statistics.impulse(site.wall).abs()).sum(), 3)
        });
        quantity("contacts", &|_, run| contacts(run).to_string());
    } else {
        for site in &all {
            let name = if site.kind == PlaceKind::Wall { "impulse" } else { "Σ|impulse|" };
            quantity(&format!("{name} {} (N s)", site.name), &|_, run| impulse(site, run));
        }
        for site in &all {
            quantity(&format!("contacts {}", site.name), &|_, run| run.statistics.contacts(site.wall).to_string());
        }
    }
    for support in &case.scene.supports {
        quantity(&format!("work rate {} (mW)", support.name), &|_, run| work_rate(run, &support.name));
    }
    quantity("energy residual", &|_, run| short(run.residuals.energy.residual));
    quantity("compl. residual", &|_, run| short(run.residuals.complementarity));
    quantity("ns / step", &|row, _| row.step_ns.map_or_else(dash, |ns| format!("{ns:.0}")));
    Table::new(&header, rows)
}

/// What the largest force is, where walls of one kind stand beside springs in their place.
#[must_use]
pub fn force_remark(case: &Case, comparison: &Comparison) -> Option<String> {
    let rigid = case.scene.walls.iter().any(|wall| wall.law.is_rigid());
    let springs = comparison.rows.iter().any(|row| matches!(row.method.scheme, Scheme::Penalty { .. }));
    (rigid && springs).then(|| {
        format!(
            "largest force: at rigid walls the largest mean over {:e} s, or over a step that is longer, of a penalty's \
             springs that at an instant",
            case.time.force_averaging
        )
    })
}

/// The remark below the table, if one is needed.
#[must_use]
pub fn remark(case: &Case) -> Option<String> {
    let count = case.scene.walls.len();
    (count > MOST_WALLS).then(|| format!("impulses and contacts of all {count} walls; compare-walls.csv has each"))
}
