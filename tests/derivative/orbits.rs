//! Periodic orbits with one impact, whose phase and speed are known in closed form.

use signorini::linear::Symmetric;
use signorini::orbit::{closed_forms, shoot};
use signorini::variation::SceneTangent;
use signorini::{Load, Row, Scene, Structure, Wall};

/// One number of a scene each: gap, restitution, amplitude, frequency, first mass, spring, dashpot.
type Numbers = [f64; 7];

const NAMES: [&str; 7] = ["gap", "restitution", "amplitude", "frequency", "mass", "stiffness", "damping"];

fn one([gap, e, amplitude, frequency, mass, k, c]: Numbers) -> Scene {
    Scene::oscillator(mass, c, k)
        .with_wall(Wall::upper("stop", gap).with_restitution(e))
        .with_load(Load::harmonic(amplitude, frequency, 0.0))
}

/// Two masses in a row, of which the second meets the stop.
fn two([gap, e, amplitude, frequency, mass, k, c]: Numbers) -> Scene {
    let chain = |x: f64| Symmetric::from_entries(2, [(0, 0, 2.0 * x), (1, 0, -x), (1, 1, x)]);
    let structure = Structure { mass: Symmetric::diagonal(&[mass, 0.8]), damping: chain(c), stiffness: chain(k) };
    Scene::structure(structure)
        .with_wall(Wall::upper("stop", gap).with_restitution(e).at(Row::dof(1)))
        .with_load(Load { at: Row::dof(0), ..Load::harmonic(amplitude, frequency, 0.0) })
}

/// Phase and speed of the orbit of one impact a period nearest to these.
fn closed_form(scene: &Scene, [phase, speed]: [f64; 2]) -> [f64; 2] {
    let all = closed_forms(scene, 1).expect("closed forms");
    let apart = |a: f64| (a - phase + 0.5).rem_euclid(1.0) - 0.5;
    let near = |form: &signorini::orbit::ClosedForm| apart(form.phase).abs() + (form.speed / speed - 1.0).abs();
    let best = all.iter().min_by(|a, b| near(a).total_cmp(&near(b))).expect("an orbit");
    [phase + apart(best.phase), best.speed]
}

/// The five-point difference with a step of 1e-3 errs by about 1e-12, and so does rounding over
/// that step.
fn check(scene: fn(Numbers) -> Scene, numbers: Numbers) {
    let own = scene(numbers);
    let orbit = shoot(&own, 300, &|_| {}).expect("an orbit");
    assert_eq!(orbit.periods, 1);
    let at = |index: usize, x: f64| {
        let mut changed = numbers;
        changed[index] = x;
        scene(changed)
    };
    let tangent = |index: usize| SceneTangent::new(NAMES[index], numbers[index], |x| Ok(at(index, x))).expect("a key");
    let tangents: Vec<SceneTangent> = (0..7).map(tangent).collect();
    let by = orbit.derivative(&own, &tangents).expect("derivatives");
    assert_eq!(by.contacts.len(), 1);
    let contact = &by.contacts[0];
    let start = [contact.contact.start / orbit.forcing_period, contact.contact.approach_speed];
    for (index, name) in NAMES.into_iter().enumerate() {
        let step = 1e-3 * numbers[index];
        let form = |k: f64| closed_form(&at(index, numbers[index] + k * step), start);
        let [far, near] = [2.0, 1.0].map(|k| [form(k), form(-k)]);
        let difference =
            |part: usize| (8.0 * (near[0][part] - near[1][part]) - (far[0][part] - far[1][part])) / (12.0 * step);
        let found = [by.phase[0][index], contact.approach_speed_by[index]];
        for part in 0..2 {
            let (a, b) = (found[part], difference(part));
            let size = b.abs() + start[part].abs() / numbers[index].abs();
            assert!((a - b).abs() <= 1e-8 * size, "{name}: {a} {b}");
        }
    }
}

#[test]
fn an_orbit_of_one_impact_has_the_derivatives_of_its_closed_form() {
    check(one, [5e-3, 0.6, 3.0, 2.6, 1.0, 100.0, 0.8]);
}

#[test]
fn so_has_that_of_two_masses() {
    check(two, [1e-2, 0.6, 3.0, 1.6, 1.2, 100.0, 1.5]);
}
