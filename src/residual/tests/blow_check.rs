//! Steps with blows.

use super::*;
use crate::scene::{Load, Wall};
use crate::step::{Bound, Law};

const H: f64 = 0.25;

/// Blows after a quarter of the first step that give 4 and 8 m/s to masses of 4 and 16 kg.
fn blown(scene: Scene) -> Scene {
    let blow = |dof: usize, impulse: f64| Load { at: Row::dof(dof), ..Load::impulse(impulse, 0.0625) };
    scene.with_load(blow(0, 16.0)).with_load(blow(1, 128.0))
}

fn start(scene: &Scene, balance: Balance) -> Judge {
    judge(scene, (balance, Promise::springs(Law::Ends(0.5))), H, &[0.0, 0.0])
}

const THETA: Balance = Balance::Theta(0.5);

/// Under [`THETA`] the blows count as of the middle of the step, and move the masses for as much
/// longer as they come earlier: a sixteenth of a second.
const BY_BLOWS: [f64; 2] = [0.25, 0.5];

#[test]
fn blows_displace_by_their_velocity_from_their_own_instants_on() {
    let scene = blown(body([4.0, 16.0], 0.0));
    // Over t⁺ − θh − t_b; a staggered rule counts a blow of the first half of a step at its start.
    let early = [-0.25, -0.5];
    for (balance, by) in [(THETA, BY_BLOWS), (Balance::Theta(1.0), early), (Balance::Staggered(0.25), early)] {
        let mut judge = start(&scene, balance);
        let made = Made { q: vec![1.0, 3.0], ..Made::rest(&scene, H) };
        assert!(judge.find_beyond(&made.step()));
        assert_eq!(judge.blows.beyond, by, "{balance:?}");
        assert_eq!(judge.blows.arrived, [1.0 - by[0], 3.0 - by[1]], "{balance:?}");
        // The next step has none.
        let later = Made { start: H, end: 2.0 * H, ..made };
        assert!(!judge.find_beyond(&Step { index: 1, ..later.step() }));
        assert_eq!(judge.blows.beyond, [0.0, 0.0]);
    }
}

#[test]
fn an_answered_blow_displaces_or_not_as_the_step_shows_it() {
    let rigid = blown(body([4.0, 16.0], 0.0).with_wall(Wall::upper("wall", 1.0)));
    let mut soft = rigid.clone();
    soft.walls[0] = soft.walls[0].clone().with_elasticity(1.0, 0.0);
    let mut below = rigid.clone();
    below.walls[0] = Wall::lower("wall", -1.0);
    let velocity = [1.0, -2.0];
    // The masses move with the mean velocity, and by these shares of the displacement by blows.
    let moved = |scene: &Scene, impulse: f64, shares: [f64; 2]| {
        let q = [0, 1].map(|i: usize| H * velocity[i] + shares[i] * BY_BLOWS[i]);
        let made = Made {
            q: q.to_vec(),
            before: velocity.map(|v| v - 3.0).to_vec(),
            after: velocity.map(|v| v + 3.0).to_vec(),
            impulse: vec![impulse],
            ..Made::rest(scene, H)
        };
        let mut judge = start(scene, THETA);
        let found = judge.find_beyond(&made.step());
        assert_eq!(judge.blows.beyond, if found { BY_BLOWS } else { [0.0; 2] });
        found
    };
    // Only a rigid wall that the blow drives into and that pushes may answer.
    assert!(!moved(&rigid, -1.0, [0.0; 2]) && moved(&rigid, -1.0, [1.0; 2]));
    assert!(moved(&rigid, 0.0, [0.0; 2]) && moved(&soft, -1.0, [0.0; 2]) && moved(&below, 1.0, [0.0; 2]));
    // Where the step is between both, the nearer one is taken.
    assert!(moved(&rigid, -1.0, [0.0, 1.0]) && !moved(&rigid, -1.0, [1.0, 0.0]));
}

#[test]
fn the_metric_of_the_mass_decides_which_displacement_is_nearer() {
    // By 0.25 m each, of 4 and 64 kg. The first mass shows none of it, the second all.
    let blow = |dof: usize, impulse: f64| Load { at: Row::dof(dof), ..Load::impulse(impulse, 0.0625) };
    let scene = body([4.0, 64.0], 0.0).with_wall(Wall::upper("wall", 1.0));
    let scene = scene.with_load(blow(0, 16.0)).with_load(blow(1, 256.0));
    for (q, beyond) in [([0.0, 0.25], true), ([0.25, 0.0], false)] {
        let mut judge = start(&scene, THETA);
        let made = Made { q: q.to_vec(), impulse: vec![-1.0], ..Made::rest(&scene, H) };
        assert_eq!(judge.find_beyond(&made.step()), beyond, "{q:?}");
    }
}

#[test]
fn a_hole_answers_a_blow_only_with_a_push_against_it() {
    let rigid = blown(with_hole(body([4.0, 16.0], 0.0), "hole", 1.0, RIGID));
    let mut soft = rigid.clone();
    soft.walls[0].law = WallLaw::Elastic { stiffness: 1.0, damping: 0.0 };
    // The blows give (4, 8) m/s; no displacement by them is shown.
    for (scene, normal, impulse, beyond) in [
        (&rigid, [1.0, 0.0], 1.0, false),
        (&rigid, [-1.0, 0.0], 1.0, true),
        (&rigid, [1.0, 0.0], 0.0, true),
        (&soft, [1.0, 0.0], 1.0, true),
        // 0.8 · 4 − 0.6 · 8 < 0: away from the blow; 0.96 · 4 − 0.28 · 8 > 0.
        (&rigid, [0.8, -0.6], 1.0, true),
        (&rigid, [0.96, -0.28], 1.0, false),
        (&rigid, [-0.8, 0.6], 1.0, false),
        (&rigid, [-0.96, 0.28], 1.0, true),
    ] {
        let mut judge = start(scene, THETA);
        let made = Made::rest(scene, H).pushing(0, normal, impulse);
        assert_eq!(judge.find_beyond(&made.step()), beyond, "{normal:?}, {impulse}");
    }
    // A bound on the displacement includes that by blows.
    let promise = Promise { hole: Some(Bound::End), ..Promise::springs(Law::Ends(0.5)) };
    let mut bound = judge(&rigid, (THETA, promise), H, &[0.0, 0.0]);
    let made = Made::rest(&rigid, H).pushing(0, [1.0, 0.0], 1.0);
    assert!(bound.find_beyond(&made.step()));
}

#[test]
fn dampers_take_from_the_balance_and_the_ledger_what_they_feel_of_the_blows() {
    let scene = blown(body([4.0, 64.0], 6.0));
    let mut judge = start(&scene, THETA);
    let made = Made { q: vec![0.25, 0.125], before: vec![2.0, 4.0], after: vec![1.0, -1.0], ..Made::rest(&scene, H) };
    assert!(judge.find_beyond(&made.step()));
    judge.feel_blows(&made.step(), true);
    // 6 N s/m over 0.25 and 0.125 m, at mean velocities of 1.5 m/s.
    assert_eq!(judge.scratch.residual, [1.5, 0.75]);
    assert_eq!(judge.blows.impulse, [-1.5, -0.75]);
    let energy = judge.energy.report();
    assert_eq!((energy.load_work_j, energy.damping_j, energy.exchanged_j), (3.375, 3.375, 3.375));
    // 1.5 N s/(0.25 s · 2 √kg); the other is smaller.
    assert_eq!(judge.balance.scale, 3.0);
}

#[test]
fn what_dampers_feel_is_left_out_only_where_it_may_be_and_the_balance_is_nearer_without() {
    let scene = blown(body([4.0, 64.0], 1.0));
    let made = Made::rest(&scene, H);
    // A residual before, and what is left of it, where the dampers feel 1 N s each.
    for (either, before, after) in [
        (true, [0.25, 0.25], [0.25, 0.25]),
        (false, [0.25, 0.25], [1.25, 1.25]),
        (true, [-1.0, -1.0], [0.0, 0.0]),
        // Over 2 and 8 √kg the first weighs more.
        (true, [-1.0, 0.5], [0.0, 1.5]),
        (true, [0.5, -1.0], [0.5, -1.0]),
    ] {
        let mut judge = start(&scene, THETA);
        judge.scratch.residual.copy_from_slice(&before);
        judge.blows.felt.copy_from_slice(&[1.0, 1.0]);
        judge.take_felt(either, &made.step());
        assert_eq!(judge.scratch.residual, after, "{before:?}, {either}");
    }
}
