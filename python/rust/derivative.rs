//! Derivatives of exact runs.

use crate::case::Case;
use crate::error::{raise, wrong};
use crate::scene::Scene;
use crate::work::compute_beside;
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use signorini as sg;
use signorini::study::derivatives::Derivatives;
use signorini::variation::{ContactDerivative, MeanDerivative, SceneTangent};

/// A key: its name, its value, and a function that returns the scene at another value.
pub type Key = (String, f64, Py<PyAny>);

/// The derivatives of the exact run of a scene by keys, with displacements and velocities of its
/// probes at these times.
#[pyfunction]
pub fn _derivative<'py>(scene: &Bound<'py, Scene>, keys: Vec<Key>, times: Vec<f64>) -> PyResult<Bound<'py, PyDict>> {
    let py = scene.py();
    let inner = &scene.get().scene;
    Derivatives::check(inner).map_err(raise)?;
    let tangents = tangents(py, &keys)?;
    let found = compute_beside(py, || Derivatives::new(inner, &tangents, &times), &mut |_| Ok(()))?;
    let dict = PyDict::new(py);
    let of =
        |part: fn(ContactDerivative<'_>) -> f64| found.contacts.iter().map(part).collect::<Vec<f64>>().into_pyarray(py);
    let by = |part: for<'a> fn(ContactDerivative<'a>) -> &'a [f64]| {
        found.contacts.iter().flat_map(part).copied().collect::<Vec<f64>>().into_pyarray(py)
    };
    dict.set_item("wall", found.contacts.iter().map(|one| inner.wall_name(one.contact.wall)).collect::<Vec<_>>())?;
    dict.set_item("start", of(|one| one.contact.start))?;
    dict.set_item("end", of(|one| one.contact.end.unwrap_or(f64::NAN)))?;
    dict.set_item("approach_speed", of(|one| one.contact.approach_speed))?;
    dict.set_item("departure_speed", of(|one| one.contact.departure_speed.unwrap_or(f64::NAN)))?;
    dict.set_item("impulse", of(|one| one.contact.impulse))?;
    dict.set_item("contact_growth", of(|one| one.growth))?;
    dict.set_item("start_by", by(|one| one.start_by))?;
    dict.set_item("end_by", by(|one| one.end_by))?;
    dict.set_item("approach_speed_by", by(|one| one.approach_speed_by))?;
    dict.set_item("departure_speed_by", by(|one| one.departure_speed_by))?;
    dict.set_item("impulse_by", by(|one| one.impulse_by))?;
    dict.set_item("mean", found.means.as_ref().map(|means| named_means(inner, means)))?;
    let motion = found.motion;
    for (name, values) in [
        ("displacement", motion.displacement),
        ("velocity", motion.velocity),
        ("displacement_by", motion.displacement_by),
        ("velocity_by", motion.velocity_by),
    ] {
        dict.set_item(name, values.into_pyarray(py))?;
    }
    dict.set_item("growth", found.growth)?;
    dict.set_item("ended", found.ended.as_ref().map(ToString::to_string))?;
    let lost = keys.iter().zip(&found.lost).filter_map(|(key, lost)| Some((&key.0, lost.as_ref()?)));
    let lost = lost.map(|(key, reason)| (key.clone(), reason.time(), reason.by(key)));
    dict.set_item("lost", lost.collect::<Vec<(String, f64, String)>>())?;
    dict.set_item("until", found.ended.as_ref().map_or(inner.duration, |reason| reason.time()))?;
    Ok(dict)
}

/// Means of a run of `scene`: their names, values and derivatives.
fn named_means(scene: &sg::Scene, means: &MeanDerivative) -> Vec<(String, f64, Vec<f64>)> {
    let mut rows = Vec::new();
    let mut add = |what: &str, names: &[&str], values: &[f64], by: &[Vec<f64>]| {
        let all = names.iter().zip(values).zip(by);
        let named = |name: &str| if name.is_empty() { what.to_owned() } else { format!("{what}:{name}") };
        rows.extend(all.map(|((name, value), by)| (named(name), *value, by.clone())));
    };
    let probes: Vec<&str> = scene.probes.iter().map(|probe| &*probe.name).collect();
    let walls: Vec<&str> = (0..scene.walls.len()).map(|wall| scene.wall_name(wall).unwrap_or_default()).collect();
    add("displacement", &probes, &means.displacement, &means.displacement_by);
    add("rms", &probes, &means.rms, &means.rms_by);
    add("force", &walls, &means.force, &means.force_by);
    rows
}

/// The derivatives of scenes by these keys.
pub fn tangents(py: Python<'_>, keys: &[Key]) -> PyResult<Vec<SceneTangent>> {
    keys.iter().map(|key| tangent(py, key)).collect()
}

/// The derivative of the scenes that a function returns.
fn tangent(py: Python<'_>, (name, value, build): &Key) -> PyResult<SceneTangent> {
    let mut raised = None;
    let found = SceneTangent::new(name, *value, |x| {
        let scene = build.bind(py).call1((x,)).and_then(|made| Ok(made.extract::<Scene>()?.scene));
        scene.map_err(|error| {
            raised = Some(error);
            sg::Error::Unknown { kind: "scene", name: name.clone(), known: Vec::new() }
        })
    });
    found.map_err(|error| match (&error, raised) {
        (sg::Error::Unknown { kind: "scene", .. }, Some(own)) => own,
        _ => raise(error),
    })
}

/// The number at a key of a scene.
#[pyfunction]
pub fn _value_at(scene: &Scene, key: &str) -> PyResult<f64> {
    key.parse::<sg::SceneKey>().and_then(|key| key.value(&scene.scene)).map_err(raise)
}

/// The scene with other numbers at keys.
#[pyfunction]
pub fn _scene_at(scene: &Scene, values: Vec<(String, f64)>) -> PyResult<Scene> {
    let mut changed = scene.scene.clone();
    for (key, value) in values {
        changed = key.parse::<sg::SceneKey>().and_then(|key| key.with(&changed, value)).map_err(raise)?;
    }
    Ok(Scene { scene: changed, origin: None, ..scene.clone() })
}

/// The number at a key of a case file.
#[pyfunction]
pub fn _case_value_at(case: &Case, key: &str) -> PyResult<f64> {
    let parsed: sg::case::Key = key.parse().map_err(raise)?;
    if parsed.is_whole() {
        return Err(wrong(key, "a whole number", "a key that can change by any small amount"));
    }
    let value = case.file.get(&parsed).map_err(raise)?;
    value.and_then(|value| value.number()).ok_or_else(|| {
        wrong(key, "left out, no number, or several that differ", "a key at which the case file has a number")
    })
}

/// The scene of a case file with other numbers at keys.
#[pyfunction]
pub fn _case_scene_at(case: &Case, values: Vec<(String, f64)>) -> PyResult<Scene> {
    let mut file = case.file.clone();
    for (key, value) in values {
        file.set(&key.parse().map_err(raise)?, &value.into()).map_err(raise)?;
    }
    let scene = file.case().map_err(raise)?.scene;
    Ok(Scene::new(scene, crate::place::Model::Numbered))
}
