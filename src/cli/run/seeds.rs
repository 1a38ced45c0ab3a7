//! `run --seeds`: the run under further realisations of its random loads.

use crate::case::Case;
use crate::cli::estimate::DurationEstimate;
use crate::cli::pipeline::Answer;
use crate::cli::ui::Ui;
use crate::error::{Error, Result};
use crate::output::realisations as output;
use crate::output::results::Results;
use crate::run::{Options, Run};
use crate::scheme::{Method, Scheme};
use crate::study::realisations::{NeededRealisations, Realisation, Realisations, realisations, widest};
use crate::time::TimeOptions;
use std::num::NonZero;
use std::ops::RangeInclusive;

/// How often the run is repeated.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Seeds {
    /// Repeat the run with N realisations of its random loads, on all cores: means with their 95 %
    /// intervals, and what half the step changes in them. Realisation k has the seeds of the case
    /// plus k - 1
    #[arg(long = "seeds", value_name = "N", allow_negative_numbers = true)]
    pub(super) count: Option<u64>,
    /// Repeat the run until the 95 % intervals of the work rates of supports (without supports, of
    /// the mean forces) are within this share of them, 5% or 0.05: six realisations say how many
    /// that takes (Stein)
    #[arg(long, value_name = "SHARE", conflicts_with = "count", allow_hyphen_values = true)]
    pub(super) until_interval: Option<String>,
    /// Most realisations of --until-interval; exit code 1 where more are needed [default: 200]
    #[arg(long, value_name = "N", requires = "until_interval")]
    pub(super) most_seeds: Option<u64>,
}

/// Realisations from which --until-interval estimates how many are needed.
const PILOTS: u64 = 6;

/// Most realisations, unless the command line says another number.
const MOST: u64 = 200;

/// How many realisations are wanted.
#[derive(Debug, Clone, Copy)]
pub enum Wanted {
    /// So many.
    Count(u64),
    /// As many as bring the intervals within this share of their means, and at most so many.
    Within { share: f64, most: u64 },
}

impl Seeds {
    /// The number of realisations of `case`, where any are asked for.
    ///
    /// # Errors
    /// [`Error::Invalid`] for 0, for a share that is none, for a case without a random load, and
    /// where a seed would exceed 2^53.
    pub fn check(&self, case: &Case) -> Result<Option<Wanted>> {
        let Some(text) = &self.until_interval else {
            return Ok(checked(self.count, case)?.map(Wanted::Count));
        };
        let wrong = || Error::invalid("--until-interval", text, "a share above 0 and below 1: 5% or 0.05");
        let (number, unit) = match text.trim().strip_suffix('%') {
            Some(number) => (number, 0.01),
            None => (text.as_str(), 1.0),
        };
        let share = unit * number.trim().parse::<f64>().map_err(|_| wrong())?;
        if !(share > 0.0 && share < 1.0) {
            return Err(wrong());
        }
        if !case.is_random() {
            let expected = "a case with a random load: without one all runs are the same";
            return Err(Error::invalid("--until-interval", text, expected));
        }
        let most = self.most_seeds.unwrap_or(MOST);
        if most < PILOTS {
            return Err(Error::invalid("--most-seeds", most, format!("{PILOTS} or more: so many are run first")));
        }
        case.realisation(most)?;
        Ok(Some(Wanted::Within { share, most }))
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

/// A study of realisations, and what it falls short of.
pub struct Study {
    pub realisations: Realisations,
    pub shortfall: Option<Error>,
}

/// The study of the realisations of `case` that are wanted, of which `run` is the first, with
/// `halved` also by half the step.
pub fn study(case: &Case, run: &Run, method: &Method, wanted: Wanted, halved: bool, ui: &Ui) -> Result<Study> {
    let scene = |number: u64| Ok(case.realisation(number)?.scene);
    // The steps and rows of the first run.
    let sample = Some(run.grid.end / run.grid.rows as f64);
    let more = |label: &str, numbers: RangeInclusive<u64>, share: f64| -> Result<Vec<Realisation>> {
        let count = (numbers.end() + 1).saturating_sub(*numbers.start()) as f64;
        let cores = std::thread::available_parallelism().map_or(1, NonZero::get) as f64;
        let work = count / share / cores.min(count.max(1.0));
        let estimate = DurationEstimate::of_run(&case.scene, method, run.grid.step).times(work);
        let options = Options::new(TimeOptions { step: share * run.grid.step, sample, ..case.time });
        ui.with_estimate(label, estimate, |bar| {
            realisations(numbers, &scene, method, &options, &mut |done| bar.set_share(done))
        })
    };
    let mut members = vec![Realisation::of(1, run)];
    let (count, needed) = match wanted {
        Wanted::Count(count) => (count, None),
        Wanted::Within { share, most } => {
            members.extend(more("pilots", 2..=PILOTS, 1.0)?);
            let needed = NeededRealisations::from_pilots(&members, share);
            let count = needed.as_ref().map_or(PILOTS, |needed| needed.count);
            ui.message(&pilots_in_words(needed.as_ref(), share, count.min(most)));
            (count.min(most), Some((share, count)))
        }
    };
    members.extend(more("realisations", members.len() as u64 + 1..=count, 1.0)?);
    for member in members.iter().skip(1) {
        ui.refute(&format!("realisation {}", member.number), &member.findings);
    }
    let shortfall = needed.filter(|(_, needed)| *needed > count).and_then(|(share, needed)| {
        let widest = widest(&members)?;
        let quantity = format!("{} of {} {:?}", widest.measure.words(), widest.place.kind.word(), widest.place.name);
        let reached = widest.pilot_share;
        (reached > share).then_some(Error::Scattered { share, reached, quantity, count, needed })
    });
    if !halved || method.scheme == Scheme::Event {
        return Ok(Study { realisations: Realisations::new(members), shortfall });
    }
    let halves = more("half the step", 1..=count, 0.5)?;
    for half in &halves {
        ui.refute(&format!("realisation {} with half the step", half.number), &half.findings);
    }
    Ok(Study { realisations: Realisations::new(members).with_half_step(&halves), shortfall })
}

/// What the pilots say, as a sentence.
fn pilots_in_words(needed: Option<&NeededRealisations>, share: f64, count: u64) -> String {
    let Some(needed) = needed else {
        return format!("pilots: {PILOTS} realisations scatter in no work rate and no force; no more are run");
    };
    let (measure, place) = (needed.measure.words(), &needed.place);
    let most = if needed.count > count { format!("; {count} are run") } else { String::new() };
    format!(
        "pilots: after {PILOTS} realisations the {measure} of {} {:?} is known to ± {:.1} %; ± {:.1} % needs {}{most}",
        place.kind.word(),
        place.name,
        100.0 * needed.pilot_share,
        100.0 * share,
        needed.count
    )
}

/// Writes `realisations.csv`.
pub fn write(study: &Realisations, results: &mut Results) -> Result<()> {
    output::write(&results.place(output::FILE)?, study)
}

/// Shows the table of the study and the remarks on it.
pub fn show(answer: &mut Answer, study: &Realisations, case: &Case) {
    if let Some(table) = output::table(study, &case.scene) {
        answer.table(table, "summary.json");
    }
    answer.messages(output::remarks(study, &case.scene));
}
