//! Sums of whole numbers, which are exact in any order.

use super::*;

#[test]
fn a_product_of_any_length_has_each_term_once() {
    for n in 0..21_i32 {
        let term = |i: i32| (3 * i + 1, 7 - 2 * i);
        let (a, b): (Vec<f64>, Vec<f64>) = (0..n).map(|i| (f64::from(term(i).0), f64::from(term(i).1))).unzip();
        let expected: i32 = (0..n).map(|i| term(i).0 * term(i).1).sum();
        assert_eq!(dot(&a, &b), f64::from(expected), "{n} terms");
    }
}

#[test]
fn a_multiple_is_added_entry_by_entry() {
    let mut out = [1.0, -2.0, 4.0];
    add(3.0, &[1.0, 5.0, -2.0], &mut out);
    assert_eq!(out, [4.0, 13.0, -2.0]);
}
