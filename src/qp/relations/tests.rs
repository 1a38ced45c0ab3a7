//! What still counts as met, by hand. Dividing and escaping are tested where rows are put in play:
//! in `block`.

use super::*;
use crate::qp::tests::trial::Dense;

/// Whether a row of weight 8 that depends with coefficient `c` on a row of weight 4 is met together
/// with it: the other row moves by `q` with force `force`, this one by `c q` plus `miss`.
fn met(c: f64, (q, miss): (f64, f64), slack: [f64; 2], (force, ulps): (f64, f64)) -> bool {
    let system = Dense::rigid([[4.0], [8.0]]).at_rest();
    let mut relations = Relations::new(2);
    relations.push(1, &[c]);
    let shift = |row: usize| if row == 0 { q } else { c * q + miss };
    !relations.escapes(&system, &[0], &[force], shift, |row| slack[row], ulps)
}

/// The least miss that does not count as met is this `limit`, to the share `to`.
fn limited(limit: f64, to: f64, met: impl Fn(f64) -> bool) {
    for sign in [1.0, -1.0] {
        assert!(met(sign * limit * (1.0 - to)), "{limit}, sign {sign}");
        assert!(!met(sign * limit * (1.0 + to)), "{limit}, sign {sign}");
    }
}

#[test]
fn a_dependent_row_may_miss_by_what_states_and_bounds_allow() {
    let none = (0.0, 0.0);
    // Nothing asked for is met.
    assert!(met(0.25, none, [0.0, 0.0], none));
    // The other row may miss by 1, and this one then by 0.25, which is below its own 2; W is
    // rounded by 2⁻⁵² of what the slack is 1e-12 of.
    limited(0.25 * (1.0 + 2.220_446e-4), 1e-5, |miss| met(0.25, (0.0, miss), [1.0, 2.0], none));
    // Its own slack is the smaller one.
    limited(0.1 + 0.25 * 2.220_446e-4, 1e-5, |miss| met(0.25, (0.0, miss), [1.0, 0.1], none));
    // A row with a thousandth of this one's motion does not make room for it: 4c against 8e-3.
    limited(2.0, 1e-3, |miss| met(1e-3, (0.0, miss), [1.0, 2.0], none));
    limited(4e-3, 1e-3, |miss| met(4e-3, (0.0, miss), [1.0, 2.0], none));
}

#[test]
fn a_dependent_row_may_miss_by_rounding() {
    // 16 ulps of the other row's motion 8, times 0.25: 7.1e-15, where numbers near 2 are multiples
    // of 4.4e-16.
    let bounds = 16.0 * f64::EPSILON * 8.0 * 0.25;
    limited(bounds, 0.1, |miss| met(0.25, (8.0, miss), [0.0, 0.0], (0.0, 0.0)));
    limited(bounds, 0.1, |miss| met(0.25, (-8.0, miss), [0.0, 0.0], (0.0, 0.0)));
    // And of W, with a slack of 1e-10 of which this row has none.
    let both = bounds + 0.25 * f64::EPSILON * 100.0;
    limited(both, 0.05, |miss| met(0.25, (8.0, miss), [1e-10, 0.0], (0.0, 0.0)));
    // A force of 10 moves its row by 40 times its weight: a share of 1e-3 of that times 8, and a
    // quarter of that times 4.
    limited(0.32 + 0.04, 1e-3, |miss| met(0.25, (0.0, miss), [0.0, 0.0], (10.0, 1e-3)));
    limited(0.32 + 0.04, 1e-3, |miss| met(-0.25, (0.0, miss), [0.0, 0.0], (-10.0, 1e-3)));
}
