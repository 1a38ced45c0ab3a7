//! The marks at which steps end, and the refusal of a run that would not.

use super::super::EVENTS_PER_WINDOW;
use super::*;

/// The marks that a run meets from `time` on: multiples of the stride and the end of the scene.
fn marks(clock: &mut Clock, mut time: f64, count: usize) -> Vec<f64> {
    let mut found = Vec::new();
    while found.len() < count {
        time = clock.limit(time);
        clock.pass(time);
        found.push(time);
    }
    found
}

#[test]
fn steps_end_at_multiples_of_the_stride_and_at_the_end_of_the_scene() {
    assert_eq!(marks(&mut Clock::new(1.0, 0.25), 0.0, 6), [0.25, 0.5, 0.75, 1.0, 1.25, 1.5]);
    assert_eq!(marks(&mut Clock::new(1.0, 0.375), 0.0, 5), [0.375, 0.75, 1.0, 1.125, 1.5]);
    // Three strides are the end, whatever their rounding; a little more is not.
    for stride in [0.1, 1e-7, 3e5] {
        let end = 3.0 * stride;
        for off in [0.0, 0.9e-9, -0.9e-9] {
            let mut clock = Clock::new(end + off * stride, stride);
            assert_eq!(marks(&mut clock, 0.0, 4)[2..], [clock.duration, 4.0 * stride], "{stride} {off}");
        }
        for (off, last) in [(1.1e-9, 3.0 * stride), (-1.1e-9, end - 1.1e-9 * stride)] {
            let mut clock = Clock::new(end + off * stride, stride);
            assert_eq!(marks(&mut clock, 0.0, 3)[2], last, "{stride} {off}");
        }
    }
    // Events between two marks change nothing.
    let mut clock = Clock::new(1.0, 0.25);
    clock.pass(0.125);
    clock.pass(0.249);
    assert_eq!((clock.limit(0.249), clock.limit(2.0)), (0.25, 0.25));
}

#[test]
fn a_restart_goes_on_with_the_next_mark() {
    for (time, next) in [
        (0.0, 0.25),
        (0.3, 0.5),
        (0.5, 0.75),
        // A mark that is ahead by rounding only is passed.
        (0.5 - 1e-10, 0.75),
        (0.5 - 1e-9, 0.5),
        (0.5 + 1e-9, 0.75),
        (0.8, 1.0),
    ] {
        let mut clock = Clock::new(1.0, 0.25);
        clock.last_wall = Some(3);
        clock.restart(time);
        assert_eq!((clock.limit(time), clock.last_wall), (next, None), "{time}");
    }
}

#[test]
fn a_run_of_too_many_events_in_a_twentieth_of_the_duration_is_refused() {
    // Windows of 0.5 s.
    let mut clock = Clock::new(10.0, 1.0);
    clock.count().events = EVENTS_PER_WINDOW;
    assert!(clock.check(0.25, &[]).is_ok());
    clock.count().events += 1;
    match clock.check(0.375, &[]) {
        Err(Error::TooManyEvents { time, count, window, .. }) => {
            assert_eq!((time, count, window), (0.375, EVENTS_PER_WINDOW + 1, 0.5));
        }
        other => panic!("{other:?}"),
    }
    assert!(clock.check(0.5, &[]).is_ok());
    clock.count().evaluations += EVENTS_PER_WINDOW + 1;
    assert!(clock.check(0.75, &[]).is_err());
    // A restart forgets the window but not the work.
    clock.restart(0.75);
    assert!(clock.check(0.75, &[]).is_ok());
    assert_eq!(clock.total().events, EVENTS_PER_WINDOW + 1);
}
