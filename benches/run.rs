//! Cost of a run compared with its stepper alone: with the judge, with recording, and with both,
//! measured alternately. Prints a table, asserts nothing about time.

use signorini::{Load, Options, Scene, Scheme, Stepper, TimeOptions, Wall, case::Case, run};
use std::hint::black_box;

mod support;
use support::{race, time};

/// Number of rounds, of which the best counts; the variants alternate within each. Most rounds last
/// a millisecond or two, so that some fit between the interruptions of a busy machine.
const ROUNDS: usize = 40;

/// One line: a scene, a scheme, the step and the rows, and the duration of a round (s).
fn line(what: &str, scene: &Scene, scheme: &Scheme, times: TimeOptions, end: f64) {
    // A word on the command line selects the lines that contain it.
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    if !words.is_empty() && !words.iter().any(|word| what.contains(word.as_str())) {
        return;
    }
    let scene = scene.clone().with_duration(end);
    let (options, step) = (Options::new(times), times.step);
    let count = {
        let counters = run(&scene, scheme, &options.unjudged().unrecorded()).expect("a run").counters;
        if *scheme == Scheme::Event { counters.events.max(1) } else { counters.steps }
    };
    let best = race(ROUNDS, || {
        let alone = time(1, |_| {
            let mut stepper = Stepper::new(&scene, scheme, step).expect("a scene");
            // The time on a grid has rounding errors, so half a step is subtracted; the exact
            // scheme ends exactly at the end.
            let last = if *scheme == Scheme::Event { end } else { end - 0.5 * step };
            while stepper.time() < last {
                black_box(stepper.step().expect("a step"));
            }
        });
        [
            alone,
            time(1, |_| drop(black_box(run(&scene, scheme, &options.unjudged().unrecorded()).expect("a run")))),
            time(1, |_| drop(black_box(run(&scene, scheme, &options.unrecorded()).expect("a run")))),
            time(1, |_| drop(black_box(run(&scene, scheme, &options.unjudged()).expect("a run")))),
            time(1, |_| drop(black_box(run(&scene, scheme, &options).expect("a run")))),
        ]
    })
    .map(|ns| ns / count as f64);
    let [alone, bare, judged, recorded, both] = best;
    println!(
        "{what:<30} {alone:>9.1} {bare:>9.1} {judged:>9.1} {recorded:>9.1} {both:>9.1} {:>8.2} {:>8.2}",
        judged / alone,
        both / alone
    );
}

/// The source oscillator between rigid walls.
fn source(e: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(e))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(e))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
}

fn main() {
    println!(
        "{:<30} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8}",
        "ns a step (event: an impact)", "Stepper", "run bare", "judged", "recorded", "both", "judged/", "both/"
    );
    let jean = Scheme::MoreauJean { theta: 0.5 };
    let every = TimeOptions::with_step;
    line("moreau-jean, e = 0.8", &source(0.8), &jean, every(1e-4), 1.0);
    line("paoli-schatzman, e = 0.8", &source(0.8), &Scheme::PaoliSchatzman, every(1e-4), 1.0);
    line("event, e = 0.8", &source(0.8), &Scheme::Event, every(60.0), 60.0);
    for (name, steps) in [("chain-20", 500.0), ("chain-200", 50.0)] {
        let case = Case::embedded(name).expect("a built-in case");
        line(&format!("{name}, moreau-jean"), &case.scene, &jean, every(case.time.step), steps * case.time.step);
    }
    // The contacts of a tube that starts at rest begin within the first tenths of a second; rows
    // and statistics as in its case.
    for name in ["tube-loose-supports", "tube-round-supports"] {
        let case = Case::embedded(name).expect("a built-in case");
        let times = TimeOptions { statistics_from: 0.0, ..case.time };
        for (by, scheme) in [("moreau-jean", jean), ("located", Scheme::Located)] {
            line(&format!("{name}, {by}"), &case.scene, &scheme, times, 1.0);
        }
    }
}
