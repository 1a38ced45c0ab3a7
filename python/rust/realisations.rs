//! Means over realisations of the random loads of a case.

use crate::case::Case;
use crate::error::{raise, wrong};
use crate::json::loads;
use crate::plan::Plan;
use crate::run_folder::{RunFolder, reason, stepped};
use crate::work::compute_beside;
use pyo3::prelude::*;
use serde_json::{Value, json};
use signorini as sg;
use signorini::output::run_folder::{RunGoal, RunRequest};
use signorini::output::table::Table;
use signorini::output::{error_parts, realisations as output, sector_means, worn_means};
use signorini::study::accuracy::Accuracy;
use signorini::study::realisations::{
    Batch, KnownRealisations, MOST_REALISATIONS, Realisation, RealisationCount, RealisationPlan, RealisationStudy,
    Realisations, TimeLimit, checked,
};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

/// How many realisations are asked for: a number, or the share of an interval with the most that
/// it may take.
pub type Asked = (Option<i64>, Option<f64>, Option<i64>);

/// The number of realisations that is asked for, in at most `most_time` seconds from now on where
/// that is given.
///
/// # Errors
/// `ValueError` for numbers that make no sense.
pub fn asked((seeds, until_interval, most): Asked, most_time: Option<f64>) -> PyResult<Option<RealisationCount>> {
    let count = |name: &str, count: Option<i64>| {
        count.map(|count| u64::try_from(count).map_err(|_| wrong(name, count, "1 or more realisations"))).transpose()
    };
    let (seeds, most) = (count("seeds", seeds)?, count("most_seeds", most)?);
    let limit = most_time.map(TimeLimit::from_now).transpose().map_err(raise)?;
    RealisationCount::new(seeds, until_interval, most, limit).map_err(raise)
}

/// How far a study is: runs that are done, in thousandths, and the runs of all batches that have
/// begun.
#[derive(Default)]
pub struct RunsDone {
    thousandths: AtomicU64,
    runs: AtomicU64,
}

impl RunsDone {
    /// Calls Python's `progress` with the runs that are done and those that are known of.
    pub fn tell(&self, progress: &Bound<'_, PyAny>) -> PyResult<()> {
        let done = self.thousandths.load(Ordering::Relaxed) / 1000;
        progress.call1((done, self.runs.load(Ordering::Relaxed))).map(drop)
    }

    /// Begins a batch of `count` runs; what is returned is called with the share of them done.
    pub fn begin(&self, count: u64) -> impl FnMut(f64) {
        let before = 1000 * self.runs.fetch_add(count, Ordering::Relaxed);
        move |share| self.thousandths.store(before + (1000.0 * share * count as f64) as u64, Ordering::Relaxed)
    }
}

/// The number of realisations of `case` that is asked for.
///
/// # Errors
/// As [`asked`]; `ValueError` for a case without random loads.
pub fn count(given: Asked, most_time: Option<f64>, case: &sg::case::Case) -> PyResult<Option<RealisationCount>> {
    let count = asked(given, most_time)?;
    if let Some(count) = count {
        case.check_realisations(count).and_then(|()| case.realisation(count.most())).map_err(raise)?;
    }
    Ok(count)
}

/// The first run of a study, with what a drawing of it needs in `folder` where there is one.
pub fn first_run(
    (case, plan): (&sg::case::Case, &Plan),
    folder: Option<&mut RunFolder>,
    done: &RunsDone,
) -> sg::Result<sg::Run> {
    let mut first = done.begin(1);
    let end = case.scene.duration;
    let mut progress = |time| first(time / end);
    match folder {
        Some(folder) => folder.run(case, &plan.method, &mut progress),
        None => sg::run_with_progress(&case.scene, &plan.method, &sg::Options::new(plan.time), &mut progress),
    }
}

/// What limits the use of `study`.
pub fn cautions(study: &RealisationStudy, case: &sg::case::Case) -> Vec<String> {
    let found = &study.realisations;
    let groups = found.groups_in_words().into_iter().chain(study.wider_in_words());
    groups.chain(found.cautioned().sentences()).chain(case.instability()).collect()
}

/// The study of `count` realisations of `case` from its first `run`, of which so many are
/// `checked`; those in `known` are not run again.
pub fn study_from(
    run: &sg::Run,
    (case, plan): (&sg::case::Case, &Plan),
    (count, checked): (RealisationCount, u64),
    mut known: KnownRealisations,
    done: &RunsDone,
) -> sg::Result<RealisationStudy> {
    let Plan { method, time } = plan;
    let plan = RealisationPlan { scenes: case, run, method, time: *time, count, checked };
    let mut make = |batch: &Batch<'_>| known.complete(batch, &mut |missing| made(missing, done));
    plan.follow(&mut make, &mut |_| {})
}

/// Runs `batch`, and counts its runs.
fn made(batch: &Batch<'_>, done: &RunsDone) -> sg::Result<Vec<Realisation>> {
    batch.run(&mut done.begin(batch.count()))
}

/// What a study of a case is asked for.
struct Study<'a> {
    case: &'a sg::case::Case,
    plan: Plan,
    /// Why this method.
    reason: String,
    folder: Option<PathBuf>,
}

/// A study, what was reached where an accuracy was asked for, and what is to be warned of.
struct Found {
    study: RealisationStudy,
    notes: Vec<String>,
    accuracy: Option<Accuracy>,
    /// What is not known of its first run.
    unknown: Vec<String>,
}

impl Study<'_> {
    /// The folder of the results, where one is asked for.
    fn open(&self, goal: RunGoal, count: Option<RealisationCount>) -> sg::Result<Option<RunFolder>> {
        let asked = RunRequest { case: self.case, method: Some(&self.plan.method), goal, count };
        self.folder.as_deref().map(|path| RunFolder::open(path, &asked)).transpose()
    }

    /// So many realisations, with `verdict` also the errors of their means.
    fn counted(self, count: RealisationCount, verdict: bool, done: &RunsDone) -> sg::Result<Found> {
        let mut folder = self.open(RunGoal::Step { verdict }, Some(count))?;
        let of = (self.case, &self.plan);
        let run = first_run(of, folder.as_mut(), done)?;
        let study = study_from(&run, of, (count, checked(verdict)), KnownRealisations::default(), done)?;
        self.found(&run, study, None, folder.map(|folder| (folder, verdict)))
    }

    /// The study at the step that keeps the error `share` of the means, from at most `most`
    /// realisations; `start_scatter` is recorded with what was reached.
    fn accurate(mut self, (share, most): (f64, u64), start_scatter: Option<f64>, done: &RunsDone) -> sg::Result<Found> {
        let mut folder = self.open(RunGoal::Means { accuracy: share, most_seeds: most }, None)?;
        let search = self.case.step_search(&self.plan.method, share, most);
        let found = search.find(&mut |batch| made(batch, done), &mut |_| {})?;
        self.plan.time = found.time;
        let case = &sg::case::Case { time: found.time, ..self.case.clone() };
        let own = Study { case, ..self };
        let of = (own.case, &own.plan);
        let run = first_run(of, folder.as_mut(), done)?;
        let mut study = study_from(&run, of, (found.count, found.pairs), found.known.clone(), done)?;
        let (mut accuracy, shortfall) = found.judge(&study);
        accuracy.start_scatter = start_scatter;
        study.shortfall = shortfall;
        own.found(&run, study, Some(accuracy), folder.map(|folder| (folder, false)))
    }

    /// What was found, with its files in the folder, whose run has a `verdict`.
    fn found(
        self,
        run: &sg::Run,
        study: RealisationStudy,
        accuracy: Option<Accuracy>,
        folder: Option<(RunFolder, bool)>,
    ) -> sg::Result<Found> {
        let (notes, made) = (cautions(&study, self.case), (run, &self.plan, self.reason));
        let write = |(folder, verdict): (RunFolder, bool)| {
            folder.write(self.case, made, (Some(&study), accuracy.as_ref()), verdict)
        };
        let unknown = folder.map(write).transpose()?.unwrap_or_default();
        Ok(Found { study, notes, accuracy, unknown })
    }
}

impl Found {
    /// The same as the Python half reads it.
    fn told(&self, case: &sg::case::Case) -> Value {
        let mut told = told(&self.study, &self.notes, case);
        if let Some(unknown) = told["unknown"].as_array_mut() {
            unknown.extend(self.unknown.iter().map(|text| json!(text)));
        }
        if let Some(accuracy) = &self.accuracy {
            told["accuracy"] = json!(accuracy);
        }
        told
    }
}

/// A study as the Python half reads it: `document` and `table` hold its numbers, `text` its tables
/// for people, `refuted` what makes its means wrong, `unknown` which parts of errors are not known.
pub fn told(study: &RealisationStudy, notes: &[String], case: &sg::case::Case) -> Value {
    let mut told = means_told(&study.realisations, case);
    // One finding of a run is enough, and one run of a check.
    let finding = |member: &Realisation| member.findings.first().map(ToString::to_string).unwrap_or_default();
    let members = study.refuted().filter(|(refined, _)| refined.is_none()).map(|(_, member)| member);
    let failed = study.failures.iter().map(|failed| (failed.refined, failed.error.to_string()));
    let refuted = study.realisations.checks.iter().filter_map(|check| {
        let (_, member) = study.refuted().find(|(refined, _)| *refined == Some(check.refined))?;
        Some((check.refined, format!("realisation {} is refuted: {}", member.number, finding(member))))
    });
    let unknown = failed.chain(refuted).map(|(refined, why)| format!("the check with {refined} failed: {why}"));
    told["refuted"] =
        members.map(|one| format!("realisation {}: {}", one.number, finding(one))).collect::<Vec<_>>().into();
    told["unknown"] = unknown.collect::<Vec<_>>().into();
    told["shortfall"] = json!(study.shortfall.as_ref().map(ToString::to_string));
    told["notes"] = json!(notes);
    told
}

/// The numbers and the tables of a study.
pub fn means_told(found: &Realisations, case: &sg::case::Case) -> Value {
    let worn = worn_means::table(case, found);
    let tables = [output::table(found, &case.scene), worn, error_parts::table(found, &case.scene)];
    json!({
        "document": found,
        "worn": worn_means::document(case, found),
        "table": output::cells(found),
        "sectors": sector_means::cells(case, found),
        "text": texts(tables),
    })
}

/// Tables for people, below one another.
pub fn texts(tables: impl IntoIterator<Item = Option<Table>>) -> String {
    let texts = tables.into_iter().flatten().map(|table| table.fit(None).text);
    texts.collect::<Vec<_>>().join("\n\n")
}

#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
pub fn _realisations<'py>(
    case: &Bound<'py, Case>,
    scheme: Option<&str>,
    step: Option<f64>,
    asked: Asked,
    most_time: Option<f64>,
    accuracy: Option<f64>,
    verdict: bool,
    folder: Option<PathBuf>,
    progress: Py<PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = case.py();
    let plan = case.get().plan(scheme, step)?;
    // The files have the step as the case's own.
    let stepped = stepped(&case.get().case, step.filter(|_| folder.is_some())).map_err(raise)?;
    let (case, reason) = (&*stepped, reason(&stepped, scheme));
    let done = RunsDone::default();
    let mut watch = |py: Python<'_>| done.tell(progress.bind(py));
    let found = match accuracy {
        Some(share) => {
            let most = most_beside_accuracy(asked, step, verdict)?;
            if let Some(seconds) = most_time {
                let expected = "none beside accuracy, which most_seeds limits";
                return Err(wrong("most_time", format!("{seconds:?}"), expected));
            }
            let start_scatter = (!case.is_random()).then(|| case.start_scatter());
            let case = &case.with_scattered_start().map_err(|error| match case.scene.walls.is_empty() {
                true => wrong("accuracy", format!("{share:?}"), "a case with a wall or support: its forces have means"),
                false => raise(error),
            })?;
            case.realisation(most.max(1)).map_err(raise)?;
            case.step_search(&plan.method, share, most).validate().map_err(raise)?;
            let study = Study { case, plan, reason, folder };
            let found = compute_beside(py, || study.accurate((share, most), start_scatter, &done), &mut watch)?;
            found.told(case)
        }
        None => {
            let Some(count) = count(asked, most_time, case)? else {
                return Err(wrong("seeds", "missing", "the number of realisations, until_interval or accuracy"));
            };
            let study = Study { case, plan, reason, folder };
            compute_beside(py, || study.counted(count, verdict, &done), &mut watch)?.told(case)
        }
    };
    loads(py, &found.to_string())
}

/// The most realisations that an accuracy may take, unless something stands beside it
/// from which it cannot be told.
fn most_beside_accuracy((seeds, until_interval, most): Asked, step: Option<f64>, verdict: bool) -> PyResult<u64> {
    let follows = "none beside accuracy: the number of realisations follows from it, and most_seeds limits it";
    if let Some(step) = step {
        return Err(wrong("step", format!("{step:?}"), "no step beside accuracy, which finds one"));
    }
    if let Some(count) = seeds {
        return Err(wrong("seeds", count, follows));
    }
    if let Some(share) = until_interval {
        return Err(wrong("until_interval", format!("{share:?}"), follows));
    }
    if !verdict {
        return Err(wrong("verdict", "False", "True beside accuracy: checks with half the step find the step"));
    }
    let most = most.map_or(Ok(MOST_REALISATIONS), u64::try_from);
    most.map_err(|_| wrong("most_seeds", "negative", "6 or more: so many are run first"))
}
