//! Orbits a second, with multipliers, admissibility and special points: Newton's method alone, and
//! along a branch in the frequency, of one degree of freedom and of structures. One thread, the
//! best of several.
//!
//! `cargo bench --bench orbit`

use signorini::orbit::branch::{Request, Switch, graph};
use signorini::orbit::{Problem, closed_forms, shoot};
use signorini::{Chain, Damping, Load, Scene, Wall};
use std::time::Instant;

const REPEATS: usize = 7;

fn scene(frequency: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
        .with_wall(Wall::lower("lower", -4.9e-3).with_restitution(0.8))
        .with_load(Load::harmonic(3.0, frequency, 0.0))
}

/// Masses in a row, of which the first strikes a wall.
fn chain(masses: usize, frequency: f64) -> Scene {
    let chain = Chain { masses: vec![1.0; masses], springs: vec![60.0; masses - 1], grounds: [80.0, 20.0] };
    let damping = Damping::Rayleigh { mass: 0.6, stiffness: 4e-3 };
    let structure = chain.structure().and_then(|chain| chain.with_damping(&damping)).expect("a chain");
    Scene::structure(structure)
        .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.6))
        .with_load(Load::harmonic(2.0, frequency, 0.0))
}

/// Seconds of the best of several runs.
fn best(mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let started = Instant::now();
        work();
        started.elapsed().as_secs_f64()
    };
    (0..REPEATS).map(time).fold(f64::INFINITY, f64::min)
}

fn main() {
    let start = Problem::new(scene(5.0)).and_then(|problem| problem.settled(400)).expect("an orbit");
    println!("orbit of {} impacts", start.phases.len());
    let problem = Problem::new(scene(5.0)).expect("a problem");
    let mut near = start.clone();
    near.phases.iter_mut().for_each(|phase| *phase += 1e-3);
    let count = 2000;
    let newton = best(|| (0..count).for_each(|_| drop(std::hint::black_box(problem.correct(&near)))));
    println!("Newton's method from 1e-3 cycles away: {:.0} orbits/s", f64::from(count) / newton);
    let floquet = best(|| (0..count).for_each(|_| drop(std::hint::black_box(problem.floquet(&start)))));
    let admissible = best(|| (0..count).for_each(|_| drop(std::hint::black_box(problem.admissible(&start)))));
    println!("multipliers {:.2} µs, admissibility {:.2} µs", 1e6 * floquet / 2e3, 1e6 * admissible / 2e3);
    let listed = best(|| drop(std::hint::black_box(closed_forms(problem.scene(), 8))));
    println!("all closed forms up to 8 periods: {:.1} µs", 1e6 * listed);
    let request = Request { range: [4.7, 12.0], switch: Switch::No, depth: 0, points: 100_000 };
    let mut points = 0;
    let branch = best(|| {
        let found = graph(&|frequency| Ok(scene(frequency)), &start, 5.0, &request, &mut |_| ()).expect("a branch");
        points = found.branches[0].points.len();
    });
    println!("branch: {points} orbits, {:.0} orbits/s", points as f64 / branch);
    for masses in [2, 20] {
        let start = shoot(&chain(masses, 1.9), 400, &|_| ()).expect("an orbit");
        let request = Request { range: [1.85, 1.95], ..request };
        let branch = best(|| {
            let found = graph(&|frequency| Ok(chain(masses, frequency)), &start, 1.9, &request, &mut |_| ());
            points = found.expect("a branch").branches[0].points.len();
        });
        let events = start.orbit.phases.len();
        println!("{masses} masses, {events} events: {points} orbits, {:.0} orbits/s", points as f64 / branch);
    }
}
