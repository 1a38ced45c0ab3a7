//! Wrong requests of a program that builds its scene in code are refused in the library's words.

use signorini::batch::Lane;
use signorini::case::CaseFile;
use signorini::linear::Symmetric;
use signorini::qp::Backend;
use signorini::study::derivatives::Derivatives;
use signorini::sweep::{Axis, Measure, Sweep};
use signorini::variation::SceneTangent;
use signorini::{
    Load, Method, ModalData, PlaneRows, Result, Row, Scene, Scheme, Spectrum, Statistics, Stepper, Structure, Support,
    Wall, foreseen,
};

fn oscillator(stiffness: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, stiffness)
}

/// A point mass in a round hole with this coefficient of friction.
fn rubbing(friction: f64) -> Scene {
    let same = |x: f64| Symmetric::diagonal(&[x; 2]);
    let structure = Structure { mass: same(1.0), damping: same(0.2), stiffness: same(100.0) };
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let wall = Wall::round("hole", at.clone(), 5e-3).with_friction(friction);
    Scene::structure(structure).with_support("hole", at, [0.0; 2], vec![wall])
}

/// Asserts that `result` is a refusal that says all of `words`.
fn refused<T>(result: Result<T>, words: &[&str]) {
    let error = result.map(drop).expect_err("a refusal");
    let said = error.to_string();
    assert!(error.is_request() && words.iter().all(|word| said.contains(word)), "{said:?} lacks one of {words:?}");
    assert!(said.len() < 250 || words.iter().any(|word| word.contains("measure")), "{said}");
}

#[test]
fn scenes_and_schemes_name_what_was_given() {
    let fast = oscillator(100.0).with_load(Load::harmonic(1.0, 1e308, 0.0));
    refused(fast.validate(), &["load 1: frequency is 1e308;"]);
    let modal = |ratios: Vec<f64>| ModalData { omega: vec![1.0], masses: vec![1.0], ratios, points: vec![] };
    refused(modal(vec![]).structure(), &["modal data: ratios is 0 values"]);
    refused(modal(vec![-1.0]).structure(), &["modal data: ratios: value 1"]);
    for (walls, found) in [(1..1, "1..1"), (0..2, "0..2")] {
        let mut scene = rubbing(0.2);
        scene.supports.push(Support { name: "none".to_owned(), walls, ..scene.supports[0].clone() });
        refused(scene.validate(), &["support \"none\": walls is", found, "one or more of the 1 walls"]);
    }
    let by = |scheme: Scheme, step: f64| Stepper::new(&oscillator(100.0), &scheme, step);
    refused(by(Scheme::Event, -1e308), &["step is -1e308;"]);
    refused(by(Scheme::MoreauJean { theta: 1e-320 }, 1e-3), &["theta is 1e-320;"]);
    refused(by(Scheme::GeneralizedAlpha { rho: 1e308 }, 1e-3), &["rho is 1e308;"]);
    let noted = foreseen(&oscillator(-0.0).with_load(Load::harmonic(1.0, -0.0, 0.0)), &Scheme::Located, 1e-3);
    assert!(noted.is_empty(), "{noted:?}");
}

#[test]
fn studies_name_what_was_given() {
    for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(Lane::of(&oscillator(100.0).with_load(Load::harmonic(3.0, 5.0, 0.0)), period), &["period is "]);
    }
    refused(SceneTangent::new("mu", 0.2, |mu| Ok(rubbing(mu))), &["derivative by mu", "friction has no derivative"]);
    let same = SceneTangent::new("mu", 0.2, |_| Ok(rubbing(0.2)));
    refused(same, &["a key on which the scene depends"]);
    let scene = |gap: f64| Ok(oscillator(100.0).with_wall(Wall::upper("stop", gap)));
    let keys = [SceneTangent::new("gap", 5e-3, scene).expect("a key")];
    for (time, found) in [(5.0, "times is 5.0;"), (-0.5, "times is -0.5;")] {
        let mut times = [time, 1.0];
        times.sort_by(f64::total_cmp);
        refused(Derivatives::new(&scene(5e-3).expect("a scene"), &keys, &times), &[found, "from 0 to the end, 1.0 s"]);
    }
    refused(Spectrum::of(&[f64::NAN; 100], 1.0), &["spectrum is of NaN; expected finite values"]);
    let early = Statistics::new(&oscillator(100.0), &[], -1.0);
    assert_eq!((early.from_s, early.to_s), (0.0, 1.0));
}

#[test]
fn sweeps_name_what_is_missing_wherever_they_were_asked_for() {
    let sweep = || Sweep::new(CaseFile::embedded("rigid-walls-sine").expect("a case"));
    let axis = || Axis::linear("wall.upper.position", 4e-3, 5e-3, 2).expect("an axis");
    refused(sweep().vary(axis()).plan(), &["what is measured is nothing; expected one measure or more"]);
    refused(sweep().measure([Measure::Contacts]).plan(), &["what is varied is nothing", "an axis"]);
    let seeds = sweep().vary(axis()).measure([Measure::Contacts]).realisations(0);
    refused(seeds.plan(), &["number of realisations (--seeds) is 0"]);
}

#[test]
fn a_clamp_for_two_unknowns_is_a_wrong_request() {
    let pair = Scene::structure(Structure {
        mass: Symmetric::diagonal(&[1.0; 2]),
        damping: Symmetric::zeros(2),
        stiffness: Symmetric::diagonal(&[1.0; 2]),
    });
    let method = Method { scheme: Scheme::ImplicitEuler, backend: Backend::Clamp };
    refused(
        Stepper::new(&pair, &method, 1e-3),
        &["QP solver is clamp; expected auto, condensed or clarabel: there are 2 unknowns"],
    );
}
