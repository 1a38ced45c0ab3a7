//! Wear over the years of the supports of a case.

use crate::case::Case;
use crate::error::raise;
use crate::json::loads;
use crate::plan::Plan;
use crate::realisations::{RunsDone, cautions, count, first_run, study_from, texts, told};
use crate::run_folder::reason;
use crate::work::compute_beside;
use pyo3::prelude::*;
use serde_json::{Value, json};
use signorini as sg;
use signorini::output::format::{Format, Formats};
use signorini::output::results::Results;
use signorini::output::wear_folder::{self, WearRequest};
use signorini::output::wear_journal::WindowJournal;
use signorini::output::{first_window, run_folder, sector_means, wear_history as output, wear_remarks};
use signorini::report;
use signorini::study::realisations::{KnownRealisations, Realisation, RealisationCount, RealisationStudy, checked};
use signorini::study::wear_history::{USUAL_WINDOWS, WearHistories, WearPlan, WearWindow, WearingSupport};
use signorini::wear::Opening;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

/// Follows histories of wear: `histories` of them, or as many as the interval `within` takes after
/// a study of their first windows: a share, with the most that it may take and the seconds that it
/// may last; in `folder`, where one is given, from what it holds of this study. Calls `counted`
/// with the runs of that study, and `progress` with the per cent of the years that are done.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
pub fn _wear<'py>(
    case: &Bound<'py, Case>,
    scheme: Option<&str>,
    step: Option<f64>,
    years: Option<f64>,
    histories: Option<u64>,
    within: (Option<f64>, Option<i64>, Option<f64>),
    verdict: bool,
    folder: Option<PathBuf>,
    counted: Py<PyAny>,
    progress: Py<PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = case.py();
    let plan = case.get().plan(scheme, step)?;
    let case = &case.get().case;
    let supports = case.wearing_supports().map_err(raise)?;
    let service = case.service(years).map_err(raise)?;
    // A number beside an interval is refused.
    let beside = histories.filter(|_| within.0.is_some()).map(|count| count as i64);
    let (share, most, most_time) = within;
    let within = count((beside, share, most), most_time, case)?.map(|count| count.with_runs_each(USUAL_WINDOWS));
    let asked = case.histories(histories.map(|count| count as usize)).map_err(raise)?;
    let count = within.unwrap_or(RealisationCount::Exactly(asked as u64));
    let request = WearRequest { case, method: &plan.method, years, count, verdict };
    let formats = Formats { pictures: vec![Format::Svg], workbook: false };
    let open = |folder: PathBuf| request.open(&folder, false, formats).map_err(raise);
    let mut results = folder.map(open).transpose()?;
    let done = RunsDone::default();
    let work = || begun(case, (&plan, reason(case, scheme)), results.as_mut(), (within, verdict), &done);
    let (first, window, checked) = compute_beside(py, work, &mut |py| done.tell(counted.bind(py)))?;
    let study = first.as_ref().map(|(study, _)| study);
    let histories = study.map_or(asked, |study| study.realisations.members.len());
    let members = study.map_or(window.as_slice(), |study| &study.realisations.members);
    let found = followed(py, case, &plan, (&supports, histories, service), (members, results.as_mut()), &progress)?;
    if let Some(results) = &mut results {
        let written = wear_folder::write(results, case, (&found, histories), (study, &checked));
        written.and_then(|()| report::finish(results, true)).map_err(raise)?;
    }
    let mut known = wear_told(case, &plan, &found, histories);
    known["first"] = json!(first.as_ref().map(|(study, notes)| told(study, notes, case)));
    loads(py, &known.to_string())
}

/// A study, and the notes that limit its use.
type Noted = (RealisationStudy, Vec<String>);

/// The study of the first windows, where one is asked for `within` an interval, with the notes that
/// limit its use; and the first window, whose files are written into `results`, with what its check
/// says. Without results nothing is known of it before the histories are followed.
fn begun(
    case: &sg::case::Case,
    (plan, reason): (&Plan, String),
    results: Option<&mut Results>,
    (within, verdict): (Option<RealisationCount>, bool),
    done: &RunsDone,
) -> sg::Result<(Option<Noted>, Vec<Realisation>, Vec<String>)> {
    let written = results.is_some();
    let run = match results {
        Some(results) => {
            let mut first = done.begin(1);
            let mut progress = |time| first(time / case.scene.duration);
            wear_folder::first_window(results, case, (&plan.method, reason), true, &mut progress)?
        }
        None if within.is_none() => return Ok((None, Vec::new(), Vec::new())),
        None => first_run((case, plan), None, done)?,
    };
    let study = |count| {
        let asked = (count, checked(verdict));
        let study = study_from(&run, (case, plan), asked, KnownRealisations::default(), done)?;
        let notes = cautions(&study, case);
        Ok((study, notes))
    };
    // As the tool tells it on the page.
    let told = (written && verdict && within.is_none()).then(|| {
        let (step, modes) = run_folder::checks(case, (&run, &plan.method), &mut |_| {});
        first_window::remarks(&step, modes.as_ref())
    });
    Ok((within.map(study).transpose()?, vec![Realisation::of(1, &run)], told.unwrap_or_default()))
}

/// So many histories over `service` seconds, whose first windows begin with those of `members`,
/// beside the journal in `results` where there are any.
fn followed(
    py: Python<'_>,
    case: &sg::case::Case,
    plan: &Plan,
    (supports, histories, service): (&[WearingSupport], usize, f64),
    (members, results): (&[Realisation], Option<&mut Results>),
    progress: &Py<PyAny>,
) -> PyResult<WearHistories> {
    let options = sg::Options::new(plan.time);
    let scene = |number: u64, openings: &[Opening]| case.worn(number, supports, openings);
    let wear = WearPlan { supports, scene: &scene, method: &plan.method, options: &options, histories, service };
    let done = AtomicU64::new(0);
    let mut tell = |share: f64| done.store((100.0 * share) as u64, Ordering::Relaxed);
    let mut watch = |py: Python<'_>| progress.bind(py).call1((done.load(Ordering::Relaxed),)).map(drop);
    let follow = || match results {
        Some(results) => {
            WindowJournal::open(results, histories, false)?.follow(&wear, members, &mut tell).map(|(found, _)| found)
        }
        None => {
            let kept: Vec<WearWindow> = members.iter().map(|member| WearWindow::of(member, supports)).collect();
            wear.follow(&kept, &mut |_| Ok(()), &mut tell)
        }
    };
    compute_beside(py, follow, &mut watch)
}

/// The histories as the Python half reads them.
fn wear_told(case: &sg::case::Case, plan: &Plan, found: &WearHistories, histories: usize) -> Value {
    let notes = sg::foreseen(&case.scene, &plan.method.scheme, plan.time.step);
    let limits = found.cautioned.sentences().chain(case.instability());
    let notes: Vec<String> = notes.into_iter().chain(limits).collect();
    let remarks = [wear_remarks::remarks(case, found), case.notes()].concat();
    let refuted = found.refuted.iter();
    let refuted = refuted.filter_map(|(number, findings)| Some(format!("window {number}: {}", findings.first()?)));
    json!({
        "supports": found.supports,
        "histories": histories,
        "windows": found.windows,
        "limit": case.wear.limit,
        "years": output::years(found),
        "history": output::history(found),
        "sectors": sector_means::cells_of_histories(case, found),
        "limits": output::limits(case, found),
        "text": texts([Some(output::table(found))]),
        "remarks": remarks,
        "refuted": refuted.collect::<Vec<_>>(),
        "notes": notes,
    })
}
