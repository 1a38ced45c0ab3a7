//! `run --seeds`: the run under further realisations of its random loads.

use super::error_checks::ErrorChecks;
use super::repeats::Repeats;
use crate::case::Case;
use crate::cli::pipeline::Answer;
use crate::error::{Error, Result};
use crate::output::results::Results;
use crate::output::{error_parts, realisations as output};
use crate::study::realisations::{NeededRealisations, Realisation, Realisations, widest};

/// How often the run is repeated.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Seeds {
    /// Repeat the run with N realisations of its random loads, on all cores: means with their 95 %
    /// intervals, and their errors of start, step, modes and sampling. Realisation k has the seeds
    /// of the case plus k - 1
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
    /// What kept parts of its errors from being known, in sentences.
    pub failures: Vec<String>,
    pub shortfall: Option<Error>,
}

/// The study of the realisations that are wanted, of which the run is the first; with `verdict`
/// also the errors of its means.
pub fn study(repeats: &Repeats<'_>, wanted: Wanted, verdict: bool) -> Result<Study> {
    let (ui, step) = (repeats.ui, repeats.run.grid.step);
    let mut members = vec![Realisation::of(1, repeats.run)];
    let (count, needed) = match wanted {
        Wanted::Count(count) => (count, None),
        Wanted::Within { share, most } => {
            members.extend(repeats.run("pilots", 2..=PILOTS, step)?);
            let needed = NeededRealisations::from_pilots(&members, share);
            let count = needed.as_ref().map_or(PILOTS, |needed| needed.count);
            ui.message(&pilots_in_words(needed.as_ref(), share, count.min(most)));
            (count.min(most), Some((share, count)))
        }
    };
    members.extend(repeats.run("realisations", members.len() as u64 + 1..=count, step)?);
    for member in members.iter().skip(1) {
        ui.refute(&format!("realisation {}", member.number), &member.findings);
    }
    let shortfall = needed.filter(|(_, needed)| *needed > count).and_then(|(share, needed)| {
        let widest = widest(&members)?;
        let quantity = format!("{} of {} {:?}", widest.measure.words(), widest.place.kind.word(), widest.place.name);
        let reached = widest.pilot_share;
        (reached > share).then_some(Error::Scattered { share, reached, quantity, count, needed })
    });
    let realisations = Realisations::new(members);
    if !verdict {
        return Ok(Study { realisations, failures: Vec::new(), shortfall });
    }
    let checks = ErrorChecks::of(repeats, count)?;
    Ok(Study { realisations: realisations.with_checks(checks.made), failures: checks.failures, shortfall })
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

impl Study {
    /// Writes `realisations.csv`, and `errors.csv` where errors are known.
    pub fn write(&self, results: &mut Results) -> Result<()> {
        output::write(&results.place(output::FILE)?, &self.realisations)?;
        if error_parts::has_any(&self.realisations) {
            error_parts::write(&results.place(error_parts::FILE)?, &self.realisations)?;
        }
        Ok(())
    }

    /// Shows its tables and the remarks on them.
    pub fn show(&self, answer: &mut Answer, case: &Case) {
        if let Some(table) = output::table(&self.realisations, &case.scene) {
            answer.table(table, "summary.json");
        }
        answer.messages(output::remarks(&self.realisations, &case.scene));
        if let Some(table) = error_parts::table(&self.realisations, &case.scene) {
            answer.table(table, error_parts::FILE);
        }
        answer.messages(error_parts::remarks(&self.realisations, &case.scene));
        answer.messages(self.failures.iter().cloned());
    }
}
