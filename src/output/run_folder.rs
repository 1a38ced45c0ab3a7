//! The folder of a run of a case, alone or as the first of several realisations: what was asked,
//! the run with what a drawing of it needs, its checks, and the files of what was found.

use super::animation::{self, animation};
use super::format::Formats;
use super::request::{extended, interval, request};
use super::results::Results;
use super::run::Picture;
use super::shape::{self, Shape};
use super::summary::{Checks, Reasons};
use super::{Span, error_parts, run, sector_means};
use crate::case::Case;
use crate::error::Result;
use crate::parallel::both;
use crate::run::{Options, Run, run_with_progress};
use crate::scheme::Method;
use crate::study::choice;
use crate::study::realisations::{RealisationCount, RealisationStudy};
use crate::study::truncation::Truncation;
use crate::study::verdict::Verdict;
use serde_json::{Map, Value, json};
use std::path::Path;

/// What decides how a case is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RunGoal {
    /// The step of the case; whether half of it, and more modes, are tried for a verdict.
    Step {
        /// Whether there is a verdict.
        verdict: bool,
    },
    /// An error of the motion.
    Motion {
        /// Share of the gap and of the contact statistics.
        accuracy: f64,
    },
    /// An error of means over realisations.
    Means {
        /// Share of the means.
        accuracy: f64,
        /// Most realisations.
        most_seeds: u64,
    },
}

/// What a run is asked for.
#[derive(Debug, Clone, Copy)]
pub struct RunRequest<'a> {
    /// The case, with its step.
    pub case: &'a Case,
    /// The scheme; `None` where the goal chooses it.
    pub method: Option<&'a Method>,
    /// What decides how it is run.
    pub goal: RunGoal,
    /// How many realisations are asked for, where any are.
    pub count: Option<RealisationCount>,
}

impl RunRequest<'_> {
    /// The request as it is recorded.
    #[must_use]
    pub fn recorded(&self) -> Map<String, Value> {
        let settings = match self.goal {
            RunGoal::Step { verdict } => json!({ "verdict": verdict }),
            RunGoal::Motion { accuracy } => json!({ "step_s": null, "accuracy": accuracy, "of": "motion" }),
            RunGoal::Means { accuracy, most_seeds } => {
                json!({ "step_s": null, "accuracy": accuracy, "of": "means", "most_seeds": most_seeds })
            }
        };
        let methods: Vec<Method> = self.method.into_iter().copied().collect();
        let asked = extended(request("run", self.case, &methods), settings);
        match self.count {
            None => asked,
            Some(RealisationCount::Exactly(count)) => extended(asked, json!({ "seeds": count })),
            Some(within) => extended(asked, interval(within)),
        }
    }

    /// Opens `folder`, which may hold results of this request, or with `force` anything. Files are
    /// written in `formats`.
    ///
    /// # Errors
    /// As [`Results::open`].
    pub fn open(&self, folder: &Path, force: bool, formats: Formats) -> Result<Results> {
        let mut results = Results::open(folder, self.recorded(), force, formats)?;
        results.add_to_manifest("title", json!(self.case.title));
        Ok(results)
    }
}

/// The run of `case` by `method`. Where it is `drawn`, writes into the folder `prefix` of the
/// results, their own where it is empty, the motion of the whole structure, `shape.csv`, and of a
/// structure with a line `animation.svg`. `progress` is called with the time (s) that it has
/// reached.
///
/// # Errors
/// As [`run_with_progress`]; [`crate::Error::Io`].
pub fn drawn_run(
    results: &mut Results,
    prefix: &str,
    case: &Case,
    method: &Method,
    drawn: bool,
    progress: &mut dyn FnMut(f64),
) -> Result<Run> {
    let shape = if drawn { Shape::of(case) } else { Shape::default() };
    let mut run = run_with_progress(&shape.watched(case), method, &Options::new(case.time), progress)?;
    let moved = shape.take(&mut run);
    if !shape.is_empty() {
        let time = run.trajectory.time();
        shape.write(&results.place(&run::named(prefix, shape::FILE))?, time, &moved)?;
        let picture = shape.stations().and_then(|stations| animation(case, &stations, time, &moved));
        if let Some(svg) = picture {
            results.write(&run::named(prefix, animation::FILE), svg)?;
        }
    }
    Ok(run)
}

/// What half the step changes in `run` of `case` by `method`, and what more modes change, where
/// modes are left out. `progress` is called with the time (s) that the first has reached.
pub fn checks(
    case: &Case,
    (run, method): (&Run, &Method),
    progress: &mut dyn FnMut(f64),
) -> (Result<Verdict>, Option<Result<Truncation>>) {
    let with_more_modes = || match &case.truncated {
        None => Ok(None),
        Some(truncated) => Truncation::of(&truncated.whole, &truncated.reduction, run, method, &case.time, &mut |_| {}),
    };
    let (truncation, refinement) =
        both(with_more_modes, || Verdict::of(&case.scene, method, run, &case.time, progress));
    (refinement, truncation.transpose())
}

/// Writes the files of a study of realisations of `case`: `realisations.csv`, `errors.csv` where
/// errors are known, and of supports `sector-means.csv`.
pub fn write_study(results: &mut Results, case: &Case, study: &RealisationStudy) -> Result<()> {
    error_parts::write_study(results, study)?;
    if case.scene.supports.is_empty() {
        return Ok(());
    }
    sector_means::write(&results.place(sector_means::FILE)?, case, &study.realisations)
}

/// Writes the files of `run` of `case` by `method`, for the `reason`, with the `checks` made of it,
/// into the folder `prefix` of the results, their own where it is empty: the last files, since the
/// summary records the tables beside it. Pictures show the stretch `span`. Returns the summary.
pub fn write(
    results: &mut Results,
    prefix: &str,
    case: &Case,
    (run, method, reason): (&Run, &Method, String),
    checks: Checks<'_>,
    span: Span,
) -> Result<Value> {
    let reasons = Reasons { scheme: reason, qp: choice::qp_reason(method, &case.scene) };
    run::write(results, prefix, case, run, method, (&reasons, checks), Picture { span, look: 0 })
}
