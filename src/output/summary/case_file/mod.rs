//! The case of a run in the keys of a case file: what a summary needs so that the run can be
//! repeated.

mod contact;
mod load;
mod place;
mod put;
mod system;

use crate::case::{Case, Model, Origin};
use crate::scene::Shape;
use crate::scheme::PenaltyLaw;
use crate::study::truncation::Start;
use crate::time::TimeOptions;
use contact::{flats_of, round_of, support, wall};
use load::load;
use place::put_place;
use put::{put, some};
use serde_json::{Map, Value, json};
use system::system;

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

/// The table `[penalty]`.
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
