//! `signorini compare`: methods side by side, the main command.

use super::compare_seeds;
use super::drawing::PlotSpan;
use super::estimate::DurationEstimate;
use super::pipeline::Answer;
use super::realisations::{self, not_checked};
use super::request::Request;
use super::run::checked_seeds;
use super::ui::Ui;
use super::{values, verdicts};
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::agreement::{conclusion, half_the_step};
use crate::output::compare as output;
use crate::output::compare_table::{all_quantities, force_remark, length_word, overview, remark};
use crate::output::document::under_head;
use crate::output::method_realisations;
use crate::output::request::{extended, request};
use crate::output::results::Results;
use crate::output::shape::{self, Shape};
use crate::output::summary;
use crate::run::{Options, run};
use crate::scheme::{Method, Scheme};
use crate::study::choice;
use crate::study::compare::{Comparison, any_succeeded, compare, default_methods, other_restitution};
use crate::study::verdict::{self, Verdict};
use serde_json::{Value, json};

const EXAMPLES: &str = "\
Examples:
  signorini compare cases/rigid-walls-sine.toml
  signorini compare rigid-walls-sine --restitution 0.8
  signorini compare tube-round-supports --seeds 6      means over six realisations of the random loads
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
    /// Methods to compare [default: the constrained QP, the same through Clarabel (with friction or
    /// round supports a second scheme), every penalty of the case]; the exact one is included
    /// wherever it has a law for the walls
    #[arg(long, value_name = "A,B,…", alias = "scheme", value_parser = values::schemes(), hide_possible_values = true)]
    schemes: Option<String>,
    /// Run every method with N realisations of the case's random loads, the same for all: means
    /// with their 95 % intervals, and what each method differs by from the exact one, or else from
    /// the first, and the errors of its means in the parts of `run --seeds`. Realisation k has the
    /// seeds of the case plus k - 1, as with `run --seeds`
    #[arg(long, value_name = "N", value_parser = values::whole, allow_negative_numbers = true)]
    seeds: Option<u64>,
    /// Do not repeat the methods with half the step, nor with --seeds with more modes
    #[arg(long)]
    no_verdict: bool,
    /// Show all quantities of each method, and all notes
    #[arg(long)]
    verbose: bool,
    #[command(flatten)]
    span: PlotSpan,
}

pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let case = args.request.read(ui)?;
    let count = checked_seeds(args.seeds, &case)?;
    let methods = args.methods(&case)?;
    args.request.check_use(&methods)?;
    // A stretch outside the run is refused before anything runs.
    let span = args.span.within(&case, case.scene.duration)?;
    let mut asked = extended(request("compare", &case, &methods), json!({ "verdict": !args.no_verdict }));
    if let Some(count) = count {
        asked.insert("seeds".to_owned(), json!(count));
    }
    let mut results = args.request.place.open(&case, "compare", asked)?;
    let (comparison, (verdicts, failures)) = compared(args, &case, &methods, count, ui)?;
    refute(&comparison, &verdicts, ui);
    any_succeeded(&comparison)?;
    let studies =
        count.map(|count| compare_seeds::studies(&case, &comparison, count, !args.no_verdict, ui)).transpose()?;
    if let Some(studies) = &studies {
        method_realisations::write(&mut results, studies)?;
    }
    let common = args.span.within(&case, comparison.horizon)?;
    let report = !args.request.place.no_report;
    if report {
        draw(&case, &comparison, &mut results)?;
    }
    let rows = output::write(&mut results, &case, &comparison, &verdicts, [span, common])?;
    let notes: Vec<String> = run_notes(&comparison).into_iter().chain(case.notes()).collect();
    let findings = comparison.findings.iter();
    let conclusion = conclusion(&case, &comparison);
    results.add_to_manifest("conclusion", json!(conclusion));
    results.add_to_manifest("error_length", json!(length_word(&case)));
    results.add_to_manifest("reference", json!(comparison.reference_in_words()));
    results.add_to_manifest("remarks", json!(findings.clone().chain(&notes).collect::<Vec<_>>()));
    let mut document = document(&case, &comparison, rows, &conclusion, &notes);
    if let Some(studies) = &studies {
        document["realisations"] = method_realisations::document(studies);
    }
    let mut answer = Answer::of(results, report, document);
    if args.verbose {
        answer.table(all_quantities(&case, &comparison), "compare.csv");
        answer.remarks(remark(&case));
    } else {
        answer.table(overview(&case, &comparison), "compare.csv");
        answer.remarks(force_remark(&case, &comparison));
    }
    answer.prose(conclusion);
    answer.remarks(half_the_step(&case, &comparison, &verdicts));
    if let Some(studies) = &studies {
        compare_seeds::show(studies, &mut answer, &case);
    }
    add_messages(&mut answer, args, &case, &comparison, &verdicts, &notes);
    let failed = failures.iter();
    answer
        .messages(failed.map(|(method, error)| format!("- the check of {method} with half the step failed: {error}")));
    let unchecked = failures.iter().map(|(method, _)| format!("half the step of {method}"));
    answer.fall_short(not_checked(unchecked.chain(studies.iter().flat_map(compare_seeds::unchecked))));
    Ok(answer)
}

/// Shows what failed, and in full or as a count the findings and notes.
fn add_messages(
    answer: &mut Answer,
    args: &Args,
    case: &Case,
    comparison: &Comparison,
    verdicts: &[Option<Verdict>],
    notes: &[String],
) {
    let findings = comparison.findings.iter();
    let failure = comparison.rows.iter().filter_map(|row| Some((row.method, row.outcome.as_ref().err()?)));
    answer.messages(failure.map(|(method, error)| format!("- {method} failed: {error}")));
    if !args.verbose {
        answer.messages(case.instability());
        answer.messages(other_restitution(&case.scene, comparison));
        let count = findings.count() + notes.len();
        let more = (count > 0).then(|| format!("--verbose shows all quantities and the notes, {count} of them"));
        answer.remarks(more);
        return;
    }
    answer.messages(findings.map(|finding| format!("- {finding}")));
    if case.penalty.laws.is_empty()
        && args.schemes.is_none()
        && case.scene.walls.iter().any(|wall| wall.law.is_rigid() && !wall.is_round())
    {
        answer.messages(["- the case has no [penalty] table: no penalty was compared".to_owned()]);
    }
    answer.messages(notes.iter().map(|note| format!("- {note}")));
    if !args.no_verdict {
        answer.messages([format!("refinement: {}", verdicts::line(comparison, verdicts))]);
    }
}

impl Args {
    /// The methods asked for, or those that are compared by default.
    fn methods(&self, case: &Case) -> Result<Vec<Method>> {
        if let Some(list) = &self.schemes {
            return self.request.methods(list, case);
        }
        let chosen = self.request.method(&choice::choose(&case.scene).method.to_string(), case)?;
        let integrator = case.penalty.integrator.unwrap_or_default();
        let penalties = case.penalty.laws.iter().map(|&law| Method::new(Scheme::Penalty { law, integrator }));
        Ok(default_methods(&case.scene, chosen, penalties))
    }
}

/// What half the step changes in each row of a comparison, and the checks that failed.
type Checks = (Vec<Option<Verdict>>, Vec<(Method, Error)>);

/// The comparison, and its checks; `seeds` realisations by each method follow.
fn compared(args: &Args, case: &Case, methods: &[Method], seeds: Option<u64>, ui: &Ui) -> Result<(Comparison, Checks)> {
    // The exact run is among the methods asked for, or is added to them.
    let stepping = methods.iter().filter(|method| method.scheme != Scheme::Event).count() as f64;
    let count = stepping + 2.0;
    let checks = if args.no_verdict { 0.0 } else { (count - 1.0) * verdict::COST };
    let each = |exact| seeds.map_or(0.0, |seeds| realisations::cost(case, seeds, !args.no_verdict, exact));
    let following = (stepping * each(false) + each(true)) / (count + checks);
    let estimate = DurationEstimate::of_comparison(&case.scene, methods, case.time.step).followed_by(following);
    ui.with_estimate("comparing", estimate, |bar| {
        let done = |runs: f64| bar.set_share(runs / (count + checks));
        let comparison = compare(&case.scene, methods, &case.time, &done)?;
        let verdicts = if args.no_verdict {
            (vec![None; comparison.rows.len()], Vec::new())
        } else {
            verdicts::check(case, &comparison, &|rows| done(count + rows as f64 * verdict::COST))
        };
        Ok((comparison, verdicts))
    })
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

/// Reports the rows that the judge has refuted, and the refuted checks of these rows.
fn refute(comparison: &Comparison, verdicts: &[Option<Verdict>], ui: &Ui) {
    for (row, verdict) in comparison.rows.iter().zip(verdicts) {
        match &row.outcome {
            Ok(run) => ui.refute(&row.method.to_string(), &run.findings),
            Err(error) => ui.refute_failed(&row.method.to_string(), error),
        }
        if let Some(verdict) = verdict {
            ui.refute(&format!("the check of {}", row.method), &verdict.findings);
        }
    }
    if let Some((method, run)) = &comparison.refined {
        ui.refute(&format!("{method} as reference"), &run.findings);
    }
}

/// The comparison as one JSON document: what all methods share, then one row per method.
fn document(case: &Case, comparison: &Comparison, rows: Vec<Value>, conclusion: &str, notes: &[String]) -> Value {
    let document = json!({
        "scene": summary::scene(case),
        "horizon_s": comparison.horizon,
        "growth": comparison.growth,
        "reference_failure": comparison.reference.as_ref().err().map(ToString::to_string),
        "rows": rows,
        "conclusion": conclusion,
        "findings": comparison.findings,
        "notes": notes,
    });
    under_head(case, document)
}

/// Every note of the rows, with the methods to which it applies.
fn run_notes(comparison: &Comparison) -> Vec<String> {
    let runs =
        comparison.rows.iter().filter_map(|row| Some((row.method.to_string(), &row.outcome.as_ref().ok()?.notes)));
    let mut notes: Vec<(&str, Vec<String>)> = Vec::new();
    let mut count = 0;
    for (method, of_run) in runs {
        count += 1;
        for note in of_run {
            match notes.iter_mut().find(|(text, _)| text == note) {
                Some((_, methods)) => methods.push(method.clone()),
                None => notes.push((note, vec![method.clone()])),
            }
        }
    }
    let said = |(note, methods): (&str, Vec<String>)| {
        if methods.len() == count { note.to_owned() } else { format!("{}: {note}", methods.join(", ")) }
    };
    notes.into_iter().map(said).collect()
}
