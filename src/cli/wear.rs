//! `signorini wear`: depth over the years at round supports whose gaps grow by wear.

use super::estimate::DurationEstimate;
use super::pipeline::Shown;
use super::request::Request;
use super::ui::Ui;
use super::values;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::request::{extended, request};
use crate::output::wear_history as output;
use crate::output::wear_history::YEAR;
use crate::run::Options;
use crate::scene::Scene;
use crate::study::choice;
use crate::study::wear_history::{WearPlan, WearingSupport};
use serde_json::json;
use std::num::NonZero;

const EXAMPLES: &str = "\
Examples:
  signorini wear tube-in-cross-flow --years 40
  signorini wear tube-round-supports --years 10 --histories 12
  signorini wear my-tube.toml --set wear.coefficient=2e-14

The gap of a round support grows by the wear of tube and support, evenly all round: dγ/dt = k
W(γ)/(2πRw); gaps of flats stay. The work rate W is that of a run with the gap of that time; its statistics begin at
statistics_from. Under random loads several histories are followed, each run with seeds of its own.
Writes history.csv (every history), years.csv (means with their 95 % intervals) and wear.svg;
report.html shows them.";

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
pub fn answer(args: &Args, ui: &Ui) -> Result<Shown> {
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
    let scene = |number: u64, gaps: &[f64]| with_gaps(case.realisation(number)?.scene, &supports, gaps);
    let options = Options::new(case.time);
    let plan = WearPlan { supports: &supports, scene: &scene, method: &method, options: &options, histories, service };
    let cores = std::thread::available_parallelism().map_or(1, NonZero::get).min(histories) as f64;
    let runs = WINDOWS * histories as f64 / cores;
    let estimate = DurationEstimate::of_run(&case.scene, &method, case.time.step).times(runs);
    let found = ui.with_estimate("wear", estimate, |bar| plan.follow(&mut |share| bar.set_share(share)))?;
    for (number, findings) in &found.refuted {
        ui.refute(&format!("window {number}"), findings);
    }
    output::write(&mut results, &found)?;
    results.draw("wear", &output::figure(&case, &found))?;
    let notes = case.notes();
    results.add_to_manifest("case_file", case.document.json()?);
    results.add_to_manifest("remarks", json!(notes));
    let mut answers = output::remarks(&case, &found);
    answers.extend(supports.iter().filter(|support| !support.grows).map(|support| {
        format!("the gaps of support {:?} stay as they are: flats wear, but only round supports widen", support.name)
    }));
    results.add_to_manifest("answers", json!(answers));
    results.add_to_manifest("supports", json!(found.supports));
    results.add_to_manifest("fluid_elastic", json!(case.fluid_elastic));
    let mut shown = Shown::of(results, !args.request.place.no_report, output::document(&case, &found));
    shown.table(output::table(&found), "years.csv");
    shown.remarks(answers);
    shown.messages([format!("{} by {method}: {} runs of {:?} s", case.name, found.windows, case.scene.duration)]);
    shown.messages(notes.iter().map(|note| format!("note: {note}")));
    Ok(shown)
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
        let gap = support.gaps(&case.scene.walls).into_iter().fold(f64::INFINITY, f64::min);
        let grows = support.hole(&case.scene.walls).is_some();
        wearing.push(WearingSupport { name: support.name.clone(), gap, grows, law });
    }
    if wearing.is_empty() {
        let expected = "a case with supports, and coefficient and service in [wear]: depths follow from these";
        return Err(Error::invalid("wear", &case.name, expected));
    }
    Ok(wearing)
}

/// `scene` with the gaps of the supports that wear.
fn with_gaps(mut scene: Scene, supports: &[WearingSupport], gaps: &[f64]) -> Result<Scene> {
    for (support, gap) in supports.iter().zip(gaps) {
        let walls = scene.supports.iter().find(|own| own.name == support.name).map(|own| own.walls.clone());
        for wall in walls.into_iter().flatten() {
            if let Some(wall) = scene.walls.get_mut(wall) {
                wall.set_round_gap(*gap);
            }
        }
    }
    Ok(scene)
}
