//! `signorini chart`: accuracy against speed.

use super::case_args::CaseArgs;
use super::estimate::DurationEstimate;
use super::pipeline::{Answer, Destination};
use super::request::Request;
use super::ui::Ui;
use super::values;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::cheapest::{cheapest, conclusion, rows, tables};
use crate::output::floors;
use crate::output::request::{extended, request};
use crate::output::results::Results;
use crate::output::{document, work_precision as output};
use crate::study::choice::refused_in_words;
use crate::study::work_precision::{
    Effort, MethodPoints, Outcome, Peer, Quantity, Steps, WorkPrecision, default_methods, read, study,
};
use serde_json::json;
use std::collections::BTreeMap;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  signorini chart rigid-walls-sine --end 1
  signorini chart rigid-walls-sine --restitution 0.8 --steps 1e-2:1e-6 --levels 5
  signorini chart bouncing-ball --schemes event,moreau-jean,paoli-schatzman
  signorini chart rigid-walls-sine --end 1 --with peers.csv

Each error is dimensionless, and a column of work-precision.csv:
  displacement   largest difference over the gap
  velocity       distance between the completed graphs (t, u, v), jumps filled in
  impulse        largest difference at a wall over the reference's total; each wall's is in work-precision-walls.csv
  contact time   largest shift of a contact over the duration, and contacts missing or spurious
Times are of stepping alone: the best of several, in turn, warm. The file of --with has the columns
program,method,error_over_gap,seconds; benches/peers makes one.";

/// Chart accuracy against speed: every method over a range of steps
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    case: CaseArgs,
    /// End of the run, s; the comparison ends earlier where the motion is too sensitive
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    end: Option<f64>,
    /// Coarsest and finest step, s [default: a sixteenth of the fastest period, and 1e6 steps,
    /// fewer for many degrees of freedom]
    #[arg(long, value_name = "COARSE:FINE")]
    steps: Option<String>,
    /// Most steps tried in that range; each is finer than the last by a power of two
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..))]
    levels: u32,
    /// Methods to chart [default: all that have a rule for the walls, every penalty of the
    /// case with every integrator]
    #[arg(long, value_name = "A,B,…", alias = "scheme", value_parser = values::schemes(), hide_possible_values = true)]
    schemes: Option<String>,
    /// Timed runs of each point; the fastest counts
    #[arg(long, value_name = "N", default_value_t = 5)]
    repeats: u32,
    /// Leave out runs that would take longer than this, s
    #[arg(long, value_name = "S", default_value_t = 1.0)]
    longest: f64,
    /// Points of other programs to show on the chart
    #[arg(long, value_name = "FILE")]
    with: Option<PathBuf>,
    #[command(flatten)]
    place: Destination,
}

pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let settings = Request { case: args.case.clone(), end: args.end, ..Request::default() };
    let case = settings.read(ui)?;
    let (methods, refused) = match &args.schemes {
        Some(list) => (settings.methods(list, &case)?, Vec::new()),
        None => default_methods(&case.scene, &case.penalty.laws),
    };
    let effort = args.effort()?;
    let peers = args.with.as_deref().map(read).transpose()?.unwrap_or_default();
    let asked = extended(
        request("chart", &case, &methods),
        json!({
            "step_s": null,
            "sample_s": null,
            "steps": args.steps,
            "levels": args.levels,
            "repeats": args.repeats,
            "longest_s": args.longest,
            "with": args.with,
        }),
    );
    let mut results = args.place.open(&case, "chart", asked)?;
    let estimate = DurationEstimate::of_chart(&case.scene, &methods, args.levels, args.longest);
    let chart = ui.with_estimate("charting", estimate, |bar| {
        study(&case.scene, &methods, &effort, &|share| bar.set_share(share))
    })?;
    refute(&chart, ui);
    any_ran(&chart)?;
    let best = cheapest(&chart, &peers);
    let conclusions =
        Quantity::ALL.map(|quantity| (output::column(quantity), conclusion(&case.scene, &best, quantity)));
    let [(_, conclusion), ..] = conclusions.clone();
    write(&mut results, &case, &chart, &peers, &conclusion)?;
    let mut document = document::chart(&case, &chart);
    results.add_to_manifest("case_file", case.document.json()?);
    let remarks: Vec<String> = case.notes().into_iter().chain(refused_in_words(&refused)).collect();
    results.add_to_manifest("remarks", json!(remarks));
    results.add_to_manifest("conclusions", json!(BTreeMap::from(conclusions)));
    results.add_to_manifest("cheapest", rows(&best));
    results.add_to_manifest("floors", floors::rows(&chart));
    results.add_to_manifest("orders", document::orders(&chart));
    results.add_to_manifest("other_programs", json!(output::programs(&peers)));
    results.add_to_manifest("compared", json!(compared(&case, &chart)));
    document["conclusion"] = json!(conclusion);
    document["cheapest"] = rows(&best);
    let mut answer = Answer::of(results, !args.place.no_report, document);
    for table in tables(&best) {
        answer.table(table, "work-precision.csv");
    }
    answer.remarks([conclusion]);
    answer.messages(messages(&case, &chart).into_iter().chain(refused_in_words(&refused)));
    Ok(answer)
}

/// Reports the points that the judge has refuted: the CSV marks their rows, the picture does not
/// show them.
fn refute(chart: &WorkPrecision, ui: &Ui) {
    for (series, point) in chart.series.iter().flat_map(|s| s.points.iter().map(move |p| (s, p))) {
        if let Outcome::Failed(error) = &point.outcome {
            let step = point.step.map_or_else(String::new, |h| format!(", h = {h:.2e} s"));
            ui.refute_failed(&format!("{}{step}", series.method), error);
        }
    }
}

impl Args {
    fn effort(&self) -> Result<Effort> {
        let mut steps = Steps { levels: Some(self.levels), ..Steps::default() };
        if let Some(text) = &self.steps {
            let expected = "two steps in seconds, COARSE:FINE, such as 1e-2:1e-6";
            let wrong = || Error::invalid("--steps", text, expected);
            let (coarse, fine) = text.split_once(':').ok_or_else(wrong)?;
            let number = |text: &str| text.trim().parse::<f64>().map_err(|_| wrong());
            (steps.coarsest, steps.finest) = (Some(number(coarse)?), Some(number(fine)?));
        }
        if self.longest.is_finite() && self.longest > 0.0 {
            Ok(Effort { steps, repeats: self.repeats, most_seconds: self.longest })
        } else {
            Err(Error::invalid("--longest", self.longest, "a finite number above 0"))
        }
    }
}

/// The first error, if no run succeeded.
fn any_ran(chart: &WorkPrecision) -> Result<()> {
    let mut outcomes = chart.series.iter().flat_map(|s| s.points.iter().map(|p| &p.outcome));
    let failure = outcomes.clone().find_map(|o| if let Outcome::Failed(error) = o { Some(error) } else { None });
    match failure {
        Some(error) if !outcomes.any(|o| matches!(o, Outcome::Ran(_))) => Err(error.clone()),
        _ => Ok(()),
    }
}

fn write(results: &mut Results, case: &Case, chart: &WorkPrecision, peers: &[Peer], conclusion: &str) -> Result<()> {
    output::table(&results.place("work-precision.csv")?, chart)?;
    output::walls(&results.place("work-precision-walls.csv")?, &case.scene, chart)?;
    let title = case.heading();
    let walls = case.scene.walls.iter();
    let asked: Vec<f64> = walls.filter_map(|w| w.law.restitution()).collect();
    let title = match asked.first() {
        Some(e) if asked.iter().all(|other| other == e) => format!("{title}, e = {e}"),
        _ => title.to_owned(),
    };
    for (name, svg) in output::charts(&title, conclusion, chart, peers) {
        results.draw(name, &svg)?;
    }
    Ok(())
}

/// Up to when the methods are compared, and with which reference.
fn compared(case: &Case, chart: &WorkPrecision) -> [String; 2] {
    let (horizon, reference) = (&chart.horizon, &chart.reference);
    [
        format!(
            "compared up to t = {:.4} s of {} s: a small change of the start grows by {:.1e} until then, {:.1e} \
             over all ({})",
            horizon.end, case.scene.duration, horizon.growth, horizon.growth_of_all, horizon.how
        ),
        format!("reference: {}; known to {:.1e} of the gap", reference.how, reference.uncertainty.displacement),
    ]
}

/// With what the methods are compared, and what each of them reached.
fn messages(case: &Case, chart: &WorkPrecision) -> Vec<String> {
    let mut messages = Vec::from(compared(case, chart));
    messages.extend(floors::sentences(chart));
    for series in &chart.series {
        if let Some(order) = series.order(chart.known(&series.method.scheme)) {
            messages.push(format!("{}: order {order:.2} in the displacement{}", series.method, own_words(series)));
        }
        let failures = series.points.iter().filter(|p| p.measured().is_none()).count();
        if failures > 0 {
            messages.push(format!(
                "{}: {failures} of {} runs have no result; the CSV says why",
                series.method,
                series.points.len()
            ));
        }
    }
    messages
}

fn own_words(series: &MethodPoints) -> &'static str {
    if series.measured().any(|(_, m)| m.own.is_some()) { " of its own springs" } else { "" }
}
