//! Many runs side by side: a row of numbers for each; motions are not kept.

use crate::case::{Case, value};
use crate::error::{raise, wrong};
use crate::plan::Plan;
use crate::realisations::{self, Asked};
use crate::scene::Scene;
use crate::work::{compute_beside, kept};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use signorini as sg;
use signorini::WallStatistics;
use signorini::case::KeyValue;
use signorini::parallel::{Take, on_threads};
use signorini::study::realisations::RealisationCount;
use signorini::sweep::{Axis, Finished, Measure, Random, Shard, Sweep, SweepOptions, Values, Window};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// A number of a wall; nan where there is none.
type Number = fn(&WallStatistics) -> f64;

/// The columns of a wall: the name, with the wall's name for {}, and the statistic.
const COLUMNS: [(&str, Number); 13] = [
    ("contacts_{}", |w| w.contacts as f64),
    ("contact_rate_{}_per_s", |w| w.contact_rate_per_s),
    ("contact_rate_half_width_95_{}_per_s", |w| w.half_width_95.map_or(f64::NAN, |h| h.contact_rate_per_s)),
    ("contact_time_ratio_{}", |w| w.contact_time_ratio),
    ("impulse_{}_N_s", |w| w.force.map_or(f64::NAN, |f| f.impulse_n_s)),
    ("force_mean_{}_N", |w| w.force.map_or(f64::NAN, |f| f.mean_n)),
    ("force_mean_half_width_95_{}_N", |w| w.force.and_then(|f| f.mean_half_width_95_n).unwrap_or(f64::NAN)),
    ("force_rms_{}_N", |w| w.force.map_or(f64::NAN, |f| f.rms_n)),
    ("peak_force_{}_N", |w| w.episode_peak_force_n.max.unwrap_or(f64::NAN)),
    ("impulse_max_{}_N_s", |w| w.episode_impulse_n_s.max.unwrap_or(f64::NAN)),
    ("impact_power_{}_W", |w| w.impact_power_w),
    ("impact_power_half_width_95_{}_W", |w| w.half_width_95.map_or(f64::NAN, |h| h.impact_power_w)),
    ("arrived_less_departed_power_{}_W", |w| w.arrived_less_departed_power_w),
];

/// The names of the columns for walls of these names.
#[pyfunction]
pub fn _columns(walls: Vec<String>) -> Vec<String> {
    walls.iter().flat_map(|wall| COLUMNS.map(|(name, _)| name.replace("{}", wall))).collect()
}

/// A column, its name without the place, what the place is, and the place.
type Placed = (String, String, Option<&'static str>, String);

/// The columns of these measures in the tables of a sweep over the case, those that have a place.
#[pyfunction]
pub fn _placed_columns(case: &Case, measures: Vec<String>) -> PyResult<Vec<Placed>> {
    let mut placed = Vec::new();
    for name in measures {
        let measure: Measure = name.parse().map_err(raise)?;
        let columns = measure.placed_columns(&case.case.scene).into_iter();
        placed.extend(columns.map(|one| (one.column, one.quantity, measure.scope().word(), one.place)));
    }
    Ok(placed)
}

/// The unit of the values of a key of the case format, as column names write it.
#[pyfunction]
pub fn _unit(key: &str) -> Option<&'static str> {
    key.parse::<sg::case::Key>().ok().and_then(|key| key.unit())
}

/// What limits the use of a run: a note, and that it has not settled.
pub type Caution = (Option<String>, Option<String>);

/// The same as Python has it.
pub fn pair(caution: sg::Caution) -> Caution {
    (caution.note, caution.unsettled)
}

/// What limits the use of several runs, in sentences.
#[pyfunction]
pub fn _cautioned(cautions: Vec<Caution>) -> Vec<String> {
    let mut found = sg::Cautioned::default();
    for (number, (note, unsettled)) in (1..).zip(cautions) {
        let mut caution = sg::Caution::default();
        (caution.note, caution.unsettled) = (note, unsettled);
        found.add(number, caution);
    }
    found.sentences().collect()
}

/// A row of numbers for each scene, the reason where there is none, and what limits its use.
type Rows<'py> = (Bound<'py, PyArray2<f64>>, Vec<Option<String>>, Vec<Caution>);

/// The number of walls of each scene, which must have the names of those of the first.
fn common_walls(scenes: &[Scene]) -> PyResult<usize> {
    let names = |scene: &Scene| scene.scene.walls.iter().map(|wall| wall.name.clone()).collect::<Vec<_>>();
    let walls = scenes.first().map_or_else(Vec::new, names);
    match scenes.iter().map(names).find(|other| *other != walls) {
        None => Ok(walls.len()),
        Some(other) => Err(PyValueError::new_err(format!(
            "walls are {}; expected {}, as in the first scene: rows of one table have one set of columns",
            listed(&other),
            listed(&walls)
        ))),
    }
}

/// Names beside one another, or that there are none.
fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// Runs scenes on threads without the interpreter's lock.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
pub fn _run_many<'py>(
    py: Python<'py>,
    scenes: Vec<Scene>,
    scheme: Option<&str>,
    step: Option<f64>,
    statistics_from: f64,
    judge: bool,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<Rows<'py>> {
    let width = COLUMNS.len() * common_walls(&scenes)?;
    let plans = scenes
        .iter()
        .map(|scene| {
            // Two rows only: the motion is not kept.
            let plan = Plan::new(&scene.scene, scheme, step, Some(scene.scene.duration), statistics_from)?;
            plan.check_step(step)?;
            Ok(plan)
        })
        .collect::<PyResult<Vec<_>>>()?;
    let mut table = vec![f64::NAN; width * scenes.len()];
    let (mut errors, mut cautions) = (vec![None; scenes.len()], vec![(None, None); scenes.len()]);
    let finished = AtomicUsize::new(0);
    let work = |index: u64, send: &mut Take<'_, (usize, Numbers)>| {
        let index = index as usize;
        if let (Some(scene), Some(plan)) = (scenes.get(index), plans.get(index)) {
            let outcome = match numbers(&scene.scene, plan, judge) {
                Err(sg::Error::Stopped) => return Err(sg::Error::Stopped),
                outcome => {
                    outcome.map_err(|error| kept().map_or_else(|| error.to_string(), |raised| raised.to_string()))
                }
            };
            send((index, outcome));
        }
        Ok(())
    };
    let mut receive = |row: Option<(usize, Numbers)>| {
        if let Some((index, outcome)) = row {
            match outcome {
                Ok((row, caution)) => {
                    table[width * index..width * (index + 1)].copy_from_slice(&row);
                    cautions[index] = caution;
                }
                Err(reason) => errors[index] = Some(reason),
            }
            finished.fetch_add(1, Ordering::Relaxed);
        }
        Ok(())
    };
    let mut watch = |py: Python<'_>| match &progress {
        Some(progress) => progress.bind(py).call1((finished.load(Ordering::Relaxed),)).map(drop),
        None => Ok(()),
    };
    compute_beside(py, || on_threads(scenes.len() as u64, threads, &work, &mut receive), &mut watch)?;
    Ok((PyArray1::from_vec(py, table).reshape([scenes.len(), width])?, errors, cautions))
}

/// The numbers of a run and what limits their use, or the reason why there are none.
type Numbers = Result<(Vec<f64>, Caution), String>;

/// The numbers of one run.
fn numbers(scene: &sg::Scene, plan: &Plan, judge: bool) -> sg::Result<(Vec<f64>, Caution)> {
    let options = sg::Options::new(plan.time);
    let (caution, statistics) = if judge {
        let run = sg::run(scene, &plan.method, &options)?.unrefuted()?;
        (run.caution(), run.statistics)
    } else {
        let run = sg::run(scene, &plan.method, &options.unjudged())?;
        (run.caution(), run.statistics)
    };
    let numbers = statistics.walls.iter().flat_map(|wall| COLUMNS.map(|(_, number)| number(wall))).collect();
    Ok((numbers, pair(caution)))
}

/// Notes that limit the use of the table, the number of rows, how many failed, and the first of
/// these.
type Outcome = (Vec<String>, u64, u64, Option<String>);

/// True for the word that stands after the bounds of a value whose logarithm is drawn.
fn is_log(value: &Bound<'_, PyAny>) -> bool {
    value.extract::<String>().is_ok_and(|word| word == "log")
}

/// A random design: its kind, its number of rows and its seed.
type Drawn = (String, Option<u64>, Option<u64>);

/// The values of `key`: a list, or where they are `drawn` between two bounds these, the word "log"
/// after them where their logarithm is.
fn values_of(key: &str, values: &[Bound<'_, PyAny>], drawn: bool) -> PyResult<Values> {
    let log = drawn && values.len() == 3 && values.last().is_some_and(is_log);
    let own = if log { &values[..2] } else { values };
    let own = own.iter().map(|one| value(key, one)).collect::<PyResult<Vec<_>>>()?;
    let numbers: Option<Vec<f64>> = own.iter().map(KeyValue::number).collect();
    Ok(match numbers.as_deref() {
        Some(&[from, to]) if drawn => Values::Range { from, to, log },
        _ => Values::List(own),
    })
}

/// `sweep` with values drawn at random, where that is asked for.
fn drawn(sweep: Sweep, random: Option<Drawn>) -> PyResult<Sweep> {
    let Some((design, rows, seed)) = random else { return Ok(sweep) };
    let Some(points) = rows.filter(|rows| *rows > 0) else {
        let found = rows.map_or_else(|| "missing".to_owned(), |rows| rows.to_string());
        return Err(wrong("rows", found, "the number of rows to draw at random, 1 or more"));
    };
    Ok(sweep.drawn(Random { design: design.parse().map_err(raise)?, points, seed }))
}

/// `sweep` with rows of so many realisations, where several are asked for.
fn repeated(sweep: Sweep, given: Asked) -> PyResult<Sweep> {
    Ok(match realisations::asked(given, None)? {
        None => sweep,
        Some(RealisationCount::Within { share, most, .. }) => sweep.until_interval(share, Some(most)).map_err(raise)?,
        Some(count) => sweep.realisations(count.most()),
    })
}

/// `sweep` with the window of its measures in forcing periods, where they are given: so many before
/// it, and in it.
fn timed(sweep: Sweep, (settle, keep): (Option<u32>, Option<u32>)) -> PyResult<Sweep> {
    match (settle, keep) {
        (_, Some(keep)) => Ok(sweep.over(Window::Periods { settle: settle.unwrap_or(0), keep })),
        (Some(settle), None) => Err(wrong("settle", settle, "keep beside it: the forcing periods in the window")),
        (None, None) => Ok(sweep),
    }
}

/// Varies the keys of a case over a grid, one at a time between two bounds, or at random between
/// them, and writes the tables into `folder`. Calls `progress` with the runs that are done and
/// those that are known to be needed.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
pub fn _sweep(
    py: Python<'_>,
    case: &Case,
    axes: Vec<(String, Vec<Bound<'_, PyAny>>)>,
    one_at_a_time: bool,
    random: Option<Drawn>,
    scheme: Option<&str>,
    measures: Vec<String>,
    periods: (Option<u32>, Option<u32>),
    asked: Asked,
    threads: Option<usize>,
    folder: PathBuf,
    progress: Py<PyAny>,
) -> PyResult<Outcome> {
    let mut sweep = Sweep::new(case.file.clone());
    for (key, values) in axes {
        let values = values_of(&key, &values, one_at_a_time || random.is_some())?;
        sweep = sweep.vary(Axis::new(&key, values).map_err(raise)?);
    }
    if one_at_a_time {
        sweep = sweep.one_at_a_time();
    }
    if let Some(scheme) = scheme {
        sweep = sweep.by(scheme);
    }
    sweep = timed(repeated(drawn(sweep, random)?, asked)?, periods)?;
    sweep = sweep.measure(measures.iter().map(|name| name.parse().map_err(raise)).collect::<PyResult<Vec<_>>>()?);
    let (done, runs, mut notes) = (AtomicU64::new(0), AtomicU64::new(0), Vec::new());
    let work = || {
        let plan = sweep.plan()?;
        // What concerns the result; the other notes are those of the case, which has them.
        notes.extend(plan.case().large_random_forces());
        let options = SweepOptions { threads, shard: Shard::WHOLE, force: false };
        plan.run_into(&folder, options, &|progress| {
            done.store(progress.done, Ordering::Relaxed);
            runs.store(progress.runs, Ordering::Relaxed);
        })
    };
    let mut watch = |py: Python<'_>| {
        progress.bind(py).call1((done.load(Ordering::Relaxed), runs.load(Ordering::Relaxed))).map(drop)
    };
    let Finished { rows, tables, cautioned, .. } = compute_beside(py, work, &mut watch)?;
    notes.extend(tables.instabilities().into_iter().chain(cautioned.sentences()));
    Ok((notes, rows, tables.bad(), tables.first_error))
}
