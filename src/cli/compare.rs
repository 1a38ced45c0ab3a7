//! `signorini compare`: methods side by side, the main command.

use super::drawing::Stretch;
use super::noted;
use super::pace::Pace;
use super::refuted::Refutations;
use super::request::Request;
use super::ui::Ui;
use super::{values, verdicts};
use crate::case::Case;
use crate::error::Result;
use crate::output::asked::{asked, with};
use crate::output::compare as output;
use crate::output::results::Results;
use crate::output::shape::{self, Shape};
use crate::output::summary;
use crate::run::{Options, run};
use crate::scheme::{Method, Scheme};
use crate::study::choice;
use crate::study::compare::{Comparison, any_succeeded, compare, default_methods};
use crate::study::verdict::{self, Verdict};
use serde_json::{Value, json};

const EXAMPLES: &str = "\
Examples:
  signorini compare cases/rigid-walls-sine.toml
  signorini compare rigid-walls-sine --restitution 0.8
  signorini compare rigid-walls-sine --schemes moreau-jean,paoli-schatzman,implicit-euler,newmark
  signorini compare rigid-walls-sine --schemes 'moreau-jean:theta=0.75;penalty:epsilon=1e-9,integrator=trapezoidal'

Methods are written as in the table. Separate them by commas; where a method's own settings need
commas, by semicolons.";

/// Compare methods on one case: constrained QP, penalty and the exact motion, side by side
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    request: Request,
    /// Methods to compare [default: the constrained QP, the same through Clarabel, every penalty of
    /// the case]; the exact one is always included
    #[arg(long, value_name = "A,B,…", alias = "scheme", value_parser = values::schemes(), hide_possible_values = true)]
    schemes: Option<String>,
    /// Do not repeat the methods with half the step
    #[arg(long)]
    no_verdict: bool,
    #[command(flatten)]
    stretch: Stretch,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let case = args.request.case(ui)?;
    let methods = match &args.schemes {
        Some(list) => split(list).map(|name| args.request.method(name, &case)).collect::<Result<Vec<_>>>()?,
        None => {
            let chosen = args.request.method(&choice::choose(&case.scene).method.to_string(), &case)?;
            let integrator = case.penalty.integrator.unwrap_or_default();
            let penalty = |&law| Method::new(Scheme::Penalty { law, integrator });
            let penalties = case.penalty.laws.iter().map(penalty);
            if case.scene.turns_or_rubs() {
                // No quadratic programme, which Clarabel could solve too.
                std::iter::once(chosen).chain(penalties).collect()
            } else if case.scene.walls.is_empty() {
                vec![chosen]
            } else {
                default_methods(chosen, penalties)
            }
        }
    };
    args.request.check_use(&methods)?;
    // A stretch outside the run is refused before anything runs.
    let span = args.stretch.span(&case, case.scene.duration)?;
    let request = with(asked("compare", &case, &methods), json!({ "verdict": !args.no_verdict }));
    let mut results = args.request.results(&case, "compare", request)?;
    // The exact run is among the methods asked for, or is added to them.
    let count = methods.iter().filter(|method| method.scheme != Scheme::Event).count() as f64 + 2.0;
    let checks = if args.no_verdict { 0.0 } else { (count - 1.0) * verdict::COST };
    let pace = Pace::of_all(&case.scene, &methods, case.time.step);
    let progress = ui.paced("comparing", UNITS as u64, pace);
    let done = |runs: f64| progress.share(runs / (count + checks));
    let comparison = compare(&case.scene, &methods, &case.time, &done)?;
    let mut verdicts = vec![None; comparison.rows.len()];
    if !args.no_verdict {
        verdicts = verdicts::check(&case, &comparison, &|rows| done(count + rows as f64 * verdict::COST));
    }
    progress.finish();
    let refuted = refutations(&comparison, &verdicts);
    refuted.announce(ui);
    any_succeeded(&comparison)?;
    let common = args.stretch.span(&case, comparison.horizon)?;
    let report = !args.request.place.no_report;
    if report {
        draw(&case, &comparison, &mut results)?;
    }
    let rows = output::write(&mut results, &case, &comparison, &verdicts, [span, common])?;
    let notes = noted::of_rows(&comparison).into_iter().chain(case.notes());
    results.tell("remarks", json!(comparison.findings.iter().cloned().chain(notes).collect::<Vec<_>>()));
    super::run::finish(&mut results, "", report, ui)?;
    if ui.json() {
        ui.document(&document(&case, &comparison, rows, &results))?;
    } else {
        ui.table(&output::table(&case, &comparison), "compare.csv")?;
        output::remark(&case).iter().for_each(|remark| ui.message(remark));
    }
    for row in &comparison.rows {
        if let Err(error) = &row.outcome {
            ui.message(&format!("- {} failed: {error}", row.method));
        }
    }
    for finding in &comparison.findings {
        ui.message(&format!("- {finding}"));
    }
    if case.penalty.laws.is_empty() && args.schemes.is_none() && case.scene.walls.iter().any(|w| w.law.is_rigid()) {
        ui.message("- the case has no [penalty] table: no penalty was compared");
    }
    for note in noted::of_rows(&comparison).iter().chain(&case.notes()) {
        ui.message(&format!("- {note}"));
    }
    if !args.no_verdict {
        ui.message(&format!("refinement: {}", verdicts::line(&comparison, &verdicts)));
    }
    refuted.verdict()
}

/// Runs the first method that succeeded once more, with the places from which the report draws a
/// structure; the comparison itself uses only the probes of the case.
fn draw(case: &Case, comparison: &Comparison, results: &mut Results) -> Result<()> {
    let shape = Shape::of(case);
    let first = comparison.rows.iter().find(|row| row.outcome.is_ok());
    if let Some(row) = first.filter(|_| !shape.is_empty()) {
        let mut run = run(&shape.watched(case), &row.method, &Options::new(case.time))?;
        let moved = shape.take(&mut run);
        let file = format!("{}/{}", output::folder_of(&row.method.to_string()), shape::FILE);
        shape.write(&results.place(&file)?, run.trajectory.time(), &moved)?;
    }
    Ok(())
}

/// The rows that the judge has refuted, and the refuted checks of these rows.
fn refutations(comparison: &Comparison, verdicts: &[Option<Verdict>]) -> Refutations {
    let mut refuted = Refutations::default();
    for (row, verdict) in comparison.rows.iter().zip(verdicts) {
        match &row.outcome {
            Ok(run) => refuted.see(&row.method.to_string(), &run.findings),
            Err(error) => refuted.see_error(&row.method.to_string(), error),
        }
        if let Some(verdict) = verdict {
            refuted.see(&format!("the check of {}", row.method), &verdict.findings);
        }
    }
    if let Some((method, run)) = &comparison.refined {
        refuted.see(&format!("{method} as reference"), &run.findings);
    }
    refuted
}

/// The comparison as one JSON document: what all methods share, then one row per method.
fn document(case: &Case, comparison: &Comparison, rows: Vec<Value>, results: &Results) -> Value {
    let document = json!({
        "program": format!("signorini {}", env!("CARGO_PKG_VERSION")),
        "case": case.name,
        "title": case.title,
        "source": case.source,
        "scene": summary::scene(case),
        "horizon_s": comparison.horizon,
        "growth": comparison.growth,
        "reference_failure": comparison.reference.as_ref().err().map(ToString::to_string),
        "rows": rows,
        "findings": comparison.findings,
        "notes": noted::of_rows(comparison).into_iter().chain(case.notes()).collect::<Vec<_>>(),
    });
    super::run::with_folder(document, results)
}

/// Resolution of the progress bar.
const UNITS: f64 = 1000.0;

/// Methods separated by semicolons or commas; a comma before a setting (`integrator=trapezoidal`)
/// belongs to the method before it.
pub(super) fn split(list: &str) -> impl Iterator<Item = &str> {
    let by_semicolon = list.contains(';');
    let mut parts = Vec::new();
    let mut start = 0;
    for (i, c) in list.char_indices() {
        let next = list[i + c.len_utf8()..].split([',', ';']).next().unwrap_or("");
        // `integrator=trapezoidal` is a setting, `penalty:epsilon=1e-9` and `event` are methods.
        let begins = next.contains(':') || !next.contains('=');
        if c == ';' || (c == ',' && !by_semicolon && begins) {
            parts.push(&list[start..i]);
            start = i + c.len_utf8();
        }
    }
    parts.push(&list[start..]);
    parts.into_iter().map(str::trim).filter(|part| !part.is_empty())
}
