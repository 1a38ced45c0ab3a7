//! The folder of a study of wear over the years: what was asked, and the files of what was found.
//! An interrupted study goes on from its journal, and so does one of more years.

use super::format::Formats;
use super::request::{extended, interval, program, request, without_limit};
use super::results::Results;
use super::run_folder;
use super::summary::Checks;
use super::{Span, error_parts, realisations, sector_means, summary, turbulence, wear_history, wear_remarks};
use crate::case::Case;
use crate::error::Result;
use crate::run::Run;
use crate::scheme::Method;
use crate::study::realisations::{RealisationCount, RealisationStudy};
use crate::study::wear_history::{WearHistories, YEAR};
use serde_json::{Map, Value, json};
use std::path::Path;

/// The folder of the first window of the first history, with the files of a run.
pub const FIRST_WINDOW: &str = "first-window";

/// The key of the request that may grow: a study goes on to further years.
const YEARS: &str = "years";

/// What a study of wear is asked for.
#[derive(Debug, Clone, Copy)]
pub struct WearRequest<'a> {
    /// The case.
    pub case: &'a Case,
    /// The scheme.
    pub method: &'a Method,
    /// Time in service, years; that of the case where it is `None`.
    pub years: Option<f64>,
    /// How many histories are followed: a number, or as many as the interval of their first windows
    /// takes.
    pub count: RealisationCount,
    /// With an interval: whether the errors of the first windows are found.
    pub verdict: bool,
}

impl WearRequest<'_> {
    /// The request as it is recorded.
    fn recorded(&self) -> Result<Map<String, Value>> {
        let mut settings = match self.count {
            RealisationCount::Exactly(count) => json!({ "histories": count }),
            within => {
                let mut settings = interval(within);
                settings["verdict"] = json!(self.verdict);
                settings
            }
        };
        // As they were asked for: years in seconds and back may differ in the last digit.
        settings[YEARS] = json!(self.years.map_or_else(|| Ok(self.case.service(None)? / YEAR), Ok)?);
        // Windows are kept, and those of another version may differ.
        settings["program"] = json!(program());
        let own = without_limit(request("wear", self.case, &[*self.method]), self.case);
        Ok(extended(own, settings))
    }

    /// Opens `folder`, which may hold results of this study with as many years or fewer, with
    /// whatever limit, or with `force` anything. Files are written in `formats`.
    ///
    /// # Errors
    /// As [`Results::open`]; [`crate::Error::Invalid`] under `years` without a time in service.
    pub fn open(&self, folder: &Path, force: bool, formats: Formats) -> Result<Results> {
        Results::open_growing(folder, self.recorded()?, Some(YEARS), force, formats)
    }
}

/// Runs the first window of the first history of wear, `case` in its own gaps, by `method`, for the
/// `reason`, and writes its files into a folder of their own in `results`; where it is `drawn` also
/// the shape of the structure over time. `progress` is called with the time (s) that is reached.
///
/// # Errors
/// As [`crate::run_with_progress`]; [`crate::Error::Io`].
pub fn first_window(
    results: &mut Results,
    case: &Case,
    (method, reason): (&Method, String),
    drawn: bool,
    progress: &mut dyn FnMut(f64),
) -> Result<Run> {
    let run = run_folder::drawn_run(results, FIRST_WINDOW, case, method, drawn, progress)?;
    let span = Span { from: 0.0, to: case.scene.duration };
    run_folder::write(results, FIRST_WINDOW, case, (&run, method, reason), Checks::default(), span)?;
    Ok(run)
}

/// Writes the files of `histories` histories of wear at the supports of `case`: `history.csv`,
/// `years.csv`, `sector-means.csv`, of turbulence those of its forces, the picture `wear`, and
/// those of the study `first` of their first windows. The manifest has what a check of the first
/// window says (`checked`).
pub fn write(
    results: &mut Results,
    case: &Case,
    (found, histories): (&WearHistories, usize),
    (first, checked): (Option<&RealisationStudy>, &[String]),
) -> Result<()> {
    wear_history::write(results, found)?;
    turbulence::write(|name| results.place(name), case)?;
    sector_means::write_histories(&results.place(sector_means::FILE)?, case, found)?;
    if let Some(study) = first {
        error_parts::write_study(results, study)?;
        results.add_to_manifest("realisations", json!(study.realisations));
    }
    results.draw("wear", &wear_history::figure(case, found))?;
    let errors = first.iter().flat_map(|study| error_parts::remarks(&study.realisations, &case.scene));
    let answers = wear_remarks::remarks(case, found).into_iter().chain(errors);
    let answers: Vec<String> = answers.chain(checked.iter().cloned()).collect();
    for (key, value) in [
        ("title", json!(case.title)),
        ("case_file", case.document.json()?),
        ("remarks", json!(case.notes())),
        ("answers", json!(answers)),
        ("scene", summary::scene(case)),
        ("limit_m", json!(case.wear.limit)),
        ("seeds", realisations::seeds(case)),
        ("supports", json!(found.supports)),
        ("histories", json!(histories)),
        ("fluid_elastic", json!(case.fluid_elastic)),
    ] {
        results.add_to_manifest(key, value);
    }
    Ok(())
}
