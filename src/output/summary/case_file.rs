//! The case of a run in the keys of a case file: what a summary needs so that the run can be
//! repeated.

use crate::case::{Case, Model, Origin, Place, Scarred, Support, TableColumns};
use crate::scene::{
    self, BarEnd, BeamEnd, Damping, Density, Flats, Load, LoadKind, MassMatrix, RandomForce, Row, Shape, Side, System,
    Wall, WallLaw,
};
use crate::scheme::PenaltyLaw;
use crate::study::truncation::Start;
use crate::time::TimeOptions;
use serde_json::{Map, Value, json};

/// The whole case; null where a case file cannot express it, such as a load that is a function of a
/// program.
pub(super) fn case_file(case: &Case) -> Value {
    let whole = case.whole();
    let several = case.has_places();
    let mut out = Map::new();
    let text = |word: &Option<String>| word.as_ref().map(|word| json!(word));
    put(&mut out, "title", text(&case.title));
    put(&mut out, "source", text(&case.source));
    out.insert("system".to_owned(), system(case));
    let mut supports = Vec::new();
    let is_beam = matches!(case.model, Model::Beam(_));
    // Walls that a table of a support makes.
    let mut made = vec![false; whole.walls.len()];
    for (index, (written, there)) in case.written.supports.iter().zip(&whole.supports).enumerate() {
        let shape = match (&written.flats, &there.shape) {
            (Some((flats, first)), _) => case.law_of_flats(index).map(|law| {
                made.iter_mut().skip(*first).take(flats.flats.len()).for_each(|made| *made = true);
                (flats_of(flats), law)
            }),
            (None, Shape::Round { gap, law }) => Some((round_of(*gap), *law)),
            (None, Shape::Flats(_)) => None,
        };
        supports.extend(shape.map(|(shape, law)| support((written, there), shape, law, is_beam)));
    }
    let own = whole.walls.iter().enumerate().filter(|(index, _)| made.get(*index) == Some(&false));
    let walls: Vec<Value> =
        own.map(|(index, one)| wall(case, one, case.places.get(index).filter(|_| several), several)).collect();
    put(&mut out, "wall", some(walls));
    put(&mut out, "support", some(supports));
    let second = |index: usize| matches!(case.written.origins.get(index), Some(Origin::Second(_)));
    let loads = whole.loads.iter().enumerate().filter(|(i, _)| !second(*i));
    let loads: Vec<Value> = loads.map(|(i, l)| load(case, i, l, several)).collect();
    put(&mut out, "load", some(loads));
    let mut initial = Map::new();
    match case.written.start {
        Start::Given => {
            put(&mut initial, "displacement", field(case, &whole.initial.q));
            put(&mut initial, "velocity", field(case, &whole.initial.v));
        }
        Start::Equilibrium => put(&mut initial, "equilibrium", Some(json!(true))),
    }
    put(&mut out, "initial", Some(initial).filter(|initial| !initial.is_empty()).map(Value::Object));
    let probes = whole.probes.iter().enumerate().filter(|(_, probe)| several || !probe.name.is_empty());
    let probes: Vec<Value> = probes
        .map(|(i, probe)| {
            let mut out = Map::new();
            out.insert("name".to_owned(), json!(probe.name));
            if several {
                put_place(&mut out, case, case.written.probes.get(i), &probe.at);
            }
            Value::Object(out)
        })
        .collect();
    put(&mut out, "probe", some(probes));
    let mut time = Map::new();
    time.insert("end".to_owned(), json!(case.scene.duration));
    time.insert("step".to_owned(), json!(case.time.step));
    put(&mut time, "sample", case.time.sample.map(|x| json!(x)));
    put(&mut time, "statistics_from", Some(case.time.statistics_from).filter(|x| *x != 0.0).map(|x| json!(x)));
    let averaging = Some(case.time.force_averaging).filter(|x| *x != TimeOptions::FORCE_AVERAGING);
    put(&mut time, "force_averaging", averaging.map(|x| json!(x)));
    out.insert("time".to_owned(), Value::Object(time));
    put(&mut out, "wear", wear(case));
    put(&mut out, "statistics", case.statistics.map(|s| json!({ "rest": s.rest, "spectra": s.spectra })));
    put(&mut out, "penalty", penalty(case));
    Value::Object(out)
}

fn put(map: &mut Map<String, Value>, key: &str, value: Option<Value>) {
    if let Some(value) = value {
        map.insert(key.to_owned(), value);
    }
}

fn some(list: Vec<Value>) -> Option<Value> {
    (!list.is_empty()).then_some(Value::Array(list))
}

/// What vibrates.
fn system(case: &Case) -> Value {
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

fn wall(case: &Case, wall: &Wall, place: Option<&Place>, several: bool) -> Value {
    let mut out = Map::new();
    out.insert("name".to_owned(), json!(wall.name));
    if several {
        put_place(&mut out, case, place, &wall.at);
    }
    out.insert("side".to_owned(), json!(if wall.side == Side::Upper { "upper" } else { "lower" }));
    out.insert("position".to_owned(), json!(wall.position));
    if let WallLaw::Quartic { .. } = wall.law {
        return Value::Null;
    }
    put_law(&mut out, wall.law);
    Value::Object(out)
}

/// Puts a law that a case file can express.
fn put_law(out: &mut Map<String, Value>, law: WallLaw) {
    match law {
        // Where a static correction replaces the restitution, the file must not name one.
        WallLaw::Rigid { restitution } => put(out, "restitution", (restitution != 1.0).then(|| json!(restitution))),
        WallLaw::Elastic { stiffness, damping } => {
            out.insert("stiffness".to_owned(), json!(stiffness));
            put(out, "damping", (damping != 0.0).then(|| json!(damping)));
        }
        WallLaw::Quartic { .. } => {}
    }
}

fn load(case: &Case, index: usize, load: &Load, several: bool) -> Value {
    let mut out = Map::new();
    if several {
        put_place(&mut out, case, case.written.loads.get(index), &load.at);
    }
    let (kind, value) = match &load.kind {
        LoadKind::Constant { force } => ("constant", json!({ "force": force })),
        LoadKind::Harmonic { amplitude, frequency, phase } => {
            ("harmonic", json!({ "amplitude": amplitude, "frequency": frequency, "phase": phase }))
        }
        LoadKind::Impulse { impulse, time } => ("impulse", json!({ "impulse": impulse, "time": time })),
        LoadKind::Table(_) => match case.written.origins.get(index) {
            Some(Origin::Table { file, columns }) => ("table", table(file, columns, "force")),
            Some(Origin::Random { force, file, both }) => {
                if *both {
                    out.insert("direction".to_owned(), json!("both"));
                }
                ("random", random(force, file.as_deref()))
            }
            Some(Origin::Base { file, columns, influence, direction }) => {
                out.clear();
                put(&mut out, "direction", direction.map(|degrees| json!(degrees)));
                let mut base = table(file, columns, "acceleration");
                if let (Some(row), Some(map)) = (influence, base.as_object_mut()) {
                    map.insert("influence".to_owned(), json!({ "row": row }));
                }
                ("base", base)
            }
            _ => return Value::Null,
        },
        LoadKind::Function(_) => return Value::Null,
    };
    out.insert(kind.to_owned(), value);
    Value::Object(out)
}

/// A table: its file, its columns and the format of its numbers.
fn table(file: &str, columns: &TableColumns, values: &str) -> Value {
    json!({
        "file": file,
        "time": columns.time,
        values: columns.force,
        "delimiter": columns.delimiter,
        "decimal": columns.decimal,
        "scale": columns.scale,
    })
}

fn random(force: &RandomForce, file: Option<&str>) -> Value {
    match (&force.density, file) {
        (_, Some(file)) => json!({ "file": file, "seed": force.seed }),
        (Density::Flat { rms, from, to }, _) => json!({ "rms": rms, "from": from, "to": to, "seed": force.seed }),
        (Density::Points(points), _) => json!({ "psd": points, "seed": force.seed }),
    }
}

/// Puts the location that the scene has as `row`: as the file gave it, with its direction, or as
/// the row itself where the location was changed or condensed.
fn put_place(map: &mut Map<String, Value>, case: &Case, place: Option<&Place>, row: &Row) {
    match place.filter(|place| case.sees(place).is_some_and(|seen| seen == *row)) {
        Some(Place::Towards { place, degrees }) => {
            map.insert("at".to_owned(), at(place));
            map.insert("direction".to_owned(), json!(degrees));
        }
        Some(place) if !matches!(place, Place::Row(_)) => {
            map.insert("at".to_owned(), at(place));
        }
        _ => {
            let entries: Vec<(usize, f64)> =
                row.entries().iter().map(|&(i, weight)| (case.numbered(i), weight)).collect();
            map.insert("at".to_owned(), json!({ "row": entries }));
        }
    }
}

/// A location, without its direction.
fn at(place: &Place) -> Value {
    match place {
        Place::Dof(i) => json!({ "dof": i }),
        Place::Position(x) => json!({ "position": x }),
        Place::Spread { from, to } => json!({ "spread": [from, to] }),
        Place::Points(points) => match points.as_slice() {
            [(name, 1.0)] => json!({ "point": name }),
            _ => json!({ "points": points }),
        },
        Place::Row(entries) => json!({ "row": entries }),
        Place::Rows { y, z } => {
            let mut out = Map::new();
            for (plane, row) in [("y", y), ("z", z)] {
                put(&mut out, plane, (!row.is_empty()).then(|| json!(row)));
            }
            Value::Object(out)
        }
        Place::Towards { place, .. } => at(place),
    }
}

/// The keys of the shape of flats.
fn flats_of(Flats { flats, .. }: &Flats) -> Map<String, Value> {
    let mut out = Map::new();
    out.insert("shape".to_owned(), json!("flats"));
    out.insert("directions".to_owned(), flats.iter().map(|flat| flat.direction).collect());
    let gap = match flats.split_first() {
        Some((first, rest)) if rest.iter().all(|flat| flat.gap == first.gap) => json!(first.gap),
        _ => flats.iter().map(|flat| flat.gap).collect(),
    };
    out.insert("gap".to_owned(), gap);
    out
}

/// The keys of the shape of a round hole.
fn round_of(gap: f64) -> Map<String, Value> {
    [("shape".to_owned(), json!("round")), ("gap".to_owned(), json!(gap))].into_iter().collect()
}

fn support(
    (written, there): (&Support, &scene::Support),
    shape: Map<String, Value>,
    law: WallLaw,
    is_beam: bool,
) -> Value {
    let mut out = Map::new();
    out.insert("name".to_owned(), json!(written.name));
    out.insert("at".to_owned(), at(&written.place));
    out.extend(shape);
    put(&mut out, "centre", (there.centre != [0.0; 2]).then(|| json!(there.centre)));
    put_law(&mut out, law);
    put(&mut out, "friction", (there.friction != 0.0).then(|| json!(there.friction)));
    let Scarred { scar, coefficient, support_coefficient, .. } = written.scarred;
    put(&mut out, "width", scar.map(|(width, _)| json!(width)));
    // The radius of a beam follows from its diameter.
    put(&mut out, "radius", scar.filter(|_| !is_beam).map(|(_, radius)| json!(radius)));
    put(&mut out, "coefficient", coefficient.map(|k| json!(k)));
    put(&mut out, "support_coefficient", support_coefficient.map(|k| json!(k)));
    Value::Object(out)
}

/// The table `[wear]`.
fn wear(case: &Case) -> Option<Value> {
    let mut out = Map::new();
    put(&mut out, "coefficient", case.wear.coefficient.map(|k| json!(k)));
    put(&mut out, "support_coefficient", case.wear.support_coefficient.map(|k| json!(k)));
    put(&mut out, "service", case.wear.service.map(|s| json!(s)));
    let sectors = case.time.sectors;
    put(&mut out, "sectors", (sectors != TimeOptions::SECTORS).then(|| json!(sectors)));
    (!out.is_empty()).then_some(Value::Object(out))
}

/// An initial field: a number for one degree of freedom, else pairs for the entries that are not 0;
/// `None` at rest.
fn field(case: &Case, values: &[f64]) -> Option<Value> {
    let pairs: Vec<(usize, f64)> =
        values.iter().enumerate().filter(|(_, x)| **x != 0.0).map(|(i, &x)| (case.numbered(i), x)).collect();
    match (&case.model, pairs.first()) {
        (_, None) => None,
        (Model::Oscillator, Some((_, x))) if !case.has_places() => Some(json!(x)),
        (_, Some(_)) => Some(json!({ "dofs": pairs })),
    }
}

fn penalty(case: &Case) -> Option<Value> {
    let mut out = Map::new();
    let (mut epsilons, mut stiffnesses, mut dashpot) = (Vec::new(), Vec::new(), 0.0);
    for law in &case.penalty.laws {
        match *law {
            PenaltyLaw::Quartic { epsilon } => epsilons.push(json!(epsilon)),
            PenaltyLaw::Linear { stiffness, damping } => {
                stiffnesses.push(json!(stiffness));
                dashpot = damping;
            }
        }
    }
    put(&mut out, "epsilon", some(epsilons));
    put(&mut out, "stiffness", some(stiffnesses));
    put(&mut out, "damping", (dashpot != 0.0).then(|| json!(dashpot)));
    put(&mut out, "integrator", case.penalty.integrator.map(|integrator| json!(integrator.to_string())));
    (!case.penalty.laws.is_empty()).then_some(Value::Object(out))
}
