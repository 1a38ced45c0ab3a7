//! Bounds that are violated, met and crossed.

use super::*;

#[test]
fn only_a_bound_that_is_passed_is_violated() {
    assert_eq!(Side::violated(-1.5, -1.0, 1.0), Some(Side::Lower));
    assert_eq!(Side::violated(1.5, -1.0, 1.0), Some(Side::Upper));
    for y in [-1.0, 0.0, 1.0] {
        assert_eq!(Side::violated(y, -1.0, 1.0), None, "{y} lies within the bounds or on one");
    }
    // Bounds that have crossed by rounding: the lower one is taken.
    assert_eq!(Side::violated(0.0, 1.0, -1.0), Some(Side::Lower));
}
