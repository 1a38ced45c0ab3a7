//! The momentum of a whole run, worked out by hand.

use super::*;
use crate::residual::momentum_sums::Forces;
use crate::scene::{PlaneRows, Row};

/// The scene with a rigid round hole around the first two degrees of freedom.
pub(super) fn in_hole(scene: Scene) -> Scene {
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let wall = Wall::round("hole", at.clone(), 1.0).with_restitution(0.5);
    scene.with_support("hole", at, [0.0; 2], vec![wall])
}

#[test]
fn what_the_forces_and_impulses_of_a_run_leave_is_measured_by_what_was_exchanged() {
    let stop = Wall::upper("stop", 64.0).at(Row::new(vec![(0, 2.0)]));
    let pad = Wall::lower("pad", 0.0).with_elasticity(16.0, 0.0).at(Row::new(vec![(0, -0.5)]));
    let scene = Scene::oscillator(4.0, 2.0, 8.0).with_load(Load::constant(7.0)).with_wall(stop).with_wall(pad);
    let mut judge = Judge::new(&scene, contract(Balance::Theta(0.5)), 0.5, &[1.0], &[2.0]);
    // Four steps from 1 m at 2 m/s to 2 m at −1 m/s, after which the load is 4 N.
    (judge.q, judge.load, judge.noise.end, judge.walls.force_scale) = (vec![2.0], vec![4.0], 2.0, 8.0);
    let sums = &mut judge.sums;
    (sums.steps, sums.last, sums.place, sums.load) = (4, vec![-1.0], vec![3.0], vec![-495.0]);
    sums.forces.set(0, Forces { load: 2.0, own: -3.0, changes: 1.0, largest: 6.0, exchanged: 9.0 });
    (sums.seen, sums.sizes) = (vec![-3.0, 2.0], vec![5.0, 2.0]);
    // m Δv + c Δq + k ∫q dt − ∫f dt, and the walls' impulses through their levers.
    let open = 4.0 * -3.0 + 2.0 * 1.0 + 8.0 * 3.0 + 495.0 - (2.0 * -3.0 - 0.5 * 2.0);
    // The forces at the ends, f − c v − k q: how large they get, and how they differ from those of
    // the steps beside them; and the pad at the end, 1 m deep, which pushes with 16 N.
    let (begin, end) = (7.0 - 2.0 * 2.0 - 8.0 * 1.0, 4.0 + 2.0 * 1.0 - 8.0 * 2.0);
    assert_eq!((open, begin, end), (516.0, -5.0, -10.0));
    let ends = 10.0 + 5.0 + (4.0 - 2.0) + (-10.0f64 - 4.0 + 3.0).abs() + 0.5 * 16.0;
    let exchanged = 9.0 + 2.0 * 5.0 + 0.5 * 2.0;
    // Two steps of these forces and of their changes are what a rule may miss.
    let left = open - 2.0 * 0.5 * (1.0 + ends);
    let worst = judge.open_momentum();
    assert_eq!((worst.value, worst.time, worst.wall), (left / exchanged, 2.0, None));
}

#[test]
fn a_force_is_said_to_change_from_the_second_step_on() {
    // 3 N in the first step, 2½ N in the second.
    let table = Table::new(vec![0.0, 2.0], vec![3.25, -4.75]).expect("a table");
    let scene = Scene::oscillator(1.0, 0.0, 0.0).with_load(Load::table(table));
    let mut theta = judge(&scene, contract(Balance::Theta(0.5)), 0.0, 0.0);
    theta.observe(&Claim::of(0.0, 0.0, 3.0 * H, 0).step());
    assert_eq!((theta.sums.forces.changes[0], theta.sums.forces.load[0]), (0.0, 3.0));
    theta.observe(&Claim::of(0.0, 3.0 * H, 5.5 * H, 0).at(1).step());
    assert_eq!((theta.sums.forces.changes[0], theta.sums.forces.load[0]), (0.5, 2.5));
    // generalized-α: the whole force at the end of a step is 7 N, 3 N of it the load's.
    let alpha = Balance::GeneralizedAlpha { alpha_m: 0.0, alpha_f: 0.5, beta: 0.25, gamma: 0.5 };
    let mut alpha = judge(&scene, contract(alpha), 0.0, 2.0);
    alpha.load_end = vec![3.0];
    alpha.previous.as_mut().expect("generalized-α").force = vec![7.0];
    alpha.sum(Scalar, &Claim::of(1.0, 2.0, 4.0, 0).step(), 1.0 / H, 1);
    let Forces { load, own, changes, largest, exchanged } = alpha.sums.forces.of(0);
    assert_eq!([load, own, changes, largest, exchanged], [3.0, 4.0, 0.0, 7.0, 7.0 * H]);
    assert_eq!((alpha.sums.rate[0], alpha.sums.last[0]), (0.5 * H * (2.0 + 4.0), 4.0));
}

#[test]
fn a_staggered_run_ends_half_a_step_before_its_last_instant() {
    // Blows of 2 N s before the middle of the fourth step, and of 3 N s after it: the first has
    // changed the velocity of 1 kg.
    let blows = [Load::impulse(2.0, 3.375 * H), Load::impulse(3.0, 3.75 * H)];
    let scene = blows.into_iter().fold(Scene::oscillator(1.0, 0.0, 0.0), Scene::with_load);
    let open = |last: f64| {
        let mut judge = judge(&scene, contract(Balance::Staggered(0.25)), 0.0, 1.0);
        let sums = &mut judge.sums;
        (sums.steps, sums.last, sums.forces.exchanged[0]) = (4, vec![last], 10.0);
        judge.open_momentum().value
    };
    assert_eq!([1.0, 3.0, 6.0].map(open), [2.0 / 10.0, 0.0, 3.0 / 10.0]);
}

#[test]
fn recorded_impulses_that_are_not_those_seen_are_found_in_any_unit() {
    for unit in [1.0, 2f64.powi(-60), 2f64.powi(60)] {
        let mut judge = judge(&under(Wall::upper("stop", 1.0)), rigid(None, None), 0.0, 0.0);
        let sums = &mut judge.sums;
        (sums.steps, sums.whole, sums.seen, sums.sizes) = (3, false, vec![-4.0 * unit], vec![8.0 * unit]);
        assert_eq!(judge.open_momentum().value, 0.0);
        judge.hear(&[-4.0 * unit]);
        assert_eq!(judge.open_momentum().value, 0.0);
        judge.hear(&[-5.0 * unit]);
        let worst = judge.open_momentum();
        // Three roundings are taken off.
        assert!((worst.value - (0.125 - 3.0 * f64::EPSILON)).abs() < 1e-16, "{unit}: {worst:?}");
        assert_eq!(worst.wall, Some(0));
    }
    // The last place of a denormal impulse is a share of it, and no finding.
    let mut denormal = judge(&under(Wall::upper("stop", 1.0)), rigid(None, None), 0.0, 0.0);
    let sums = &mut denormal.sums;
    (sums.steps, sums.whole, sums.seen, sums.sizes) = (3, false, vec![-4e-321], vec![8e-321]);
    denormal.hear(&[-5e-321]);
    assert_eq!(denormal.open_momentum().value, 0.0);
    // The same of a hole, along both axes.
    let scene = in_hole(two([[1.0; 2], [0.0; 2], [0.0; 2]]));
    let open = |told: [f64; 2]| {
        let mut judge = Judge::new(&scene, rigid(None, None), H, &[0.0; 2], &[0.0; 2]);
        (judge.sums.steps, judge.sums.whole) = (3, false);
        let supports = judge.supports.as_mut().expect("a hole");
        (supports.impulse[0], supports.size[0]) = ([3.0, 4.0], 20.0);
        judge.hear_holes(&[told]);
        judge.open_momentum().value
    };
    assert_eq!(open([3.0, 4.0]), 0.0);
    let expected = 0.25 - 3.0 * f64::EPSILON;
    assert!((open([6.0, 8.0]) - expected).abs() < 1e-16 && (open([-1.0, 1.0]) - expected).abs() < 1e-16);
}

#[test]
fn a_hole_exchanges_its_impulse_through_its_levers() {
    let at = PlaneRows { y: Row::new(vec![(0, 2.0)]), z: Row::new(vec![(1, -0.5)]) };
    let scene = two([[1.0; 2], [0.0; 2], [0.0; 2]]).with_wall(Wall::round("lever", at, 1.0));
    let mut judge = Judge::new(&scene, rigid(None, None), H, &[0.0; 2], &[1.0, 1.0]);
    // Two bodies of 1 kg keep their velocities although 3 and 4 N s act through the levers.
    judge.sums.steps = 4;
    let supports = judge.supports.as_mut().expect("a hole");
    (supports.impulse[0], supports.size[0]) = ([3.0, 4.0], 20.0);
    assert_eq!(judge.open_momentum().value, 2.0 * 3.0 / (2.0 * 20.0));
}

#[test]
fn a_force_that_no_load_explains_breaks_the_balance_of_a_run_without_a_caller() {
    // A free body of 1 kg takes 4 N from ⅛ s on, where its table begins: none of it in the first
    // step, at whose end the jump makes up −2 N for the 2 N of the rule, and 0.5 N s in each later.
    let table = Table::new(vec![H, 1.0], vec![4.0, 4.0]).unwrap();
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("far", 50.0))
        .with_load(Load::table(table))
        .with_duration(1.0);
    let step = |index: u64, [v0, v1]: [f64; 2], extra: f64, q: f64| {
        let mut claim = Claim::of(q, v0, v1, 1).at(index);
        claim.extra = vec![extra];
        claim
    };
    let right = [step(0, [0.0, 0.0], -2.0, 0.0), step(1, [0.0, 0.5], 0.0, 0.03125)];
    // What is left of the jump goes on to act in the second step.
    let wrong = [right[0].clone(), step(1, [0.0, 0.25], -2.0, 0.015_625)];
    let contract = contract(Balance::Theta(0.5));
    let (shared, masses) = (Arc::new(scene.clone()), scene.wall_masses());
    let refuted = |claims: &[Claim], caller: bool| {
        let alone = Judge::over(&shared, &masses, contract, H, (&[0.0], &[0.0]));
        let mut judge = if caller { Judge::new(&scene, contract, H, &[0.0], &[0.0]) } else { alone };
        claims.iter().for_each(|claim| judge.observe(&claim.step()));
        judge.findings().iter().any(|finding| finding.refuted == Refuted::MomentumBalance)
    };
    assert!(!refuted(&right, false) && !refuted(&right, true));
    assert!(refuted(&wrong, false));
    // A caller may add −2 N.
    assert!(!refuted(&wrong, true));
}
