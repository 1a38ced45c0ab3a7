//! located beside moreau-jean: the cost of a step without contact, and the time to an error of a
//! thousandth of the gap. The sides are measured alternately. Prints two tables, and asserts
//! nothing about time.
//!
//! The error is that of the displacements at the probes at the end, against the exact scheme, while
//! the motion is predictable. Each scheme takes the largest step of a ladder, a factor of 10^(1/8)
//! from rung to rung, from which on down to a tenth of it no step has a larger error than asked.

use signorini::case::Case;
use signorini::{Options, Scene, Scheme, Stepper, run};
use std::hint::black_box;

mod support;
use support::{race, time};

/// Best of these rounds counts.
const ROUNDS: usize = 15;

/// Error over the gap scale that both are to reach.
const ERROR: f64 = 1e-3;

const MOREAU_JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// The scene of a built-in case up to `end` (s), with this restitution at all walls if one is
/// given.
fn scene(name: &str, restitution: Option<f64>, end: f64) -> Scene {
    let mut scene = Case::embedded(name).expect("a built-in case").scene.with_duration(end);
    if let Some(e) = restitution {
        scene.walls.iter_mut().for_each(|wall| *wall = wall.clone().with_restitution(e));
    }
    scene
}

/// The probes' displacements at the end by `scheme` with steps of `h` (s).
fn shown(scene: &Scene, scheme: Scheme, h: f64) -> Vec<f64> {
    let done = run(scene, &scheme, &Options::with_step(h)).expect("a run");
    assert!(done.findings.is_empty(), "{scheme} at {h:e}: {:?}", done.findings);
    scene.probes.iter().map(|probe| probe.at.dot(&done.state.q)).collect()
}

/// The largest step of a ladder down to `least` (s) with which `scheme` keeps the error, and with
/// it every tenth below.
fn largest_step(scene: &Scene, scheme: Scheme, exact: &[f64], [most, least]: [f64; 2]) -> Option<f64> {
    let rungs = (8.0 * (most / least).log10()).ceil() as i32;
    let ladder: Vec<(f64, bool)> = (0..=rungs)
        .map(|k| {
            let h = scene.duration / (scene.duration / (most * 10_f64.powf(-f64::from(k) / 8.0))).ceil();
            let apart =
                shown(scene, scheme, h).iter().zip(exact).fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs()));
            (h, apart <= ERROR * scene.gap_scale())
        })
        .collect();
    (0..ladder.len()).find(|&k| ladder[k..].iter().take(9).all(|rung| rung.1)).map(|k| ladder[k].0)
}

/// Nanoseconds of a run's steps.
fn cost(scene: &Scene, scheme: Scheme, h: f64) -> f64 {
    let mut stepper = Stepper::new(scene, &scheme, h).expect("a stepper");
    let end = scene.duration - 0.5 * h;
    time(1, |_| {
        while stepper.time() < end {
            black_box(stepper.step().expect("a step").q);
        }
    })
}

fn main() {
    println!("a step without contact, ns          located  moreau-jean  ratio");
    for (name, h) in [("rigid-walls-sine", 1e-5), ("chain-200", 1e-3)] {
        let mut scene = scene(name, None, 2e4 * h);
        scene.loads.clear();
        scene.initial.v.iter_mut().for_each(|v| *v = 1e-4);
        let steps = scene.duration / h;
        let [located, moreau] =
            race(ROUNDS, || [Scheme::Located, MOREAU_JEAN].map(|scheme| cost(&scene, scheme, h) / steps));
        println!("{name:32} {located:10.1} {moreau:12.1} {:6.2}", located / moreau);
    }
    println!("\nto an error of {ERROR:.0e} of the gap   end (s)  located: step, µs    moreau-jean: step, µs   ratio");
    let cases = [
        ("rigid-walls-sine", Some(1.0), 1.0),
        ("rigid-walls-sine", Some(0.8), 1.0),
        ("rigid-walls-sine", Some(0.0), 1.0),
        ("bouncing-ball", None, 0.8),
        ("two-masses", None, 1.0),
        ("chain-20", Some(0.0), 0.1),
        ("chain-20", Some(0.5), 0.1),
        ("tube-loose-supports", None, 0.02),
        ("tube-round-supports", None, 0.02),
    ];
    for (name, restitution, end) in cases {
        let mut scene = scene(name, restitution, end);
        // The exact scheme follows round holes without friction.
        scene.walls.iter_mut().for_each(|wall| wall.friction = 0.0.into());
        let exact = shown(&scene, Scheme::Event, end);
        let label = restitution.map_or(String::new(), |e| format!(", e = {e}"));
        let located = largest_step(&scene, Scheme::Located, &exact, [1e-1 * end, 1e-6 * end]);
        let moreau = largest_step(&scene, MOREAU_JEAN, &exact, [1e-1 * end, 1e-7 * end]);
        let (Some(located), Some(moreau)) = (located, moreau) else {
            println!("{:32} {end:7.2}  {located:?} {moreau:?}", format!("{name}{label}"));
            continue;
        };
        let [a, b] = race(ROUNDS, || [cost(&scene, Scheme::Located, located), cost(&scene, MOREAU_JEAN, moreau)])
            .map(|ns| 1e-3 * ns);
        println!(
            "{:32} {end:7.2}  {located:10.1e} {a:9.1}  {moreau:14.1e} {b:9.1}  {:6.1}",
            format!("{name}{label}"),
            b / a
        );
    }
}
