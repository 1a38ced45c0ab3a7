//! Poincaré points by hand: the state of an impact oscillator once a period of its load, for a
//! range of frequencies.
//!
//! `cargo run --release --example poincare > points.csv` prints frequency, displacement and
//! velocity: plotted over the frequency, a bifurcation diagram. Periodic motion is a few points,
//! chaos is many.
//!
//! The exact scheme ends its steps at events and at multiples of its stride: with the period of the
//! load for a stride, those multiples are the Poincaré section, and nothing has to be interpolated.

use signorini::{Load, Result, Scene, Scheme, Stepper, Wall};
use std::collections::BTreeSet;

/// Number of periods for the transient to decay, and number of recorded ones.
const TRANSIENT: u32 = 200;
const RECORDED: u32 = 50;

/// The states at the multiples of the period after the transient, for a load of `frequency` (Hz).
fn section(frequency: f64) -> Result<Vec<(f64, f64)>> {
    let period = 1.0 / frequency;
    let scene = Scene::oscillator(1.0, 0.4, 100.0)
        .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.7))
        .with_load(Load::harmonic(2.0, frequency, 0.0))
        .with_duration(f64::from(TRANSIENT + RECORDED) * period);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, period)?;
    let mut points = Vec::new();
    for count in 1..=TRANSIENT + RECORDED {
        // Steps end at impacts too: go on to the next multiple of the period, which is reached up
        // to rounding of the time.
        let section = f64::from(count) * period;
        while stepper.time() < section * (1.0 - 1e-12) {
            stepper.step()?;
        }
        if count > TRANSIENT {
            let state = stepper.state();
            points.push((state.q[0], state.v[0]));
        }
    }
    Ok(points)
}

fn main() -> Result<()> {
    println!("frequency_hz,displacement_m,velocity_m_per_s");
    for step in 0..60_u32 {
        let frequency = 2.0 + 0.05 * f64::from(step);
        let points = section(frequency)?;
        for (q, v) in &points {
            println!("{frequency:.3},{q:.9e},{v:.9e}");
        }
        // Points closer than a thousandth of the gap count as one.
        let distinct: BTreeSet<i64> = points.iter().map(|(q, _)| (q / 5e-6).round() as i64).collect();
        eprintln!("{frequency:.3} Hz: {} distinct points of {RECORDED}", distinct.len());
    }
    Ok(())
}
