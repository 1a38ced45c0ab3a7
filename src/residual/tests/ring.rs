//! Elastic round holes.

use super::*;
use crate::step::Law;

#[test]
fn a_force_off_the_law_or_the_normal_counts_less_the_rounding_of_place_and_force() {
    let law = WallLaw::Elastic { stiffness: 100.0, damping: 3.0 };
    let scene = with_hole(body([4.0; 2], 0.0), "ring", 0.5, law);
    let h = 0.25;
    // From 1.25 to 2.75 m along one direction, at speeds that make rounding large. In the middle
    // the depth is 1.5 m: 150 N, and 18 N of the dashpot, over half the step and over the whole.
    for (balance, of) in [(Balance::Theta(0.5), Law::Depth(0.5)), (Balance::Theta(0.5), Law::Gradient)] {
        let mut judge = judge(&scene, (balance, Promise::springs(of)), h, &[0.75, 1.0]);
        judge.noise.load(1e7);
        let (more, turn) = (1e-4, 1e-6);
        let normal = [0.6 - 0.8 * turn, 0.8 + 0.6 * turn];
        let made = Made { q: vec![1.65, 2.2], before: vec![6e5, 8e5], after: vec![-3e5, 4e5], ..Made::rest(&scene, h) };
        judge.supports_on_grid(Scalar, &made.pushing(0, normal, h * (168.0 + more)).step(), false);
        assert!((judge.walls.law.value - more).abs() < 1e-12, "{of:?}: {}", judge.walls.law.value);
        // Places 1.75 and 3.85 m, gap 0.5 m, and the way at 2.1e6 m/s.
        let place = judge.noise.place(1.75 + 3.85 + 0.5 + h * 2.1e6);
        let force = judge.noise.wall_force(0);
        // A metre more at the end is 50 N of the spring and 12 of the dashpot; twice that is
        // allowed.
        assert_less(judge.walls.law.excess.value, more, (100.0 + 24.0) * place + force);
        let askew = judge.supports.as_ref().expect("a ring").askew.excess.value;
        assert_less(askew, 168.0 * turn, 168.0 * place / 2.0 + force);
    }
}
