//! Where steps end, what they show, and what is refused.

mod flights;
mod scan;
mod units;

use super::*;
use crate::scene::{Load, Table, Wall};
use crate::scheme::motion::Motion;

/// A body of 2 kg without a spring.
fn free() -> Scene {
    Scene::oscillator(2.0, 0.0, 0.0).with_duration(20.0)
}

#[test]
fn a_stride_that_is_no_finite_number_above_0_is_refused() {
    for stride in [0.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert!(matches!(Event::new(&free(), stride), Err(Error::Invalid { .. })), "{stride}");
    }
}

#[test]
fn a_blow_soon_after_one_at_the_start_acts_at_its_time() {
    // At 0.5 m/s from the start and 2 m/s from 0.25 s on, whether a step ends there or not.
    for stride in [0.125, 0.4, 3.0] {
        let scene = free().with_load(Load::impulse(3.0, 0.25)).with_load(Load::impulse(1.0, 0.0));
        let mut event = Event::new(&scene, stride).unwrap();
        assert_eq!((event.v(), event.limit()), (&[0.5][..], stride.min(0.25)));
        while event.end() < 3.0 {
            event.advance(0.0).unwrap();
        }
        // Rounding of a sum of some ten terms.
        let expected = 0.125 + 2.0 * (event.end() - 0.25);
        assert!((event.q()[0] - expected).abs() < 1e-14, "{stride}: {} {expected}", event.q()[0]);
    }
}

#[test]
fn an_arc_that_ends_at_its_limit_ends_there_to_the_last_digit() {
    let mut event = Event::new(&free(), 1.0).unwrap();
    // The span is rounded, so that start and span together miss the limit …
    let (start, limit): (f64, f64) = (0.5469297933871174, 1.9443405444631126);
    let span = limit - start;
    assert!(start + span < limit);
    (event.time, event.late) = (start, 0.0);
    event.pass(span, span, limit);
    assert_eq!((event.time, event.late), (limit, 0.0));
    // … or meet it before all of the span has passed.
    (event.time, event.late) = (1.0, 0.0);
    event.pass(0.5_f64.next_down(), 0.5, 1.5);
    assert_eq!((event.time, event.late), (1.5, 0.0));
    // What an end before the limit loses to rounding is kept.
    (event.time, event.late) = (1.0, 0.0);
    event.pass(0.5_f64.powi(60), 0.5, 1.5);
    assert_eq!((event.time, event.late), (1.0, 0.5_f64.powi(60)));
}

#[test]
fn a_motion_that_leaves_the_numbers_is_refused_with_the_step_and_the_time() {
    let scene = free().with_initial(&[0.0], &[4e307]);
    let mut event = Event::new(&scene, 1.0).unwrap();
    let refused = (0..6).find_map(|_| event.advance(0.0).err());
    // 1.6e308 m after 4 s, and more than 1.8e308 m after 5 s, at a finite speed.
    assert!(matches!(refused, Some(Error::NotFinite { time: 5.0, step: 5, .. })), "{refused:?}");
}

#[test]
fn evaluations_count_in_the_window_of_the_time_that_they_look_at() {
    // Windows of 1 s.
    let mut event = Event::new(&free(), 1.0).unwrap();
    event.time = 0.25;
    event.clock.count().evaluations = EVENTS_PER_WINDOW - 1;
    assert!(event.count_evaluation(0.5).is_ok());
    assert!(event.count_evaluation(0.5).is_err());
    // The next window begins after it.
    assert!(event.count_evaluation(1.0).is_ok());
    event.clock.count().evaluations += EVENTS_PER_WINDOW - 1;
    assert!(event.count_evaluation(1.5).is_ok());
    assert!(event.count_evaluation(1.5).is_err());
    assert_eq!(event.counters().evaluations, 2 * EVENTS_PER_WINDOW + 3);
}

#[test]
fn a_step_shows_where_it_came_from_and_the_wall_that_carries_the_body() {
    // Thrown to the second wall, where e = 0 stops it, and called back by a load from 2 s on.
    let table = Table::new(vec![0.0, 2.0, 2.0 + 1e-9, 20.0], vec![1.0, 1.0, -2.0, -2.0]).unwrap();
    let scene = free()
        .with_wall(Wall::lower("floor", -50.0))
        .with_wall(Wall::upper("ceiling", 3.0).with_restitution(0.0))
        .with_load(Load::table(table))
        .with_initial(&[0.0], &[4.0]);
    let mut event = Event::new(&scene, 0.5).unwrap();
    let mut rests = Vec::new();
    while event.end() < 4.0 {
        let v = event.v().to_vec();
        event.advance(0.0).unwrap();
        assert_eq!(event.step().velocity_before, v);
        rests.push((event.end(), event.rests_on()));
    }
    // It arrives within the second step.
    let at = |t: f64| rests.iter().rev().find(|row| row.0 <= t).unwrap().1;
    assert_eq!([0.5, 1.0, 1.5, 2.5, 4.0].map(at), [None, Some(1), Some(1), None, None]);
    let mut counters = crate::scheme::Counters::default();
    Motion::count(&event, &mut counters);
    // The impact and the release.
    assert_eq!((counters.events, counters.flow_evaluations), (2, event.counters().evaluations));
    assert!(counters.flow_evaluations > 0);
}
