//! What a user reads.

use super::*;

#[test]
fn bounds_of_one_row_and_of_two_are_told_apart() {
    let one = Failure::Infeasible { row: 3, against: 3 };
    assert_eq!(one.to_string(), "the bounds of row 3 cross: the lower one lies above the upper one");
    let two = Failure::Infeasible { row: 3, against: 5 };
    assert_eq!(two.to_string(), "the bounds of rows 3 and 5 cannot be met together");
}
