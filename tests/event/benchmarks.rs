//! Published and closed-form cases, each to the digits that are printed.

use signorini::Contact;
use signorini::Error;
use signorini::scheme::event::Event;
use signorini::{Load, Scene, Table, Wall};

/// Runs to the end; all contacts in the order they closed, then those still open.
fn run(scene: &Scene, stride: f64) -> (Event, Vec<Contact>) {
    let mut event = Event::new(scene, stride).unwrap();
    let mut contacts = Vec::new();
    while !event.is_done() {
        event.advance(0.0).unwrap();
        contacts.extend_from_slice(event.step().closed);
    }
    contacts.extend(event.open_contacts());
    (event, contacts)
}

fn near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} instead of {expected}");
}

#[test]
fn sdnd101_a_mass_on_a_spring_strikes_an_elastic_wall() {
    // code_aster SDND101: m = 100, k = 1e4, wall spring 1e6 at gap 0, v0 = 1 towards it.
    let wall = Wall::upper("wall", 0.0).with_elasticity(1e6, 0.0);
    let scene = Scene::oscillator(100.0, 0.0, 1e4).with_wall(wall).with_initial(&[0.0], &[1.0]).with_duration(0.6);
    let (_, contacts) = run(&scene, 0.6);
    near(contacts[0].end.unwrap(), 0.03126, 5e-6);
    near(contacts[0].peak_force.unwrap(), 9950.37, 5e-3);
    near(contacts[0].impulse, -198.020, 5e-4);
    near(contacts[1].start + 0.5 * contacts[0].end.unwrap(), 0.36105, 1e-5);
    let mut event = Event::new(&scene, 0.6).unwrap();
    event.advance(0.0).unwrap();
    near(event.arc().state(0.015630).1, 0.0, 1e-3);
}

#[test]
fn sdnd108a_a_falling_body_meets_an_elastic_floor() {
    let wall = Wall::lower("floor", -2.0).with_elasticity(100.0, 0.0);
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(wall)
        .with_load(Load::constant(-10.0))
        .with_initial(&[0.0], &[-1.0])
        .with_duration(1.1);
    let mut event = Event::new(&scene, 0.1).unwrap();
    let (mut contacts, mut at_one) = (Vec::new(), f64::NAN);
    while !event.is_done() {
        event.advance(0.0).unwrap();
        contacts.extend_from_slice(event.step().closed);
        if event.end() == 1.0 {
            at_one = event.q()[0];
        }
    }
    near(contacts[0].start, 0.540_312_423_74, 1e-11);
    near(contacts[0].end.unwrap(), 0.885_456_153_07, 1e-11);
    near(contacts[0].peak_force.unwrap(), 74.80741, 5e-6);
    near(at_one, -1.332_162_981_855, 5e-13);
    near(event.q()[0], -0.856_394_405_035, 5e-13);
}

#[test]
fn siconos_linear_oscillator_meets_the_floor_when_it_should() {
    let scene = Scene::oscillator(1e-3, 0.0, 100.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.9))
        .with_load(Load::constant(-9.81e-3))
        .with_initial(&[1.0], &[0.0])
        .with_duration(0.02);
    let (_, contacts) = run(&scene, 0.02);
    near(contacts[0].start, 4.966983943889e-3, 5e-16);
    near(contacts[0].approach_speed, 316.258786, 5e-7);
    near(contacts[0].departure_speed.unwrap(), 0.9 * 316.258786, 5e-7);
}

#[test]
fn a_bouncing_ball_comes_to_rest_and_stays() {
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.9))
        .with_load(Load::constant(-9.81))
        .with_initial(&[1.0], &[0.0])
        .with_duration(20.0);
    let (event, contacts) = run(&scene, 0.1);
    near(event.accumulation().unwrap(), 8.578949, 5e-7);
    let rest = contacts.last().unwrap();
    assert_eq!((event.q()[0], event.v()[0], event.rests_on()), (0.0, 0.0, Some(0)));
    assert!(rest.end.is_none() && rest.start < 8.578949 && rest.start > 8.5789);
    assert_eq!(rest.peak_force, Some(9.81));
    // All the momentum that gravity gave is taken by the floor.
    let total: f64 = contacts.iter().map(|c| c.impulse).sum();
    near(total, 9.81 * 20.0, 1e-11 * 196.2);
    assert!(contacts.len() > 100 && contacts.len() < 150, "{}", contacts.len());
}

#[test]
fn a_plastic_impact_rests_until_its_force_would_pull() {
    // Release where k g = f(t): 3 sin(10πt) = 0.5.
    let scene = Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.0))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
        .with_duration(0.15);
    let (_, contacts) = run(&scene, 1.0);
    let release = (std::f64::consts::PI - (0.5f64 / 3.0).asin()) / (10.0 * std::f64::consts::PI);
    assert_eq!(contacts.len(), 1);
    near(contacts[0].end.unwrap(), release, 1e-15);
    assert_eq!(contacts[0].departure_speed, Some(0.0));
    let t = contacts[0].start;
    near(contacts[0].peak_force.unwrap(), 3.0 * (10.0 * std::f64::consts::PI * t).sin() - 0.5, 1e-12);
    // Impact and rest are one episode: its impulse is momentum at impact plus the force's integral.
    let w = 10.0 * std::f64::consts::PI;
    let integral = 3.0 / w * ((w * t).cos() - (w * release).cos()) - 0.5 * (release - t);
    near(contacts[0].impulse, -(contacts[0].approach_speed + integral), 1e-14);
}

#[test]
fn a_rest_peak_between_its_ends_is_found() {
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0))
        .with_load(Load::constant(-2.0))
        .with_load(Load::harmonic(1.0, 1.0, 0.3))
        .with_duration(1.0);
    let (_, contacts) = run(&scene, 0.77);
    assert_eq!(contacts.len(), 1);
    near(contacts[0].peak_force.unwrap(), 3.0, 1e-14);
}

#[test]
fn an_exact_graze_is_met_and_misses_and_hits_by_1e_12_are_told_apart() {
    // q = sin t reaches 1 exactly at π/2.
    for (position, impacts) in [(1.0 - 1e-12, 1), (1.0 + 1e-12, 0)] {
        let scene = Scene::oscillator(1.0, 0.0, 1.0)
            .with_wall(Wall::upper("wall", position))
            .with_initial(&[0.0], &[1.0])
            .with_duration(3.0);
        let (event, contacts) = run(&scene, 3.0);
        assert_eq!(contacts.len(), impacts, "{position}");
        near(event.q()[0], 3.0f64.sin(), 3e-6);
        if impacts == 1 {
            // √(1 − g²) = 1.414e-6.
            near(contacts[0].approach_speed, 2e-12f64.sqrt(), 1e-9);
        }
    }
    let scene = Scene::oscillator(1.0, 0.0, 1.0)
        .with_wall(Wall::upper("wall", 1.0))
        .with_initial(&[0.0], &[1.0])
        .with_duration(3.0);
    let (event, contacts) = run(&scene, 3.0);
    assert!(contacts.len() <= 1 && contacts.iter().all(|c| c.approach_speed < 1e-7));
    near(event.q()[0], 3.0f64.sin(), 1e-7);
}

#[test]
fn two_walls_at_one_place_hold_the_body_and_the_pressed_one_carries() {
    let scene = Scene::oscillator(1.0, 0.1, 10.0)
        .with_wall(Wall::upper("upper", 0.0).with_restitution(0.7))
        .with_wall(Wall::lower("lower", 0.0).with_restitution(0.4))
        .with_load(Load::harmonic(2.0, 1.0, 0.0))
        .with_initial(&[0.0], &[3.0])
        .with_duration(2.0);
    let (event, contacts) = run(&scene, 0.3);
    assert_eq!((event.q()[0], event.v()[0]), (0.0, 0.0));
    // 3 N s at once, then 2/π N s in each half period, at the walls in turn.
    let half = 2.0 / std::f64::consts::PI;
    let expected = [(0, -3.0 - half), (1, half), (0, -half), (1, half)];
    assert_eq!(contacts.len(), 4, "{contacts:#?}");
    for (contact, (wall, impulse)) in contacts.iter().zip(expected) {
        assert_eq!(contact.wall, wall);
        near(contact.impulse, impulse, 1e-13);
    }
}

#[test]
fn a_damped_elastic_wall_lets_go_where_its_force_vanishes() {
    // Free mass onto a spring and dashpot, v0 = 1: s = e^{−ζωt} sin(ω_d t)/ω_d; k s + c ṡ = 0
    // inside the wall.
    let (k, c): (f64, f64) = (100.0, 4.0);
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("wall", 0.5).with_elasticity(k, c))
        .with_initial(&[0.0], &[1.0])
        .with_duration(2.0);
    let (_, contacts) = run(&scene, 2.0);
    let sigma = 0.5 * c;
    let omega = (k - sigma * sigma).sqrt();
    let zero = |t: f64| (k - c * sigma) * (omega * t).sin() / omega + c * (omega * t).cos();
    let span = contacts[0].end.unwrap() - 0.5;
    near(contacts[0].start, 0.5, 1e-15);
    near(zero(span), 0.0, 1e-13);
    let depth = (-sigma * span).exp() * (omega * span).sin() / omega;
    assert!(depth > 1e-3, "let go inside the wall, {depth}");
    near(contacts[0].impulse, -1.0 - contacts[0].departure_speed.unwrap(), 1e-14);
    // A dashpot that dominates: the force is largest on entry.
    let wall = Wall::upper("wall", 0.5).with_elasticity(1.0, 30.0);
    let scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(wall).with_initial(&[0.0], &[1.0]).with_duration(0.7);
    let (_, contacts) = run(&scene, 2.0);
    near(contacts[0].peak_force.unwrap(), 30.0, 1e-12);
}

#[test]
fn a_rigid_wall_behind_an_elastic_one_stops_the_body() {
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("soft", 0.1).with_elasticity(10.0, 0.5))
        .with_wall(Wall::upper("hard", 0.2).with_restitution(0.5))
        .with_initial(&[0.0], &[2.0])
        .with_duration(1.0);
    let (event, contacts) = run(&scene, 1.0);
    let hard = contacts.iter().find(|c| c.wall == 1).unwrap();
    assert_eq!(hard.end, Some(hard.start));
    let soft: f64 = contacts.iter().filter(|c| c.wall == 0).map(|c| c.impulse).sum();
    near(2.0 + hard.impulse + soft, event.v()[0], 1e-14);
    assert!(event.v()[0] < 0.0);
}

#[test]
fn blows_and_tables_act_at_their_times() {
    let table = Table::new(vec![0.5, 1.0, 1.5], vec![0.0, 2.0, 1.0]).unwrap();
    let scene = Scene::oscillator(2.0, 0.0, 0.0)
        .with_load(Load::table(table))
        .with_load(Load::impulse(3.0, 0.25))
        .with_load(Load::impulse(1.0, 0.0))
        .with_duration(2.0);
    let (event, _) = run(&scene, 0.4);
    near(event.v()[0], (1.0 + 3.0 + 0.5 + 0.75) / 2.0, 1e-15);
}

#[test]
fn a_blow_at_rest_bounces_off_the_wall_it_drives_into() {
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.5))
        .with_load(Load::constant(-1.0))
        .with_load(Load::impulse(-2.0, 1.0))
        .with_duration(1.5);
    let (event, contacts) = run(&scene, 5.0);
    assert_eq!(contacts.len(), 2, "{contacts:?}");
    near(contacts[0].end.unwrap(), 1.0, 0.0);
    near(contacts[0].impulse, 1.0, 1e-15);
    assert_eq!((contacts[1].start, contacts[1].end), (1.0, Some(1.0)));
    near(contacts[1].impulse, 3.0, 1e-15);
    near(contacts[1].departure_speed.unwrap(), 1.0, 1e-15);
    near(event.q()[0], 0.5 - 0.125, 1e-15);
}

#[test]
fn too_many_events_are_a_named_error() {
    // 1e10 impacts a second.
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("upper", 1e-10))
        .with_wall(Wall::lower("lower", 0.0))
        .with_initial(&[0.0], &[1.0])
        .with_duration(10.0);
    let mut event = Event::new(&scene, 1.0).unwrap();
    let error = loop {
        if let Err(error) = event.advance(0.0) {
            break error;
        }
        assert!(!event.is_done());
    };
    assert!(matches!(error, Error::TooManyEvents { ref wall, time, .. } if !wall.is_empty() && time < 0.01), "{error}");
}

#[test]
fn an_extra_force_lifts_a_resting_body() {
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0))
        .with_load(Load::constant(-1.0))
        .with_duration(1.0);
    let mut event = Event::new(&scene, 0.25).unwrap();
    event.advance(0.5).unwrap();
    assert_eq!((event.end(), event.q()[0], event.step().force[0]), (0.25, 0.0, 0.5));
    event.advance(3.0).unwrap();
    assert_eq!(event.end(), 0.5);
    near(event.q()[0], 0.5 * 2.0 * 0.0625, 1e-16);
    assert_eq!(event.step().closed.len(), 1);
}

#[test]
fn the_speed_of_an_impact_is_that_of_the_energy() {
    // From the middle between the walls at v₀, without damping and load: √(v₀² − kg²) at a wall, at
    // once and after a quarter of a period. Place and instant are rounded, and the speed with them.
    let (k, g) = (100.0, 5e-3);
    for i in 0..1000 {
        let v0 = 0.052 + 5e-4 * f64::from(i);
        let scene = Scene::oscillator(1.0, 0.0, k)
            .with_wall(Wall::upper("upper", g).with_restitution(1.0))
            .with_wall(Wall::lower("lower", -g).with_restitution(1.0))
            .with_initial(&[0.0], &[v0]);
        let mut event = Event::new(&scene, 1.0).unwrap();
        event.advance(0.0).unwrap();
        let speed = (v0 * v0 - k * g * g).sqrt();
        let error = (event.v()[0] + speed).abs();
        let rounding = f64::EPSILON * (v0 + k * g * g / speed);
        assert!(event.q() == [g] && error < 4.0 * rounding, "{v0}: {error:e}");
    }
}
