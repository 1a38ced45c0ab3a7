//! The sum of the residuals of many steps.

use super::*;
use crate::step::{Conserves, Law, Promise, Tolerances};

#[test]
fn small_residuals_add_up_beside_a_large_one() {
    let (balance, tolerances) = (Balance::Theta(0.5), Tolerances::of(Conserves::Nothing));
    let promise = Promise::springs(Law::Ends(0.5));
    let contract = Contract { balance, promise, instant: 1.0, tolerances, divides: false };
    let mut ledger = Ledger::new(&Arc::new(Scene::oscillator(1.0, 0.0, 0.0)), contract, &[0.0], &[0.0]);
    // 1 J that came from nowhere, then many times a work without effect, each below half an ulp of
    // that.
    let (small, count) = (0.25 * f64::EPSILON, 4096);
    ledger.book(1.0, Flows::default());
    for _ in 0..count {
        ledger.book(1.0, Flows { work: -small, passed: small, ..Flows::default() });
    }
    let expected = 1.0 + f64::from(count) * small;
    // The sum of a thousand ulps is known to one of them.
    assert!((ledger.report().residual_j - expected).abs() <= f64::EPSILON, "{}", ledger.report().residual_j);
}
