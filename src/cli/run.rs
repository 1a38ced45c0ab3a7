//! `signorini run`: one case, one method.

use super::drawing::Stretch;
use super::pace::Pace;
use super::refuted::Refutations;
use super::request::Request;
use super::seeds::{self, Seeds};
use super::ui::{Progress, Ui};
use super::values;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::asked::{asked, with};
use crate::output::atomic::write_whole;
use crate::output::episodes::Episodes;
use crate::output::results::Results;
use crate::output::run::{self as output, Picture};
use crate::output::shape::{self, Shape};
use crate::output::summary::{Checks, Reasons};
use crate::output::supports;
use crate::report;
use crate::run::{Options, Run, run_with_progress};
use crate::scene::Scene;
use crate::scheme::Method;
use crate::study::accuracy::{Outcome, Target, foresee, reach};
use crate::study::choice;
use crate::study::truncation::{ChosenModes, Truncation, choose_modes};
use crate::study::verdict::{self, Verdict};
use crate::time::TimeOptions;
use serde_json::{Value, json};
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
  signorini run tube-lattice-bars --seeds 6        means over six realisations of the random loads

Schemes: implicit-euler, paoli-schatzman, moreau-jean, generalized-alpha, newmark (for
demonstration), penalty, event (exact).";

/// Run one case by one scheme: trajectory, contacts, summary and figures
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    request: Request,
    /// Scheme [default: chosen from the scene; see `signorini explain`]
    #[arg(long, value_name = "NAME", value_parser = values::schemes(), hide_possible_values = true)]
    scheme: Option<String>,
    /// Find scheme and step for this error, as a share of the gap and of each wall's impulse and
    /// contact statistics; exit code 1 if it is not kept to the end; for a case reduced to modes,
    /// find the number of modes too
    #[arg(long, value_name = "TOL", allow_negative_numbers = true)]
    accuracy: Option<f64>,
    /// Do not repeat the run with half the step, nor, for a case reduced to modes, with more modes
    #[arg(long)]
    no_verdict: bool,
    #[command(flatten)]
    seeds: Seeds,
    #[command(flatten)]
    stretch: Stretch,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let case = args.request.case(ui)?;
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
    let request = asked("run", &case, &[method]);
    let request = with(request, json!({ "verdict": !args.no_verdict }));
    let count = args.seeds.check(&case)?;
    let request = seeds::asked(request, count);
    let mut results = args.request.results(&case, "run", request)?;
    let truncated = case.truncated.is_some() && !args.no_verdict;
    let checks = if args.no_verdict { 0.0 } else { verdict::COST } + if truncated { 1.0 } else { 0.0 };
    let bar = Bar::new(&method, &case, 1.0 + checks, ui);
    let report = !args.request.place.no_report;
    let shape = if report { Shape::of(&case) } else { Shape::default() };
    let mut run = bar.run(&shape.watched(&case), case.time, &method)?;
    let moved = shape.take(&mut run);
    let verdict = if args.no_verdict { None } else { Some(bar.verdict(&case, &method, &run)) };
    let truncation = if truncated { bar.truncation(&case, &method, &run).transpose() } else { None };
    bar.finish();
    let mut refuted = Refutations::default();
    refuted.see(&method.to_string(), &run.findings);
    if let Some(Ok(verdict)) = &verdict {
        refuted.see("the check of its step", &verdict.findings);
    }
    if let Some(Ok(truncation)) = &truncation {
        refuted.see("the check with more modes", &truncation.findings);
    }
    let study = seeds::study(&case, &run, &method, (count, args.no_verdict), &mut refuted, ui)?;
    refuted.announce(ui);
    ui.message(&format!("{method}: {reason}"));
    let reasons = Reasons { scheme: reason, qp: choice::qp_reason(&method, &case.scene) };
    let checks = Checks {
        refinement: verdict.as_ref().and_then(|v| v.as_ref().ok()),
        truncation: truncation.as_ref().and_then(|t| t.as_ref().ok()),
        realisations: study.as_ref(),
        ..Checks::default()
    };
    seeds::write(study.as_ref(), &mut results)?;
    if !shape.is_empty() {
        shape.write(&results.place(shape::FILE)?, run.trajectory.time(), &moved)?;
    }
    // Last, since the summary records the tables beside it.
    let document =
        output::write(&mut results, "", &case, &run, &method, (&reasons, checks), Picture { span, look: 0 })?;
    finish(&mut results, "", report, ui)?;
    tell(&case, &run, &method, document, &results, ui)?;
    seeds::tell(study.as_ref(), &case, ui)?;
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
    refuted.verdict()
}

/// A run that keeps the error asked for; if it falls short, that is reported after its results are
/// written.
fn accurate(args: &Args, case: &Case, tolerance: f64, ui: &Ui) -> Result<()> {
    if let Some(step) = args.request.step {
        return Err(Error::invalid("--step", step, "no step beside --accuracy, which finds one"));
    }
    let method = args.scheme.as_ref().map(|name| args.request.method(name, case)).transpose()?;
    if let Some(method) = method {
        args.request.check_use(&[method])?;
    }
    let span = args.stretch.span(case, case.scene.duration)?;
    let methods: Vec<Method> = method.into_iter().collect();
    let request = with(asked("run", case, &methods), json!({ "step_s": null, "accuracy": tolerance }));
    let count = args.seeds.check(case)?;
    let request = seeds::asked(request, count);
    let mut results = args.request.results(case, "run", request)?;
    let target = Target { method, ..Target::new(tolerance, case.time) };
    target.validate()?;
    // The cost of a step is proportional to the unknowns: a structure may cost some times as much
    // as one degree of freedom, but no more.
    let patience = |case: &Case| {
        let unknowns = case.scene.system.degrees_of_freedom() as u64;
        (PATIENCE * target.most_steps / unknowns).clamp(FEWEST_STEPS, target.most_steps)
    };
    let watch = ui.paced("", 0, Pace::of_search(&case.scene, method, case.time.step, patience(case)));
    // Printed before the search, which may take minutes.
    let foreseen = foresee(&case.scene, &target).ok().flatten();
    if let Some(until) = foreseen {
        ui.message(&format!(
            "beyond about t = {until:.4e} s no step keeps an error of {tolerance:e}: rounding alone grows to \
             it; so scheme and step are found for the time up to then at most"
        ));
    }
    let (case, modes) = match (foreseen, &case.truncated) {
        // The error cannot be kept with any number of modes, and runs that separated by chance
        // cannot be compared.
        (Some(_), Some(truncated)) => {
            let modes = truncated.reduction.modes.count();
            ui.message(&format!("so the {modes} modes of the case are kept, and no more are tried"));
            (case.clone(), None)
        }
        _ => enough_modes(case, &target, ui)?,
    };
    let target = Target { most_steps: patience(&case), ..target };
    let bar = ui.progress("refining", UNITS as u64);
    let end = case.scene.duration;
    let outcome = reach(&case.scene, &target, &mut |time| bar.set((UNITS * time / end) as u64));
    bar.finish();
    watch.finish();
    let Outcome { method, reason, run, accuracy, mut shortfall } = outcome?;
    let mut refuted = Refutations::default();
    refuted.see(&method.to_string(), &run.findings);
    let study = seeds::study(&case, &run, &method, (count, args.no_verdict), &mut refuted, ui)?;
    refuted.announce(ui);
    ui.message(&format!("{method}: {reason}"));
    let reasons = Reasons { scheme: reason, qp: choice::qp_reason(&method, &case.scene) };
    let checks =
        Checks { accuracy: Some(&accuracy), modes: modes.as_ref(), realisations: study.as_ref(), ..Checks::default() };
    seeds::write(study.as_ref(), &mut results)?;
    let mut document =
        output::write(&mut results, "", &case, &run, &method, (&reasons, checks), Picture { span, look: 0 })?;
    shortfall = shortfall.or(modes.as_ref().and_then(ChosenModes::shortfall));
    if let (Some(error), Some(map)) = (&shortfall, document.as_object_mut()) {
        map.insert("error".to_owned(), json!(error.to_string()));
    }
    let kept = if shortfall.is_some() { ", kept in spite of the error below" } else { "" };
    finish(&mut results, kept, !args.request.place.no_report, ui)?;
    tell(&case, &run, &method, document, &results, ui)?;
    seeds::tell(study.as_ref(), &case, ui)?;
    if let Some(modes) = &modes {
        ui.message(&format!("modes: {modes}"));
    }
    ui.message(&format!("accuracy: {accuracy}"));
    refuted.verdict()?;
    shortfall.map_or(Ok(()), Err)
}

/// The case with as many modes as `target` takes, and how their number was found; unchanged where
/// it is not reduced to modes.
fn enough_modes(case: &Case, target: &Target, ui: &Ui) -> Result<(Case, Option<ChosenModes>)> {
    let Some(truncated) = &case.truncated else { return Ok((case.clone(), None)) };
    let method = target.method.unwrap_or(choice::choose(&case.scene).method);
    let bar = ui.progress("modes", UNITS as u64);
    let mut progress = |time| bar.set((UNITS * time / case.scene.duration) as u64);
    let start = truncated.reduction.modes.count();
    let chosen = choose_modes(&truncated.whole, start, &method, &case.time, target.tolerance, &mut progress);
    bar.finish();
    let chosen = chosen?;
    Ok((case.clone().with_modes(chosen.modes / case.planes.modes())?, Some(chosen)))
}

/// Unknowns times steps of the last run of a refinement, relative to one degree of freedom.
const PATIENCE: u64 = 8;

/// Fewest steps that a run of a refinement may always take.
const FEWEST_STEPS: u64 = 1 << 16;

/// Resolution of the progress bar.
const UNITS: f64 = 1000.0;

/// Runs `case` by `method` with a progress bar.
pub(super) fn perform(case: &Case, method: &Method, ui: &Ui) -> Result<Run> {
    let bar = Bar::new(method, case, 1.0, ui);
    let run = bar.run(&case.scene, case.time, method);
    bar.finish();
    run
}

/// A progress bar over a run and, where asked for, its verdict.
struct Bar {
    progress: Progress,
    end: f64,
    runs: f64,
}

impl Bar {
    /// A bar for work that costs `runs` times as much as the run.
    fn new(method: &Method, case: &Case, runs: f64, ui: &Ui) -> Self {
        let pace = Pace::of(&case.scene, method, case.time.step).times(runs);
        Self { progress: ui.paced(&method.to_string(), UNITS as u64, pace), end: case.scene.duration, runs }
    }

    fn run(&self, scene: &Scene, time: TimeOptions, method: &Method) -> Result<Run> {
        let options = Options::new(time);
        run_with_progress(scene, method, &options, &mut |time| self.set(time / self.end))
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
        self.progress.share(runs / self.runs);
    }

    fn finish(self) {
        self.progress.finish();
    }
}

/// Prints a run: its table, the remarks on it, and its notes; with `--json` its summary.
fn tell(case: &Case, run: &Run, method: &Method, document: Value, results: &Results, ui: &Ui) -> Result<()> {
    if ui.json() {
        ui.document(&with_folder(document, results))?;
    } else if let Some(table) = output::table(run)? {
        ui.table(&table, "summary.json")?;
        output::remarks(run).iter().for_each(|remark| ui.message(remark));
    }
    if let (Some(table), false) = (supports::table(case, run), ui.json()) {
        ui.table(&table, "supports.csv")?;
        supports::remarks(case, run).iter().for_each(|remark| ui.message(remark));
    }
    if let (Some(options), false) = (case.statistics, ui.json()) {
        let episodes = Episodes::of(case, run, options.rest);
        if let Some(table) = episodes.table(&case.scene) {
            ui.table(&table, "episodes.csv")?;
            ui.message(&episodes.remark());
        }
    }
    ui.message(&output::line(case, run, method));
    for note in run.notes.iter().chain(&case.notes()).chain(&supports::warnings(case, run)) {
        ui.message(&format!("note: {note}"));
    }
    Ok(())
}

/// `document` with the folder of the results added.
pub(super) fn with_folder(mut document: Value, results: &Results) -> Value {
    if let Some(map) = document.as_object_mut() {
        map.insert("results".to_owned(), json!(results.folder()));
        map.insert("files_written".to_owned(), json!(results.files()));
    }
    document
}

/// The last line of a command: the folder of its results, and the `report` to open if there is one.
pub(super) fn last_line(folder: &Path, remark: &str, report: bool) -> String {
    let page = folder.join(report::FILE);
    let open = if report { format!("; open {}", page.display()) } else { String::new() };
    format!("results in {}{remark}{open}", folder.display())
}

/// Finishes the folder of the results, with a `report` where one is wanted, and prints what it
/// replaced; the last line of the command says where it is, and which page to open.
pub(super) fn finish(results: &mut Results, remark: &str, report: bool, ui: &Ui) -> Result<()> {
    // The report is made from the files in their places.
    let replaced = results.finish()?;
    if report {
        let page = report::page(results.folder(), &results.manifest())?;
        write_whole(&results.place(report::FILE)?, page.as_bytes())?;
        results.finish()?;
    }
    if let Some(replaced) = replaced {
        ui.message(&replaced);
    }
    ui.close_with(last_line(results.folder(), remark, report));
    Ok(())
}
