//! `signorini wear`: depth over the years at supports whose gaps grow by wear.

use super::command_line::command_line;
use super::estimate::DurationEstimate;
use super::pipeline::Answer;
use super::realisations::{self, StudyRequest, failed_checks, not_checked, of_argument};
use super::request::Request;
use super::run::Seeds;
use super::ui::Ui;
use super::values;
use crate::case::Case;
use crate::error::Result;
use crate::output::results::Results;
use crate::output::wear_folder::{self, WearRequest};
use crate::output::wear_journal::WindowJournal;
use crate::output::{first_window, run_folder, wear_history as output, wear_remarks};
use crate::run::Options;
use crate::scheme::Method;
use crate::study::realisations::{Realisation, RealisationCount, RealisationStudy};
use crate::study::verdict::COST;
use crate::study::wear_history::{USUAL_WINDOWS, WearHistories, WearPlan, WearingSupport};
use crate::wear::Opening;
use serde_json::json;

const EXAMPLES: &str = "\
Examples:
  signorini wear tube-in-cross-flow --years 40
  signorini wear tube-round-supports --years 10 --histories 12
  signorini wear tube-in-cross-flow --until-interval 5%   as many histories as that takes
  signorini wear my-tube.toml --set wear.coefficient=2e-14

The gap of a round support grows by the wear of tube and support, evenly all round: dγ/dt = k
W(γ)/(2πRw). With growth = \"shifted\" of the support its centre moves towards the deeper side as
well; gaps of flats stay, or with growth = \"flats\" each flat recedes by its scar. The work rate W is
that of a run with the gap of that time; its statistics begin at statistics_from. Under random loads
several histories are followed, each run with seeds of its own.
The first window is run with half the step and with more modes as well, and what that changes in
its work rates is told: the years err alike. With --until-interval the first runs of the histories
are a study of realisations, as that of `run --until-interval`, with the errors of the first work
rates.
Writes history.csv (every history), years.csv (means with their 95 % intervals), sector-means.csv
(where around each support it wears), wear.svg and, in first-window/, the files of the first run;
for --until-interval also realisations.csv and errors.csv (the first runs). A study ends before its
last year where the deepest depth over its histories is the tube's wall. report.html shows all.
After an interruption the same command goes on, after the study of the first runs. With more --years
it goes on from finished results as well: the same results as those of so many years at once.";

/// Follow wear over the years: gaps that grow, depths with their intervals, when a limit is reached
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    request: Request,
    /// Scheme [default: chosen from the scene; see `signorini explain`]
    #[arg(long, value_name = "NAME", value_parser = values::schemes(), hide_possible_values = true)]
    scheme: Option<String>,
    /// Time in service, years of 365.25 days [default: `service` of the case]
    #[arg(long, value_name = "Y", allow_negative_numbers = true)]
    years: Option<f64>,
    /// Histories under random loads [default: 6]
    #[arg(long, value_name = "N")]
    histories: Option<usize>,
    /// In place of --histories: as many as bring the 95 % intervals of the work rates in the first
    /// gaps within this share of them, 5% or 0.05: six say how many that takes (Stein)
    #[arg(long, value_name = "SHARE", conflicts_with = "histories", allow_hyphen_values = true)]
    until_interval: Option<String>,
    /// Most histories of --until-interval; exit code 1 where more are needed [default: 200]
    #[arg(long, value_name = "N", requires = "until_interval")]
    most_seeds: Option<u64>,
    /// Most time of --until-interval: 10min, 90s. Six first runs, made in any case, say how many
    /// histories, of some seven runs each, fit into it on this machine; exit code 1 where that are
    /// fewer than the interval needs. Histories with such a limit begin anew after an interruption
    #[arg(long, value_name = "TIME", requires = "until_interval", allow_hyphen_values = true)]
    most_time: Option<String>,
    /// Do not repeat the first window, with --until-interval up to six of the first runs, with half
    /// the step, nor with more modes, for the errors of the first work rates
    #[arg(long)]
    no_verdict: bool,
}

/// Follows the histories and shows the years.
///
/// # Errors
/// A case without supports that wear, a scheme that refuses it, a run that fails.
pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let case = args.request.read(ui)?;
    let supports = case.wearing_supports()?;
    let within = args.within(&case)?;
    let histories = case.histories(args.histories).map_err(of_argument)?;
    let service = case.service(args.years).map_err(of_argument)?;
    let (method, reason) = args.request.chosen(args.scheme.as_deref(), &case)?;
    let (place, count) = (&args.request.place, within.unwrap_or(RealisationCount::Exactly(histories as u64)));
    let verdict = !args.no_verdict;
    let asked = WearRequest { case: &case, method: &method, years: args.years, count, verdict };
    let mut results = asked.open(&place.folder(&case.name, "wear"), place.force, place.formats.usable()?)?;
    results.add_to_manifest("command_line", json!(command_line()));
    let estimate = DurationEstimate::of_run(&case.scene, &method, case.time.step);
    let run = ui.with_estimate("first window", estimate, |bar| {
        let mut progress = |time| bar.set_share(time / case.scene.duration);
        wear_folder::first_window(&mut results, &case, (&method, reason), !place.no_report, &mut progress)
    })?;
    let checks = (within.is_none() && verdict).then(|| {
        let estimate = DurationEstimate::of_run(&case.scene, &method, case.time.step).times(COST);
        ui.with_estimate("checks of the first window", estimate, |bar| {
            run_folder::checks(&case, (&run, &method), &mut |time| bar.set_share(time / case.scene.duration))
        })
    });
    let checked = checks.as_ref().map_or_else(Vec::new, |(step, modes)| first_window::remarks(step, modes.as_ref()));
    let study = |count| realisations::study(&case, (&run, &method), StudyRequest::new(count, verdict), "", ui);
    let first = within.map(study).transpose()?;
    let histories = first.as_ref().map_or(histories, |study| study.realisations.count);
    let plan = Followed { case: &case, supports: &supports, method: &method, histories, service };
    let alone = [Realisation::of(1, &run)];
    let known = first.as_ref().map_or(&alone[..], |study| &study.realisations.members);
    // Another number of histories may fit into the time than before: their windows are others.
    let anew = args.request.place.force || args.most_time.is_some();
    let (found, there) = plan.follow(known, &mut results, anew, ui)?;
    wear_folder::write(&mut results, &case, (&found, histories), (first.as_ref(), &checked))?;
    let mut document = output::document(&case, &found);
    if let Some(study) = &first {
        document["realisations"] = json!(study.realisations);
    }
    if let Some((step, modes)) = &checks {
        document["refinement"] = json!(step.as_ref().ok());
        document["truncation"] = json!(modes.as_ref().and_then(|modes| modes.as_ref().ok()));
    }
    let mut answer = Answer::of(results, !args.request.place.no_report, document);
    answer.table(output::table(&found), "years.csv");
    answer.remarks(wear_remarks::remarks(&case, &found));
    answer.messages(checked);
    if let Some(study) = &first {
        show_first(study, &mut answer, &case);
    }
    let runs = format!("{} by {method}: {} runs of {:?} s{there}", case.name, found.windows, case.scene.duration);
    answer.messages([runs]);
    answer.messages(case.notes().iter().map(|note| format!("note: {note}")));
    Ok(answer)
}

/// Shows the errors of the first runs of the histories, and what they fall short of.
fn show_first(study: &RealisationStudy, answer: &mut Answer, case: &Case) {
    let count = study.realisations.count;
    answer.messages([format!("the first runs of the {count} histories, in the gaps of the start, have these errors")]);
    realisations::show_errors(study, answer, case);
    let shortfall = study.shortfall.clone().or_else(|| not_checked(failed_checks(study)));
    if shortfall.is_some() {
        answer.close_with(", kept in spite of the error below");
    }
    answer.fall_short(shortfall);
}

impl Args {
    /// The number of histories that an interval takes, where one is asked for.
    fn within(&self, case: &Case) -> Result<Option<RealisationCount>> {
        let (until_interval, most_time) = (self.until_interval.clone(), self.most_time.clone());
        let seeds = Seeds { count: None, until_interval, most_seeds: self.most_seeds, most_time };
        Ok(seeds.check(case)?.map(|count| count.with_runs_each(USUAL_WINDOWS)))
    }
}

/// What histories are followed.
struct Followed<'a> {
    case: &'a Case,
    supports: &'a [WearingSupport],
    method: &'a Method,
    histories: usize,
    service: f64,
}

impl Followed<'_> {
    /// Follows the histories, of which the first windows are `known`, beside the journal of their
    /// windows in `results`, which begins `anew` where it may not go on. With them how many windows
    /// were there already, in words.
    fn follow(
        &self,
        known: &[Realisation],
        results: &mut Results,
        anew: bool,
        ui: &Ui,
    ) -> Result<(WearHistories, String)> {
        let Self { case, supports, method, histories, service } = *self;
        let mut journal = WindowJournal::open(results, histories, anew)?;
        let scene = |number: u64, openings: &[Opening]| case.worn(number, supports, openings);
        let options = Options::new(case.time);
        let plan = WearPlan { supports, scene: &scene, method, options: &options, histories, service };
        let estimate = DurationEstimate::of_run(&case.scene, method, case.time.step).times(USUAL_WINDOWS);
        let estimate = estimate.on_all_cores(histories as f64).at_most().resumable();
        // Windows lengthen as gaps grow.
        let (found, there) =
            ui.with_estimate("wear", estimate, |bar| journal.follow(&plan, known, &mut |share| bar.set_share(share)))?;
        // The study has told of its own, but of the first.
        let told = 2..=known.len() as u64;
        for (number, findings) in found.refuted.iter().filter(|(number, _)| !told.contains(number)) {
            ui.refute(&format!("window {number}"), findings);
        }
        let there = match there {
            0 => String::new(),
            _ if there == found.windows => ", all of them there already".to_owned(),
            count => format!(", {count} of them there already"),
        };
        Ok((found, there))
    }
}
