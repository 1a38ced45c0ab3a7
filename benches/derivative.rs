//! Cost of an exact run with its derivatives by 1, 4 and 7 keys, over that of the run without,
//! measured alternately: a body between two walls, and chains of masses. Prints a table, asserts
//! nothing about time. The target is half a run for each key.
//!
//! `cargo bench --bench derivative`

use signorini::study::derivatives::Derivatives;
use signorini::variation::SceneTangent;
use signorini::{Chain, Damping, Load, Scene, Scheme, Stepper, Wall};
use std::hint::black_box;

mod support;
use support::{race, time};

/// Number of rounds, of which the best counts.
const ROUNDS: usize = 20;

/// Gap, restitution, amplitude, frequency, mass, spring and dashpot.
type Numbers = [f64; 7];

const NAMES: [&str; 7] = ["gap", "restitution", "amplitude", "frequency", "mass", "stiffness", "damping"];

/// A body between two walls.
fn body([gap, e, amplitude, frequency, m, k, c]: Numbers, end: f64) -> Scene {
    Scene::oscillator(m, c, k)
        .with_wall(Wall::upper("upper", gap).with_restitution(e))
        .with_wall(Wall::lower("lower", -gap).with_restitution(e))
        .with_load(Load::harmonic(amplitude, frequency, 0.0))
        .with_duration(end)
}

/// Masses in a row, of which the first strikes a wall.
fn chain(masses: usize, [gap, e, amplitude, frequency, m, k, c]: Numbers, end: f64) -> Scene {
    let chain = Chain { masses: vec![m; masses], springs: vec![k; masses - 1], grounds: [k, 0.3 * k] };
    let damping = Damping::Rayleigh { mass: c, stiffness: 4e-3 };
    let structure = chain.structure().and_then(|chain| chain.with_damping(&damping)).expect("a chain");
    Scene::structure(structure)
        .with_wall(Wall::upper("stop", gap).with_restitution(e))
        .with_load(Load::harmonic(amplitude, frequency, 0.0))
        .with_duration(end)
}

/// One line: a family of scenes and its numbers.
fn line(what: &str, scene: &dyn Fn(Numbers) -> Scene, numbers: Numbers) {
    let own = scene(numbers);
    let tangent = |index: usize| {
        let at = |x: f64| {
            let mut changed = numbers;
            changed[index] = x;
            Ok(scene(changed))
        };
        SceneTangent::new(NAMES[index], numbers[index], at).expect("a key")
    };
    let tangents: Vec<SceneTangent> = (0..7).map(tangent).collect();
    let with = |keys: usize| Derivatives::new(&own, &tangents[..keys], &[]).expect("derivatives");
    let whole = with(7);
    let best = race(ROUNDS, || {
        let alone = time(1, |_| {
            let mut stepper = Stepper::new(&own, &Scheme::Event, own.duration).expect("a scene");
            while stepper.time() < own.duration {
                black_box(stepper.step().expect("a step"));
            }
        });
        [
            alone,
            time(1, |_| drop(black_box(with(1)))),
            time(1, |_| drop(black_box(with(4)))),
            time(1, |_| drop(black_box(with(7)))),
        ]
    });
    let [alone, one, four, seven] = best;
    let ended = whole.ended.map_or_else(String::new, |reason| format!(" ({reason})"));
    println!(
        "{what:<24} {:>9.3} {:>8.2} {:>8.2} {:>8.2} {:>9}{ended}",
        1e-6 * alone,
        one / alone,
        four / alone,
        seven / alone,
        whole.contacts.len()
    );
}

fn main() {
    println!("{:<24} {:>9} {:>8} {:>8} {:>8} {:>9}", "exact run", "ms", "1 key", "4 keys", "7 keys", "contacts");
    println!("{:<24} {:>9} {:>8.2} {:>8.2} {:>8.2}", "target", "", 1.5, 3.0, 4.5);
    let bodies = [5e-3, 0.8, 3.0, 5.0, 1.0, 100.0, 0.2];
    line("body between walls", &|numbers| body(numbers, 20.0), bodies);
    let unseen = |numbers| Scene { probes: Vec::new(), ..body(numbers, 20.0) };
    line("body, no means asked for", &unseen, bodies);
    for masses in [2, 6, 20] {
        let scene = move |numbers: Numbers| chain(masses, numbers, 5.0);
        line(&format!("chain of {masses}"), &scene, [5e-3, 0.6, 2.0, 1.3, 1.0, 60.0, 0.6]);
    }
}
