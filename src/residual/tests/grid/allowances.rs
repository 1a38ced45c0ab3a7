//! What is taken off a residual for rounding, where the residual is so small that this matters:
//! 2⁻²⁰ of terms of the size of one.

use super::*;
use crate::scene::{Row, WallLaw};

const SMALL: f64 = 1.0 / 1_048_576.0;

/// Twice the tolerance of the solvers, relative to the gap scale.
const MET: f64 = 2e-12;

/// Fails unless `found` is `SMALL` less `noise`; the difference is rounded to 2e-22.
#[track_caller]
fn small_less(found: f64, noise: f64) {
    assert!(noise > 1e-13 && (found - (SMALL - noise)).abs() < 1e-21, "{:e}, expected {noise:e}", SMALL - found);
}

#[test]
fn a_gap_is_known_to_the_rounding_of_all_that_it_is_made_of() {
    let wall = Wall::upper("stop", 2.0 - SMALL).at(Row::new(vec![(0, 1.0), (1, -0.5)]));
    let scene = two([[1.0; 2], [0.0; 2], [0.0; 2]]).with_wall(wall);
    let mut judge = Judge::new(&scene, rigid(Some(Bound::End), None), 0.25, &[1.0, -2.0], &[0.0; 2]);
    let claim = Claim {
        q: vec![1.5, -1.0],
        before: vec![2.0, 0.0],
        after: vec![-1.0, 0.0],
        extra: vec![0.0; 2],
        ..Claim::of(0.0, 0.0, 0.0, 1)
    };
    // 3 m √kg of the other degree of freedom, from which the equations find this one.
    judge.noise.state(&[1.5, -1.0], &[0.0, 8.0], 0.25, &judge.weights);
    judge.walls_on_grid(&claim.step(), false);
    // The terms of the displacement at both ends, the wall's place, and the way of a step; that
    // other one, as of the 0.8 kg that the wall feels.
    let size = (1.5 + 0.5) + (1.0 + 1.0) + (2.0 - SMALL) + 0.25 * (2.0 + 1.0) + 3.0 / 0.8f64.sqrt();
    let noise = judge.noise.of(size) + MET * scene.gap_scale();
    small_less(judge.walls.gaps.outside.excess.value, noise);
    // A sum over two degrees of freedom has √2 the rounding of one, 64 ulps.
    assert!((judge.noise.of(1.0) / (64.0 * f64::EPSILON) - 2f64.sqrt()).abs() < 1e-15);
}

#[test]
fn a_speed_of_rebound_is_known_to_the_rounding_of_all_that_it_is_made_of() {
    let wall = Wall::upper("stop", 1.0).at(Row::new(vec![(0, 1.0), (1, -0.5)]));
    let scene = two([[1.0; 2], [0.0; 2], [0.0; 2]]).with_wall(wall).with_load(Load::impulse(1.0, H));
    let mut judge = Judge::new(&scene, rigid(None, Some(Reached::Ahead(0.5))), H, &[0.0; 2], &[0.0; 2]);
    let claim = Claim {
        q: vec![0.0; 2],
        before: vec![2.0, -4.0],
        after: vec![-1.0, 6.0],
        extra: vec![0.0; 2],
        ..Claim::of(0.0, 0.0, 0.0, 1).pushed(-12.0, 0.0)
    };
    judge.blows.struck = vec![16.0, 8.0];
    let noise = judge.noise.velocity(judge.speeds(&claim.step(), 0), H);
    judge.walls.observe_rebound(&judge.noise, 0, (-SMALL, noise), 0.0);
    // The impulse of 12 N s moves the mass that the wall feels, 1/(1 + ¼) kg, by 15 m/s.
    let size = (2.0 + 2.0) + (1.0 + 3.0) + (16.0 + 4.0) + 15.0;
    small_less(judge.walls.rebounds.outside.excess.value, judge.noise.of(size) + MET * scene.gap_scale() / H);
}

#[test]
fn the_law_of_a_spring_is_known_to_its_slope_times_the_rounding_of_the_place() {
    let mut contract = contract(Balance::Theta(0.5));
    contract.promise.elastic = Elastic { force: PromisedForce::Mean, law: Law::Ends(0.5) };
    let scene = |law| under(Wall { law, ..Wall::upper("pad", 1.0) });
    let found = |law, (w0, w1): (f64, f64), pressure: f64, slope: f64| {
        let mut judge = judge(&scene(law), contract, w0, 0.0);
        judge.walls_on_grid(&Claim::of(w1, 2.0, -4.0, 1).pushed(-H * (pressure + SMALL), 0.0).step(), false);
        // The impulse moves the body, of 1 kg, by `H` times as much.
        let size = w0 + w1 + 1.0 + H * (2.0 + 4.0) + H * H * (pressure + SMALL);
        let place = judge.noise.of(size) + MET;
        small_less(judge.walls.law.excess.value, slope * place + judge.noise.wall_force(0));
    };
    // |r|(s) = s(s + 1)(2s + 1)/2 is ¾ N at ½ m and 15/64 N at ¼ m; at ½ m it rises by
    // (6 · ½ · 1½ + 1)/2 N/m, whichever end of the step is the deeper one.
    let quartic = WallLaw::Quartic { epsilon: 2.0, span: 1.0 };
    found(quartic, (1.5, 1.25), 0.5 * (0.75 + 0.234375), 2.75);
    found(quartic, (1.25, 1.5), 0.5 * (0.75 + 0.234375), 2.75);
    // 8 N/m and 4 N s/m: a place that is wrong at one end changes the mean rate, too. The pressure
    // is the mean of 2 and 4 N and 4 N s/m times ¼ m in a step.
    let damped = WallLaw::Elastic { stiffness: 8.0, damping: 4.0 };
    found(damped, (1.25, 1.5), 3.0 + 4.0 * 0.25 / H, 8.0 + 2.0 * 4.0 / H);
    // A wall on the other side, with 1024 N/m times 1.5 and 1.25 m: its impulse moves the body,
    // too.
    let spring = WallLaw::Elastic { stiffness: 8.0, damping: 0.0 };
    let floor = Wall::lower("floor", 2.75).with_elasticity(1024.0, 0.0);
    let mut between = scene(spring).with_wall(floor);
    between.walls.swap(0, 1);
    let mut judge = judge(&between, contract, 1.25, 0.0);
    let mut claim = Claim::of(1.5, 2.0, -4.0, 2).pushed(H * 1408.0, 0.0);
    claim.impulse[1] = -H * (3.0 + SMALL);
    judge.walls_on_grid(&claim.step(), false);
    let size = 1.25 + 1.5 + 1.0 + H * (2.0 + 4.0) + H * H * (3.0 + SMALL + 1408.0);
    let place = judge.noise.of(size) + MET * between.gap_scale();
    small_less(judge.walls.law.excess.value, 8.0 * place + judge.noise.wall_force(1));
}

#[test]
fn what_rounding_explains_is_taken_off_each_residual() {
    let mut judge = judge(&under(Wall::upper("stop", 1.0)), rigid(Some(Bound::End), None), 0.0, 0.0);
    // Nothing has moved yet: a force is exact.
    judge.walls.observe_law(&judge.noise, 0, 1.0, 0.25);
    assert_eq!((judge.walls.law.excess.value, judge.walls.law.excess.wall), (0.75, Some(0)));
    judge.walls.observe_gap(&judge.noise, 0, (-1.0, 0.0), 0.0);
    assert_eq!(judge.walls.gaps.outside.excess.value, 1.0 - MET);
    // A residual of nothing is not doubted, and a small one by what is left of it.
    judge.noise.state(&[3.0], &[5.0], 0.0, &judge.weights);
    let place = 64.0 * f64::EPSILON * 3.0;
    judge.balance.observe(&judge.noise, 0.0, 0.0);
    assert_eq!(judge.balance.path.excess.value, 0.0);
    judge.balance.observe(&judge.noise, 0.0, 1.5 * place);
    assert_eq!(judge.balance.path.excess.value, 0.5 * place);
}
