//! A bifurcation diagram: Poincaré points of the source oscillator over the frequency of its load,
//! all oscillators at once.
//!
//! `cargo run --release --example bifurcation > points.csv` prints frequency, displacement and
//! velocity once a period: plotted over the frequency, periodic motion is a few points, chaos is
//! many. A summary of the batch goes to stderr.

use signorini::batch::{Lane, Plan};
use signorini::{Load, Result, Scene, Wall};

/// Frequencies from 2 Hz to 7 Hz.
const FREQUENCIES: u32 = 500;

/// Number of periods for the transient to decay, and number of recorded ones.
const SETTLE: u32 = 300;
const KEEP: u32 = 40;

fn main() -> Result<()> {
    let frequency = |i: u32| 2.0 + 5.0 * f64::from(i) / f64::from(FREQUENCIES - 1);
    let lane = |i: u32| {
        let scene = Scene::oscillator(1.0, 0.2, 100.0)
            .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
            .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
            .with_load(Load::harmonic(3.0, frequency(i), 0.0));
        Lane::of(&scene, 1.0 / frequency(i))
    };
    let lanes = (0..FREQUENCIES).map(lane).collect::<Result<Vec<_>>>()?;
    let batch = Plan::new(SETTLE, KEEP).run(&lanes)?;
    println!("frequency_Hz,displacement_m,velocity_m_per_s");
    for i in 0..FREQUENCIES {
        for [q, v] in batch.strobes(i as usize) {
            println!("{:.4},{q:.9e},{v:.9e}", frequency(i));
        }
    }
    let chaotic = batch.outcomes().iter().flatten().filter(|outcome| outcome.exponent > 0.05).count();
    eprintln!(
        "{FREQUENCIES} frequencies: {chaotic} with a Lyapunov exponent above 0.05 /s, {} handed to the exact scheme",
        batch.handed()
    );
    Ok(())
}
