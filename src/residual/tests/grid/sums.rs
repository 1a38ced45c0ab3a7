//! Sums over the steps of a run, worked out by hand.

use super::*;
use crate::residual::momentum_sums::Forces;
use crate::residual::step_motion::StepMotion;

fn entries(forces: &Forces) -> [f64; 5] {
    [forces.load, forces.own, forces.changes, forces.largest, forces.exchanged]
}

#[test]
fn forces_are_summed_by_size_and_by_change_except_at_the_start() {
    let mut sums = MomentumSums::new(&two([[1.0; 2]; 3]), &[1.0, 2.0], &[0.0; 2]);
    let zeros = [0.0; 2];
    let moves = StepMotion {
        h: 0.5,
        per_h: 2.0,
        from: &[1.0, 2.0],
        to: &zeros,
        shown: &[3.0, -1.0],
        before: &zeros,
        after: &zeros,
        v: &zeros,
        load_start: &[1.0, 2.0],
        load_end: &[3.0, -4.0],
        extra: &[2.0, -1.0],
        blow: &zeros,
    };
    let mut means = Scratch::new(2);
    // Springs and dampers are given as impulses with the opposite sign, over half a second.
    (means.load, means.spring, means.damper) = (vec![3.0, 1.0], vec![2.0, -1.0], vec![-1.0, 1.0]);
    sums.add(Scalar, &moves, &means, true, 2);
    assert_eq!(entries(&sums.forces.of(0)), [3.0, -4.0, 0.0, 3.0 + 4.0 + 2.0, 0.5 * 1.0]);
    assert_eq!(entries(&sums.forces.of(1)), [1.0, 2.0, 0.0, 1.0 + 2.0 + 2.0, 0.5 * 1.0]);
    // Ends by the trapezoid rule, the extra force all the while.
    assert_eq!((&sums.place[..], &sums.load[..]), (&[0.25 * 4.0, 0.25 * 1.0][..], &[1.0 + 1.0, -0.5 - 0.5][..]));
    (means.load, means.spring, means.damper) = (vec![1.0, 1.0], vec![1.0, 1.0], vec![0.0, 0.25]);
    sums.add(Scalar, &moves, &means, false, 2);
    assert_eq!(entries(&sums.forces.of(0)), [1.0, -2.0, 2.0 + 2.0, 9.0, 0.5 + 0.5 * 1.0]);
    assert_eq!(entries(&sums.forces.of(1)), [1.0, -2.0, 0.0 + 4.0, 5.0, 0.5 + 0.5 * 1.5]);
    assert_eq!((&sums.place[..], &sums.load[..]), (&[2.0, 0.5][..], &[4.0, -2.0][..]));
}

#[test]
fn steps_of_one_degree_of_freedom_are_summed_together() {
    let mut sums = MomentumSums::new(&Scene::oscillator(1.0, 0.0, 0.0), &[1.0], &[5.0]);
    let zeros = [0.0; 3];
    let moves = StepMotion {
        h: 0.5,
        per_h: 2.0,
        from: &[1.0, 2.0, 4.0],
        to: &zeros,
        shown: &[2.0, 4.0, 8.0],
        before: &zeros,
        after: &[5.0, 6.0, 7.0],
        v: &zeros,
        load_start: &[1.0, 3.0, 5.0],
        load_end: &[3.0, 5.0, 7.0],
        extra: &zeros,
        blow: &zeros,
    };
    let mut means = Scratch::new(3);
    (means.load, means.spring, means.damper) = (vec![2.0, 4.0, 6.0], vec![1.0, 1.0, 2.0], vec![0.0, 0.5, 0.0]);
    sums.add_all(&moves, &means, 3);
    // Forces of springs −2, −2 and −4 N, of the damper −1 N in the second step, from 0 before.
    let changes = (2.0 + 2.0) + (2.0 + 0.0) + (2.0 + 2.0);
    assert_eq!(entries(&sums.forces.of(0)), [6.0, -4.0, changes, 10.0, 0.5 * (0.0 + 1.0 + 2.0)]);
    assert_eq!((sums.place[0], sums.load[0], sums.last[0]), (0.25 * 21.0, 0.25 * 24.0, 7.0));
}
