//! The table `[system]`.

use super::put::put;
use crate::case::{Case, Model};
use crate::scene::{BarEnd, BeamEnd, Damping, MassMatrix, System};
use serde_json::{Map, Value, json};

/// The system.
pub(super) fn system(case: &Case) -> Value {
    let mut out = Map::new();
    let file = |key: &str| case.written.matrices.iter().find(|(name, _)| *name == key).map(|(_, file)| json!(file));
    let inner = match (&case.model, &case.scene.system) {
        (Model::Oscillator, System::Oscillator(o)) => {
            json!({ "mass": o.mass, "damping": o.damping, "stiffness": o.stiffness })
        }
        (Model::Oscillator, System::Structure(s)) => {
            json!({ "mass": s.mass.get(0, 0), "damping": s.damping.get(0, 0), "stiffness": s.stiffness.get(0, 0) })
        }
        (Model::Chain(chain), _) => {
            let mut inner = Map::new();
            // Equal masses are written as a count and one value.
            match chain.masses.split_first() {
                Some((first, rest)) if rest.iter().all(|mass| mass == first) => {
                    inner.insert("masses".to_owned(), json!(chain.masses.len()));
                    inner.insert("mass".to_owned(), json!(first));
                }
                _ => {
                    inner.insert("masses".to_owned(), json!(chain.masses));
                }
            }
            let springs = match chain.springs.split_first() {
                Some((first, rest)) if rest.iter().all(|spring| spring == first) => json!(first),
                _ => json!(chain.springs),
            };
            inner.insert("springs".to_owned(), springs);
            for (side, stiffness) in ["left", "right"].into_iter().zip(chain.grounds) {
                put(&mut inner, side, (stiffness != 0.0).then(|| json!({ "stiffness": stiffness })));
            }
            Value::Object(inner)
        }
        (Model::Bar(bar), _) => json!({
            "length": bar.length,
            "area": bar.area,
            "youngs_modulus": bar.youngs_modulus,
            "density": bar.density,
            "elements": bar.elements,
            "mass_matrix": if bar.mass == MassMatrix::Lumped { "lumped" } else { "consistent" },
            "left": bar_end(bar.left),
            "right": bar_end(bar.right),
        }),
        (Model::Beam(beam), _) => json!({
            "length": beam.length,
            "youngs_modulus": beam.youngs_modulus,
            "density": beam.density,
            "outer_diameter": beam.outer_diameter,
            "inner_diameter": beam.inner_diameter,
            "added_mass": beam.added_mass,
            "elements": beam.elements,
            "left": beam_end(beam.left),
            "right": beam_end(beam.right),
        }),
        (Model::Matrices(_), _) => {
            let mut inner = Map::new();
            ["mass", "stiffness", "damping"].into_iter().for_each(|key| put(&mut inner, key, file(key)));
            Value::Object(inner)
        }
        (Model::Modal(modal), _) => {
            let shapes = modal.points.iter().map(|point| (point.name.clone(), json!(point.shape))).collect();
            let mut inner = Map::new();
            inner.insert("omega".to_owned(), json!(modal.omega));
            inner.insert("masses".to_owned(), json!(modal.masses));
            let damped = modal.ratios.iter().any(|ratio| *ratio != 0.0);
            put(&mut inner, "damping_ratios", damped.then(|| json!(modal.ratios)));
            put(&mut inner, "shapes", Some(Value::Object(shapes)));
            Value::Object(inner)
        }
    };
    put(&mut out, "planes", case.planes.is_two().then(|| json!(2)));
    if let Some(truncated) = &case.truncated {
        out.insert("modes".to_owned(), json!(truncated.reduction.modes.count() / case.planes.modes()));
        let corrected = truncated.whole.static_correction;
        put(&mut out, "static_correction", corrected.then_some(Value::Bool(true)));
    }
    out.insert(case.model.kind().to_owned(), inner);
    let damping = case.written.damping.as_ref().and_then(|damping| match damping {
        Damping::None => None,
        Damping::Rayleigh { mass, stiffness } => Some(json!({ "rayleigh": { "mass": mass, "stiffness": stiffness } })),
        Damping::Modal(ratios) => Some(json!({ "ratios": ratios })),
        Damping::Matrix(_) => file("matrix").map(|file| json!({ "matrix": file })),
    });
    put(&mut out, "damping", damping);
    Value::Object(out)
}

fn bar_end(end: BarEnd) -> Value {
    match end {
        BarEnd::Free => json!("free"),
        BarEnd::Fixed => json!("clamped"),
        BarEnd::Sprung { stiffness } => json!({ "stiffness": stiffness }),
    }
}

fn beam_end(end: BeamEnd) -> Value {
    match end {
        BeamEnd::Free => json!("free"),
        BeamEnd::Pinned => json!("pinned"),
        BeamEnd::Clamped => json!("clamped"),
        BeamEnd::Sprung { stiffness, rotational } => json!({ "stiffness": stiffness, "rotational": rotational }),
    }
}
