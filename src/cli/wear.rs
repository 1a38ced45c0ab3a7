//! `signorini wear`: depth over the years at supports whose gaps grow by wear.

use super::estimate::DurationEstimate;
use super::pipeline::Answer;
use super::request::Request;
use super::ui::Ui;
use super::values;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::request::{extended, request};
use crate::output::wear_history as output;
use crate::output::wear_history::YEAR;
use crate::output::wear_journal::WindowJournal;
use crate::run::Options;
use crate::scene::Scene;
use crate::study::choice;
use crate::study::wear_history::{WearPlan, WearingSupport};
use crate::wear::{Growth, Opening};
use serde_json::json;
use std::num::NonZero;

const EXAMPLES: &str = "\
Examples:
  signorini wear tube-in-cross-flow --years 40
  signorini wear tube-round-supports --years 10 --histories 12
  signorini wear my-tube.toml --set wear.coefficient=2e-14

The gap of a round support grows by the wear of tube and support, evenly all round: dγ/dt = k
W(γ)/(2πRw). With growth = \"shifted\" of the support its centre moves towards the deeper side as
well; gaps of flats stay, or with growth = \"flats\" each flat recedes by its scar. The work rate W is
that of a run with the gap of that time; its statistics begin at statistics_from. Under random loads
several histories are followed, each run with seeds of its own.
Writes history.csv (every history), years.csv (means with their 95 % intervals) and wear.svg;
report.html shows them. After an interruption the same command goes on.";

/// Histories under random loads.
const HISTORIES: usize = 6;

/// Windows of a history, about, for the estimate of the duration.
const WINDOWS: f64 = 7.0;

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
}

/// Follows the histories and shows the years.
///
/// # Errors
/// A case without supports that wear, a scheme that refuses it, a run that fails.
pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let case = args.request.read(ui)?;
    let supports = wearing(&case)?;
    let histories = args.histories(&case)?;
    let service = args.service(&case)?;
    let method = match &args.scheme {
        Some(name) => args.request.method(name, &case)?,
        None => args.request.method(&choice::choose(&case.scene).method.to_string(), &case)?,
    };
    args.request.check_use(&[method])?;
    let asked = extended(request("wear", &case, &[method]), json!({ "service_s": service, "histories": histories }));
    let mut results = args.request.place.open(&case, "wear", asked)?;
    let scene = |number: u64, openings: &[Opening]| {
        let mut scene = case.realisation(number)?.scene;
        supports.iter().zip(openings).for_each(|(support, opening)| open(&mut scene, &support.name, opening));
        Ok(scene)
    };
    let options = Options::new(case.time);
    let plan = WearPlan { supports: &supports, scene: &scene, method: &method, options: &options, histories, service };
    let cores = std::thread::available_parallelism().map_or(1, NonZero::get).min(histories) as f64;
    let runs = WINDOWS * histories as f64 / cores;
    let estimate = DurationEstimate::of_run(&case.scene, &method, case.time.step).times(runs);
    let mut journal = WindowJournal::open(&mut results, histories, args.request.place.force)?;
    let kept = journal.kept()?;
    let found = ui.with_estimate("wear", estimate, |bar| {
        plan.follow(&kept, &mut |window| journal.keep(window), &mut |share| bar.set_share(share))
    })?;
    for (number, findings) in &found.refuted {
        ui.refute(&format!("window {number}"), findings);
    }
    output::write(&mut results, &found)?;
    results.draw("wear", &output::figure(&case, &found))?;
    let notes = case.notes();
    results.add_to_manifest("case_file", case.document.json()?);
    results.add_to_manifest("remarks", json!(notes));
    let answers = output::remarks(&case, &found);
    results.add_to_manifest("answers", json!(answers));
    results.add_to_manifest("supports", json!(found.supports));
    results.add_to_manifest("fluid_elastic", json!(case.fluid_elastic));
    let mut answer = Answer::of(results, !args.request.place.no_report, output::document(&case, &found));
    answer.table(output::table(&found), "years.csv");
    answer.remarks(answers);
    let there = match journal.found() {
        0 => String::new(),
        count => format!(", {count} of them there already"),
    };
    answer
        .messages([format!("{} by {method}: {} runs of {:?} s{there}", case.name, found.windows, case.scene.duration)]);
    answer.messages(notes.iter().map(|note| format!("note: {note}")));
    Ok(answer)
}

impl Args {
    fn histories(&self, case: &Case) -> Result<usize> {
        match self.histories {
            Some(0) => Err(Error::invalid("--histories", 0, "1 or more")),
            Some(count) if count > 1 && !case.is_random() => {
                let expected = "a case with a random load: without one all histories are the same";
                Err(Error::invalid("--histories", count, expected))
            }
            Some(count) => Ok(count),
            None => Ok(if case.is_random() { HISTORIES } else { 1 }),
        }
    }

    /// The time in service, s.
    fn service(&self, case: &Case) -> Result<f64> {
        match (self.years, case.wear.service) {
            (Some(years), _) if years.is_finite() && years > 0.0 => Ok(years * YEAR),
            (Some(years), _) => Err(Error::invalid("--years", years, "a number above 0")),
            // A support that wears has a service.
            (None, service) => service.ok_or_else(|| Error::invalid("--years", "left out", "a number above 0")),
        }
    }
}

/// The supports of the case that wear.
fn wearing(case: &Case) -> Result<Vec<WearingSupport>> {
    let refuse = |name: &str, expected: &str| Err(Error::invalid("support", format!("{name:?}"), expected));
    let mut wearing = Vec::new();
    for (index, support) in case.scene.supports.iter().enumerate() {
        let Some(law) = case.archard(index) else { continue };
        if law.scar.is_none() {
            return refuse(&support.name, "a support with a width: its depth is the worn volume over 2πRw");
        }
        let growth = case.written.supports.get(index).map_or_else(Growth::default, |written| written.growth);
        wearing.push(WearingSupport { name: support.name.clone(), gaps: support.gaps(&case.scene.walls), growth, law });
    }
    if wearing.is_empty() {
        let expected = "a case with supports, and coefficient and service in [wear]: depths follow from these";
        return Err(Error::invalid("wear", &case.name, expected));
    }
    Ok(wearing)
}

/// Opens the support `name` of `scene` by its wear.
fn open(scene: &mut Scene, name: &str, opening: &Opening) {
    let Some(support) = scene.supports.iter_mut().find(|support| support.name == name) else { return };
    let round = support.hole(&scene.walls).is_some();
    let walls = support.walls.clone();
    for (wall, by) in walls.zip(&opening.recession) {
        if let Some(wall) = scene.walls.get_mut(wall) {
            wall.open(*by, opening.shift);
        }
    }
    if round {
        support.centre.iter_mut().zip(opening.shift).for_each(|(centre, shift)| *centre += shift);
    }
}
