//! Cost per oscillator and load period in a batch, by instruction set, and by the scheme `event`,
//! measured alternately. Prints a table, checks that both sides found the same motion, and asserts
//! nothing about time.

use signorini::batch::{By, Lane, LaneWall, Plan, Sine, Width};
use signorini::{Oscillator, Scheme, Stepper, WallLaw};
use std::hint::black_box;
use std::time::Instant;

mod support;
use support::race;

/// Number of oscillators, periods of each, and rounds, of which the best counts: a round is short
/// enough to fit between the interruptions of a busy machine.
const LANES: usize = 256;
const PERIODS: u32 = 100;
const ROUNDS: usize = 60;

/// One oscillator in so many is timed by the scheme `event`.
const EVERY: usize = 32;

/// The source oscillator at restitution `e`, under sines of 1 to 6 N.
fn lanes(e: f64) -> Vec<Lane> {
    let stop = |position| Some(LaneWall { position, law: WallLaw::Rigid { restitution: e } });
    let lane = |i: usize| Lane {
        body: Oscillator { mass: 1.0, damping: 0.2, stiffness: 100.0 },
        lower: stop(-5e-3),
        upper: stop(5e-3),
        constant: 0.0,
        period: 0.2,
        sines: vec![Sine { amplitude: 1.0 + 5.0 * i as f64 / LANES as f64, multiple: 1, phase: 0.0 }],
        displacement: 0.0,
        velocity: 0.0,
    };
    (0..LANES).map(lane).collect()
}

/// The state after `periods` by the scheme `event`, driven by its stepper.
fn event(lane: &Lane, periods: u32) -> [f64; 2] {
    let scene = lane.scene(f64::from(periods) * lane.period);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, lane.period).expect("a scene");
    while stepper.time() < scene.duration {
        black_box(stepper.step().expect("a step").q[0]);
    }
    let state = stepper.state();
    [state.q[0], state.v[0]]
}

/// Nanoseconds per oscillator and period.
fn cost(lanes: usize, work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64() * 1e9 / (lanes as f64 * f64::from(PERIODS))
}

fn main() {
    println!("{LANES} oscillators x {PERIODS} periods, one thread; ns an oscillator and period, best of {ROUNDS}");
    println!(
        "{:>5} {:>9} {:>9} {:>9} {:>9} {:>14} {:>8}",
        "e", "AVX-512", "AVX2", "plain", "event", "impacts/period", "handed"
    );
    let available = Width::available();
    for e in [0.9, 0.8, 0.7, 0.5, 0.3] {
        let lanes = lanes(e);
        let plan = |width| Plan { threads: 1, width, ..Plan::new(PERIODS - 1, 1) };
        let run = |width: Width| {
            if !available.contains(&width) {
                return f64::NAN;
            }
            cost(LANES, || drop(black_box(plan(width).run(&lanes).expect("a batch"))))
        };
        let best = race(ROUNDS, || {
            let library = || {
                for lane in lanes.iter().step_by(EVERY) {
                    black_box(event(lane, PERIODS));
                }
            };
            [run(Width::Avx512), run(Width::Avx2), run(Width::Plain), cost(LANES / EVERY, library)]
        });
        let batch = Plan { threads: 1, ..Plan::new(0, PERIODS) }.run(&lanes).expect("a batch");
        let outcomes = batch.outcomes().iter().flatten();
        let impacts: u64 = outcomes.clone().map(|o| o.lower.impacts + o.upper.impacts).sum();
        // Both sides after five periods: before chaos has amplified rounding.
        let short = Plan { threads: 1, ..Plan::new(4, 1) }.run(&lanes).expect("a batch");
        for (index, lane) in lanes.iter().enumerate().step_by(EVERY) {
            let (a, b) = (short.strobes(index)[0], event(lane, 5));
            assert!((a[0] - b[0]).abs() < 1e-10 * 5e-3, "oscillator {index}: {a:?} by lanes, {b:?} by event");
        }
        let handed = outcomes.filter(|o| o.by == By::Event).count();
        println!(
            "{e:>5} {:>9.1} {:>9.1} {:>9.1} {:>9.1} {:>14.2} {:>7.1}%",
            best[0],
            best[1],
            best[2],
            best[3],
            impacts as f64 / (LANES as f64 * f64::from(PERIODS)),
            100.0 * handed as f64 / LANES as f64,
        );
    }
}
