//! Work and precision from the library: the cost of an error, scheme by scheme.
//!
//! `cargo run --release --example work_precision` prints the error of displacement and impulse
//! against the exact motion, and the time of a run, for steps that are halved again and again, as
//! CSV. (`signorini chart` does this for any case file, with figures.)

use signorini::{Integrator, Load, Options, PenaltyLaw, Result, Run, Scene, Scheme, Unjudged, Wall, run};

/// The source scene, 1 kg between rigid walls at ±5 mm, over the first second.
fn scene() -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
        .with_duration(1.0)
}

/// Largest difference of displacement over the gap, and of the walls' impulses (relative to the
/// larger), between a run and the exact one.
fn errors(run: &Run<Unjudged>, exact: &Run<Unjudged>) -> Result<(f64, f64)> {
    let pairs = run.trajectory.displacement().iter().zip(exact.trajectory.displacement());
    let displacement = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / 5e-3;
    let (mut off, mut largest) = (0.0_f64, 0.0_f64);
    for wall in ["upper", "lower"] {
        let (found, true_value) = (run.trajectory.impulse(wall)?, exact.trajectory.impulse(wall)?);
        off = off.max((found - true_value).abs());
        largest = largest.max(true_value.abs());
    }
    Ok((displacement, off / largest))
}

fn main() -> Result<()> {
    let scene = scene();
    // The same rows, 10 ms apart, for all runs, so that they can be compared. Unjudged, since the
    // judge's time would count.
    let options = |step: f64| Options::with_step(step).with_sample(0.01).unjudged();
    let exact = run(&scene, &Scheme::Event, &options(1e-3))?;
    let soft = PenaltyLaw::Linear { stiffness: 1e8, damping: 0.0 };
    let schemes = [
        Scheme::MoreauJean { theta: 0.5 },
        Scheme::PaoliSchatzman,
        Scheme::GeneralizedAlpha { rho: 0.8 },
        // The penalty tends to e = 1, so it cannot come near: the walls here have e = 0.8.
        Scheme::Penalty { law: soft, integrator: Integrator::DiscreteGradient },
    ];
    println!("scheme,step_s,displacement_error_of_gap,impulse_error,seconds");
    println!("event,,0,0,{:.2e}", exact.seconds);
    for scheme in schemes {
        for halvings in 0..8 {
            let step = 2e-3 * 0.5_f64.powi(halvings);
            let run = run(&scene, &scheme, &options(step))?;
            let (displacement, impulse) = errors(&run, &exact)?;
            println!("{scheme},{step:e},{displacement:.2e},{impulse:.2e},{:.2e}", run.seconds);
        }
    }
    Ok(())
}
