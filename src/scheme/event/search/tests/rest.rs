//! The search at rest, and the largest forces on the way.

use super::*;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A body of 1 kg at rest on a floor at 0 under `loads`, at the start of an arc of `span` (s).
fn resting(loads: &[Load], span: f64) -> Event {
    let mut scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(Wall::lower("floor", 0.0)).with_duration(64.0);
    for load in loads {
        scene = scene.with_load(load.clone());
    }
    let mut event = Event::new(&scene, 64.0).unwrap();
    event.support = Some(0);
    event.begin_arc(span, 0.0);
    event
}

#[test]
fn the_noise_of_a_force_at_rest_is_that_of_its_terms_and_of_the_instant() {
    let mut event = resting(&[Load::constant(-7.0), Load::harmonic(3.0, 2.0, 0.4)], 1.0);
    event.time = 5.0;
    let omega = TAU * 2.0;
    // A sine of 3 N, its derivatives, and what each changes within an ulp of 5 s.
    let size = |n: i32| 3.0 * omega.powi(n);
    let expected = [10.0 + size(1) * 5.0, size(1) + size(2) * 5.0, size(2) + size(3) * 5.0, size(3)];
    for (found, size) in event.rest_noise().iter().zip(expected) {
        assert!((found / noise(size) - 1.0).abs() < 1e-14, "{found:e} {size}");
    }
}

#[test]
fn a_rest_ends_where_a_ramp_has_taken_the_pressure_away_found_at_once() {
    // 8 N less 1/4 N/s: for 32 s.
    let ramp = Table::new(vec![0.0, 64.0], vec![-8.0, 8.0]).unwrap();
    let mut event = resting(&[Load::table(ramp)], 64.0);
    let hit = event.search(64.0).unwrap();
    assert_eq!((hit.tau, hit.state, hit.wall), (32.0, [0.0; 2], Some(0)));
    assert_eq!(event.counters().evaluations, 1);
}

#[test]
fn a_rest_goes_on_up_to_the_very_end_of_the_pressure() {
    // −cos t N presses up to t = π/2: of 1e-8 N shortly before.
    let loads = [Load::harmonic(-1.0, 1.0 / TAU, FRAC_PI_2)];
    for before in [1e-4, 1e-6, 1e-8, 1e-10] {
        let span = FRAC_PI_2 - before;
        let hit = resting(&loads, span).search(span).unwrap();
        assert_eq!((hit.tau, hit.wall), (span, None));
    }
    let hit = resting(&loads, 2.0).search(2.0).unwrap();
    // Rounding of the load over its rate.
    assert!((hit.tau - FRAC_PI_2).abs() < 4e-15 && hit.wall == Some(0), "{}", hit.tau);
}

#[test]
fn a_rest_under_a_sine_is_searched_by_windows_of_a_radian_and_a_half() {
    // 3 N with ±1 N at 4 rad/s for 60 s, in seconds and in units of 2⁻³⁰ and 2³⁰ s.
    for time in [1.0, 2.0_f64.powi(-30), 2.0_f64.powi(30)] {
        let span = 60.0 * time;
        let mut event = resting(&[Load::constant(-3.0), Load::harmonic(1.0, 4.0 / TAU / time, 0.0)], span);
        let hit = event.search(span).unwrap();
        assert_eq!((hit.tau, hit.wall), (span, None));
        // 240 rad / 1.5 rad, and one at the end.
        let evaluations = event.counters().evaluations;
        assert!((161..=165).contains(&evaluations), "{time}: {evaluations}");
        assert_eq!(event.barriers[0].open.unwrap().peak_force, Some(4.0));
    }
}

#[test]
fn the_peak_of_a_spring_and_dashpot_is_found_in_any_units() {
    // s = e^{−σt} sin(ωt)/ω of a body that arrives at 1 m/s; its force k s + c ṡ is largest where
    // the derivative vanishes.
    let (mass, k, c) = (2.0_f64, 50.0_f64, 3.0_f64);
    let sigma = 0.5 * c / mass;
    let omega = (k / mass - sigma * sigma).sqrt();
    // k s + c ṡ = e^{−σt} (A sin ωt + c cos ωt), its derivative e^{−σt} (B cos ωt − D sin ωt).
    let a = (k - c * sigma) / omega;
    let (b, d) = (a * omega - c * sigma, a * sigma + c * omega);
    let t = (b / d).atan() / omega;
    let peak = (-sigma * t).exp() * (a * (omega * t).sin() + c * (omega * t).cos());
    for side in [1.0, -1.0] {
        for time in [-40, -10, -9, 0, 8, 9, 10, 11, 40].map(|n| f64::powi(2.0, n)) {
            // In units of length that keep the speed at 1.
            let wall = if side > 0.0 { Wall::upper("wall", 0.0) } else { Wall::lower("wall", 0.0) };
            let scene = Scene::oscillator(mass, 0.0, 0.0)
                .with_wall(wall.with_elasticity(k / (time * time), c / time))
                .with_initial(&[0.0], &[side])
                .with_duration(2.0 * time);
            let mut event = Event::new(&scene, 2.0 * time).unwrap();
            while event.step().closed.is_empty() {
                event.advance(0.0).unwrap();
            }
            let found = event.step().closed[0].peak_force.unwrap() * time;
            assert!((found / peak - 1.0).abs() < 1e-14, "{side} {time:e}: {found} {peak}");
        }
    }
}
