//! The terms of a step's momentum balance, worked out by hand.

use super::*;
use crate::residual::step_motion::StepMotion;
use pulp::Scalar;

fn moves() -> StepMotion<'static> {
    StepMotion {
        h: 0.5,
        per_h: 2.0,
        from: &[1.0, 2.0],
        to: &[2.0, 3.0],
        shown: &[2.0, 3.0],
        before: &[1.0, -1.0],
        after: &[3.0, 2.0],
        v: &[3.0, 2.0],
        load_start: &[4.0, 0.0],
        load_end: &[8.0, -4.0],
        extra: &[1.0, 2.0],
        blow: &[0.5, -1.0],
    }
}

#[test]
fn a_step_of_the_theta_rule_leaves_what_its_terms_do() {
    let scene = two([[4.0, 16.0], [2.0, 8.0], [8.0, 32.0]]);
    let (weights, matrices) = (Weights::new(&scene), Matrices::new(&scene.system));
    assert_eq!((&weights.root_mass[..], &weights.per_root_mass[..]), (&[2.0, 4.0][..], &[0.5, 0.25][..]));
    let (moves, mut scratch) = (moves(), Scratch::new(2));
    let path = scratch.means(Scalar, Balance::Theta(0.25), &moves, &weights, 2).path;
    assert_eq!((&scratch.load[..], &scratch.gained[..]), (&[6.0, 1.0][..], &[2.0, 3.0][..]));
    assert_eq!((&scratch.mean_q[..], &scratch.mean_v[..]), (&[1.25, 2.25][..], &[1.5, -0.25][..]));
    // The bodies move by 1 m instead of ½ · 1.5 m, and 1 m instead of ½ · (−0.25) m: times √m.
    assert_eq!(path, 1.125 * 4.0);
    assert_eq!(scratch.residual, [-0.5 * 6.0 - 0.5, -0.5 * 1.0 + 1.0]);
    let scale = |before: f64| scratch.clone().products(Scalar, &matrices, &moves, &weights, 2, before);
    // The largest force is the second body's inertia, 16 · 3 N s in half a second, over √m.
    assert_eq!([scale(0.0), scale(30.0)], [48.0 * 2.0 / 4.0, 30.0]);
    scratch.products(Scalar, &matrices, &moves, &weights, 2, 0.0);
    assert_eq!((&scratch.inertia[..], &scratch.damper[..]), (&[8.0, 48.0][..], &[1.5, -1.0][..]));
    assert_eq!((&scratch.spring[..], &scratch.residual[..]), (&[5.0, 36.0][..], &[11.0, 83.5][..]));
    assert_eq!(scratch.open(Scalar, 2.0, &weights, 2, 0.0), (2.0 * 83.5, 2.0 * 83.5 / 4.0));
    assert_eq!(scratch.open(Scalar, 2.0, &weights, 2, 200.0).0, 200.0);
    // The load is the largest force where nothing moves.
    let still = StepMotion { to: &[0.0; 2], from: &[0.0; 2], before: &[0.0; 2], after: &[0.0; 2], ..moves };
    scratch.means(Scalar, Balance::Theta(0.25), &still, &weights, 2);
    assert_eq!(
        scratch.products(Scalar, &matrices, &StepMotion { blow: &[0.0; 2], ..still }, &weights, 2, 0.0),
        6.0 / 2.0
    );
}

#[test]
fn a_staggered_step_takes_the_load_at_its_start_and_three_displacements() {
    let weights = Weights::new(&two([[4.0, 16.0], [0.0; 2], [0.0; 2]]));
    let mut scratch = Scratch::new(2);
    // From ½ and 2½ m before, over 1 and 2 m, to 2 and 3 m.
    let path = scratch.means(Scalar, Balance::Staggered(0.25), &moves(), &weights, 2).path;
    assert_eq!((&scratch.load[..], &scratch.gained[..]), (&[5.0, 2.0][..], &[2.0, 3.0][..]));
    assert_eq!((&scratch.mean_q[..], &scratch.mean_v[..]), (&[1.125, 2.375][..], &[2.0, 0.5][..]));
    // The first body moves by 1 m instead of ½ · 3 m.
    assert_eq!(path, 0.5 * 2.0);
}
