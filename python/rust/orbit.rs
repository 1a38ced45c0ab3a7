//! Periodic orbits.

use crate::scene::Scene;
use crate::work::compute_beside;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use signorini::orbit::Problem;

/// The orbit on which a run settles, judged by a free run of `points` rows over its period.
#[pyfunction]
pub fn _orbit<'py>(scene: &Bound<'py, Scene>, settle: u32, points: u32) -> PyResult<Bound<'py, PyDict>> {
    let py = scene.py();
    let inner = &scene.get().scene;
    let work = || {
        let problem = Problem::new(inner.clone())?;
        let orbit = problem.settled(settle)?;
        let (floquet, admissible) = (problem.floquet(&orbit)?, problem.admissible(&orbit)?);
        let judged = problem.judge(&orbit, points)?;
        Ok((orbit, floquet, admissible, judged))
    };
    let (orbit, floquet, admissible, judged) = compute_beside(py, work, &mut |_| Ok(()))?;
    let wall = |index: usize| inner.walls.get(index).map(|wall| wall.name.clone());
    let events = &orbit.signature.events;
    let dict = PyDict::new(py);
    dict.set_item("kinds", events.iter().map(|event| event.kind.name()).collect::<Vec<_>>())?;
    dict.set_item("walls", events.iter().map(|event| wall(event.wall)).collect::<Vec<_>>())?;
    dict.set_item("phases", &orbit.phases)?;
    dict.set_item("speeds", &orbit.speeds)?;
    dict.set_item("period", orbit.period())?;
    dict.set_item("forcing_period", orbit.forcing_period)?;
    dict.set_item("symmetric", orbit.signature.symmetric)?;
    dict.set_item("multipliers", floquet.multipliers.to_vec())?;
    dict.set_item("stable", floquet.is_stable())?;
    dict.set_item("refused", admissible.reason(inner))?;
    dict.set_item("closure", judged.closure)?;
    dict.set_item("holds", judged.holds())?;
    for (name, column) in [
        ("time", judged.motion.iter().map(|instant| instant.time).collect::<Vec<_>>()),
        ("displacement", judged.motion.iter().map(|instant| instant.displacement).collect()),
        ("velocity", judged.motion.iter().map(|instant| instant.velocity).collect()),
    ] {
        dict.set_item(name, column)?;
    }
    Ok(dict)
}
