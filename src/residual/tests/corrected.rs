//! Steps that predict and then correct.

use super::*;
use crate::scene::{Load, Wall};
use crate::step::{Bound, Law, Normal, PromisedForce, Reached, Turning};

const H: f64 = 0.25;

/// The rule with the mean acceleration, that of both ends.
fn rule() -> (Balance, Promise) {
    let mut promise = Promise::springs(Law::Depth(1.0));
    promise.elastic.force = PromisedForce::Trapezoid;
    (promise.rigid.displacement, promise.rigid.velocity) = (Some(Bound::End), Some(Reached::Closed));
    let touching = 1e-6;
    promise.round = Some(Turning { normal: Normal::Middle(0.5), touching, sagitta: 0.0, deepest: 0.0 });
    promise.hole = Some(Bound::End);
    (Balance::GeneralizedAlpha { alpha_m: 0.0, alpha_f: 0.0, beta: 0.25, gamma: 0.5 }, promise)
}

/// A free flight of 4 and 16 kg with 1 and 2 m/s.
fn flight(scene: &Scene) -> Made {
    let v = vec![1.0, 2.0];
    Made { q: vec![H, 2.0 * H], before: v.clone(), after: v, ..Made::rest(scene, H) }
}

#[test]
fn a_wrong_velocity_counts_by_its_momentum_in_the_metric_of_the_mass() {
    let scene = body([4.0, 16.0], 0.0);
    for (dof, mass) in [(0, 4.0), (1, 16.0_f64)] {
        let mut judge = judge(&scene, rule(), H, &[0.0, 0.0]);
        let mut made = flight(&scene);
        judge.observe(&made.step());
        assert_eq!((judge.balance.largest, judge.balance.force.value, judge.balance.path.value), (0.0, 0.0, 0.0));
        // The next step, which ends with 1/8 m/s more.
        made.before.copy_from_slice(&[1.0, 2.0]);
        made.q.iter_mut().for_each(|q| *q *= 2.0);
        made.after[dof] += 0.125;
        judge.observe(&Step { index: 1, start: H, end: 2.0 * H, ..made.step() });
        assert_eq!((judge.balance.largest, judge.balance.path.value), (mass * 0.125 / H, 0.0));
        assert_eq!(judge.balance.force.value, mass.sqrt() * 0.125 / H);
    }
}

#[test]
fn a_wrong_displacement_counts_in_flight_though_there_are_holes() {
    let hole = with_hole(body([4.0, 16.0], 0.0), "hole", 9.0, RIGID);
    for scene in [body([4.0, 16.0], 0.0), hole] {
        for (dof, mass) in [(0, 4.0), (1, 16.0_f64)] {
            let mut judge = judge(&scene, rule(), H, &[0.0, 0.0]);
            let mut made = flight(&scene);
            made.q[dof] += 0.125;
            judge.observe(&made.step());
            assert_eq!((judge.balance.largest, judge.balance.path.value), (0.0, mass.sqrt() * 0.125));
            assert!(judge.findings().iter().any(|finding| finding.refuted == Refuted::Kinematics));
        }
    }
    // Where the hole is closed it may correct the displacement.
    let scene = with_hole(body([4.0, 16.0], 0.0), "hole", 1.0, RIGID);
    let mut judge = judge(&scene, rule(), H, &[0.0, 0.0]);
    judge.observe(&Made { q: vec![0.6, 0.8], ..flight(&scene) }.step());
    assert_eq!(judge.balance.path.value, 0.0);
}

#[test]
fn a_wall_may_correct_a_displacement_that_ends_at_it_but_for_rounding() {
    // From 1 m behind where it is free to be, back to the wall, which the sum misses by 4 touching
    // distances; and by 2e-6 of the gap scale.
    let scene = body([4.0, 16.0], 0.0).with_wall(Wall::upper("stop", 0.25));
    for (missed, residual) in [(1e-12, 0.0), (5e-7, 2.0)] {
        let mut judge = judge(&scene, rule(), H, &[-0.25, 0.0]);
        let made = Made { q: vec![0.25 - missed, 0.0], ..Made::rest(&scene, H) };
        judge.observe(&Step { velocity_before: &[6.0, 0.0], ..made.step() });
        assert!((judge.balance.path.value - residual).abs() < 1e-5, "{missed}");
    }
}

#[test]
fn loads_and_extra_forces_accelerate_and_are_exchanged() {
    // 2 N and 8 N more on 4 kg; −4 N on 16 kg.
    let load = |dof: usize, force: f64| Load { at: Row::dof(dof), ..Load::constant(force) };
    let scene = body([4.0, 16.0], 0.0).with_load(load(0, 2.0)).with_load(load(1, -4.0));
    let mut judge = judge(&scene, rule(), H, &[0.0, 0.0]);
    let made = Made {
        q: [2.5, -0.25].map(|a| 0.5 * H * H * a).to_vec(),
        after: [2.5, -0.25].map(|a| H * a).to_vec(),
        extra: vec![8.0, 0.0],
        ..Made::rest(&scene, H)
    };
    judge.observe(&made.step());
    assert_eq!((judge.balance.largest, judge.balance.path.value), (0.0, 0.0));
    let exchanged: Vec<f64> = judge.sums.forces.exchanged.clone();
    assert_eq!(exchanged, [10.0 * H, 4.0 * H]);
    // 10 N/2 √kg is the largest force: 8 N are given on top of 2 N.
    assert_eq!(judge.balance.scale, 4.0);
    let energy = judge.energy.report();
    let work = 10.0 * made.q[0] - 4.0 * made.q[1];
    assert_eq!((energy.load_work_j, energy.residual_j), (work, 0.0));
    // Its rounding: speeds of 2 √kg · 0.625 m/s in a quarter of a second, and 5 N/√kg.
    let allowed = judge.noise.of(2.0 * 0.625 / H + 5.0);
    assert!((judge.noise.force_over(H) / allowed - 1.0).abs() < 1e-12);
}

#[test]
fn a_damper_that_does_not_feel_a_blow_is_accused_unless_a_closed_wall_may_have_answered() {
    // 16 N s after a quarter of a step on 4 kg with 6 N s/m: 4 m/s over 1/16 s to the middle of the
    // step, of which the damper feels 1.5 N s.
    let blow = Load::impulse(16.0, 0.0625);
    let (m, c, felt) = (4.0, 6.0, 1.5);
    let scene = |walls: &[Wall]| {
        let scene = body([4.0, 16.0], 6.0).with_load(blow.clone());
        walls.iter().fold(scene, |scene, wall| scene.with_wall(wall.clone()))
    };
    // The residual, N s, where the damper feels a share of that; the body goes to `at`.
    let open = |walls: &[Wall], at: f64, share: f64| {
        let scene = scene(walls);
        let mut judge = judge(&scene, rule(), H, &[0.0, 0.0]);
        let after = (16.0 - share * felt) / (m + 0.5 * H * c);
        let made = Made { q: vec![at, 0.0], after: vec![after, 0.0], ..Made::rest(&scene, H) };
        judge.observe(&made.step());
        judge.balance.largest * H
    };
    // Rounding of 16 N s.
    let is = |found: f64, expected: f64| (found - expected).abs() < 1e-13;
    let (stop, behind) = (Wall::upper("stop", 0.5), Wall::lower("behind", -0.5));
    let beside = Wall::upper("beside", 0.0).at(Row::dof(1));
    for walls in [&[][..], &[stop.clone(), behind.clone()]] {
        assert!(is(open(walls, 0.25, 1.0), 0.0) && is(open(walls, 0.25, 0.0), felt), "{walls:?}");
    }
    // A closed wall into which the blow drives, one behind, and one that does not feel it.
    for (wall, at, answers) in [(stop, 0.5, true), (behind, -0.5, false), (beside, 0.25, false)] {
        let walls = std::slice::from_ref(&wall);
        assert!(is(open(walls, at, 1.0), 0.0), "{wall:?}");
        assert!(is(open(walls, at, 0.0), if answers { 0.0 } else { felt }), "{wall:?}");
    }
}

#[test]
fn the_impulse_of_a_rigid_wall_is_a_force_of_the_balance() {
    // 4 kg turned round by 3 N s in a quarter of a second: 12 N over 2 √kg.
    let scene = body([4.0, 16.0], 0.0).with_wall(Wall::upper("wall", 0.0));
    let mut judge = judge(&scene, rule(), H, &[0.0, 0.0]);
    let made = Made {
        before: vec![0.375, 0.0],
        after: vec![-0.375, 0.0],
        impulse: vec![-3.0],
        force: vec![-12.0],
        ..Made::rest(&scene, H)
    };
    judge.observe(&made.step());
    assert_eq!((judge.balance.largest, judge.balance.scale), (0.0, 6.0));
}
