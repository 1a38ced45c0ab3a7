//! How the expectation follows the events.

use super::*;

#[test]
fn quick_events_shorten_what_is_expected_and_their_absence_lengthens_it() {
    let mut pace = Pace::new();
    assert_eq!(pace.reach(), f64::INFINITY);
    // Nothing is known without an event, nor from one that takes no time.
    pace.note(1.0, false, 1.0);
    pace.note(0.0, true, 1.0);
    assert_eq!(pace.reach(), f64::INFINITY);
    // One quick event halves it, at most, from the length of the series on.
    pace.note(1e-3, true, 1.0);
    assert_eq!(pace.reach(), 0.5);
    for _ in 0..20 {
        pace.note(1e-3, true, 1.0);
    }
    assert_eq!(pace.reach(), 8e-3);
    // A slower one lengthens it at once.
    pace.note(4e-3, true, 1.0);
    assert_eq!(pace.reach(), 32e-3);
    // A series that a mark ended early tells nothing; one that lasted as long as expected does.
    pace.note(1e-3, false, 1.0);
    assert_eq!(pace.reach(), 32e-3);
    pace.note(32e-3, false, 1.0);
    assert_eq!(pace.reach(), 16.0 * 32e-3);
}
