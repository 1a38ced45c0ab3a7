//! Cost of a row of a sweep compared with its bare engine: the same scenes, built beforehand,
//! stepped to their ends. Both are measured alternately, the best of several, on one thread.
//!
//! `cargo bench --bench sweep`

use signorini::case::CaseFile;
use signorini::sweep::{Axis, Kernel, Measure, Plan, Sweep, Window};
use signorini::{Scene, Scheme, Stepper};
use std::time::Instant;

const REPEATS: usize = 15;

/// Seconds of the best of several runs of each, alternating.
fn best<const N: usize>(mut works: [&mut dyn FnMut(); N]) -> [f64; N] {
    let mut least = [f64::INFINITY; N];
    for _ in 0..REPEATS {
        for (work, least) in works.iter_mut().zip(&mut least) {
            let started = Instant::now();
            work();
            *least = least.min(started.elapsed().as_secs_f64());
        }
    }
    least
}

fn plan(case: &str, points: u64, window: Window, kernel: Kernel, measures: &[Measure]) -> Plan {
    let sweep = Sweep::new(CaseFile::embedded(case).expect("a built-in case"));
    let axis = Axis::linear("load.1.harmonic.frequency", 4.0, 5.5, points).expect("a key");
    let sweep = sweep.vary(axis).by("event").kernel(kernel).over(window).measure(measures.iter().copied());
    sweep.judged(0).plan().expect("a plan")
}

fn scenes(case: &str, points: u64, periods: u32) -> Vec<Scene> {
    let scene = |i: u64| {
        let frequency = 4.0 + 1.5 * (i as f64 / (points - 1) as f64);
        let mut file = CaseFile::embedded(case).expect("a built-in case");
        file.set(&"load.1.harmonic.frequency".parse().expect("a key"), &frequency.into()).expect("a value");
        let mut scene = file.case().expect("a case").scene;
        scene.duration = f64::from(periods) * (1.0 / frequency);
        scene
    };
    (0..points).map(scene).collect()
}

fn main() {
    println!("{:18} {:>8} {:>9} {:>12} {:>12} {:>7}", "case", "rows", "periods", "row (s)", "engine (s)", "ratio");
    for (case, points, settle, keep) in [
        ("rigid-walls-sine", 200, 150, 50),
        ("rigid-walls-sine", 50, 800, 200),
        ("two-masses", 20, 15, 5),
        ("tube-loose-supports", 2, 1, 1),
    ] {
        let periods = settle + keep;
        let window = Window::Periods { settle, keep };
        let measures = [Measure::Contacts, Measure::ImpulseMean, Measure::ImpactPower];
        let plan = plan(case, points, window, Kernel::Scalar, &measures);
        let scenes = scenes(case, points, periods);
        let mut rows = || assert_eq!(plan.rows(1).expect("rows").len() as u64, points);
        let mut steppers = || {
            for scene in &scenes {
                let mut stepper = Stepper::new(scene, &Scheme::Event, scene.duration).expect("a stepper");
                while stepper.time() < scene.duration {
                    stepper.step().expect("a step");
                }
            }
        };
        let [row, engine] = best([&mut rows, &mut steppers]);
        let each = |seconds: f64| seconds / points as f64;
        println!(
            "{case:18} {points:>8} {periods:>9} {:>12.3e} {:>12.3e} {:>7.3}",
            each(row),
            each(engine),
            row / engine
        );
    }
    let window = Window::Periods { settle: 150, keep: 50 };
    let plan = plan("rigid-walls-sine", 4096, window, Kernel::Batch, &[Measure::Impulse, Measure::Lyapunov]);
    let [seconds] = best([&mut || assert_eq!(plan.rows(1).expect("rows").len(), 4096)]);
    println!("batch kernel: {:.3e} s a row of 200 periods", seconds / 4096.0);
}
