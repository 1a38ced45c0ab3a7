//! The table of contacts, against closed forms and the exact motion.

mod common;

use common::event_driven::EventDriven;
use common::{MOREAU_JEAN, schemes, source};
use signorini::{Contact, Integrator, Load, Options, Scene, Scheme, Table, TimeOptions, Wall, run};

/// Contacts of a run over the scene's duration with steps of `h`.
fn contacts(scene: &Scene, scheme: &Scheme, h: f64) -> Vec<Contact> {
    let time = TimeOptions { sample: Some(scene.duration), ..TimeOptions::with_step(h) };
    let run = run(scene, scheme, &Options { time, ..Options::with_step(h) }).expect("a run");
    run.trajectory.contacts().to_vec()
}

#[test]
fn the_table_of_contacts_lists_the_impacts_of_the_exact_motion() {
    for e in [0.8, 1.0] {
        let scene = source(e, e).with_duration(1.0);
        let mut motion = EventDriven::new(&scene);
        motion.advance(1.0);
        for scheme in [Scheme::PaoliSchatzman, MOREAU_JEAN] {
            let h = 1e-5;
            let found = contacts(&scene, &scheme, h);
            assert_eq!(found.len(), motion.events.len(), "{scheme}, e = {e}");
            for (contact, event) in found.iter().zip(&motion.events) {
                let what = format!("{scheme}, e = {e}: {contact:?}, {event:?}");
                assert_eq!(
                    (contact.wall, contact.end, contact.peak_force),
                    (event.wall, Some(contact.start), None),
                    "{what}"
                );
                // The motion itself is known to 1e-3 of the gap and 1e-2 of its speed at this step: 5e-6 m at 0.1 m/s.
                assert!((contact.start - event.time).abs() < 2e-4, "{what}");
                assert!((contact.approach_speed - event.approach).abs() < 5e-3, "{what}");
                let departure = contact.departure_speed.expect("closed");
                assert!((departure - e * contact.approach_speed).abs() < 1e-3, "{what}");
                // Of 1 kg, but for what the load gives in the one or two steps: 3 N for 2e-5 s.
                assert!((contact.impulse.abs() - contact.approach_speed - departure).abs() < 2e-4, "{what}");
            }
        }
    }
}

#[test]
fn lasting_contacts_begin_end_and_peak_where_the_closed_forms_do() {
    // A published case: 100 kg on 1e4 N/m against a spring of 1e6 N/m at no gap, 1 m/s towards it.
    let struck = Scene::oscillator(100.0, 0.0, 1e4)
        .with_wall(Wall::upper("wall", 0.0).with_elasticity(1e6, 0.0))
        .with_initial(&[0.0], &[1.0])
        .with_duration(0.4);
    // Another: 1 kg under 10 N falls on a spring of 100 N/m 2 m below, thrown down at 1 m/s.
    let falling = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("wall", -2.0).with_elasticity(100.0, 0.0))
        .with_load(Load::constant(-10.0))
        .with_initial(&[0.0], &[-1.0])
        .with_duration(1.1);
    let h = 1e-5;
    // Sharing a spring between steps, an order-one scheme is off by some 10 h of relative energy loss; the others by h where a contact
    // begins or ends within a step.
    for scheme in schemes() {
        let first_order = matches!(
            scheme,
            Scheme::ImplicitEuler | Scheme::MoreauJean { theta: 0.75 } | Scheme::MoreauJean { theta: 1.0 }
        ) || matches!(scheme, Scheme::Penalty { integrator: Integrator::ImplicitEuler, .. });
        let tolerance = if first_order { 2e-3 } else { 1e-5 };
        let near = |found: f64, expected: f64, what: &str| {
            assert!((found / expected - 1.0).abs() < tolerance, "{scheme}: {what} {found}, expected {expected}");
        };
        let found = contacts(&struck, &scheme, h);
        let [first, second] = found[..] else { panic!("{scheme}: {found:?}") };
        assert!(first.start <= h && (first.end.expect("closed") - 0.03126).abs() < 4e-5, "{scheme}: {first:?}");
        near(first.peak_force.expect("finite"), 9950.37, "peak");
        near(-first.impulse, 198.020, "impulse");
        near(first.approach_speed, 1.0, "approach");
        // The second peak is at 0.36105 s, half a contact after its start.
        assert!((second.start - 0.36105 + 0.01563).abs() < 4e-5 + 2e-4 * tolerance, "{scheme}: {second:?}");
        let found = contacts(&falling, &scheme, h);
        let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
        assert!((contact.start - 0.540_312).abs() < 3e-5, "{scheme}: {contact:?}");
        assert!((contact.end.expect("closed") - 0.885_456).abs() < 3e-5 + 0.1 * tolerance, "{scheme}: {contact:?}");
        near(contact.peak_force.expect("finite"), 74.80741, "peak");
        // v = √(1 + 40) at 2 m, both ways, and gravity in between.
        near(contact.impulse, 2.0 * 41.0_f64.sqrt() + 10.0 * (0.885_456_153 - 0.540_312_424), "impulse");
        near(contact.departure_speed.expect("closed"), 41.0_f64.sqrt(), "departure");
    }
}

#[test]
fn a_body_that_lands_with_restitution_zero_stays_until_it_is_lifted() {
    // Falls 0.1 m in 0.142785 s, rests, and is pulled up by 20 N from 0.5 s on; then flies.
    let table = Table::new(vec![0.5, 2.0], vec![20.0, 20.0]).expect("a sound table");
    let scene = common::ball(0.1, 0.0).with_load(Load::table(table)).with_duration(0.6);
    let landing = (0.2_f64 / 9.81).sqrt();
    let h = 1e-4;
    for scheme in [Scheme::ImplicitEuler, Scheme::PaoliSchatzman, MOREAU_JEAN] {
        let found = contacts(&scene, &scheme, h);
        let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
        let what = format!("{scheme}: {contact:?}");
        assert!(
            (contact.start - landing).abs() <= 1.5 * h && (contact.end.expect("closed") - 0.5).abs() <= 1.5 * h,
            "{what}"
        );
        // v of the landing and the weight while it rests; each is within a step of its time.
        let expected = 9.81 * landing + 9.81 * (0.5 - landing);
        assert!((contact.impulse - expected).abs() < 2.0 * h * 9.81, "{what}, expected {expected}");
        assert!((contact.approach_speed - 9.81 * landing).abs() < 2.0 * h * 9.81, "{what}");
        assert!(contact.departure_speed.expect("closed").abs() < 2.0 * h * 10.19, "{what}");
        // The blow of the landing is no finite force: what peaks is the weight, or a blow's remainder of the same order.
        assert!(contact.peak_force.is_some_and(|p| p < 3.0 * 9.81), "{what}");
    }
    // Without the lift it is open at the end.
    for scheme in schemes() {
        let found = contacts(&common::ball(0.0, 0.0), &scheme, h);
        let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
        assert_eq!((contact.end, contact.departure_speed), (None, None), "{scheme}");
    }
}
