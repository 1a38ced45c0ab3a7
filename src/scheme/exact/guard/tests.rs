//! What counts in a window, and when the next one begins.

use super::*;

#[test]
fn more_events_or_evaluations_than_allowed_in_one_window_are_told() {
    for evaluations in [false, true] {
        let mut guard = Guard::default();
        let work = |guard: &mut Guard, count: u64| match evaluations {
            true => guard.total.evaluations += count,
            false => guard.total.events += count,
        };
        work(&mut guard, EVENTS_PER_WINDOW);
        assert_eq!(guard.exceeded(0.0, 2.0), None);
        work(&mut guard, 1);
        assert_eq!(guard.exceeded(1.999, 2.0), Some(EVENTS_PER_WINDOW + 1));
        // The next window begins with the first call after the end of this one, or at it.
        assert_eq!(guard.exceeded(2.0, 2.0), None);
        work(&mut guard, EVENTS_PER_WINDOW + 7);
        assert_eq!(guard.exceeded(3.999, 2.0), Some(EVENTS_PER_WINDOW + 7));
        assert_eq!(guard.exceeded(4.5, 2.0), None);
        work(&mut guard, EVENTS_PER_WINDOW + 1);
        assert_eq!(guard.exceeded(6.25, 2.0), Some(EVENTS_PER_WINDOW + 1));
        // A restart begins one anew, at any time.
        guard.restart(1.0);
        assert_eq!(guard.exceeded(1.5, 2.0), None);
        work(&mut guard, EVENTS_PER_WINDOW + 1);
        assert_eq!(guard.exceeded(2.75, 2.0), Some(EVENTS_PER_WINDOW + 1));
        assert_eq!(guard.exceeded(3.0, 2.0), None);
    }
}
