//! Poincaré points by hand: the state of an impact oscillator once a period of its load, for a
//! range of frequencies, with the Jacobian of the map that leads from each point to the next.
//!
//! `cargo run --release --example poincare > points.csv` prints frequency, displacement, velocity
//! and the Jacobian, row by row: plotted over the frequency, a bifurcation diagram. Periodic motion
//! is a few points, chaos is many. The product of the Jacobians along a periodic motion has its
//! Floquet multipliers as eigenvalues; the largest is told of motions of one period.
//!
//! The exact scheme ends its steps at events and at multiples of its stride: with the period of the
//! load for a stride, those multiples are the Poincaré section, and nothing has to be interpolated.

use nalgebra::DMatrix;
use signorini::variation::Product;
use signorini::{Load, Scene, Scheme, Stepper, Wall};
use std::collections::BTreeSet;
use std::error::Error;

/// Number of periods for the transient to decay, and number of recorded ones.
const TRANSIENT: u32 = 200;
const RECORDED: u32 = 50;

/// A Poincaré point.
struct Point {
    /// Displacement (m) and velocity (m/s).
    state: (f64, f64),
    /// ∂(this state)/∂(the state one period before).
    jacobian: DMatrix<f64>,
}

/// The points at the multiples of the period after the transient, for a load of `frequency` (Hz).
fn section(frequency: f64) -> Result<Vec<Point>, Box<dyn Error>> {
    let period = 1.0 / frequency;
    let scene = Scene::oscillator(1.0, 0.4, 100.0)
        .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.7))
        .with_load(Load::harmonic(2.0, frequency, 0.0))
        .with_duration(f64::from(TRANSIENT + RECORDED) * period);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, period)?;
    let mut product = Product::new(&scene)?;
    let mut points = Vec::new();
    for count in 1..=TRANSIENT + RECORDED {
        product.restart();
        // Steps end at impacts too: go on to the next multiple of the period, which is reached up
        // to rounding of the time.
        let section = f64::from(count) * period;
        while stepper.time() < section * (1.0 - 1e-12) {
            product.observe(&stepper.step()?)?;
        }
        if count > TRANSIENT {
            let state = stepper.state();
            points.push(Point { state: (state.q[0], state.v[0]), jacobian: product.matrix().clone() });
        }
    }
    Ok(points)
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("frequency_hz,displacement_m,velocity_m_per_s,dq_dq,dq_dv_s,dv_dq_per_s,dv_dv");
    for step in 0..60_u32 {
        let frequency = 2.0 + 0.05 * f64::from(step);
        let points = section(frequency)?;
        for Point { state: (q, v), jacobian } in &points {
            let entries = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|at| format!("{:.9e}", jacobian[at])).join(",");
            println!("{frequency:.3},{q:.9e},{v:.9e},{entries}");
        }
        // Points closer than a thousandth of the gap count as one.
        let distinct: BTreeSet<i64> = points.iter().map(|p| (p.state.0 / 5e-6).round() as i64).collect();
        let multiplier = match (distinct.len(), points.last()) {
            (1, Some(point)) => {
                let largest = point.jacobian.complex_eigenvalues().iter().map(|m| m.norm()).fold(0.0, f64::max);
                format!(", multiplier {largest:.6}")
            }
            _ => String::new(),
        };
        eprintln!("{frequency:.3} Hz: {} distinct points of {RECORDED}{multiplier}", distinct.len());
    }
    Ok(())
}
