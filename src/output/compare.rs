//! Files of a comparison: those of every run, figures of all runs together, `compare.csv`,
//! `compare-walls.csv`, `distance.csv`; also its JSON.

use super::Span;
use super::csv::{self, digits};
use super::pictures::{FigureSet, Labelled};
use super::results::Results;
use super::run::{self, Picture};
use super::summary::{Checks, Reasons};
use crate::case::Case;
use crate::error::Result;
use crate::run::Run;
use crate::scheme::Method;
use crate::statistics::ContactSite;
use crate::study::choice;
use crate::study::compare::{Comparison, Row};
use crate::study::difference::{error_length, largest, rows};
use crate::study::verdict::Verdict;
use serde_json::{Value, json};

/// A method's name as a folder: `penalty-epsilon-1e-9-integrator-trapezoidal`.
#[must_use]
pub fn folder_name(method: &Method) -> String {
    folder_of(&method.to_string())
}

/// The folder of the method of that name.
pub(crate) fn folder_of(method: &str) -> String {
    method.replace([':', ',', '='], "-")
}

/// The distance of every method from the reference over time.
pub(crate) const DISTANCE: &str = "distance.csv";

/// Writes all files of a comparison. Pictures of a single run show the first of the two stretches,
/// pictures of all runs together the second. Returns the comparison's rows as JSON: for each run
/// its summary (without the scene, which all share) and what the comparison found; for a method
/// that failed, the reason.
pub fn write(
    results: &mut Results,
    case: &Case,
    comparison: &Comparison,
    verdicts: &[Option<Verdict>],
    [span, common]: [Span; 2],
) -> Result<Vec<Value>> {
    let mut documents = Vec::new();
    for (look, (row, verdict)) in comparison.rows.iter().zip(verdicts).enumerate() {
        let mut document = json!({});
        if let Ok(done) = &row.outcome {
            let reasons =
                Reasons { scheme: "part of a comparison".into(), qp: choice::qp_reason(&row.method, &case.scene) };
            let checks = Checks { refinement: verdict.as_ref(), ..Checks::default() };
            let picture = Picture { span, look };
            let folder = folder_name(&row.method);
            document = run::write(results, &folder, case, done, &row.method, (&reasons, checks), picture)?;
        }
        documents.push(with_findings(document, case, comparison, row));
    }
    figures(results, case, comparison, common)?;
    distance(results, case, comparison)?;
    methods(results, case, comparison)?;
    walls(results, case, comparison)?;
    Ok(documents)
}

fn with_findings(mut document: Value, case: &Case, comparison: &Comparison, row: &Row) -> Value {
    let run = row.outcome.as_ref().ok();
    let found = json!({
        "method": row.method.to_string(),
        "restitution": row.restitution.map(|e| json!({ "median": e.median, "least": e.least, "largest": e.largest })),
        "error_over_gap": row.error,
        "horizon_s": row.error.map(|_| comparison.horizon),
        "agrees_until_s": row.agrees_until,
        "largest_displacement_m": run.map(|run| largest(run.trajectory.displacements())),
        "penetration_m": run.map(|run| run.residuals.penetration_m),
        "force_largest_n": run.and_then(largest_force),
        "peak_force_n": run.and_then(|run| peak(case, run)),
        "seconds_per_step": row.step_ns.map(|ns| 1e-9 * ns),
        "failure": row.outcome.as_ref().err().map(ToString::to_string),
    });
    if let (Some(document), Value::Object(found)) = (document.as_object_mut(), found) {
        for shared in ["program", "case", "title", "source", "case_file", "files", "scene"] {
            document.remove(shared);
        }
        document.extend(found);
    }
    document
}

fn figures(results: &mut Results, case: &Case, comparison: &Comparison, span: Span) -> Result<()> {
    let labels: Vec<String> = comparison.rows.iter().map(|row| row.method.to_string()).collect();
    let runs: Vec<Labelled<'_>> = comparison
        .rows
        .iter()
        .zip(&labels)
        .enumerate()
        .filter_map(|(look, (row, label))| {
            let run = row.outcome.as_ref().ok()?;
            Some(Labelled { label, run, reference: row.method.scheme.is_exact(), look })
        })
        .collect();
    let refined =
        comparison.refined.as_ref().map(|(method, run)| (format!("{method}, h = {:.1e} s", run.grid.step), run));
    let runs: Vec<Labelled<'_>> = match &refined {
        Some((label, run)) => runs.into_iter().chain([Labelled { label, run, reference: true, look: 0 }]).collect(),
        None => runs,
    };
    let title = case.heading();
    let sheet = FigureSet { title, scene: &case.scene, runs: &runs, span };
    for (name, svg) in sheet.figures() {
        results.draw(name, &svg)?;
    }
    Ok(())
}

/// `distance.csv`: the largest |Δu| of any probe against the reference, over the gap or
/// without one over the largest displacement, at each row, one column per method. Not written
/// without a reference or a probe.
fn distance(results: &mut Results, case: &Case, comparison: &Comparison) -> Result<()> {
    let Some(reference) = comparison.reference_run() else { return Ok(()) };
    let length = error_length(&case.scene, &reference.trajectory);
    let mut names = Vec::new();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for row in comparison.rows.iter().filter(|row| !row.method.scheme.is_exact()) {
        let Ok(run) = &row.outcome else { continue };
        names.push(row.method.to_string());
        columns.push(rows(&run.trajectory, &reference.trajectory).map(|(_, distance)| distance / length).collect());
    }
    if columns.iter().all(Vec::is_empty) {
        return Ok(());
    }
    let header: Vec<String> = std::iter::once("time_s".to_owned()).chain(names).collect();
    let time = reference.trajectory.time();
    let columns: Vec<&[f64]> = std::iter::once(time).chain(columns.iter().map(Vec::as_slice)).collect();
    csv::numbers(&results.place(DISTANCE)?, &header, &columns)
}

/// `compare.csv`: one row per method.
fn methods(results: &mut Results, case: &Case, comparison: &Comparison) -> Result<()> {
    let columns: [csv::Column<'_, &Row>; 18] = [
        ("method", &|row| row.method.to_string()),
        ("step_s", &|row| digits(ran(row).filter(|_| !row.method.scheme.is_exact()).map(|run| run.grid.step))),
        ("restitution", &|row| digits(row.restitution.map(|e| e.median))),
        ("restitution_least", &|row| digits(row.restitution.map(|e| e.least))),
        ("restitution_largest", &|row| digits(row.restitution.map(|e| e.largest))),
        ("error_over_gap", &|row| digits(row.error)),
        ("horizon_s", &|row| digits(row.error.map(|_| comparison.horizon))),
        ("agrees_until_s", &|row| digits(row.agrees_until)),
        ("largest_displacement_m", &|row| digits(ran(row).map(|run| largest(run.trajectory.displacements())))),
        ("penetration_m", &|row| digits(ran(row).map(|run| run.residuals.penetration_m))),
        ("force_largest_N", &|row| digits(ran(row).and_then(largest_force))),
        ("peak_force_N", &|row| digits(ran(row).and_then(|run| peak(case, run)))),
        ("work_rate_W", &|row| digits(ran(row).and_then(work_rate))),
        ("energy_residual", &|row| digits(ran(row).map(|run| run.residuals.energy.residual))),
        ("complementarity_residual", &|row| digits(ran(row).map(|run| run.residuals.complementarity))),
        ("step_ns", &|row| digits(row.step_ns)),
        ("refuted", &|row| {
            let findings = ran(row).map_or(&[][..], |run| &run.findings);
            findings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
        }),
        ("failure", &|row| row.outcome.as_ref().err().map_or_else(String::new, ToString::to_string)),
    ];
    csv::records(&results.place("compare.csv")?, &columns, &comparison.rows)
}

/// The run of a method, where it has one.
fn ran(row: &Row) -> Option<&Run> {
    row.outcome.as_ref().ok()
}

/// `compare-walls.csv`: one row per method and wall or round support, for any number of them; the
/// impulse of a round support is Σ|p|.
fn walls(results: &mut Results, case: &Case, comparison: &Comparison) -> Result<()> {
    let columns: [csv::Column<'_, (String, &Run, ContactSite<'_>)>; 5] = [
        ("method", &|(method, ..)| method.clone()),
        ("wall", &|(_, _, site)| site.name.to_owned()),
        ("impulse_N_s", &|(_, run, site)| digits(Some(run.statistics.impulse(site.wall)))),
        ("contacts", &|(_, run, site)| run.statistics.contacts(site.wall).to_string()),
        ("peak_force_N", &|(_, run, site)| digits(run.statistics.peak_force(run.trajectory.contacts(), site.wall))),
    ];
    let runs = comparison.rows.iter().filter_map(|row| Some((row.method.to_string(), ran(row)?)));
    let rows =
        runs.flat_map(|(method, run)| ContactSite::all(&case.scene).map(move |site| (method.clone(), run, site)));
    csv::records(&results.place("compare-walls.csv")?, &columns, rows)
}
/// Largest force of all walls and supports in the window, N: of elastic ones at an instant, of
/// rigid ones the largest mean over a stretch, as in the tables of a run.
pub(super) fn largest_force(run: &Run) -> Option<f64> {
    let walls = run.statistics.walls.iter().filter_map(|wall| wall.force_largest);
    let supports = run.statistics.supports.iter().filter_map(|support| support.force_largest);
    walls.chain(supports).map(|largest| largest.mean_n).reduce(f64::max)
}

/// Work rate of all supports over the window, W; `None` without a support.
fn work_rate(run: &Run) -> Option<f64> {
    run.statistics.wear.iter().map(|wear| wear.work_rate_w).reduce(|sum, rate| sum + rate)
}

/// Largest force of the contacts in the window at places without an impact, N.
pub(super) fn peak(case: &Case, run: &Run) -> Option<f64> {
    let contacts = run.trajectory.contacts();
    ContactSite::all(&case.scene).filter_map(|site| run.statistics.peak_force(contacts, site.wall)).reduce(f64::max)
}
