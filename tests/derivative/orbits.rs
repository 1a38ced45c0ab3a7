//! Periodic orbits with one impact, whose phase and speed are known in closed form.

use signorini::linear::Symmetric;
use signorini::orbit::{ClosedForm, Kind, Orbit, Problem, closed_forms, shoot};
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

/// The same between two walls of which the lower one stays as it is: it mirrors the upper one at
/// these numbers alone.
fn uneven(numbers: Numbers) -> Scene {
    one(numbers).with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
}

/// The same between two walls that mirror each other.
fn between(numbers: Numbers) -> Scene {
    one(numbers).with_wall(Wall::lower("lower", -numbers[0]).with_restitution(numbers[1]))
}

/// A soft stop of stiffness 2000 N/m and a dashpot; the restitution is its damping over 10 N s/m.
fn soft(numbers: Numbers) -> Scene {
    let mut scene = one(numbers);
    scene.walls = vec![Wall::upper("stop", numbers[0]).with_elasticity(2000.0, 10.0 * numbers[1])];
    scene
}

/// Phase, speed and multipliers of the orbit of one impact a period nearest to these.
fn closed_form(scene: &Scene, [phase, speed]: [f64; 2]) -> ([f64; 2], Vec<[f64; 2]>) {
    let all = closed_forms(scene, 1).expect("closed forms");
    let apart = |a: f64| (a - phase + 0.5).rem_euclid(1.0) - 0.5;
    let near = |form: &ClosedForm| apart(form.phase).abs() + (form.speed / speed - 1.0).abs();
    let best = all.iter().min_by(|a, b| near(a).total_cmp(&near(b))).expect("an orbit");
    ([phase + apart(best.phase), best.speed], best.multipliers.clone())
}

/// The scene with another value of one number.
fn changed(scene: fn(Numbers) -> Scene, mut numbers: Numbers, index: usize, x: f64) -> Scene {
    numbers[index] = x;
    scene(numbers)
}

fn tangents(scene: fn(Numbers) -> Scene, numbers: Numbers) -> Vec<SceneTangent> {
    let by = |index: usize| {
        SceneTangent::new(NAMES[index], numbers[index], |x| Ok(changed(scene, numbers, index, x))).expect("a key")
    };
    (0..7).map(by).collect()
}

/// The five-point difference with a step of 1e-3 errs by about 1e-12, and so does rounding over
/// that step.
fn check(scene: fn(Numbers) -> Scene, numbers: Numbers) {
    let own = scene(numbers);
    let orbit = shoot(&own, 300, &|_| {}).expect("an orbit");
    assert_eq!(orbit.periods, 1);
    let at = |index: usize, x: f64| changed(scene, numbers, index, x);
    let by = orbit.derivative(&own, &tangents(scene, numbers)).expect("derivatives");
    assert_eq!(by.contacts.len(), 1);
    let contact = by.contacts.get(0).expect("an impact");
    let start = [contact.contact.start / orbit.forcing_period, contact.contact.approach_speed];
    for (index, name) in NAMES.into_iter().enumerate() {
        let step = 1e-3 * numbers[index];
        let form = |k: f64| closed_form(&at(index, numbers[index] + k * step), start).0;
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

/// Phases, speeds and multipliers, one after the other.
fn listed(orbit: &Orbit, multipliers: &[[f64; 2]]) -> Vec<f64> {
    let parts = multipliers.iter().flatten();
    orbit.phases.iter().chain(&orbit.speeds).chain(parts).copied().collect()
}

/// The derivatives of phases, speeds and multipliers against five-point differences of what `found`
/// gives for the problems beside, near the orbit. The fourth power of the step of 2.5e-4
/// leaves 1e-10 of multipliers that are a hundred times as steep as their key, and the rounding of
/// orbits over it 1e-11.
fn check_orbit(scene: fn(Numbers) -> Scene, numbers: Numbers, kinds: &[Kind], found: fn(&Problem, &Orbit) -> Vec<f64>) {
    let problem = Problem::new(scene(numbers)).expect("a problem");
    let orbit = problem.settled(400).expect("an orbit");
    assert_eq!(orbit.signature.events.iter().map(|event| event.kind).collect::<Vec<_>>(), kinds);
    let at = |index: usize, x: f64| changed(scene, numbers, index, x);
    let by = problem.derivative(&orbit, &tangents(scene, numbers)).expect("derivatives");
    let orbit = problem.whole(&orbit);
    let own = listed(&orbit, &problem.floquet(&orbit).expect("multipliers").multipliers);
    for (index, name) in NAMES.into_iter().enumerate() {
        let step = 2.5e-4 * numbers[index];
        let beside = |k: f64| {
            let other = Problem::new(at(index, numbers[index] + k * step)).expect("a problem");
            found(&other, &orbit)
        };
        let [[a, b], [c, d]] = [[1.0, -1.0], [2.0, -2.0]].map(|pair| pair.map(beside));
        let ours = by.phases.iter().chain(&by.speeds).map(|by_key| by_key[index]);
        let multipliers = by.multipliers.as_ref().expect("multipliers apart");
        let ours: Vec<f64> = ours.chain(multipliers.iter().flat_map(|by_key| by_key[index])).collect();
        assert_eq!(ours.len(), own.len());
        for part in 0..own.len() {
            // An orbit is listed from the first period on: phases may differ by a whole one.
            let whole = |x: f64| if part < orbit.phases.len() { (x - own[part]).round() } else { 0.0 };
            let [a, b, c, d] = [&a, &b, &c, &d].map(|list| list[part] - whole(list[part]));
            let difference = (8.0 * (a - b) - (c - d)) / (12.0 * step);
            let size = difference.abs() + own[part].abs() / numbers[index].abs();
            assert!((ours[part] - difference).abs() <= 1e-8 * size, "{name}, {part}: {} {difference}", ours[part]);
        }
    }
}

/// The orbit of the problem near another.
fn corrected(problem: &Problem, near: &Orbit) -> Vec<f64> {
    let orbit = problem.correct(near).expect("an orbit");
    listed(&orbit, &problem.floquet(&orbit).expect("multipliers").multipliers)
}

#[test]
fn multipliers_have_the_derivatives_of_their_closed_form() {
    let found = |problem: &Problem, near: &Orbit| {
        let ([phase, speed], multipliers) = closed_form(problem.scene(), [near.phases[0], near.speeds[0]]);
        [vec![phase, speed], multipliers.concat()].concat()
    };
    check_orbit(one, [5e-3, 0.6, 3.0, 2.6, 1.0, 100.0, 0.8], &[Kind::Impact], found);
}

#[test]
fn so_have_those_of_symmetric_orbits_and_of_lasting_contacts() {
    for scene in [between, uneven] {
        check_orbit(scene, [5e-3, 0.8, 3.0, 5.0, 1.0, 100.0, 0.2], &[Kind::Impact], corrected);
    }
    check_orbit(soft, [5e-3, 0.3, 3.0, 2.2, 1.0, 100.0, 0.5], &[Kind::Enter, Kind::Leave], corrected);
}

#[test]
fn what_has_no_derivative_is_refused() {
    let numbers = [5e-3, 0.6, 3.0, 2.6, 1.0, 100.0, 0.8];
    let problem = Problem::new(one(numbers)).expect("a problem");
    let mut orbit = problem.settled(400).expect("an orbit");
    let key = SceneTangent::new("gap", 5e-3, |gap| Ok(one([gap, 0.6, 3.0, 2.6, 1.0, 100.0, 0.8]))).expect("a key");
    orbit.speeds[0] *= 1.01;
    let refused = problem.derivative(&orbit, &[key]).expect_err("no solution");
    assert!(refused.to_string().contains("miss one by"), "{refused}");
}
