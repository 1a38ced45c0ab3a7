//! `run --seeds`: the run under further realisations of its random loads.

use super::pace::Pace;
use super::refuted::Refutations;
use super::ui::Ui;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::asked::with;
use crate::output::realisations as output;
use crate::output::results::Results;
use crate::run::{Options, Run};
use crate::scheme::{Method, Scheme};
use crate::study::realisations::{Realisation, Realisations, realisations};
use crate::time::TimeOptions;
use serde_json::{Map, Value, json};
use std::num::NonZero;

/// Resolution of the progress bar.
const UNITS: u64 = 1000;

/// How often the run is repeated.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct Seeds {
    /// Repeat the run with N realisations of its random loads, on all cores: means with their 95 %
    /// intervals, and what half the step changes in them. Realisation k has the seeds of the case
    /// plus k - 1
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    seeds: Option<u64>,
}

impl Seeds {
    /// The number of realisations of `case`, where any are asked for.
    ///
    /// # Errors
    /// [`Error::Invalid`] for 0, for a case without a random load, and where a seed would exceed
    /// 2^53.
    pub fn check(self, case: &Case) -> Result<Option<u64>> {
        let Some(count) = self.seeds else { return Ok(None) };
        if count == 0 {
            return Err(Error::invalid("--seeds", 0, "1 or more realisations"));
        }
        if !case.is_random() {
            let expected = "a case with a random load: without one all runs are the same";
            return Err(Error::invalid("--seeds", count, expected));
        }
        case.realisation(count)?;
        Ok(Some(count))
    }
}

/// The study of `count` realisations of `case`, where they are asked for, of which `run` is the
/// first; unless `no_verdict` also with half the step. Refuted runs are added to `refuted`.
pub fn study(
    case: &Case,
    run: &Run,
    method: &Method,
    (count, no_verdict): (Option<u64>, bool),
    refuted: &mut Refutations,
    ui: &Ui,
) -> Result<Option<Realisations>> {
    let Some(count) = count else { return Ok(None) };
    let checked = !no_verdict && method.scheme != Scheme::Event;
    let (others, halves) = ((count - 1) as f64, if checked { count as f64 } else { 0.0 });
    let work = others + 2.0 * halves;
    let cores = std::thread::available_parallelism().map_or(1, NonZero::get) as f64;
    let pace = Pace::of(&case.scene, method, run.grid.step).times(work / cores.min(count as f64));
    let bar = ui.paced("realisations", UNITS, pace);
    let scene = |number: u64| Ok(case.realisation(number)?.scene);
    // The steps and rows of the first run.
    let sample = Some(run.grid.end / run.grid.rows as f64);
    let time = |share: f64| TimeOptions { step: share * run.grid.step, sample, ..case.time };
    let mut told = |share: f64| bar.share(others * share / work);
    let mut members = vec![Realisation::of(1, run)];
    members.extend(realisations(2..=count, &scene, method, &Options::new(time(1.0)), &mut told)?);
    let mut told = |share: f64| bar.share((others + 2.0 * halves * share) / work);
    let halves = if checked {
        realisations(1..=count, &scene, method, &Options::new(time(0.5)), &mut told)?
    } else {
        Vec::new()
    };
    bar.finish();
    for member in members.iter().skip(1) {
        refuted.see(&format!("realisation {}", member.number), &member.findings);
    }
    for half in &halves {
        refuted.see(&format!("realisation {} with half the step", half.number), &half.findings);
    }
    let study = Realisations::new(members);
    Ok(Some(if checked { study.with_half_step(&halves) } else { study }))
}

/// The request with the number of realisations, where they are asked for.
#[must_use]
pub fn asked(request: Map<String, Value>, count: Option<u64>) -> Map<String, Value> {
    match count {
        Some(count) => with(request, json!({ "seeds": count })),
        None => request,
    }
}

/// Writes `realisations.csv`.
pub fn write(study: Option<&Realisations>, results: &mut Results) -> Result<()> {
    let Some(study) = study else { return Ok(()) };
    output::write(&results.place(output::FILE)?, study)
}

/// Prints the table of the study and the remarks on it; with `--json` only those, since the summary
/// has its numbers.
pub fn tell(study: Option<&Realisations>, case: &Case, ui: &Ui) -> Result<()> {
    let Some(study) = study else { return Ok(()) };
    if let (Some(table), false) = (output::table(study, &case.scene), ui.json()) {
        ui.table(&table, "summary.json")?;
    }
    output::remarks(study, &case.scene).iter().for_each(|remark| ui.message(remark));
    Ok(())
}
