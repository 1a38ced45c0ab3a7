//! Returns to a wall that are no impacts, releases near resonance, and the times of many events.

use crate::common::event_driven::EventDriven;
use crate::common::schemes;
use crate::settling::settle;
use signorini::scheme::event::Event;
use signorini::{Contact, Load, Options, Scene, Scheme, Table, TimeOptions, Wall, run};

/// Runs to the end; every contact.
fn follow(scene: &Scene, stride: f64) -> (Event, Vec<Contact>) {
    let (event, mut contacts) = settle(scene, stride);
    contacts.extend(event.open_contacts());
    (event, contacts)
}

#[test]
fn a_body_is_let_go_near_resonance_where_the_steady_motion_is_far_larger_than_the_gap() {
    // The source scene, whose natural frequency is 1.5915 Hz, and the same with other damping: the
    // closed form after a release is the difference of motions up to 1/2ζ times as large.
    for damping in [0.0, 2e-4, 0.2, 2.0] {
        for e in [0.0, 1e-9, 1e-3, 0.1, 0.3, 0.5, 0.7] {
            for i in 0..60 {
                let frequency = 1.560_01 + 0.001 * f64::from(i);
                let scene = Scene::oscillator(1.0, damping, 100.0)
                    .with_wall(Wall::upper("upper", 5e-3).with_restitution(e))
                    .with_wall(Wall::lower("lower", -5e-3).with_restitution(e))
                    .with_load(Load::harmonic(3.0, frequency, 0.0))
                    .with_duration(5.0);
                let (event, _) = follow(&scene, 5.0);
                let evaluations = event.counters().evaluations;
                assert!(evaluations < 5_000, "c = {damping}, e = {e}, {frequency} Hz: {evaluations} evaluations");
                if e == 0.0 && i % 20 == 0 {
                    // Written apart, by bisection. Its own closed form cancels: 1e-16 of a steady
                    // motion a thousand gaps large or more.
                    let (q, v) = EventDriven::new(&scene).advance(5.0);
                    assert!((event.q()[0] - q).abs() < 1e-10, "{damping} {frequency}: {} {q}", event.q()[0]);
                    assert!((event.v()[0] - v).abs() < 1e-8, "{damping} {frequency}: {} {v}", event.v()[0]);
                }
            }
        }
    }
}

#[test]
fn a_tangential_return_is_no_impact() {
    // Stopped by the wall at its own place of rest plus g, then g cos ωτ for ever: it touches the
    // wall once a period, without speed.
    let (g, omega, duration) = (5e-3, 10.0, 1000.0);
    for (e, sign) in [(0.0, 1.0), (0.0, -1.0), (0.5, 1.0), (1.0, 1.0)] {
        let wall = if sign > 0.0 { Wall::upper("wall", g) } else { Wall::lower("wall", -g) };
        let scene = Scene::oscillator(1.0, 0.0, omega * omega)
            .with_wall(wall.with_restitution(e))
            .with_initial(&[sign * g], &[0.0])
            .with_duration(duration);
        // A stride of a whole period stops in the very touch.
        for stride in [duration, std::f64::consts::TAU / omega, 1e-2 * std::f64::consts::TAU, 0.137] {
            let mut event = Event::new(&scene, stride).expect("a sound scene");
            let mut worst = 0.0_f64;
            while !event.is_done() {
                event.advance(0.0).expect("followed to the end");
                let expected = -sign * g * omega * (omega * event.end()).sin();
                worst = worst.max((event.v()[0] - expected).abs() / (g * omega));
            }
            // Rounding of ωt, and of a thousand arcs for every stride.
            assert!(worst < 1e-11 * (1.0 + 1.0 / stride), "e = {e}, stride {stride}: {worst:e}");
            assert_eq!(event.counters().impacts, 0, "e = {e}, stride {stride}");
        }
    }
    // The same after an impact that takes all speed: one contact, and the velocity of the cosine
    // for a thousand seconds.
    let scene = Scene::oscillator(1.0, 0.0, omega * omega)
        .with_wall(Wall::upper("wall", g).with_restitution(0.0))
        .with_initial(&[0.0], &[1.0])
        .with_duration(duration);
    let (event, contacts) = follow(&scene, duration);
    let landed = (g * omega / 1.0_f64).asin() / omega;
    let expected = -g * omega * (omega * (duration - landed)).sin();
    assert_eq!(contacts.len(), 1, "{contacts:?}");
    assert!((event.v()[0] - expected).abs() < 1e-11 * g * omega, "{} {expected}", event.v()[0]);
}

#[test]
fn fifty_thousand_impacts_cost_no_digits_of_the_time() {
    // To and fro at 1 m/s between walls that are 2g apart: a triangle wave. Its phase at the end is
    // known from whole numbers.
    let g = 1e-4 / 3.0;
    for (e_load, duration) in [(0.0, 3.37), (1.0, 3.37)] {
        let mut scene = Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::upper("upper", g).with_restitution(1.0))
            .with_wall(Wall::lower("lower", -g).with_restitution(1.0))
            .with_initial(&[0.0], &[1.0])
            .with_duration(duration);
        if e_load > 0.0 {
            // A load of amplitude 0 makes the arcs general ones.
            scene = scene.with_load(Load::harmonic(0.0, 1.0, 0.0));
        }
        let (event, contacts) = follow(&scene, duration);
        // g = 1e-4/3 as a number has its own rounding: the remainder is exact.
        let phase = (duration + g) % (4.0 * g);
        let expected = if phase < 2.0 * g { phase - g } else { 3.0 * g - phase };
        assert!(contacts.len() > 50_000);
        // Two roundings of a time of 3 s, at 1 m/s: 1e-15 m. Summed without their remainders the
        // times lost 1e-12.
        assert!((event.q()[0] - expected).abs() < 2e-15, "{:e}", event.q()[0] - expected);
    }
}

/// Share of the run in contact, of each wall.
fn contact_time(scene: &Scene, scheme: &Scheme, h: f64) -> Vec<f64> {
    let time = TimeOptions { sample: Some(scene.duration), ..TimeOptions::with_step(h) };
    let run = run(scene, scheme, &Options { time, ..Options::with_step(h) }).expect("a run");
    run.statistics.walls.iter().map(|w| w.contact_time_ratio).collect()
}

#[test]
fn contact_is_where_a_force_acts_in_every_scheme() {
    let floor = || Wall::lower("floor", 0.0).with_restitution(0.0);
    let h = 1e-3;
    // Lands and stays without a load: the impact is all there is.
    let landing = Scene::oscillator(1.0, 0.0, 0.0).with_wall(floor()).with_initial(&[0.1], &[-1.0]).with_duration(1.0);
    // Stands at a wall that a spring just reaches, to the rounding of 0.1 · 3 − 0.3 and of 11 · 0.3
    // − 3.3.
    let standing = |k: f64, g: f64, f: f64| {
        Scene::oscillator(0.7, 0.3, k)
            .with_wall(Wall::lower("floor", g).with_restitution(0.0))
            .with_load(Load::constant(f))
            .with_initial(&[g], &[0.0])
            .with_duration(1.0)
    };
    let mut scenes = vec![landing.clone()];
    for (k, g, f) in [(11.0, 0.3, 3.3), (0.1, 3.0, 0.3), (1.1, 3.0, 3.3), (0.7, 0.1, 0.07)] {
        scenes.push(standing(k, g, f));
    }
    let springs = |scheme: &Scheme| matches!(scheme, Scheme::Penalty { .. });
    for (number, scene) in scenes.iter().enumerate() {
        for scheme in [Scheme::Event].into_iter().chain(schemes()) {
            // Neither a spring nor newmark stops a landing body: they have contacts of their own.
            if number == 0 && (springs(&scheme) || scheme == Scheme::Newmark) {
                continue;
            }
            let share = contact_time(scene, &scheme, h)[0];
            assert!(share <= 2.0 * h, "scene {number}, {scheme}: in contact for {share} of the run");
        }
    }
    // Pressed between 0.5 and 0.75 s only.
    let press = Table::new(vec![0.0, 0.5, 0.5 + 1e-9, 0.75, 0.75 + 1e-9, 1.0], vec![0.0, 0.0, -2.0, -2.0, 0.0, 0.0]);
    let pressed = landing.with_load(Load::table(press.expect("a sound table")));
    for scheme in [Scheme::Event].into_iter().chain(schemes()) {
        if springs(&scheme) || scheme == Scheme::Newmark {
            continue;
        }
        let share = contact_time(&pressed, &scheme, h)[0];
        assert!((share - 0.25).abs() <= 3.0 * h, "{scheme}: in contact for {share} of the run");
    }
}
