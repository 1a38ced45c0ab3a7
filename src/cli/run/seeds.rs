//! `run --seeds`: the run under further realisations of its random loads.

use crate::case::Case;
use crate::cli::pipeline::Answer;
use crate::cli::realisations::{of_argument, seconds, share, show_errors};
use crate::cli::values;
use crate::error::{Error, Result};
use crate::output::{realisations as output, worn_means};
use crate::study::realisations::{MOST_REALISATIONS, RealisationCount, RealisationStudy, TimeLimit};

/// How often the run is repeated.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Seeds {
    /// Repeat the run with N realisations of its random loads, on all cores: means with their 95 %
    /// intervals, and their errors of start, step, modes and sampling. Realisation k has the seeds
    /// of the case plus k - 1
    #[arg(long = "seeds", value_name = "N", value_parser = values::whole, allow_negative_numbers = true)]
    pub(in crate::cli) count: Option<u64>,
    /// Repeat the run until the 95 % intervals of the work rates of supports (without supports, of
    /// the mean forces) are within this share of them, 5% or 0.05: six realisations say how many
    /// that takes (Stein)
    #[arg(long, value_name = "SHARE", conflicts_with = "count", allow_hyphen_values = true)]
    pub(in crate::cli) until_interval: Option<String>,
    /// Most realisations of --until-interval, and of --accuracy of means; exit code 1 where more
    /// are needed [default: 200]
    #[arg(long, value_name = "N")]
    pub(in crate::cli) most_seeds: Option<u64>,
    /// Most time of --until-interval: 10min, 90s. The pilots say how many realisations, with the
    /// checks for their errors, fit into it on this machine; exit code 1 where that are fewer than
    /// the interval needs. The pilots run in any case
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub(in crate::cli) most_time: Option<String>,
}

impl Seeds {
    /// The number of realisations of `case`, where any are asked for.
    ///
    /// # Errors
    /// [`Error::Invalid`](crate::Error::Invalid) for 0, for a share that is none, for a case
    /// without a random load, and where a seed would exceed 2^53.
    pub fn check(&self, case: &Case) -> Result<Option<RealisationCount>> {
        if let (Some(most), None) = (self.most_seeds, &self.until_interval) {
            let expected = "--until-interval beside it, or --accuracy of means over random loads or scattered starts: \
                            it is their limit";
            return Err(Error::invalid("--most-seeds", most, expected));
        }
        let limit = |text: &String| TimeLimit::from_now(seconds("--most-time", text)?);
        let limit = self.most_time.as_ref().map(limit).transpose()?;
        if let (Some(text), None) = (&self.most_time, &self.until_interval) {
            let expected = "--until-interval beside it: it limits the number of its realisations";
            return Err(Error::invalid("--most-time", text, expected));
        }
        let share = self.until_interval.as_ref().map(|text| share("--until-interval", text)).transpose()?;
        let count = RealisationCount::new(self.count, share, self.most_seeds, limit).map_err(of_argument)?;
        if let Some(count) = count {
            case.check_realisations(count).map_err(of_argument)?;
            case.realisation(count.most())?;
        }
        Ok(count)
    }

    /// Refuses a number and an interval beside the error of one motion.
    ///
    /// # Errors
    /// As [`Seeds::check`] of a case without a random load, and [`Error::Invalid`] of others.
    pub fn check_beside_motion(&self, case: &Case) -> Result<()> {
        let asked = Self { most_seeds: None, ..self.clone() };
        match asked.check(case)? {
            None => Ok(()),
            Some(count) => {
                let expected = "no realisations beside --accuracy of one motion";
                let argument = if self.count.is_some() { "--seeds" } else { "--until-interval" };
                Err(Error::invalid(argument, count.most(), expected))
            }
        }
    }

    /// The most realisations of `case` that an error of its means may take.
    ///
    /// # Errors
    /// [`Error::Invalid`] beside a number or an interval, which follow from the error; and where a
    /// seed would exceed 2^53.
    pub fn most_beside_accuracy(&self, case: &Case) -> Result<u64> {
        let expected = "no such argument beside --accuracy of means: the number of realisations follows from it, and \
                        --most-seeds limits it";
        if let Some(count) = self.count {
            return Err(Error::invalid("--seeds", count, expected));
        }
        if let Some(share) = &self.until_interval {
            return Err(Error::invalid("--until-interval", share, expected));
        }
        if let Some(text) = &self.most_time {
            return Err(Error::invalid("--most-time", text, expected));
        }
        let most = self.most_seeds.unwrap_or(MOST_REALISATIONS);
        case.realisation(most.max(1))?;
        Ok(most)
    }
}

/// The number of realisations of `case`, where `count` asks for any.
///
/// # Errors
/// As [`Seeds::check`].
pub fn checked(count: Option<u64>, case: &Case) -> Result<Option<u64>> {
    let seeds = Seeds { count, ..Seeds::default() };
    Ok(seeds.check(case)?.map(RealisationCount::most))
}

/// Shows the tables of `study` and the remarks on them.
pub fn show(study: &RealisationStudy, answer: &mut Answer, case: &Case) {
    if let Some(table) = output::table(&study.realisations, &case.scene) {
        answer.table(table, "summary.json");
    }
    answer.messages(output::remarks(&study.realisations, &case.scene));
    if let Some(table) = worn_means::table(case, &study.realisations) {
        answer.table(table, "summary.json");
        answer.messages(worn_means::remarks(case, &study.realisations));
        let warnings = worn_means::warnings(case, &study.realisations);
        answer.messages(warnings.into_iter().map(|words| format!("note: {words}")));
    }
    show_errors(study, answer, case);
}
