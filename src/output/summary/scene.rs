//! The structure that is run, and its walls with the mass that each feels.

use crate::case::{Body, Case, Line, Model, Place};
use crate::scene::{
    BarEnd, BeamEnd, BeamSection, Damping, Face, FrictionCoefficients, Scene, Support, System, Wall, WallLaw,
};
use crate::study::choice;
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::f64::consts::TAU;

/// The scene of `case` as JSON, in the form used in the summary.
#[must_use]
pub fn scene(case: &Case) -> Value {
    let whole = unreduced(case);
    let mut out = Map::new();
    out.insert(case.model.kind().to_owned(), system(&case.model, &case.without_sliders().system, 0));
    if !matches!(case.without_sliders().system, System::Oscillator(_)) {
        out.insert("structure".to_owned(), structure(case));
    }
    let masses = case.scene.wall_masses();
    let several = case.has_places();
    let flats = whole.walls.iter().enumerate().filter(|(_, wall)| !wall.is_round());
    let walls = flats.map(|(index, w)| {
        let mut value = wall(w);
        if let (Some(place), Some(mass), true, Some(map)) =
            (case.places.get(index), masses.get(index), several, value.as_object_mut())
        {
            map.insert("at".to_owned(), at(place));
            map.insert("effective_mass_kg".to_owned(), json!(mass));
            if let Some(left) = case.truncated.as_ref().and_then(|t| t.reduction.walls.get(index)) {
                map.insert("effective_mass_of_all_modes_kg".to_owned(), json!(left.mass));
                map.insert("static_compliance_kept".to_owned(), json!(left.share()));
                map.insert("residual_compliance_m_per_n".to_owned(), json!(left.residual()));
                map.insert("statically_corrected".to_owned(), json!(left.corrected));
            }
        }
        value
    });
    out.insert("planes".to_owned(), json!(if case.planes.is_two() { 2 } else { 1 }));
    // A slider has a contact, whose results are those of a wall, and rubs as a support.
    out.insert("walls".to_owned(), walls.chain(sliders(case)).collect());
    if !case.scene.supports.is_empty() {
        out.insert("supports".to_owned(), supports(case, &whole).chain(sliders(case)).collect());
    }
    let probes = whole.probes.iter().enumerate().map(|(index, probe)| {
        let place = case.written.probes.get(index).filter(|_| several);
        json!({ "name": probe.name, "at": place.map(at) })
    });
    out.insert("probes".to_owned(), probes.collect());
    if !case.written.lines.is_empty() {
        out.insert("lines".to_owned(), case.written.lines.iter().map(line).collect());
    }
    if let Some(margins) = &case.fluid_elastic {
        out.insert("fluid_elastic".to_owned(), json!(margins));
    }
    out.insert("duration_s".to_owned(), json!(case.scene.duration));
    Value::Object(out)
}

/// The scene before its reduction to modes, without sliders.
fn unreduced(case: &Case) -> Cow<'_, Scene> {
    case.truncated.as_ref().map_or_else(|| case.without_sliders(), |truncated| Cow::Borrowed(&truncated.whole.scene))
}

/// The model as the case file describes it, of a system or body with its degrees of freedom from
/// the `first` of `system` on.
fn system(model: &Model, system: &System, first: usize) -> Value {
    match (model, system) {
        (_, System::Oscillator(o)) => {
            json!({ "mass_kg": o.mass, "damping_n_s_per_m": o.damping, "stiffness_n_per_m": o.stiffness })
        }
        (Model::Bodies(bodies), _) => bodies.iter().map(|body| self::body(body, system)).collect(),
        (Model::Oscillator, System::Structure(structure)) => {
            let [mass, damping, stiffness] =
                [&structure.mass, &structure.damping, &structure.stiffness].map(|matrix| matrix.get(first, first));
            json!({ "mass_kg": mass, "damping_n_s_per_m": damping, "stiffness_n_per_m": stiffness })
        }
        (Model::Chain(chain), _) => json!({
            "masses": chain.masses.len(),
            "mass_kg": chain.masses.iter().sum::<f64>(),
            "ground_springs_n_per_m": chain.grounds,
        }),
        (Model::Bar(bar), _) => json!({
            "length_m": bar.length,
            "youngs_modulus_pa": bar.youngs_modulus,
            "density_kg_per_m3": bar.density,
            "area_m2": bar.area,
            "elements": bar.elements,
            "ends": ([bar.left, bar.right].map(bar_end)),
        }),
        (Model::Beam(beam), _) => {
            let [(first, one), (second, other)] = match beam.section {
                BeamSection::Tube { outer_diameter, inner_diameter } => {
                    [("outer_diameter_m", outer_diameter), ("inner_diameter_m", inner_diameter)]
                }
                BeamSection::Rectangle { width, height } => [("width_m", width), ("height_m", height)],
            };
            json!({
                "length_m": beam.length,
                "youngs_modulus_pa": beam.youngs_modulus,
                "density_kg_per_m3": beam.density,
                (first): one,
                (second): other,
                "added_mass_kg_per_m": beam.added_mass,
                "elements": beam.elements,
                "bending_stiffness_n_m2": beam.bending_stiffness(),
                "mass_kg_per_m": beam.mass_per_metre(),
                "ends": ([beam.left, beam.right].map(beam_end)),
            })
        }
        (Model::Modal(modal), _) => json!({
            "modes": modal.omega.len(),
            "frequencies_hz": modal.omega.iter().map(|omega| omega / TAU).collect::<Vec<_>>(),
            "generalised_masses_kg": modal.masses,
            "damping_ratios": modal.ratios,
            "points": modal.points.iter().map(|point| &point.name).collect::<Vec<_>>(),
        }),
        _ => json!({}),
    }
}

fn body(body: &Body, all: &System) -> Value {
    let Body { name, model, dofs, .. } = body;
    json!({ "name": name, (model.kind()): system(model, all, dofs.start), "degrees_of_freedom": dofs.len() })
}

fn bar_end(end: BarEnd) -> Value {
    match end {
        BarEnd::Free => json!("free"),
        BarEnd::Fixed => json!("clamped"),
        BarEnd::Sprung { stiffness } => json!({ "stiffness_n_per_m": stiffness }),
    }
}

fn beam_end(end: BeamEnd) -> Value {
    match end {
        BeamEnd::Free => json!("free"),
        BeamEnd::Pinned => json!("pinned"),
        BeamEnd::Clamped => json!("clamped"),
        BeamEnd::Sprung { stiffness, rotational } => {
            json!({ "stiffness_n_per_m": stiffness, "rotational_n_m_per_rad": rotational })
        }
    }
}

/// The system as it is run, and how it was obtained.
fn structure(case: &Case) -> Value {
    let scene = case.without_sliders();
    let [slowest, fastest] = scene.system.frequencies().map(|omega| omega / TAU);
    let mut out = json!({
        "degrees_of_freedom": unreduced(case).system.degrees_of_freedom(),
        "unknowns": scene.system.degrees_of_freedom(),
        "slowest_frequency_hz": slowest,
        "fastest_frequency_hz": fastest,
        "damping": choice::body(&scene).pop(),
        "matrices": choice::path(&scene, case.time.step),
    });
    if let (Some(condensation), Some(map)) = (&case.condensation, out.as_object_mut()) {
        map.insert("massless_degrees_of_freedom".to_owned(), json!(condensation.massless.len()));
    }
    if let (Some(truncated), Some(map)) = (&case.truncated, out.as_object_mut()) {
        let reduction = &truncated.reduction;
        let frequencies: Vec<f64> = reduction.modes.omega.iter().map(|omega| omega / TAU).collect();
        map.insert("modes".to_owned(), json!(reduction.modes.count()));
        map.insert("frequencies_hz".to_owned(), json!(frequencies));
        map.insert("next_frequency_hz".to_owned(), json!(reduction.next_omega.map(|omega| omega / TAU)));
        if let Some(Damping::Modal(ratios)) = &truncated.whole.damping {
            map.insert("damping_ratios".to_owned(), json!(ratios));
        }
        map.insert("static_correction".to_owned(), json!(truncated.whole.static_correction));
        map.insert("start_energy_left_out".to_owned(), json!(reduction.start_energy_lost));
        map.insert("residual_coupling_neglected".to_owned(), json!(reduction.coupling_neglected));
    }
    out
}

/// Where the points of matrices or modes lie.
fn line(line: &Line) -> Value {
    let point = |(place, x): &(Place, f64)| json!({ "at": at(place), "position_m": x });
    json!({ "body": line.body, "points": line.points.iter().map(point).collect::<Vec<_>>() })
}

fn at(place: &Place) -> Value {
    match place {
        Place::Dof(i) => json!({ "dof": i }),
        Place::Position(x) => json!({ "position_m": x }),
        Place::Row(entries) => json!({ "row": entries }),
        Place::Spread { from, to } => json!({ "spread_m": [from, to] }),
        Place::Points(points) => json!({ "points": points }),
        Place::Rows { y, z } => json!({ "row_y": y, "row_z": z }),
        Place::Towards { place, degrees } => at_with(place, "direction_deg", json!(degrees)),
        Place::On { body, place } => at_with(place, "body", json!(body)),
        Place::Relative { place, to } => at_with(place, "relative_to", at(to)),
    }
}

/// The place with one more value.
fn at_with(place: &Place, key: &str, value: Value) -> Value {
    let mut place = at(place);
    if let Some(map) = place.as_object_mut() {
        map.insert(key.to_owned(), value);
    }
    place
}

/// The sliders, each with where it is.
fn sliders(case: &Case) -> impl Iterator<Item = Value> {
    let several = case.has_places();
    case.sliders.iter().zip(&case.written.supports).map(move |(slider, written)| {
        json!({
            "name": slider.name,
            "shape": "slider",
            "normal_force_n": slider.normal_force,
            "friction": friction(slider.friction),
            "at": several.then(|| at(&written.place)),
        })
    })
}

/// Coefficients of friction as in a case file.
fn friction(both: FrictionCoefficients) -> Value {
    if both.drops() { json!(both) } else { json!(both.sliding) }
}

/// The supports of `whole`, each with where it is.
fn supports(case: &Case, whole: &Scene) -> impl Iterator<Item = Value> {
    let places = case.written.supports.iter().map(|written| Some(&written.place)).chain(std::iter::repeat(None));
    whole.supports.iter().zip(places).map(|(one, place)| support(one, place, &whole.walls))
}

fn support(support: &Support, place: Option<&Place>, walls: &[Wall]) -> Value {
    let (Support { name, centre, .. }, friction) = (support, friction(support.friction(walls)));
    let hole = support.hole(walls);
    let mut out = match &hole {
        None => {
            let direction = |(_, wall): (usize, &Wall)| match wall.face {
                Face::Flat { direction, .. } => direction,
                Face::Round { .. } => None,
            };
            let directions: Vec<f64> = support.members(walls).filter_map(direction).collect();
            json!({
                "name": name,
                "shape": "flats",
                "directions_deg": directions,
                "gaps_m": support.gaps(walls),
                "centre_m": centre,
                "friction": friction,
            })
        }
        Some(hole) => json!({
            "name": name,
            "shape": "round",
            "gap_m": hole.gap,
            "restitution": hole.law.restitution(),
            "centre_m": centre,
            "friction": friction,
        }),
    };
    let spring = hole.and_then(|hole| hole.law.spring());
    if let (Some(spring), Some(map)) = (spring, out.as_object_mut()) {
        map.insert("stiffness_n_per_m".to_owned(), json!(spring.stiffness));
        map.insert("damping_n_s_per_m".to_owned(), json!(spring.damping));
    }
    if let (Some(place), Some(map)) = (place, out.as_object_mut()) {
        map.insert("at".to_owned(), at(place));
    }
    out
}

fn wall(wall: &Wall) -> Value {
    let side = wall.side().name();
    let law = match wall.law {
        WallLaw::Rigid { restitution } => json!({ "restitution": restitution }),
        WallLaw::Elastic { stiffness, damping } => {
            json!({ "stiffness_n_per_m": stiffness, "damping_n_s_per_m": damping })
        }
        WallLaw::HuntCrossley { stiffness, exponent, dissipation } => json!({
            "stiffness_n_per_m_to_the_exponent": stiffness,
            "exponent": exponent,
            "dissipation_s_per_m": dissipation,
        }),
        WallLaw::Quartic { epsilon, span } => json!({ "epsilon_m3_per_n": epsilon, "span_m": span }),
    };
    json!({ "name": wall.name, "side": side, "position_m": wall.position(), "law": law })
}
