//! `signorini run`: one scene, one method.

use super::drawing::Stretch;
use super::request::Request;
use super::ui::{Progress, Ui};
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::atomic::{check_folder, write_whole};
use crate::output::pictures::{Labelled, Sheet};
use crate::output::summary::{self, Checks, Reasons};
use crate::output::{Span, csv};
use crate::run::{Options, Run, run_with_progress};
use crate::scheme::{Method, Scheme};
use crate::statistics::WallStatistics;
use crate::study::accuracy::{Outcome, Target, reach};
use crate::study::choice;
use crate::study::truncation::{ChosenModes, Truncation, choose_modes};
use crate::study::verdict::{self, Verdict};
use std::path::Path;

const EXAMPLES: &str = "\
Examples:
  signorini run cases/rigid-walls-sine.toml
  signorini run rigid-walls-sine --restitution 0.8 --step 1e-5
  signorini run rigid-walls-sine --scheme penalty --epsilon 1e-9 --integrator trapezoidal
  signorini run elastic-wall --scheme event --out results
  signorini run elastic-wall --accuracy 1e-6
  signorini run rigid-walls-sine --restitution 0.8 --scheme moreau-jean --accuracy 1e-3
  signorini run tube-loose-supports --modes 40
  signorini run rigid-walls-sine --from 4 --to 6   pictures of these two seconds

Schemes: implicit-euler, paoli-schatzman, moreau-jean, generalized-alpha, newmark (an exhibit), penalty, event (exact).";

/// Run one case by one scheme: trajectory, contacts, summary and figures
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    request: Request,
    /// Scheme [default: chosen from the scene; see `signorini explain`]
    #[arg(long, value_name = "NAME")]
    scheme: Option<String>,
    /// Find scheme and step for this error, as a share of the gap and of each wall's impulse and contact statistics; exit code 1 if it is
    /// not kept to the end; where the case is cut to modes, as many of them as that takes
    #[arg(long, value_name = "TOL", allow_negative_numbers = true)]
    accuracy: Option<f64>,
    /// Do not repeat the run with half the step, nor with more modes where the case is cut to modes
    #[arg(long)]
    no_verdict: bool,
    #[command(flatten)]
    stretch: Stretch,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let case = args.request.case()?;
    if let Some(tolerance) = args.accuracy {
        return accurate(args, &case, tolerance, ui);
    }
    let choice = choice::choose(&case.scene);
    let (method, reason) = match &args.scheme {
        Some(name) => (args.request.method(name, &case)?, "asked for".into()),
        None => (args.request.method(&choice.method.to_string(), &case)?, choice.reason),
    };
    args.request.check_use(&[method])?;
    let span = args.stretch.span(&case, case.scene.duration)?;
    let folder = args.request.folder(&case, "run");
    check_folder(&folder)?;
    let truncated = case.truncated.is_some() && !args.no_verdict;
    let checks = if args.no_verdict { 0.0 } else { verdict::COST } + if truncated { 1.0 } else { 0.0 };
    let bar = Bar::new(&method, &case, 1.0 + checks, ui);
    let run = bar.run(&case, &method)?;
    let verdict = if args.no_verdict { None } else { Some(bar.verdict(&case, &method, &run)) };
    let truncation = if truncated { bar.truncation(&case, &method, &run).transpose() } else { None };
    bar.finish();
    ui.message(&format!("{method}: {reason}"));
    let reasons = Reasons { scheme: reason, qp: choice::qp_reason(&method, &case.scene) };
    let checks = Checks {
        refinement: verdict.as_ref().and_then(|v| v.as_ref().ok()),
        truncation: truncation.as_ref().and_then(|t| t.as_ref().ok()),
        ..Checks::default()
    };
    write(&folder, &case, &run, &method, &reasons, checks, Picture { span, look: 0 })?;
    report(&case, &run, &method, ui)?;
    ui.message(&format!("results in {}", folder.display()));
    match verdict {
        Some(Ok(verdict)) => ui.message(&format!("refinement: {verdict}")),
        Some(Err(error)) => ui.message(&format!("refinement: the check of this run failed: {error}")),
        None => {}
    }
    match truncation {
        Some(Ok(truncation)) => ui.message(&format!("truncation: {truncation}")),
        Some(Err(error)) => ui.message(&format!("truncation: the check of this run failed: {error}")),
        None => {}
    }
    Ok(())
}

/// The run that keeps an error; a shortfall is reported after its results are written.
fn accurate(args: &Args, case: &Case, tolerance: f64, ui: &Ui) -> Result<()> {
    if let Some(step) = args.request.step {
        return Err(Error::invalid("--step", step, "none beside --accuracy, which finds the step"));
    }
    let method = args.scheme.as_ref().map(|name| args.request.method(name, case)).transpose()?;
    if let Some(method) = method {
        args.request.check_use(&[method])?;
    }
    let span = args.stretch.span(case, case.scene.duration)?;
    let folder = args.request.folder(case, "run");
    check_folder(&folder)?;
    let target = Target { method, ..Target::new(tolerance, case.time) };
    target.validate()?;
    let (case, modes) = enough_modes(case, &target, ui)?;
    // A step costs what its unknowns cost: patience for a structure is some times that for one degree of freedom, and no more.
    let unknowns = case.scene.system.degrees_of_freedom() as u64;
    let most_steps = (PATIENCE * target.most_steps / unknowns).clamp(FEWEST_STEPS, target.most_steps);
    let target = Target { most_steps, ..target };
    let bar = ui.progress("refining", UNITS as u64);
    let end = case.scene.duration;
    let outcome = reach(&case.scene, &target, &mut |time| bar.set((UNITS * time / end) as u64));
    bar.finish();
    let Outcome { method, reason, run, accuracy, mut shortfall } = outcome?;
    ui.message(&format!("{method}: {reason}"));
    let reasons = Reasons { scheme: reason, qp: choice::qp_reason(&method, &case.scene) };
    let checks = Checks { accuracy: Some(&accuracy), modes: modes.as_ref(), ..Checks::default() };
    write(&folder, &case, &run, &method, &reasons, checks, Picture { span, look: 0 })?;
    report(&case, &run, &method, ui)?;
    if let Some(modes) = &modes {
        ui.message(&format!("modes: {modes}"));
        shortfall = shortfall.or(modes.shortfall());
    }
    let kept = if shortfall.is_some() { ", kept in spite of what follows" } else { "" };
    ui.message(&format!("results in {}{kept}", folder.display()));
    ui.message(&format!("accuracy: {accuracy}"));
    shortfall.map_or(Ok(()), Err)
}

/// The case with as many modes as `target` takes, and how they were found; as it is where it is not cut to modes.
fn enough_modes(case: &Case, target: &Target, ui: &Ui) -> Result<(Case, Option<ChosenModes>)> {
    let Some(truncated) = &case.truncated else { return Ok((case.clone(), None)) };
    let method = target.method.unwrap_or(choice::choose(&case.scene).method);
    let bar = ui.progress("modes", UNITS as u64);
    let mut progress = |time| bar.set((UNITS * time / case.scene.duration) as u64);
    let start = truncated.reduction.modes.count();
    let chosen = choose_modes(&truncated.whole, start, &method, &case.time, target.tolerance, &mut progress);
    bar.finish();
    let chosen = chosen?;
    Ok((case.clone().with_modes(chosen.modes)?, Some(chosen)))
}

/// Unknowns times steps of a refinement's last run, in those of one degree of freedom.
const PATIENCE: u64 = 8;

/// Steps of one run that a refinement may always take.
const FEWEST_STEPS: u64 = 1 << 16;

/// Resolution of a bar.
const UNITS: f64 = 1000.0;

/// Runs `case` by `method` with a progress bar.
pub(super) fn perform(case: &Case, method: &Method, ui: &Ui) -> Result<Run> {
    let bar = Bar::new(method, case, 1.0, ui);
    let run = bar.run(case, method);
    bar.finish();
    run
}

/// A progress bar over a run and, if there is to be one, its verdict.
struct Bar {
    progress: Progress,
    end: f64,
}

impl Bar {
    /// A bar for a work of `runs` times that of the run.
    fn new(method: &Method, case: &Case, runs: f64, ui: &Ui) -> Self {
        Self { progress: ui.progress(&method.to_string(), (UNITS * runs) as u64), end: case.scene.duration }
    }

    fn run(&self, case: &Case, method: &Method) -> Result<Run> {
        let options = Options::new(case.time, method.backend);
        run_with_progress(&case.scene, &method.scheme, &options, &mut |time| self.set(time / self.end))
    }

    fn verdict(&self, case: &Case, method: &Method, run: &Run) -> Result<Verdict> {
        let mut progress = |time| self.set(1.0 + verdict::COST * time / self.end);
        Verdict::of(&case.scene, method, run, &case.time, &mut progress)
    }

    fn truncation(&self, case: &Case, method: &Method, run: &Run) -> Result<Option<Truncation>> {
        let Some(truncated) = &case.truncated else { return Ok(None) };
        let mut progress = |time| self.set(1.0 + verdict::COST + time / self.end);
        Truncation::of(&truncated.whole, &truncated.reduction, run, method, &case.time, &mut progress)
    }

    fn set(&self, runs: f64) {
        self.progress.set((UNITS * runs) as u64);
    }

    fn finish(&self) {
        self.progress.finish();
    }
}

/// What the pictures of one run show, and the number of its look among the runs of the command.
#[derive(Debug, Clone, Copy)]
pub(super) struct Picture {
    pub span: Span,
    pub look: usize,
}

/// Writes the files of one run into `folder`.
pub(super) fn write(
    folder: &Path,
    case: &Case,
    run: &Run,
    method: &Method,
    reasons: &Reasons,
    checks: Checks<'_>,
    picture: Picture,
) -> Result<()> {
    csv::trajectory(&folder.join("trajectory.csv"), &run.trajectory)?;
    csv::contacts(&folder.join("contacts.csv"), &run.trajectory)?;
    let label = method.to_string();
    let runs = [Labelled { label: &label, run, reference: false, look: picture.look }];
    let title = case.title.as_deref().unwrap_or(&case.name);
    let sheet = Sheet { title, scene: &case.scene, runs: &runs, span: picture.span };
    for (name, svg) in sheet.figures()? {
        write_whole(&folder.join(format!("{name}.svg")), svg.as_bytes())?;
    }
    summary::write(&folder.join("summary.json"), case, run, reasons, checks)
}

fn report(case: &Case, run: &Run, method: &Method, ui: &Ui) -> Result<()> {
    let headers = [
        "wall",
        "contacts",
        "impulse (N s)",
        "largest force (N)",
        "contact time (%)",
        "impact power (W)",
        "not returned (W)",
    ];
    // A person reads a few digits, a program all of them.
    let show =
        |x: f64, digits: usize| if ui.json() { format!("{x:?}") } else { format!("{:.digits$}", settled(x, digits)) };
    let mut rows = Vec::new();
    let shown = if ui.json() { run.statistics.walls.iter().enumerate().collect() } else { busiest(run) };
    for (index, wall) in &shown {
        let none = if wall.contacts == 0 { "-" } else { "impacts" };
        rows.push(vec![
            wall.wall.clone(),
            wall.contacts.to_string(),
            show(run.trajectory.impulse(&wall.wall)?, 6),
            largest_force(run, *index).map_or_else(|| none.into(), |f| show(f, 4)),
            show(100.0 * wall.contact_time_ratio, 3),
            show(wall.impact_power_w, 6),
            show(wall.unreturned_power_w, 6),
        ]);
    }
    if !rows.is_empty() {
        ui.table(&headers, &rows);
        let all = run.statistics.walls.len();
        if rows.len() < all {
            ui.message(&format!(
                "{} of {all} walls, those of the largest impulses; the summary has them all",
                rows.len()
            ));
        }
        if run.statistics.from_s > 0.0 {
            ui.message(&format!(
                "contacts, times and powers from t = {} s on, contacts that begin in it; impulses of the whole run",
                run.statistics.from_s
            ));
        }
        ui.message("impact power is normal impact only: frictionless contact has no sliding wear in it");
    }
    let r = &run.residuals;
    ui.message(&format!(
        "{method} on {}: {} steps, {}, complementarity {:.1e}, penetration {:.1e} m, energy ledger {:.1e}, {:.3} s",
        case.name,
        run.counters.steps,
        solved(run),
        r.complementarity,
        r.penetration_m,
        r.energy.residual,
        run.seconds
    ));
    for note in run.notes.iter().chain(&case.notes()) {
        ui.message(&format!("note: {note}"));
    }
    Ok(())
}

/// 0 instead of what would be shown as −0.
fn settled(x: f64, digits: usize) -> f64 {
    if x.abs() < 0.5 * 10f64.powi(-(digits as i32)) { 0.0 } else { x }
}

/// The largest force of the contacts at a wall that reach into the window of the statistics, N: also of one that began before it and lasts.
fn largest_force(run: &Run, index: usize) -> Option<f64> {
    let from = run.statistics.from_s;
    let here = run.trajectory.contacts().iter().filter(|c| c.wall == index && c.end.is_none_or(|end| end >= from));
    here.filter_map(|c| c.peak_force).map(f64::abs).reduce(f64::max)
}

/// Most walls of a table that a person reads.
const MOST_ROWS: usize = 24;

/// The walls of the largest impulses, in the scene's order.
fn busiest(run: &Run) -> Vec<(usize, &WallStatistics)> {
    let walls = &run.statistics.walls;
    let impulse = |wall: &str| run.trajectory.impulse(wall).map_or(0.0, f64::abs);
    let mut order: Vec<(usize, f64)> = walls.iter().map(|wall| impulse(&wall.wall)).enumerate().collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1));
    order.truncate(MOST_ROWS);
    order.sort_by_key(|entry| entry.0);
    order.into_iter().filter_map(|(i, _)| walls.get(i).map(|wall| (i, wall))).collect()
}

/// What solved the steps that met a wall, and how often.
fn solved(run: &Run) -> String {
    let counters = &run.counters;
    match run.scheme {
        Scheme::Event => format!("{} contact events", counters.events),
        Scheme::Penalty { .. } => format!("{} Newton iterations", counters.newton_iterations),
        _ if counters.qp_fallbacks > 0 => {
            let (all, left) = (counters.qp_solves, counters.qp_fallbacks);
            format!("{all} QPs by {}, {left} of them left to Clarabel", run.backend)
        }
        _ => format!("{} QPs by {}", counters.qp_solves, run.backend),
    }
}
