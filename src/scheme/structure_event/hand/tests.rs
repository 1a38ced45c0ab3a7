//! When stretches are handed to moreau-jean, and what their steps tell.

use super::super::tests::{masses, on, rigid, started};
use super::*;
use crate::scene::Wall;
use crate::step::Contact;

/// A ball of 1 kg that rests on the floor, under 10 N.
fn ball(e: f64) -> Scene {
    masses(&[1.0], &[], &[])
        .with_wall(rigid(Wall::lower("floor", 0.0), e, &[(0, 1.0)]))
        .with_load(on(Load::constant(-10.0), 0))
}

/// Whether the next stretch is handed over after so many events at `time` (s).
fn is_handed(event: &mut StructureEvent, events: u64) -> bool {
    event.clock.count().events += events;
    event.hand_over().unwrap();
    event.stretch.take().is_some()
}

#[test]
fn events_are_counted_within_two_radians_or_a_thousandth_of_the_run() {
    let window = |duration: f64| {
        let mut event = started(&masses(&[1.0], &[], &[(0, 0, 400.0)]).with_duration(duration), 1.0);
        event.begin_series(1.0);
        event.crowd_window()
    };
    // The bound on the rate is a few per cent above 20/s.
    assert!(window(1e6) <= 0.1 && window(1e6) > 0.09, "{}", window(1e6));
    assert!((window(2.0) - 2e-3).abs() < 1e-18);
}

#[test]
fn a_stretch_is_handed_over_after_5000_events_or_50_where_one_was_just_before() {
    for (events, handed) in [(51, false), (5000, false), (5001, true)] {
        assert_eq!(is_handed(&mut started(&ball(0.5), 1.0), events), handed, "{events}");
    }
    // The window is 1 ms.
    for (time, events, handed) in
        [(0.5005, 50, false), (0.5005, 51, true), (0.6, 51, false), (0.6, 5000, false), (0.6, 5001, true)]
    {
        let mut event = started(&ball(0.5), 1.0);
        event.crowd.stretches = vec![Handover { from: 0.499, to: 0.5, step: 5e-6 }];
        event.crowd.handed = 0.5;
        (event.time, event.crowd.since) = (time, time);
        assert_eq!(is_handed(&mut event, events), handed, "{time} {events}");
    }
}

#[test]
fn a_stretch_ends_before_the_next_blow_which_exact_motion_gives_at_its_time() {
    let blow = 5e-4;
    let scene = masses(&[1.0], &[], &[])
        .with_wall(rigid(Wall::lower("floor", -1.0), 0.5, &[(0, 1.0)]))
        .with_load(on(Load::impulse(0.3, blow), 0));
    let mut event = started(&scene, 1.0);
    event.clock.count().events += 6000;
    event.hand_over().unwrap();
    assert_eq!(event.stretch.as_ref().unwrap().to, blow.next_down());
    for _ in 0..PARTS {
        event.advance(None).unwrap();
    }
    assert_eq!((event.time, event.v[0]), (blow.next_down(), 0.0));
    // A step that ends at the blow has it, as everywhere in exact motion.
    event.advance(None).unwrap();
    assert_eq!((event.time, event.v[0]), (blow, 0.3));
    // No stretch fits before a blow that is the next number.
    let mut event = started(&scene, 1.0);
    event.time = blow.next_down();
    assert!(!is_handed(&mut event, 6000));
}

#[test]
fn a_body_that_a_stretch_left_behind_a_wall_starts_from_the_wall_although_it_moves_away() {
    let mut event =
        started(&masses(&[1.0], &[], &[]).with_wall(rigid(Wall::lower("floor", 0.0), 0.5, &[(0, 1.0)])), 1.0);
    event.restart(0.5, &[-1e-6], &[1.0]).unwrap();
    event.crowd.handed = 0.5;
    event.advance(None).unwrap();
    assert_eq!((event.time, event.q[0]), (1.0, 0.5));
}

#[test]
fn a_stretch_measures_distances_by_the_gap_of_the_run() {
    // The body starts 1 m above the floor, which it touches within 1e-12 of that. A scene that
    // starts here has a gap of 1e-13 m.
    let mut scene = ball(0.5);
    scene.initial.q = vec![1.0];
    let mut event = started(&scene, 1.0);
    event.restart(0.5, &[1e-13], &[0.0]).unwrap();
    event.clock.count().events += 6000;
    event.advance(None).unwrap();
    let (_, h) = event.handed.unwrap();
    // Under 10 N, to rounding.
    assert!((event.shown.impulse[0] - 10.0 * h).abs() < 1e-15 * h && event.v == [0.0], "{:?}", event.shown.impulse);
}

#[test]
fn a_restart_begins_to_count_anew() {
    let mut event = started(&ball(0.5), 1.0);
    event.clock.count().events = 6000;
    event.restart(0.0, &[0.0], &[0.0]).unwrap();
    assert!(!is_handed(&mut event, 100) && is_handed(&mut event, 5000));
}

#[test]
fn a_contact_of_the_exact_motion_ends_where_its_stretch_begins() {
    let mut event = started(&ball(0.0), 0.5);
    while event.time < 0.5 {
        event.advance(None).unwrap();
    }
    event.crowd.restart(event.time, event.clock.total().events);
    event.clock.count().events += 6000;
    event.advance(None).unwrap();
    assert!(event.stretch.is_some() && event.time > 0.5 && event.time < 0.5 + 1e-5, "{}", event.time);
    let [Contact { start, end, impulse, .. }] = event.shown.closed[..] else { panic!("{:?}", event.shown.closed) };
    assert!(start == 0.0 && end == Some(0.5) && (impulse - 5.0).abs() < 1e-13, "{:?}", event.shown.closed);
}

#[test]
fn contacts_of_a_stretch_are_at_the_times_of_the_run() {
    let mut event = started(&ball(0.9), 1.0);
    event.restart(0.75, &[1e-7], &[-5e-3]).unwrap();
    event.clock.count().events += 6000;
    let mut all = Vec::new();
    event.advance(None).unwrap();
    while event.stretch.is_some() {
        all.extend_from_slice(&event.shown.closed);
        event.advance(None).unwrap();
    }
    all.extend_from_slice(&event.shown.closed);
    // 0.1 µm from 5 mm/s, under 10 m/s²; then a flight from 0.9 of the speed, within the stretch of
    // 1 ms.
    let speed = f64::sqrt(5e-3 * 5e-3 + 2.0 * 10.0 * 1e-7);
    let first = 0.75 + (speed - 5e-3) / 10.0;
    assert_eq!(all.len(), 2, "{all:?}");
    for (contact, time) in all.iter().zip([first, first + 2.0 * 0.9 * speed / 10.0]) {
        let end = contact.end.unwrap();
        // A step is 5 µs; an impact is within two steps, and takes two.
        assert!((contact.start - time).abs() < 1.5e-5 && end >= contact.start && end < time + 3e-5, "{all:?}");
    }
}
