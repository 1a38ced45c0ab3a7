//! Floquet multipliers of an impact oscillator's orbit over the frequency of its load, and where it
//! loses its stability.
//!
//! `cargo run --release --example multipliers`

use signorini::orbit::Problem;
use signorini::orbit::branch::{Request, Switch, graph};
use signorini::{Load, Result, Scene, Wall};

/// 1 kg, 0.2 N s/m, 100 N/m between walls at ±5 mm under 3 N.
fn scene(frequency: f64) -> Result<Scene> {
    Ok(Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
        .with_load(Load::harmonic(3.0, frequency, 0.0)))
}

fn main() -> Result<()> {
    let start = Problem::new(scene(5.0)?)?.settled(200)?;
    let request = Request { range: [4.0, 16.0], switch: Switch::Stable, depth: 1, points: 5000 };
    let found = graph(&scene, &start, 5.0, &request, &mut |_| ())?;
    println!("{:>6} {:>14} {:>14} {:>14}  stable", "branch", "frequency (Hz)", "speed (m/s)", "largest |μ|");
    for (number, branch) in found.branches.iter().enumerate() {
        for point in branch.points.iter().step_by(10) {
            let [re, im] = point.floquet.multipliers[0];
            let speed = point.orbit.speeds.first().copied().unwrap_or(0.0);
            let stable = if point.floquet.is_stable() { "yes" } else { "no" };
            println!("{:>6} {:>14.6} {speed:>14.6} {:>14.6}  {stable}", number + 1, point.value, re.hypot(im));
        }
    }
    for special in &found.specials {
        println!("{} at {:.9} Hz", special.label, special.point.value);
    }
    Ok(())
}
