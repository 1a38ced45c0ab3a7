//! Periodic orbits: of one degree of freedom by their events, of structures by their states.

use crate::derivative::{Key, tangents};
use crate::error::raise;
use crate::subject::Subject;
use crate::work::compute_beside;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use signorini as sg;
use signorini::orbit::{Orbit, Problem, Shot};
use signorini::output::first_orbit::FirstOrbit;
use signorini::output::varied::check_changes_orbits;
use signorini::study::orbit_derivatives::{Differentiated, OrbitDerivatives};
use signorini::variation::SceneTangent;
use signorini::{Path, Scheme, State, Stepper};

/// An orbit with its results.
struct Found {
    orbit: Orbit,
    multipliers: Vec<[f64; 2]>,
    stable: bool,
    /// Why no body can follow it.
    refused: Option<String>,
    closure: f64,
    /// Whether a free run comes back.
    holds: bool,
    /// Displacement and velocity of every degree of freedom at the first instant of the motion.
    state: State,
    motion: Motion,
    /// By keys, where any were asked for.
    derivatives: Option<OrbitDerivatives>,
}

/// Instants (s), displacement (m) and velocity (m/s) at one place.
type Motion = [Vec<f64>; 3];

/// The orbit on which a run settles, with `rows` rows of the motion over its period, and its
/// derivatives by `keys`.
#[pyfunction]
pub fn _orbit<'py>(
    py: Python<'py>,
    scene: Subject<'py>,
    settle: u32,
    rows: u32,
    keys: Vec<Key>,
) -> PyResult<Bound<'py, PyDict>> {
    let inner = scene.inner();
    scene.case().map_or(Ok(()), sg::case::Case::check_repeats).map_err(raise)?;
    keys.iter().try_for_each(|(key, ..)| check_changes_orbits("derivative", key)).map_err(raise)?;
    let tangents = &tangents(py, &keys)?[..];
    let work = || {
        let structure = matches!(inner.system, sg::System::Structure(_));
        let problem = if structure { None } else { Some(Problem::new(inner.clone())?) };
        match (FirstOrbit::settled(inner, problem.as_ref(), settle, &|_| {})?, &problem) {
            (FirstOrbit::Orbit(orbit), Some(problem)) => by_events(problem, orbit, rows, tangents),
            (FirstOrbit::Orbit(orbit), None) => by_events(&Problem::new(inner.clone())?, orbit, rows, tangents),
            (FirstOrbit::Shot(shot), _) => by_state(inner, shot, rows, tangents),
        }
    };
    let found = compute_beside(py, work, &mut |_| Ok(()))?;
    let wall = |index: usize| inner.walls.get(index).map(|wall| wall.name.clone());
    let events = &found.orbit.signature.events;
    let dict = PyDict::new(py);
    dict.set_item("kinds", events.iter().map(|event| event.kind.name()).collect::<Vec<_>>())?;
    dict.set_item("walls", events.iter().map(|event| wall(event.wall)).collect::<Vec<_>>())?;
    dict.set_item("phases", &found.orbit.phases)?;
    dict.set_item("speeds", &found.orbit.speeds)?;
    dict.set_item("period", found.orbit.period())?;
    dict.set_item("forcing_period", found.orbit.forcing_period)?;
    dict.set_item("symmetric", found.orbit.signature.symmetric)?;
    dict.set_item("multipliers", found.multipliers)?;
    dict.set_item("stable", found.stable)?;
    dict.set_item("refused", found.refused)?;
    dict.set_item("closure", found.closure)?;
    dict.set_item("holds", found.holds)?;
    dict.set_item("state", (found.state.q, found.state.v))?;
    for (name, column) in ["time", "displacement", "velocity"].into_iter().zip(found.motion) {
        dict.set_item(name, column)?;
    }
    let by = found.derivatives.map(|by| derivatives(py, inner, by)).transpose()?;
    dict.set_item("derivative", by)?;
    Ok(dict)
}

/// The derivatives: walls, kinds and numbers of the events, each number with its name, its values
/// and its derivatives, and the multipliers with theirs.
fn derivatives<'py>(py: Python<'py>, scene: &sg::Scene, by: OrbitDerivatives) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let walls = by.events.iter().map(|event| scene.wall_name(event.wall).unwrap_or_default());
    dict.set_item("walls", walls.collect::<Vec<_>>())?;
    dict.set_item("kinds", by.events.iter().map(|event| event.kind).collect::<Vec<_>>())?;
    let number = |one: Differentiated| (one.name, one.value, one.by);
    let numbers = by.events.into_iter().map(|event| event.numbers.into_iter().map(number).collect::<Vec<_>>());
    dict.set_item("numbers", numbers.collect::<Vec<_>>())?;
    dict.set_item("forcing_period", by.forcing_period)?;
    let multipliers = by.multipliers.map(|all| all.into_iter().map(|one| (one.value, one.by)).collect::<Vec<_>>());
    dict.set_item("multipliers", multipliers)?;
    Ok(dict)
}

/// An orbit of one degree of freedom, judged by a free run over its period.
fn by_events(problem: &Problem, orbit: Orbit, rows: u32, tangents: &[SceneTangent]) -> sg::Result<Found> {
    let asked = !tangents.is_empty();
    let derivatives = asked.then(|| OrbitDerivatives::of_events(problem, &orbit, tangents)).transpose()?;
    let (floquet, admissible) = (problem.floquet(&orbit)?, problem.admissible(&orbit)?);
    let judged = problem.judge(&orbit, rows)?;
    let column = |value: fn(&sg::orbit::Instant) -> f64| judged.motion.iter().map(value).collect::<Vec<_>>();
    let motion = [column(|at| at.time), column(|at| at.displacement), column(|at| at.velocity)];
    let [_, q, v] = &motion;
    Ok(Found {
        multipliers: floquet.multipliers.to_vec(),
        stable: floquet.is_stable(),
        refused: admissible.reason(problem.scene()),
        closure: judged.closure,
        holds: judged.holds(),
        state: State { q: q.iter().take(1).copied().collect(), v: v.iter().take(1).copied().collect() },
        motion,
        orbit,
        derivatives,
    })
}

/// An orbit that is told by its state; the run that found it came back.
fn by_state(scene: &sg::Scene, shot: Shot, rows: u32, tangents: &[SceneTangent]) -> sg::Result<Found> {
    let asked = !tangents.is_empty();
    Ok(Found {
        derivatives: asked.then(|| OrbitDerivatives::of_state(scene, &shot, tangents)).transpose()?,
        motion: motion(scene, &shot, rows)?,
        stable: shot.is_stable(),
        refused: None,
        closure: shot.closure,
        holds: true,
        multipliers: shot.multipliers,
        state: shot.state,
        orbit: shot.orbit,
    })
}

/// The motion over the orbit `shot` from its state on at the first probe: `rows` instants, and both
/// sides of each event. It has none without a probe.
fn motion(scene: &sg::Scene, shot: &Shot, rows: u32) -> sg::Result<Motion> {
    let mut motion = Motion::default();
    let Some(probe) = scene.probes.first() else { return Ok(motion) };
    let period = f64::from(shot.periods) * shot.forcing_period;
    let (end, spacing) = (shot.time + period, period / f64::from(rows));
    let mut timed = scene.clone();
    timed.duration = end;
    let mut stepper = Stepper::new(&timed, &Scheme::Event, end)?;
    stepper.set_state(shot.time, &shot.state)?;
    let (mut q, mut v) = (shot.state.q.clone(), shot.state.v.clone());
    while stepper.time() < end {
        let step = stepper.step()?;
        let mut put = |time: f64, path: &Path<'_>| {
            path.state(time, &mut q, &mut v);
            for (column, value) in motion.iter_mut().zip([time, probe.at.dot(&q), probe.at.dot(&v)]) {
                column.push(value);
            }
        };
        put(step.start, &step.path);
        let due = |index: u32| shot.time + f64::from(index) * spacing;
        (1..rows).map(due).filter(|time| *time > step.start && *time < step.end).for_each(|time| put(time, &step.path));
        put(step.end, &step.path);
    }
    Ok(motion)
}
