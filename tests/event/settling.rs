//! Motions that decay at a wall, and what blows do to a body at rest on one.

use signorini::scheme::event::Event;
use signorini::{Load, Scene, Wall, WallLaw};

/// Runs to the end; every closed contact.
pub fn settle(scene: &Scene, stride: f64) -> (Event, Vec<signorini::Contact>) {
    let mut event = Event::new(scene, stride).expect("a sound scene");
    let mut contacts = Vec::new();
    while !event.is_done() {
        event.advance(0.0).expect("followed to the end");
        contacts.extend_from_slice(event.step().closed);
    }
    (event, contacts)
}

#[test]
fn a_body_that_creeps_to_an_elastic_wall_at_its_equilibrium_comes_to_rest_there() {
    for (stiffness, damping) in [(1e3, 0.0), (50.0, 500.0), (1e3, 1.0)] {
        let mut wall = Wall::lower("wall", 0.0);
        wall.law = WallLaw::Elastic { stiffness, damping };
        for v in [1.0, -1.0, 1e-100] {
            let scene = Scene::oscillator(1e-3, 20.0, 1e4)
                .with_wall(wall.clone())
                .with_initial(&[0.0], &[v])
                .with_duration(5.0);
            for stride in [1e-4, 1e-2, 10.0] {
                let (event, contacts) = settle(&scene, stride);
                assert!(event.q()[0].abs() <= 1e-30 * v.abs() && event.counters().evaluations < 200_000);
                assert!(contacts.len() < 5, "{contacts:?}");
            }
        }
        // What has come to rest starts again when it is pushed.
        let scene = Scene::oscillator(1e-3, 20.0, 1e4)
            .with_wall(wall)
            .with_initial(&[0.0], &[1.0])
            .with_load(Load::impulse(1e-3, 3.0))
            .with_duration(3.001);
        let (event, _) = settle(&scene, 10.0);
        let fresh = Scene::oscillator(1e-3, 20.0, 1e4).with_initial(&[0.0], &[1.0]).with_duration(1e-3);
        let (free, _) = settle(&fresh, 10.0);
        assert!((event.q()[0] / free.q()[0] - 1.0).abs() < 1e-9, "{} {}", event.q()[0], free.q()[0]);
    }
}

#[test]
fn a_dashpot_wall_beside_a_stiffer_one_is_entered_once() {
    let mut soft = Wall::lower("soft", -5e-3);
    soft.law = WallLaw::Elastic { stiffness: 50.0, damping: 500.0 };
    let mut hard = Wall::lower("hard", -5e-3);
    hard.law = WallLaw::Elastic { stiffness: 1e3, damping: 0.0 };
    let scene = Scene::oscillator(1.0, 20.0, 100.0)
        .with_wall(soft)
        .with_wall(hard)
        .with_load(Load::constant(-9.81))
        .with_load(Load::harmonic(3.0, 5.0, std::f64::consts::FRAC_PI_2))
        .with_initial(&[5e-3], &[1.0])
        .with_duration(1.0);
    let (event, _) = settle(&scene, 10.0);
    assert!(event.counters().events < 20, "{:?}", event.counters());
}

#[test]
fn bounces_without_loss_at_the_wall_die_of_drag() {
    let scene = Scene::oscillator(1e-3, 20.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(1.0))
        .with_load(Load::constant(-9.81))
        .with_initial(&[1e-3], &[0.0])
        .with_duration(1.0);
    let (event, contacts) = settle(&scene, 10.0);
    assert_eq!((event.rests_on(), event.q()[0], event.v()[0]), (Some(0), 0.0, 0.0));
    assert_eq!(event.accumulation(), None);
    let impulse = contacts.iter().chain(event.open_contacts()).map(|c| c.impulse).sum::<f64>();
    // Momentum: the weight less what drag took, c times the way down.
    assert!((impulse - (9.81 - 20.0 * 1e-3)).abs() < 1e-9, "{impulse}");
}

#[test]
fn a_blow_at_a_body_at_rest_on_a_wall_is_an_impact_of_its_own() {
    let floor = |e| {
        Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::lower("floor", 0.0).with_restitution(e))
            .with_load(Load::constant(-10.0))
            .with_duration(1.0)
    };
    let (_, contacts) = settle(&floor(0.5).with_load(Load::impulse(-1.0, 0.5)), 10.0);
    let [rest, impact, ..] = contacts[..] else { panic!("{contacts:?}") };
    assert_eq!((rest.start, rest.end, rest.peak_force), (0.0, Some(0.5), Some(10.0)));
    assert_eq!((rest.approach_speed, rest.departure_speed), (0.0, Some(0.0)));
    assert!((rest.impulse - 5.0).abs() < 1e-14);
    assert_eq!((impact.start, impact.end, impact.peak_force), (0.5, Some(0.5), None));
    assert_eq!((impact.approach_speed, impact.departure_speed, impact.impulse), (1.0, Some(0.5), 1.5));

    // At e = 0 it stays …
    let (event, contacts) = settle(&floor(0.0).with_load(Load::impulse(-1.0, 0.5)), 10.0);
    assert_eq!((contacts.len(), event.rests_on()), (1, Some(0)));
    let open = event.open_contacts().next().expect("rest");
    assert_eq!((open.start, open.approach_speed), (0.5, 1.0));
    assert!((open.impulse - 6.0).abs() < 1e-14);

    // … and at e > 0 it leaves with the speed that the blow gives upwards, to land again.
    let (_, contacts) = settle(&floor(0.5).with_load(Load::impulse(1.0, 0.5)), 10.0);
    assert_eq!((contacts[0].end, contacts[0].departure_speed), (Some(0.5), Some(0.0)));
    assert!((contacts[1].start - 0.7).abs() < 1e-14 && (contacts[1].approach_speed - 1.0).abs() < 1e-14);
}

#[test]
fn a_blow_in_the_instant_of_an_arrival_counts_with_it() {
    // Arrives at 1 m/s after 1 s, and is thrown back at 2 m/s: no impact, and no velocity that is
    // rounding.
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", -1.0).with_restitution(0.5))
        .with_initial(&[0.0], &[-1.0])
        .with_load(Load::impulse(3.0, 1.0))
        .with_duration(2.0);
    let (event, contacts) = settle(&scene, 10.0);
    assert_eq!((event.q()[0], event.v()[0], contacts.len()), (1.0, 2.0, 0));
}
