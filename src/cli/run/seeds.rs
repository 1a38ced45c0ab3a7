//! `run --seeds`: the run under further realisations of its random loads.

use crate::case::Case;
use crate::cli::estimate::DurationEstimate;
use crate::cli::pipeline::Shown;
use crate::cli::ui::Ui;
use crate::error::{Error, Result};
use crate::output::realisations as output;
use crate::output::results::Results;
use crate::run::{Options, Run};
use crate::scheme::{Method, Scheme};
use crate::study::realisations::{Realisation, Realisations, realisations};
use crate::time::TimeOptions;
use std::num::NonZero;

/// How often the run is repeated.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct Seeds {
    /// Repeat the run with N realisations of its random loads, on all cores: means with their 95 %
    /// intervals, and what half the step changes in them. Realisation k has the seeds of the case
    /// plus k - 1
    #[arg(long = "seeds", value_name = "N", allow_negative_numbers = true)]
    pub(super) count: Option<u64>,
}

impl Seeds {
    /// The number of realisations of `case`, where any are asked for.
    ///
    /// # Errors
    /// [`Error::Invalid`] for 0, for a case without a random load, and where a seed would exceed
    /// 2^53.
    pub fn check(self, case: &Case) -> Result<Option<u64>> {
        checked(self.count, case)
    }
}

/// The number of realisations of `case`, where `count` asks for any.
///
/// # Errors
/// As [`Seeds::check`].
pub fn checked(count: Option<u64>, case: &Case) -> Result<Option<u64>> {
    let Some(count) = count else { return Ok(None) };
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

/// The study of `count` realisations of `case`, of which `run` is the first, with `halved` also by
/// half the step.
pub fn study(case: &Case, run: &Run, method: &Method, count: u64, halved: bool, ui: &Ui) -> Result<Realisations> {
    let halved = halved && method.scheme != Scheme::Event;
    let (others, halves) = ((count - 1) as f64, if halved { count as f64 } else { 0.0 });
    let work = others + 2.0 * halves;
    let cores = std::thread::available_parallelism().map_or(1, NonZero::get) as f64;
    let estimate = DurationEstimate::of_run(&case.scene, method, run.grid.step).times(work / cores.min(count as f64));
    let scene = |number: u64| Ok(case.realisation(number)?.scene);
    // The steps and rows of the first run.
    let sample = Some(run.grid.end / run.grid.rows as f64);
    let options = |share: f64| Options::new(TimeOptions { step: share * run.grid.step, sample, ..case.time });
    let (members, halves) = ui.with_estimate("realisations", estimate, |bar| -> Result<_> {
        let mut progress = |share: f64| bar.set_share(others * share / work);
        let mut members = vec![Realisation::of(1, run)];
        members.extend(realisations(2..=count, &scene, method, &options(1.0), &mut progress)?);
        let mut progress = |share: f64| bar.set_share((others + 2.0 * halves * share) / work);
        let last = if halved { count } else { 0 };
        Ok((members, realisations(1..=last, &scene, method, &options(0.5), &mut progress)?))
    })?;
    for member in members.iter().skip(1) {
        ui.refute(&format!("realisation {}", member.number), &member.findings);
    }
    for half in &halves {
        ui.refute(&format!("realisation {} with half the step", half.number), &half.findings);
    }
    let study = Realisations::new(members);
    Ok(if halved { study.with_half_step(&halves) } else { study })
}

/// Writes `realisations.csv`.
pub fn write(study: &Realisations, results: &mut Results) -> Result<()> {
    output::write(&results.place(output::FILE)?, study)
}

/// Shows the table of the study and the remarks on it.
pub fn show(shown: &mut Shown, study: &Realisations, case: &Case) {
    if let Some(table) = output::table(study, &case.scene) {
        shown.table(table, "summary.json");
    }
    shown.messages(output::remarks(study, &case.scene));
}
