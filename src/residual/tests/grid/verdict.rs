//! From residuals to findings: scales, limits, and what a contract does not promise.

use super::*;
use crate::flow::Arc as Motion;
use crate::scene::Oscillator;

/// The findings after one step.
fn found(scene: &Scene, contract: Contract, step: &Step<'_>) -> Vec<Refuted> {
    let mut judge = judge(scene, contract, 0.0, step.velocity_before[0]);
    judge.observe(step);
    judge.findings().iter().map(|finding| finding.refuted).collect()
}

#[test]
fn the_worst_finding_relative_to_its_limit_comes_first() {
    // Half a gap scale behind the wall, under an extra force of 1 N that moves nothing: residuals ½
    // and 1.
    let scene = under(Wall::upper("stop", 1.0));
    let claim = Claim { extra: vec![1.0], ..Claim::of(1.5, 12.0, 12.0, 1) };
    let order = |walls: f64, balance: f64| {
        let mut contract = rigid(Some(Bound::End), None);
        contract.tolerances.walls.limit = walls;
        contract.tolerances.balance.limit = balance;
        contract.tolerances.impulses.limit = 1e9;
        found(&scene, contract, &claim.step())
    };
    assert_eq!(order(1e-2, 1e-3), [Refuted::MomentumBalance, Refuted::Penetration]);
    assert_eq!(order(1e-3, 0.5), [Refuted::Penetration, Refuted::MomentumBalance]);
    assert_eq!(order(1e-3, 1.0), [Refuted::Penetration]);
}

#[test]
fn a_step_without_any_residual_keeps_every_limit() {
    let mut contract = rigid(Some(Bound::End), Some(Reached::Closed));
    let limits = &mut contract.tolerances;
    for limit in [&mut limits.walls, &mut limits.balance, &mut limits.impulses, &mut limits.energy] {
        limit.limit = 0.0;
    }
    limits.conserves = Conserves::Everything;
    assert_eq!(found(&under(Wall::upper("stop", 1.0)), contract, &Claim::of(0.5, 4.0, 4.0, 1).step()), []);
}

#[test]
fn energy_from_nowhere_is_found_where_the_scheme_promises_to_conserve_it() {
    // From 1 to 2 m/s without a force, far from the wall.
    let claim = Claim::of(1.5 * H, 1.0, 2.0, 1);
    let pad = |damping: f64| under(Wall::upper("pad", 1.0).with_elasticity(8.0, damping));
    let stop = under(Wall::upper("stop", 1.0));
    let promised = |scene: &Scene, conserves: Conserves| {
        let mut contract = contract(Balance::Theta(0.5));
        contract.tolerances.conserves = conserves;
        let accused = found(scene, contract, &claim.step());
        assert!(accused.contains(&Refuted::MomentumBalance), "{accused:?}");
        // A stretch that another scheme stepped promises nothing.
        let path = Path::Handed { contract: &contract, step: H };
        let handed = found(scene, contract, &Step { path, ..claim.step() });
        assert!(handed.contains(&Refuted::MomentumBalance) && !handed.contains(&Refuted::Energy), "{handed:?}");
        accused.contains(&Refuted::Energy)
    };
    use Conserves::{Everything, Nothing, RigidWalls, UndampedWalls};
    for (scene, kept) in [(stop, [false, true, true, true]), (pad(0.0), [false, false, true, true])] {
        assert_eq!([Nothing, RigidWalls, UndampedWalls, Everything].map(|all| promised(&scene, all)), kept);
    }
    let damped = [Nothing, RigidWalls, UndampedWalls, Everything].map(|all| promised(&pad(4.0), all));
    assert_eq!(damped, [false, false, false, true]);
}

#[test]
fn residuals_are_told_with_the_scale_of_what_is_promised() {
    // At rest for 4 s: the scale of speeds is the gap scale over that.
    let scene = under(Wall::upper("stop", 1.0)).with_duration(4.0);
    let scale = |displacement, velocity| {
        let judge = judge(&scene, rigid(displacement, velocity), 0.0, 0.0);
        judge.residuals().gap_scale
    };
    let (bound, law) = (Some(Bound::End), Some(Reached::Closed));
    assert_eq!([scale(bound, None), scale(bound, law), scale(None, law), scale(None, None)], [1.0, 1.0, 0.25, 1.0]);
    // An impulse that a step does not account for, over its length.
    let mut judge = judge(&scene, rigid(None, None), 0.0, 1.0);
    judge.observe(&Claim::of(1.25 * H, 1.0, 1.5, 1).step());
    assert_eq!(judge.residuals().force_balance_n, 0.5 / H);
}

#[test]
fn exact_motion_is_known_to_the_rounding_of_its_instants() {
    let body = Oscillator { mass: 4.0, damping: 0.0, stiffness: 0.0 };
    let arc = Motion::new(body, 0, &Forcing::on(0, &[]));
    let prepared = |start: f64, end: f64| {
        let mut judge = judge(&Scene::oscillator(4.0, 0.0, 0.0), contract(Balance::Exact), 0.0, 0.0);
        judge.load_end = vec![-3.0];
        let claim = Claim { extra: vec![5.0], ..Claim::of(0.0, 0.0, 0.0, 0) };
        judge.prepare(&Step { start, end, path: Path::Exact(&arc), ..claim.step() });
        judge
    };
    let judge = prepared(2.0, 2.5);
    assert_eq!((judge.noise.end, judge.noise.span, judge.noise.clock), (2.5, 0.5, 1.0 + 5.0));
    // An instant lasts an ulp of its time.
    let judge = prepared(4.0, 4.0);
    assert_eq!((judge.noise.span, judge.noise.clock), (4.0 * f64::EPSILON, 1.0 + 1.0 / f64::EPSILON));
    // The load and the extra force together, 8 N, over √m.
    assert_eq!(judge.noise.force_over(1.0), judge.noise.of(8.0 / 2.0));
}
