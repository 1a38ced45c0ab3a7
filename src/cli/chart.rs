//! `signorini chart`: accuracy against speed.

use super::pace::Pace;
use super::refuted::Refutations;
use super::ui::Ui;
use super::{request, values};
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::asked::{asked, with};
use crate::output::cheapest::{cheapest, conclusion, rows, table};
use crate::output::document;
use crate::output::results::Results;
use crate::output::summary;
use crate::output::work_precision as output;
use crate::study::work_precision::{Effort, Outcome, Peer, Series, Steps, WorkPrecision, every_method, read, study};
use serde_json::json;
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
    /// Case file, or the name of a built-in case; a file of that name is taken before a built-in
    /// case
    #[arg(value_hint = clap::ValueHint::FilePath)]
    case: String,
    #[command(flatten)]
    changes: request::Changes,
    /// End of the run, s; the comparison ends earlier where the motion is too sensitive
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    end: Option<f64>,
    /// Restitution of every rigid wall, 0 to 1
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    restitution: Option<f64>,
    /// Coarsest and finest step, s [default: a sixteenth of the fastest period, and 1e6 steps,
    /// fewer for many degrees of freedom]
    #[arg(long, value_name = "COARSE:FINE")]
    steps: Option<String>,
    /// Most steps tried in that range; each is finer than the last by a power of two
    #[arg(long, value_name = "N", default_value_t = 8)]
    levels: u32,
    /// Methods to chart [default: all of them, every penalty of the case with every integrator]
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
    place: request::Destination,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let request = args.request();
    let case = request.case(ui)?;
    let methods = match &args.schemes {
        Some(list) => {
            super::compare::split(list).map(|name| request.method(name, &case)).collect::<Result<Vec<_>>>()?
        }
        None => every_method(&case.penalty.laws),
    };
    let effort = args.effort()?;
    let peers = args.with.as_deref().map(read).transpose()?.unwrap_or_default();
    /// Resolution of the progress bar.
    const UNITS: f64 = 1000.0;
    let asked = with(
        asked("chart", &case, &methods),
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
    let mut results = request.results(&case, "chart", asked)?;
    let pace = Pace::of_chart(&case.scene, &methods, args.levels, args.longest);
    let progress = ui.paced("charting", UNITS as u64, pace);
    let chart = study(&case.scene, &methods, &effort, &|share| progress.set((UNITS * share) as u64));
    progress.finish();
    let chart = chart?;
    let refuted = refutations(&chart);
    refuted.announce(ui);
    any_ran(&chart)?;
    write(&mut results, &case, &chart, &peers)?;
    results.tell("case_file", summary::case_file(&case));
    results.tell("remarks", json!(case.notes()));
    let best = cheapest(&chart, &peers);
    let conclusion = conclusion(&case.scene, &chart, &peers, &best);
    results.tell("conclusion", json!(conclusion));
    results.tell("cheapest", rows(&best));
    super::run::finish(&mut results, "", !request.place.no_report, ui)?;
    if ui.json() {
        let mut document = document::chart(&case, &chart);
        document["conclusion"] = json!(conclusion);
        document["cheapest"] = rows(&best);
        ui.document(&super::run::with_folder(document, &results))?;
    } else {
        ui.table(&table(&best), "work-precision.csv")?;
        ui.message(&conclusion);
    }
    report(&case, &chart, ui);
    refuted.verdict()
}

/// The points that the judge has refuted: the CSV marks their rows, the picture does not show them.
fn refutations(chart: &WorkPrecision) -> Refutations {
    let mut refuted = Refutations::default();
    for (series, point) in chart.series.iter().flat_map(|s| s.points.iter().map(move |p| (s, p))) {
        if let Outcome::Failed(error) = &point.outcome {
            let step = point.step.map_or_else(String::new, |h| format!(", h = {h:.2e} s"));
            refuted.see_error(&format!("{}{step}", series.method), error);
        }
    }
    refuted
}

impl Args {
    fn request(&self) -> request::Request {
        request::Request {
            case: self.case.clone(),
            changes: self.changes.clone(),
            step: None,
            end: self.end,
            sample: None,
            force_averaging: None,
            restitution: self.restitution,
            modes: None,
            epsilon: None,
            qp: None,
            theta: None,
            rho: None,
            integrator: None,
            place: self.place.clone(),
        }
    }

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

fn write(results: &mut Results, case: &Case, chart: &WorkPrecision, peers: &[Peer]) -> Result<()> {
    output::table(&results.place("work-precision.csv")?, chart)?;
    output::walls(&results.place("work-precision-walls.csv")?, &case.scene, chart)?;
    let title = case.title.as_deref().unwrap_or(&case.name);
    let walls = case.scene.walls.iter();
    let asked: Vec<f64> = walls.filter_map(|w| w.law.restitution()).collect();
    let title = match asked.first() {
        Some(e) if asked.iter().all(|other| other == e) => format!("{title}, e = {e}"),
        _ => title.to_owned(),
    };
    for (name, svg) in output::charts(&title, chart, peers) {
        results.draw(name, &svg)?;
    }
    Ok(())
}

fn report(case: &Case, chart: &WorkPrecision, ui: &Ui) {
    let (horizon, reference) = (&chart.horizon, &chart.reference);
    ui.message(&format!(
        "compared up to t = {:.4} s of {} s: a small change of the start grows by {:.1e} until then, {:.1e} \
         over all ({})",
        horizon.end, case.scene.duration, horizon.growth, horizon.growth_of_all, horizon.how
    ));
    ui.message(&format!(
        "reference: {}; known to {:.1e} of the gap",
        reference.how, reference.uncertainty.displacement
    ));
    for floor in &chart.floors {
        match (&floor.reference, &floor.errors) {
            (Ok(own), Some(errors)) => ui.message(&format!(
                "penalty {}: no step reduces its error against the rigid walls below {:.1e} of the gap; its own \
                 motion up to t = {:.4} s: {}, known to {:.1e}",
                floor.law, errors.displacement, floor.end, own.how, own.uncertainty.displacement
            )),
            (Err(error), _) => {
                ui.message(&format!("penalty {}: no motion of its own to compare with: {error}", floor.law))
            }
            _ => {}
        }
    }
    for series in &chart.series {
        if let Some(order) = series.order(chart.known(&series.method.scheme)) {
            ui.message(&format!("{}: order {order:.2} in the displacement{}", series.method, own_words(series)));
        }
        let failures = series.points.iter().filter(|p| p.measured().is_none()).count();
        if failures > 0 {
            ui.message(&format!(
                "{}: {failures} of {} runs have no result; the CSV says why",
                series.method,
                series.points.len()
            ));
        }
    }
}

fn own_words(series: &Series) -> &'static str {
    if series.measured().any(|(_, m)| m.own.is_some()) { " of its own springs" } else { "" }
}
