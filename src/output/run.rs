//! Files of one run, and the table of its walls; shared by `run`, `compare` and any other caller.

use super::detail::Detail;
use super::pictures::{FigureSet, Labelled};
use super::places::Chosen;
use super::realisations::{in_column, with_decimals};
use super::record::TABLES;
use super::results::Results;
use super::summary::{self, Checks, Reasons};
use super::table::Table;
use super::{Span, csv, json, realisations, supports, turbulence};
use crate::case::Case;
use crate::error::{Result, counted};
use crate::qp::Backend;
use crate::run::Run;
use crate::scheme::{Method, Scheme};
use crate::statistics::{ForceStatistics, LargestForce, Statistics, WallStatistics};
use serde_json::Value;

/// Most rows of the table in the terminal.
const MOST_ROWS: usize = 24;

/// Energy at walls is rounding below this share of the energy exchanged over the run, as in the
/// notes of a run.
const ROUNDING: f64 = 1e-9;

/// What the pictures of one run show, and the index of its look among the runs of the command.
#[derive(Debug, Clone, Copy)]
pub struct Picture {
    /// The stretch of time that is drawn.
    pub span: Span,
    /// Index of its colour and dash pattern.
    pub look: usize,
}

/// Writes the files of one run: `trajectory.csv`, `contacts.csv`, for output times `output.csv`, of
/// supports also `supports.csv` and `sectors.csv`, of turbulence `turbulence.csv` and
/// `turbulence-pairs.csv`, the figures, what `[statistics]` asks for, and
/// `summary.json`, into the folder of `results` or, where `prefix` is not empty, into a folder of
/// that name in it. Returns the summary, which records all tables written there so far.
pub fn write(
    results: &mut Results,
    prefix: &str,
    case: &Case,
    run: &Run,
    method: &Method,
    (reasons, checks): (&Reasons, Checks<'_>),
    picture: Picture,
) -> Result<Value> {
    let named = |name: &str| named(prefix, name);
    csv::trajectory(&results.place(&named("trajectory.csv"))?, &run.trajectory)?;
    csv::contacts(&results.place(&named("contacts.csv"))?, &run.trajectory)?;
    if !run.trajectory.output().time.is_empty() {
        csv::output(&results.place(&named("output.csv"))?, &run.trajectory)?;
    }
    supports::write(|name| results.place(&named(name)), case, run)?;
    // All runs of a comparison have the same forces.
    if prefix.is_empty() {
        turbulence::write(|name| results.place(name), case)?;
    }
    let label = method.to_string();
    let runs = [Labelled { label: &label, run, reference: false, look: picture.look }];
    let draws = checks.realisations.map_or(1, |study| study.count as u64);
    let title = &realisations::titled(case.heading(), draws);
    let sheet = FigureSet { title, scene: &case.scene, runs: &runs, span: picture.span };
    for (name, svg) in sheet.figures() {
        results.draw(&named(name), &svg)?;
    }
    let detail = Detail::of(case, run)?;
    if let Some(detail) = &detail {
        detail.write(results, title, named)?;
    }
    let checks = Checks { detail: detail.as_ref(), ..checks };
    let mut document = summary::document(case, run, reasons, checks)?;
    document[TABLES] = results.tables(prefix)?;
    results.write(&named("summary.json"), json::text(&document))?;
    Ok(document)
}

/// The file `name` in the folder `prefix` of results, their own where it is empty.
pub(super) fn named(prefix: &str, name: &str) -> String {
    if prefix.is_empty() { name.to_owned() } else { format!("{prefix}/{name}") }
}

/// The table of walls for the terminal; where there are many, the walls of the largest impulses.
/// `None` without walls.
#[must_use]
pub fn table(run: &Run) -> Option<Table> {
    let headers = [
        "wall",
        "contacts",
        "impulse (N s)",
        "mean force (N)",
        "RMS force (N)",
        "largest force (N)",
        "at (s)",
        "contact time (%)",
        "impact power (W)",
        "arrived - left (W)",
    ];
    let mut rows = Vec::new();
    for wall in busiest(run) {
        let force = |part: fn(&ForceStatistics) -> f64, digits| {
            wall.force.as_ref().map_or_else(|| "-".to_owned(), |force| in_column(part(force), digits))
        };
        let largest = |part: fn(&LargestForce) -> f64| {
            wall.force_largest.as_ref().map_or_else(|| "-".to_owned(), |largest| in_column(part(largest), 4))
        };
        rows.push(vec![
            wall.wall.clone(),
            wall.contacts.to_string(),
            force(|f| f.impulse_n_s, 6),
            force(|f| f.mean_n, 4),
            force(|f| f.rms_n, 4),
            largest(|f| f.mean_n),
            largest(|f| f.at_s),
            with_decimals(100.0 * wall.contact_time_ratio, 3),
            in_column(wall.impact_power_w, 6),
            with_decimals(wall.arrived_less_departed_power_w, 6),
        ]);
    }
    (!rows.is_empty()).then(|| Table::new(&headers, rows))
}

/// The remarks below the table of walls, a sentence each.
#[must_use]
pub fn remarks(run: &Run) -> Vec<String> {
    let all = flats(run).count();
    if all == 0 {
        return Vec::new();
    }
    let mut remarks = Vec::new();
    if all > MOST_ROWS {
        remarks.push(format!("{MOST_ROWS} of {all} walls, those of the largest impulses; the summary has them all"));
    }
    if run.statistics.from_s > 0.0 {
        remarks.push(format!(
            "all columns refer to t >= {} s: a contact counts if it begins there, a force as far as it acts there",
            run.statistics.from_s
        ));
    }
    if let Some(stretch) = flats(run).find_map(|wall| wall.force?.rms_averaged_over_s) {
        remarks.push(format!(
            "mean of |force| over time; RMS and largest force at rigid walls of the mean over stretches of \
             {stretch:.3e} s, since those of impulse/h have no limit as h → 0 (--force-averaging); {}",
            intervals(&run.statistics)
        ));
    }
    let window = run.statistics.to_s - run.statistics.from_s;
    let rounding = ROUNDING * run.residuals.energy.exchanged_j / window;
    if flats(run).any(|wall| wall.arrived_less_departed_power_w < -rounding) {
        remarks.push(
            "arrived - left is negative: load and structure did work on the body during contact, so that it \
             left with more energy than it arrived with"
                .to_owned(),
        );
    }
    let sliding = if run.statistics.wear.is_empty() {
        "frictionless contact has no sliding wear in it"
    } else {
        "the table of supports has the work of sliding"
    };
    remarks.push(format!("impact power is normal impact only: {sliding}"));
    remarks
}

/// Where the intervals of means are, and from what.
fn intervals(statistics: &Statistics) -> String {
    let force = |wall: &WallStatistics| wall.force.as_ref().and_then(|force| force.mean_half_width_95_n);
    if !statistics.walls.iter().any(|wall| force(wall).is_some()) && statistics.batches != 2 {
        return "no mean force has an interval: the contacts are too few to tell how it scatters".to_owned();
    }
    match (statistics.batches, statistics.periods_per_batch) {
        (2, None) => "the window has fewer than three periods of the loads, so that no mean has an interval".to_owned(),
        (batches, Some(periods)) => format!(
            "95 % intervals of mean and RMS, from {batches} stretches of {}, are in the summary",
            counted(periods as usize, "period")
        ),
        _ => "95 % intervals of mean and RMS are in the summary".to_owned(),
    }
}

/// One line: what a run cost and how well it kept its scheme's contract.
#[must_use]
pub fn line(case: &Case, run: &Run, method: &Method) -> String {
    let r = &run.residuals;
    format!(
        "{method} on {}: {} steps, {}, complementarity {:.1e}, penetration {:.1e} m, energy balance {:.1e}, {:.3} s",
        case.name,
        run.counters.steps,
        solved(run),
        r.complementarity,
        r.penetration_m,
        r.energy.residual,
        run.seconds
    )
}

/// The flat walls: a round one is in the table of its support.
fn flats(run: &Run) -> impl Iterator<Item = &WallStatistics> {
    run.statistics.walls.iter().filter(|wall| !wall.round)
}

/// The flat walls of the largest impulses, in the scene's order.
fn busiest(run: &Run) -> Vec<&WallStatistics> {
    let impulse = |wall: &&WallStatistics| wall.force.map_or(0.0, |force| force.impulse_n_s.abs());
    Chosen::heaviest(flats(run), MOST_ROWS, impulse).shown
}

/// How the steps that met a wall were solved, and how many there were.
fn solved(run: &Run) -> String {
    let counters = &run.counters;
    match run.scheme {
        Scheme::Event => format!("{} contact events", counters.events),
        Scheme::Penalty { .. } => format!("{} Newton iterations", counters.newton_iterations),
        // Round supports and friction have no quadratic programme, hence no solver of one.
        Scheme::ImplicitEuler | Scheme::GeneralizedAlpha { .. } if run.backend == Backend::Auto => {
            format!("{} programmes with disks", counters.qp_solves)
        }
        _ if run.backend == Backend::Auto && counters.parts > 0 => {
            format!("{} contact problems in parts of steps, solved in sweeps", counters.qp_solves)
        }
        _ if run.backend == Backend::Auto => format!("{} contact problems, solved in sweeps", counters.qp_solves),
        _ if counters.qp_fallbacks > 0 => {
            let (all, left) = (counters.qp_solves, counters.qp_fallbacks);
            format!("{all} QPs by {}, {left} of them solved by Clarabel as fallback", run.backend)
        }
        _ => format!("{} QPs by {}", counters.qp_solves, run.backend),
    }
}
