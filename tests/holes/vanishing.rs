//! A body at rest at the brim of a round hole, where force and rate along the normal vanish: the
//! fourth derivative of the gap decides whether it stays.

use crate::rubbing::{body, hole, isotropic, load, with};
use signorini::{Load, Options, Row, Scene, Scheme, heading, run};

/// 1 kg under 3 N along the tangent, and inwards under half k (3 N)² t²/γ kg⁻¹.
fn scene(k: f64, degrees: f64) -> Scene {
    let (gap, push, omega) = (1e-2, 3.0, 5.0);
    let [c, s] = heading(degrees);
    let (normal, tangent) = (Row::new(vec![(0, c), (1, s)]), Row::new(vec![(0, -s), (1, c)]));
    let inwards = k * push * push / gap / (omega * omega);
    let cosine = Load::harmonic(inwards, omega / std::f64::consts::TAU, 0.5 * std::f64::consts::PI);
    with(isotropic(1.0, 0.0, 0.0), hole("hole", body(), gap, 0.5, 0.0))
        .with_load(load(Load::constant(push), tangent))
        .with_load(load(Load::constant(-inwards), normal.clone()))
        .with_load(load(cosine, normal))
        .with_initial(&[gap * c, gap * s], &[0.0, 0.0])
        .with_duration(5e-3)
}

#[test]
fn the_way_along_the_brim_holds_a_body_that_the_load_draws_inwards() {
    // At the speed 3t the circle takes 9t²/γ, and the load along the tangent gives half of that as
    // the normal turns: pressed for k < 3, with ½(3 − k) 9t²/γ.
    let t = 5e-3_f64;
    for degrees in [0.0, 35.0, 200.0] {
        for k in [0.5, 2.0, 2.8] {
            let made = run(&scene(k, degrees), &Scheme::Event, &Options::with_step(1e-3)).expect("a run");
            let [y, z] = &made.trajectory.hole_impulses()[0];
            let p = y.iter().sum::<f64>().hypot(z.iter().sum());
            let expected = 0.5 * (3.0 - k) * 9.0 / 1e-2 * t * t * t / 3.0;
            // The next terms are smaller by the square of the way over γ, 4e-3, and by (ωt)²; both
            // are of the order of 1e-3 of 9t²/γ.
            assert!((p / expected - 1.0).abs() < 0.01 / (3.0 - k), "{k}, {degrees}: {p}, not {expected}");
            assert_eq!(made.findings, []);
        }
        for k in [3.2, 4.0] {
            let made = run(&scene(k, degrees), &Scheme::Event, &Options::with_step(1e-3)).expect("a run");
            let [y, z] = &made.trajectory.hole_impulses()[0];
            assert!(y.iter().chain(z).all(|p| *p == 0.0), "{k}, {degrees}: {y:?} {z:?}");
            assert_eq!(made.findings, []);
        }
    }
}
