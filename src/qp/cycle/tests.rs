//! Sequences of states with and without repetitions.

use super::*;

/// A state: one wrong row and what it shall be, beside row 7 in play.
fn closes(cycle: &mut Cycle, row: usize, side: Option<Side>) -> bool {
    cycle.closes(&[(row, side)], &[7])
}

#[test]
fn states_that_differ_close_no_cycle() {
    let mut cycle = Cycle::default();
    for row in 0..100 {
        for side in [None, Some(Side::Upper), Some(Side::Lower)] {
            assert!(!closes(&mut cycle, row, side), "row {row}, {side:?}");
        }
    }
    // Other rows in play make another state, too.
    for row in 0..100 {
        assert!(!cycle.closes(&[(0, None)], &[row]), "row {row}");
    }
    assert_eq!(cycle.closed, 0);
}

#[test]
fn every_cycle_closes_after_any_beginning_and_again() {
    for period in 1..12 {
        for beginning in 0..20 {
            let mut cycle = Cycle::default();
            let mut closed = vec![];
            for step in 0..200 {
                let row = if step < beginning { 1000 + step } else { (step - beginning) % period };
                if closes(&mut cycle, row, None) {
                    closed.push(step);
                }
            }
            // Brent's method compares with a state that it replaces after 1, 2, 4, 8, … states: one
            // of the cycle is held for a whole period by the state 2·max(period, beginning), and
            // the cycle closes a period later.
            let latest = 2 * period.max(beginning) + period + 1;
            let case = format!("period {period} after {beginning}: {closed:?}");
            assert!(closed[0] >= beginning + period && closed[0] <= latest, "{case}");
            // It then starts anew, so that a cycle closes again after a whole period, and a state
            // to compare with is needed first.
            assert!(closed.windows(2).all(|pair| pair[1] - pair[0] > period), "{case}");
            assert!(closed.windows(2).all(|pair| pair[1] - pair[0] <= 3 * period + 1), "{case}");
            assert_eq!(cycle.closed as usize, closed.len(), "{case}");
        }
    }
}
