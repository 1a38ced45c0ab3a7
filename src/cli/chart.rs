//! `signorini chart`: accuracy against speed.

use super::request;
use super::ui::Ui;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::atomic::{check_folder, write_whole};
use crate::output::work_precision as output;
use crate::study::work_precision::{Effort, Measured, Peer, Series, Steps, WorkPrecision, every_method, read, study};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  signorini chart rigid-walls-sine --end 1
  signorini chart rigid-walls-sine --restitution 0.8 --steps 1e-2:1e-6 --levels 5
  signorini chart bouncing-ball --schemes event,moreau-jean,paoli-schatzman
  signorini chart rigid-walls-sine --end 1 --with peers.csv

Each error is dimensionless, and a column of work-precision.csv:
  displacement   largest difference over the gap
  velocity       distance between the completed graphs (t, u, v), jumps filled in
  impulse        difference at each wall over the reference's total
  contact time   largest shift of a contact over the duration, and contacts missing or spurious
Times are of stepping alone: the best of several, in turn, warm. The file of --with has the columns
program,method,error_over_gap,seconds; benches/peers makes one.";

/// The errors of the table of the cheapest.
const TOLERANCES: [(f64, &str); 5] = [(0.1, "10 %"), (1e-2, "1 %"), (1e-3, "0.1 %"), (1e-6, "1e-6"), (1e-9, "1e-9")];

/// Chart accuracy against speed: every method over a range of steps
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Case file, or the name of a built-in case
    case: String,
    /// End of the run, s; the comparison ends earlier where the motion is too sensitive
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    end: Option<f64>,
    /// Restitution of every rigid wall, 0 to 1
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    restitution: Option<f64>,
    /// Coarsest and finest step, s [default: a sixteenth of the fastest period, and 1e6 steps, fewer for many degrees of freedom]
    #[arg(long, value_name = "COARSE:FINE")]
    steps: Option<String>,
    /// How many steps are tried in that range, at most; each a power of two finer than the last
    #[arg(long, value_name = "N", default_value_t = 8)]
    levels: u32,
    /// Methods to chart [default: all of them, every penalty of the case with every integrator]
    #[arg(long, value_name = "A,B,…", alias = "scheme")]
    schemes: Option<String>,
    /// Timed runs of each point; the fastest counts
    #[arg(long, value_name = "N", default_value_t = 5)]
    repeats: u32,
    /// Leave out runs that would take longer than this, s
    #[arg(long, value_name = "S", default_value_t = 1.0)]
    longest: f64,
    /// Points of other programs to lay over the chart
    #[arg(long, value_name = "FILE")]
    with: Option<PathBuf>,
    /// Folder for the results [default: out/<case>/chart]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let request = args.request();
    let case = request.case()?;
    let methods = match &args.schemes {
        Some(list) => {
            super::compare::split(list).map(|name| request.method(name, &case)).collect::<Result<Vec<_>>>()?
        }
        None => every_method(&case.penalty.laws),
    };
    let effort = args.effort()?;
    let peers = args.with.as_deref().map(read).transpose()?.unwrap_or_default();
    /// Resolution of the bar.
    const UNITS: f64 = 1000.0;
    let folder = request.folder(&case, "chart");
    check_folder(&folder)?;
    let progress = ui.progress("charting", UNITS as u64);
    let chart = study(&case.scene, &methods, &effort, &|share| progress.set((UNITS * share) as u64));
    progress.finish();
    let chart = chart?;
    any_ran(&chart)?;
    write(&folder, &case, &chart, &peers)?;
    cheapest(&chart, &peers, args.with.is_some(), ui);
    report(&case, &chart, ui);
    ui.message(&format!("results in {}", folder.display()));
    Ok(())
}

impl Args {
    fn request(&self) -> request::Request {
        request::Request {
            case: self.case.clone(),
            step: None,
            end: self.end,
            sample: None,
            restitution: self.restitution,
            modes: None,
            epsilon: None,
            qp: None,
            theta: None,
            rho: None,
            integrator: None,
            out: self.out.clone(),
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
        match self.longest.is_finite() && self.longest > 0.0 {
            true => Ok(Effort { steps, repeats: self.repeats, most_seconds: self.longest }),
            false => Err(Error::invalid("--longest", self.longest, "a finite number above 0")),
        }
    }
}

/// The first failure, if nothing ran.
fn any_ran(chart: &WorkPrecision) -> Result<()> {
    use crate::study::work_precision::Outcome;
    let mut outcomes = chart.series.iter().flat_map(|s| s.points.iter().map(|p| &p.outcome));
    let failure = outcomes.clone().find_map(|o| if let Outcome::Failed(error) = o { Some(error) } else { None });
    match failure {
        Some(error) if !outcomes.any(|o| matches!(o, Outcome::Ran(_))) => Err(error.clone()),
        _ => Ok(()),
    }
}

fn write(folder: &Path, case: &Case, chart: &WorkPrecision, peers: &[Peer]) -> Result<()> {
    output::table(&folder.join("work-precision.csv"), &case.scene, chart)?;
    let title = case.title.as_deref().unwrap_or(&case.name);
    let walls = case.scene.walls.iter();
    let asked: Vec<f64> = walls.filter_map(|w| w.law.restitution()).collect();
    let title = match asked.first() {
        Some(e) if asked.iter().all(|other| other == e) => format!("{title}, e = {e}"),
        _ => title.to_owned(),
    };
    write_whole(&folder.join("work-precision.svg"), output::chart(&title, chart, peers).as_bytes())
}

/// The table: for each tolerance the cheapest method, and what the cheapest of the other programs takes.
fn cheapest(chart: &WorkPrecision, peers: &[Peer], with: bool, ui: &Ui) {
    let mut header = vec!["error/gap", "cheapest method", "step (s)", "time (s)", "reached"];
    if with {
        header.extend(["cheapest other", "its time (s)", "times slower"]);
    }
    let rows: Vec<Vec<String>> = TOLERANCES
        .iter()
        .map(|&(tolerance, name)| {
            let mut row = vec![name.to_owned()];
            let best = best(chart, tolerance);
            row.extend(match best {
                Some((series, step, m)) => [
                    series.method.to_string(),
                    step.map_or_else(|| "exact".into(), |h| format!("{h:.2e}")),
                    format!("{:.2e}", m.seconds),
                    format!("{:.1e}", m.errors.displacement),
                ],
                None => ["none".into(), String::new(), String::new(), String::new()],
            });
            if with {
                let within = peers.iter().filter(|p| p.error <= tolerance);
                row.extend(match within.min_by(|a, b| a.seconds.total_cmp(&b.seconds)) {
                    Some(peer) => [
                        peer.label(),
                        format!("{:.2e}", peer.seconds),
                        best.map_or_else(String::new, |(_, _, m)| format!("{:.0}", peer.seconds / m.seconds)),
                    ],
                    None => ["none".into(), String::new(), String::new()],
                });
            }
            row
        })
        .collect();
    ui.table(&header, &rows);
}

/// The cheapest measurement whose error is, and with finer steps stays, at or below `tolerance`.
fn best(chart: &WorkPrecision, tolerance: f64) -> Option<(&Series, Option<f64>, &Measured)> {
    let all = chart.series.iter().filter_map(|s| s.cheapest(tolerance).map(|(step, m)| (s, step, m)));
    all.min_by(|a, b| a.2.seconds.total_cmp(&b.2.seconds))
}

fn report(case: &Case, chart: &WorkPrecision, ui: &Ui) {
    let (horizon, reference) = (&chart.horizon, &chart.reference);
    ui.message(&format!(
        "compared up to t = {:.4} s of {} s: a small change of the start grows by {:.1e} until then, {:.1e} over all ({})",
        horizon.end, case.scene.duration, horizon.growth, horizon.growth_of_all, horizon.how
    ));
    ui.message(&format!(
        "reference: {}; known to {:.1e} of the gap",
        reference.how, reference.uncertainty.displacement
    ));
    for floor in &chart.floors {
        match (&floor.reference, &floor.errors) {
            (Ok(own), Some(errors)) => ui.message(&format!(
                "penalty {}: no step gets it below {:.1e} of the gap from the rigid walls; its own motion up to t = {:.4} s: {}, known to {:.1e}",
                floor.law, errors.displacement, floor.end, own.how, own.uncertainty.displacement
            )),
            (Err(error), _) => ui.message(&format!("penalty {}: no motion of its own to compare with: {error}", floor.law)),
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
