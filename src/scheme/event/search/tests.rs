//! What the search goes by: the rounding of its functions, and their peaks.

mod careful;
mod rest;

use super::*;
use crate::scene::{Load, Scene, Table, Wall};
use std::cell::Cell;

/// Damped, under a sine, at the start of an arc that is not the first, in other units of length,
/// mass and time.
fn under_way(length: f64, mass: f64, time: f64) -> Event {
    let force = mass * length / (time * time);
    let scene = Scene::oscillator(3.0 * mass, 5.0 * mass / time, 700.0 * force / length)
        .with_wall(Wall::upper("stop", 2.0 * length))
        .with_load(Load::harmonic(40.0 * force, 3.0 / time, 0.3))
        .with_initial(&[0.1 * length], &[0.2 * length / time])
        .with_duration(8.0 * time);
    let mut event = Event::new(&scene, 0.5 * time).unwrap();
    for _ in 0..7 {
        event.advance(0.0).unwrap();
    }
    event.begin_arc(0.5 * time, 0.0);
    event
}

#[test]
fn the_noise_of_a_derivative_is_that_of_all_its_terms() {
    let event = under_way(1.0, 1.0, 1.0);
    let (steady, motion) = (event.arc.steady_size(), event.arc.fastest_motion());
    let [_, v, force, rate] = event.sizes;
    assert!(event.time == 3.5 && steady > 0.0 && motion > 0.0 && force > 0.0 && rate > 0.0 && v > 0.0);
    // Of (f − cv − kq)/m and of its derivative; the instant is known to an ulp of the time, in
    // which a sine of 3 Hz changes by its rate, and the rate by its own.
    let late = std::f64::consts::TAU * 3.0 * 3.5;
    let a = force / 3.0 + rate * 3.5 / 3.0 + 5.0 / 3.0 * v;
    let jerk = rate / 3.0 + rate * late / 3.0 + 5.0 / 3.0 * a + 700.0 / 3.0 * v;
    for (closed, sizes) in [(true, [v, a + steady, jerk + steady * motion]), (false, [v, a, jerk])] {
        let found = event.flow_noise(closed);
        for (found, size) in found[1..].iter().zip(sizes) {
            // Rounding of the sum itself.
            assert!((found / noise(size) - 1.0).abs() < 1e-14, "{closed}: {found:e} of {size}");
        }
    }
    let (length, mass, time) = (1024.0, 0.25, 0.0625);
    let other = under_way(length, mass, time).flow_noise(true);
    let scaled = [0, 1, 2, 3].map(|n| event.flow_noise(true)[n] * length / time.powi(n as i32));
    assert_eq!(other, scaled);
}

#[test]
fn a_gap_has_the_derivatives_of_the_motion() {
    let event = under_way(1.0, 1.0, 1.0);
    // q = 1 + 2t + 3t² + 4t³ + 5t⁴ at t = ½, from its derivatives at 0.
    let (mut jet, h): (Jet, f64) = (Jet::default(), 0.5);
    jet[..5].copy_from_slice(&[1.0, 2.0, 6.0, 24.0, 120.0]);
    for sign in [1.0, -1.0] {
        let g = gap(&event.barriers[0], sign, false, &jet, &[0.0; 2], &[0.0; 4]);
        let [c0, c1, c2, c3] = g.c;
        let value = c0 + h * (c1 + h * (c2 / 2.0 + h * (c3 / 6.0 + h * g.fourth / 24.0)));
        assert_eq!(value, sign * (1.0 + 1.0 + 0.75 + 0.5 + 0.3125 - 2.0));
    }
}

#[test]
fn a_peak_is_found_to_rounding_in_few_evaluations() {
    // ½ − x arctan x + ½ ln(1 + x²), of which the derivative is −arctan x: Newton's method alone
    // diverges from |x| > 1.39.
    for (width, reach, few) in [(2.0, 0.5, 7), (2.0, 8.0, 12), (2e-6, 8.0, 12), (2e-6, 50.0, 12)] {
        for part in 1..100 {
            let (low, high) = (1.0, 1.0 + width);
            let (scale, peak) = (reach / width, low + 0.01 * f64::from(part) * width);
            let count = Cell::new(0);
            let best = highest((low, high), |t| {
                count.set(count.get() + 1);
                assert!((low..=high).contains(&t), "{t}");
                let x = scale * (t - peak);
                [0.5 - x * x.atan() + 0.5 * (x * x).ln_1p(), -scale * x.atan(), -scale * scale / (1.0 + x * x)]
            });
            // Rounding of ½; where the peak is flat its place does not matter.
            assert!((best - 0.5).abs() <= 2.0 * f64::EPSILON, "{width} {reach} {peak}: {best}");
            assert!(count.get() <= few, "{width} {reach} {peak}: {} evaluations", count.get());
        }
    }
}
