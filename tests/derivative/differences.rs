//! Structures against central differences of exact runs: chains of five and six masses, and a beam
//! reduced to modes under a random force.

use signorini::case::Case;
use signorini::linear::Symmetric;
use signorini::study::derivatives::Derivatives;
use signorini::variation::SceneTangent;
use signorini::{Load, Result, Row, Scene, Structure, Wall};

/// So many contacts are compared: how many impacts of an accumulation are resolved is a matter of
/// rounding.
const FIRST: usize = 20;

/// What is compared: of the first contacts their instants, their speeds and their impulses, then
/// means.
fn listed(found: &Derivatives) -> [Vec<f64>; 4] {
    let mut kinds: [Vec<f64>; 4] = Default::default();
    for contact in found.contacts.iter().take(FIRST).map(|one| one.contact) {
        kinds[0].extend([contact.start, contact.end.expect("an end")]);
        kinds[1].extend([contact.approach_speed, contact.departure_speed.expect("an end")]);
        kinds[2].push(contact.impulse);
    }
    let means = found.means.as_ref().expect("means");
    kinds[3] = [&means.rms[..], &means.force].concat();
    kinds
}

/// Their derivatives by the one key.
fn derived(found: &Derivatives) -> [Vec<f64>; 4] {
    let mut kinds: [Vec<f64>; 4] = Default::default();
    for contact in found.contacts.iter().take(FIRST) {
        kinds[0].extend([contact.start_by[0], contact.end_by[0]]);
        kinds[1].extend([contact.approach_speed_by[0], contact.departure_speed_by[0]]);
        kinds[2].push(contact.impulse_by[0]);
    }
    let means = found.means.as_ref().expect("means");
    kinds[3] = means.rms_by.iter().chain(&means.force_by).map(|by| by[0]).collect();
    kinds
}

/// The largest difference as a share of the largest number of its kind, and the contacts compared.
///
/// A run is exact to about 1e-14 of itself times its growth, of 3 for the chains and of 14 for the
/// beam. Over a step of 1e-4 that is 3e-10 of the derivative, and 1e-8 over one of 1e-5, which the
/// accumulating impacts of the beam need; the fourth power of the step leaves less. `within` is
/// thirty to a hundred times as much, since numbers are differences of larger ones.
fn check(name: &str, build: &dyn Fn(f64) -> Result<Scene>, value: f64, step: f64, within: f64) {
    let tangent = SceneTangent::new(name, value, build).expect("a tangent");
    let found = |x: f64| Derivatives::new(&build(x).unwrap(), std::slice::from_ref(&tangent), &[]).expect("a run");
    let own = found(value);
    assert!(own.ended.is_none() && own.contacts.len() >= 4, "{name}: {:?}, {}", own.ended, own.contacts.len());
    let h = step * value;
    let [a, b, c, d] = [1.0, -1.0, 2.0, -2.0].map(|k| listed(&found(value + k * h)));
    let mut worst = 0.0_f64;
    for (kind, ours) in derived(&own).iter().enumerate() {
        assert!([&a, &b, &c, &d].iter().all(|other| other[kind].len() == ours.len()), "{name}: other contacts");
        let difference = |i: usize| (8.0 * (a[kind][i] - b[kind][i]) - (c[kind][i] - d[kind][i])) / (12.0 * h);
        let size = (0..ours.len()).fold(0.0, |most: f64, i| most.max(difference(i).abs()));
        for (i, ours) in ours.iter().enumerate() {
            worst = worst.max((ours - difference(i)).abs() / size);
        }
    }
    println!("{name}: {} contacts, {worst:.1e}, growth {:.0}", own.contacts.len(), own.growth);
    assert!(worst <= within, "{name}: {worst:e}");
}

/// Masses in a row on the ground, driven at the first; the last meets a rigid stop, the second a
/// buffer with a dashpot. The numbers: mass of the third, springs, dashpots, gap, restitution,
/// stiffness and dashpot of the buffer, amplitude, frequency, start of the last.
fn chain(n: usize, x: [f64; 10]) -> Scene {
    let [mass, spring, dash, gap, e, stiff, damped, amplitude, frequency, start] = x;
    let tied = |k: f64| {
        let middle = (0..n).map(|i| (i, i, if i + 1 == n { k } else { 2.0 * k }));
        Symmetric::from_entries(n, middle.chain((1..n).map(|i| (i, i - 1, -k))))
    };
    let masses: Vec<f64> = (0..n).map(|i| if i == 2 { mass } else { 1.0 + 0.1 * i as f64 }).collect();
    let structure = Structure { mass: Symmetric::diagonal(&masses), damping: tied(dash), stiffness: tied(spring) };
    let mut q = vec![0.0; n];
    q[n - 1] = start;
    Scene::structure(structure)
        .with_wall(Wall::upper("stop", gap).with_restitution(e).at(Row::dof(n - 1)))
        .with_wall(Wall::lower("buffer", -0.6 * gap).with_elasticity(stiff, damped).at(Row::dof(1)))
        .with_load(Load { at: Row::dof(0), ..Load::harmonic(amplitude, frequency, 0.2) })
        .with_initial(&q, &vec![0.0; n])
        .with_duration(4.0)
}

const NAMES: [&str; 10] =
    ["mass", "spring", "dash", "gap", "restitution", "stiffness", "damping", "amplitude", "frequency", "start"];

#[test]
fn chains_of_five_and_six_have_the_differences_of_their_runs() {
    let numbers = [1.4, 80.0, 0.4, 0.05, 0.6, 900.0, 5.0, 8.0, 0.9, -0.02];
    for n in [5, 6] {
        for (index, name) in NAMES.into_iter().enumerate() {
            let build = |x: f64| {
                let mut changed = numbers;
                changed[index] = x;
                Ok(chain(n, changed))
            };
            check(&format!("{n} masses, {name}"), &build, numbers[index], 1e-4, 1e-8);
        }
    }
}

/// A beam of six modes that rattles between stops under a random force of a fixed seed.
const BEAM: &str = r#"
[system]
modes = 6

[system.beam]
length = 1.0
youngs_modulus = 200e9
density = 7850.0
outer_diameter = 12e-3
inner_diameter = 10e-3
elements = 20
left = "pinned"
right = "pinned"

[system.damping]
ratio = 0.02

[[wall]]
name = "guide"
at = { position = 0.4 }
side = "both"
gap = 0.2e-3
restitution = 0.5

[[load]]
at = { position = 0.6 }
random = { rms = 12.0, from = 20.0, to = 200.0, seed = 3 }

[[probe]]
name = "middle"
at = { position = 0.5 }

[time]
end = 0.03
step = 1e-5
"#;

#[test]
fn a_beam_under_a_random_force_has_the_differences_of_its_runs() {
    for (key, value) in [
        ("load.1.random.rms", 12.0),
        ("system.beam.youngs_modulus", 200e9),
        ("system.beam.outer_diameter", 12e-3),
        ("system.damping.ratio", 0.02),
        ("wall.guide.gap", 0.2e-3),
    ] {
        let build = |x: f64| Ok(Case::parse(BEAM, "beam.toml", "")?.with(key, x)?.scene);
        check(key, &build, value, 1e-5, 1e-6);
    }
}

/// Guide, load and probe stand at nodes, where the second derivative of the beam's shape jumps: the
/// differences of the runs err by the first power of their step, 1e-6, and by 1e-15 times the
/// growth of 14 over it, 1e-8 of numbers that are differences of larger ones.
#[test]
fn a_beam_has_derivatives_by_its_length_and_by_places_at_nodes() {
    for (key, value) in [("system.beam.length", 1.0), ("wall.guide.at.position", 0.4), ("load.1.at.position", 0.6)] {
        let build = |x: f64| Ok(Case::parse(BEAM, "beam.toml", "")?.with(key, x)?.scene);
        check(key, &build, value, 1e-6, 1e-5);
    }
}

/// The shape of a bar is bent at its nodes: the derivative on one side differs from that on the
/// other.
#[test]
fn a_place_at_a_node_of_a_bar_has_no_derivative() {
    let bar = r#"
        [system.bar]
        length = 1.0
        youngs_modulus = 1.0
        density = 1.0
        area = 1.0
        elements = 5
        left = "clamped"
        right = "free"
        [[wall]]
        name = "stop"
        at = { position = 0.6 }
        side = "upper"
        position = 0.01
        [time]
        end = 1.0
        step = 1e-3
    "#;
    let tangent = |key: &str| Case::parse(bar, "bar.toml", "")?.tangent(&key.parse()?);
    let refused = tangent("wall.stop.at.position").expect_err("a kink").to_string();
    assert!(refused.contains("depends smoothly"), "{refused}");
    let misspelt = tangent("wall.stopp.position").expect_err("no such wall").to_string();
    assert!(misspelt.contains("no wall is named \"stopp\""), "{misspelt}");
}
