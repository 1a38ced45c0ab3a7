//! Studies of several runs: their results as lists and dictionaries, from which the Python half
//! makes tables.

use crate::case::{Case, value};
use crate::error::raise;
use crate::json::{list, loads};
use crate::plan::Plan;
use crate::realisations::{RunsDone, count, means_told, study_from, texts};
use crate::run::Run;
use crate::subject::Subject;
use crate::sweep::{Caution, pair};
use crate::work::compute_beside;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde_json::{Value, json};
use signorini as sg;
use signorini::output::method_realisations as output;
use signorini::study::compare::{MethodStudies, MethodStudy, compare};
use signorini::study::realisations::{KnownRealisations, checked};
use signorini::study::stability::family::MapRequest;
use signorini::study::stability::plan::{Grid, Plan as Maps};
use signorini::study::work_precision::{self, Effort, Outcome, Quantity, Steps};
use signorini::sweep::{Axis, Measure, Sample, Samples, Sweep, Window};

fn dict<'py>(py: Python<'py>, items: impl FnOnce(&Bound<'py, PyDict>) -> PyResult<()>) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    items(&dict)?;
    Ok(dict)
}

/// Rows, findings, the time up to which errors are taken, and the methods under all realisations.
type Compared<'py> = (Bound<'py, PyList>, Vec<String>, f64, Bound<'py, PyAny>);

/// Compares the methods; with `seeds` also under so many realisations, with `verdict` with the
/// errors of their means.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
pub fn _compare<'py>(
    py: Python<'py>,
    scene: Subject<'py>,
    methods: Vec<String>,
    step: Option<f64>,
    sample: Option<f64>,
    statistics_from: Option<f64>,
    seeds: Option<i64>,
    verdict: bool,
    progress: Py<PyAny>,
) -> PyResult<Compared<'py>> {
    let methods = scene.methods(&methods)?;
    let inner = scene.inner();
    let time = scene.time(step, sample, statistics_from)?;
    let case = scene.case();
    let count = case.map(|case| count((seeds, None, None), None, case)).transpose()?.flatten();
    let done = RunsDone::default();
    let work = || {
        let comparison = compare(inner, &methods, &time, &|_| {})?;
        let studies = case.zip(count).map(|(case, count)| {
            MethodStudies::of(&comparison, count.most(), &mut |run, method| {
                let plan = Plan { method: *method, time };
                study_from(run, (case, &plan), (count, checked(verdict)), KnownRealisations::default(), &done)
            })
        });
        Ok((comparison, studies.transpose()?))
    };
    let (comparison, studies) = compute_beside(py, work, &mut |py| done.tell(progress.bind(py)))?;
    let told = case.zip(studies).map(|(case, studies)| methods_told(&studies, case));
    let rows = comparison.rows.into_iter().map(|row| {
        dict(py, |d| {
            d.set_item("method", row.method.to_string())?;
            d.set_item("error", row.error)?;
            d.set_item("agrees_until_s", row.agrees_until)?;
            d.set_item("restitution", row.restitution.map(|e| e.median))?;
            d.set_item("step_ns", row.step_ns)?;
            d.set_item("failure", row.outcome.as_ref().err().map(ToString::to_string))?;
            d.set_item("note", row.outcome.as_ref().ok().and_then(|run| run.cautions.first()))?;
            d.set_item("refuted", row.outcome.as_ref().ok().and_then(sg::Run::refuted).map(|e| e.to_string()))?;
            d.set_item("run", row.outcome.ok().map(|run| Run::of(&scene.scene, run, time)))
        })
    });
    let rows = list(py, rows.collect::<PyResult<Vec<_>>>()?)?;
    Ok((rows, comparison.findings, comparison.horizon, loads(py, &json!(told).to_string())?))
}

/// The methods under all realisations, as the Python half reads them.
fn methods_told(studies: &MethodStudies, case: &sg::case::Case) -> Value {
    let one = |one: &MethodStudy| {
        let study = means_told(&one.study, case);
        json!({ "method": one.method, "study": study, "differences": one.differences })
    };
    let tables = [output::table(studies, &case.scene), output::error_table(studies, &case.scene)];
    let failures = |of_check: bool| {
        let failures = studies.failures.iter().filter(move |failure| failure.refined.is_some() == of_check);
        failures.map(ToString::to_string)
    };
    json!({
        "count": studies.count,
        "reference": studies.reference,
        "methods": studies.methods.iter().map(one).collect::<Vec<_>>(),
        "table": output::cells(studies),
        "text": texts(tables),
        "remarks": output::remarks(studies),
        "warnings": output::warnings(studies).into_iter().chain(failures(false)).collect::<Vec<_>>(),
        "unknown": failures(true).collect::<Vec<_>>(),
    })
}

#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
pub fn _chart<'py>(
    py: Python<'py>,
    scene: Subject<'py>,
    methods: Option<Vec<String>>,
    coarsest: Option<f64>,
    finest: Option<f64>,
    levels: Option<u32>,
    repeats: u32,
    most_seconds: f64,
) -> PyResult<(Bound<'py, PyList>, String, f64)> {
    let methods = match methods {
        Some(methods) => scene.methods(&methods)?,
        None => work_precision::default_methods(scene.inner(), scene.laws()).0,
    };
    let effort = Effort { steps: Steps { coarsest, finest, levels }, repeats, most_seconds };
    let inner = scene.inner();
    let chart = compute_beside(py, || work_precision::study(inner, &methods, &effort, &|_| {}), &mut |_| Ok(()))?;
    let rows = list(py, Vec::<i32>::new())?;
    for series in &chart.series {
        for point in &series.points {
            rows.append(dict(py, |d| {
                d.set_item("method", series.method.to_string())?;
                d.set_item("kind", series.method.scheme.entry().kind.name())?;
                d.set_item("step_s", point.step)?;
                let measured = point.measured();
                d.set_item("seconds", measured.map(|m| m.seconds))?;
                for (name, quantity) in [
                    ("displacement_error", Quantity::Displacement),
                    ("impulse_error", Quantity::Impulse),
                    ("contact_time_error", Quantity::ContactTime),
                ] {
                    d.set_item(name, measured.and_then(|m| quantity.of(&m.errors)))?;
                }
                d.set_item(
                    "failure",
                    match &point.outcome {
                        Outcome::Ran(_) => None,
                        Outcome::Failed(error) => Some(error.to_string()),
                        Outcome::LeftOut(seconds) => Some(format!("left out: it would take {seconds:.1} s")),
                        _ => Some("not run".to_owned()),
                    },
                )
            })?)?;
        }
    }
    Ok((rows, chart.reference.how, chart.horizon.end))
}

/// Rows of cells, and a row for each scheme with its largest stable step.
#[pyfunction]
pub fn _stability<'py>(
    py: Python<'py>,
    scene: Subject<'py>,
    finest: Option<f64>,
    coarsest: Option<f64>,
    per_decade: Option<f64>,
    contacts: Option<usize>,
) -> PyResult<(Bound<'py, PyList>, Bound<'py, PyList>)> {
    let inner = scene.inner();
    let mut grid = Grid::of(inner);
    grid.finest = finest.unwrap_or(grid.finest);
    grid.coarsest = coarsest.unwrap_or(grid.coarsest);
    grid.per_decade = per_decade.unwrap_or(grid.per_decade);
    grid.contacts = contacts.unwrap_or(grid.contacts);
    let question = MapRequest { scene: inner, laws: scene.laws() };
    let maps = compute_beside(py, || Maps::new(question, &grid)?.run(&|_| {}), &mut |_| Ok(()))?;
    let (cells, stable) = (PyList::empty(py), PyList::empty(py));
    for row in &maps.rows {
        let subject = &row.subject;
        let name = |d: &Bound<'_, PyDict>| {
            d.set_item("scheme", subject.family.to_string())?;
            d.set_item("parameter", subject.parameter.name())?;
            d.set_item("value", subject.value)
        };
        for cell in &row.cells {
            cells.append(dict(py, |d| {
                name(d)?;
                d.set_item("step_s", cell.step)?;
                d.set_item("class", cell.class.name())?;
                d.set_item("reason", &cell.reason)
            })?)?;
        }
        if let Some(found) = &row.stable {
            stable.append(dict(py, |d| {
                name(d)?;
                d.set_item("stable_step_s", found.step)?;
                d.set_item("beyond", found.beyond.as_ref().map(|cell| format!("{}: {}", cell.class, cell.reason)))
            })?)?;
        }
    }
    Ok((cells, stable))
}

/// Rows of samples, and what limits the use of each run.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
pub fn _bifurcation<'py>(
    case: &Bound<'py, Case>,
    key: &str,
    values: Vec<Bound<'py, PyAny>>,
    scheme: &str,
    settle: u32,
    keep: u32,
    follow: &str,
    samples: &str,
    threads: usize,
) -> PyResult<(Bound<'py, PyList>, Vec<Caution>)> {
    let py = case.py();
    let values = values.iter().map(|x| value(key, x)).collect::<PyResult<Vec<_>>>()?;
    let axis = Axis::list(key, &values).map_err(raise)?.followed(follow.parse().map_err(raise)?);
    let samples: Samples = samples.parse().map_err(raise)?;
    let sweep = Sweep::new(case.get().file.clone())
        .vary(axis)
        .over(Window::Periods { settle, keep })
        .by(scheme)
        .measure([Measure::Contacts])
        .sample(samples, usize::MAX);
    let rows = compute_beside(py, || sweep.plan()?.rows(threads), &mut |_| Ok(()))?;
    let (list, mut cautions) = (PyList::empty(py), Vec::new());
    for row in rows {
        cautions.push(pair(row.caution.clone()));
        let name = |d: &Bound<'_, PyDict>| {
            let first = row.values.first();
            d.set_item("value", first.and_then(sg::case::KeyValue::number))?;
            d.set_item("direction", row.direction)?;
            d.set_item("error", Some(&row.error).filter(|text| !text.is_empty()))
        };
        if row.samples.is_empty() {
            list.append(dict(py, name)?)?;
        }
        for sample in &row.samples {
            list.append(dict(py, |d| {
                name(d)?;
                match sample {
                    Sample::Impact { wall, start, phase, approach, departure, impulse } => {
                        d.set_item("wall", wall)?;
                        d.set_item("time_s", start)?;
                        d.set_item("phase_cycles", phase)?;
                        d.set_item("approach_speed_m_per_s", approach)?;
                        d.set_item("departure_speed_m_per_s", departure)?;
                        d.set_item("impulse_N_s", impulse)
                    }
                    Sample::Strobe { time, seen } => {
                        d.set_item("time_s", time)?;
                        let [q, v] = seen.first().copied().unwrap_or([f64::NAN; 2]);
                        d.set_item("displacement_m", q)?;
                        d.set_item("velocity_m_per_s", v)
                    }
                    _ => Ok(()),
                }
            })?)?;
        }
    }
    Ok((list, cautions))
}
