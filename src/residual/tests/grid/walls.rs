//! False steps at a wall, one by one: what the wall should have done is worked out by hand.

use super::*;

/// The judge after its walls were shown a step, and whether one is closed.
fn shown(mut judge: Judge, claim: &Claim) -> (Judge, bool) {
    judge.noise.span = H;
    judge.walls_on_grid(&claim.step(), false);
    let closed = judge.closes(&claim.step());
    (judge, closed)
}

fn stop(e: f64) -> Scene {
    under(Wall::upper("stop", 1.0).with_restitution(e))
}

#[test]
fn a_wall_far_away_may_not_push() {
    // 2 N, a metre away from the wall: by its impulse, and by its force.
    let promise = |force| {
        let mut contract = rigid(Some(Bound::End), None);
        contract.promise.rigid.force = force;
        contract
    };
    for (force, claim) in [
        (PromisedForce::Mean, Claim::of(0.0, 0.0, 0.0, 1).pushed(-2.0 * H, 0.0)),
        (PromisedForce::End, Claim::of(0.0, 0.0, 0.0, 1).pushed(0.0, -2.0)),
    ] {
        let (judge, _) = shown(judge(&stop(0.5), promise(force), 0.0, 0.0), &claim);
        near(judge.walls.gaps.worst_excess(1.0, 1.0).value, 1.0);
        near(judge.walls.gaps.worst_excess(1.0, 8.0).value, 0.25);
    }
    // A spring that held 4 N at the start of the step and nothing at its end gives the mean of
    // both, not nothing.
    let mut contract = contract(Balance::Theta(0.5));
    contract.promise.elastic.force = PromisedForce::Trapezoid;
    let mut judge = judge(&under(Wall::upper("pad", 1.0).with_elasticity(8.0, 0.0)), contract, 0.0, 0.0);
    judge.walls.last_force = vec![-4.0];
    let (judge, _) = shown(judge, &Claim::of(0.0, 0.0, 0.0, 1));
    assert_eq!((judge.walls.law.value, judge.walls.last_force[0]), (2.0, 0.0));
    near(judge.walls.law.excess.value, 2.0);
}

#[test]
fn a_wall_that_the_step_reaches_halfway_must_answer() {
    let contract = rigid(None, Some(Reached::Ahead(0.5)));
    // At 4 m/s from ¾ m half a step reaches 1 m, though the step ends before. −¾ · 4 m/s was due.
    let (found, _) = shown(judge(&stop(0.75), contract, 0.75, 4.0), &Claim::of(0.875, 4.0, -2.0, 1));
    near(found.walls.rebounds.outside.excess.value, 0.75 * 4.0 - 2.0);
    // From further away it does not.
    let (found, _) = shown(judge(&stop(0.75), contract, 0.625, 4.0), &Claim::of(0.875, 4.0, -2.0, 1));
    assert_eq!(found.walls.rebounds.outside.excess.value, 0.0);
    // It may not push then: 2 N.
    let claim = Claim::of(0.875, 4.0, -2.0, 1).pushed(-2.0 * H, 0.0);
    let (found, _) = shown(judge(&stop(0.75), contract, 0.625, 4.0), &claim);
    near(found.walls.law.excess.value, 2.0);
    // A push that throws the body back too fast, by 1 m/s.
    let claim = Claim::of(0.875, 4.0, -4.0, 1).pushed(-8.0, 0.0);
    let (found, _) = shown(judge(&stop(0.75), contract, 0.75, 4.0), &claim);
    near(found.walls.rebounds.worst_excess(1.0, 1.0).value, 1.0);
}

#[test]
fn a_blow_counts_to_the_velocity_that_arrives() {
    // A blow in the middle of the step, which adds nothing to the displacement of this rule: 1 m/s
    // become 5 m/s, with which half a step reaches the wall from ¾ m. −½ · 5 m/s was due.
    let scene = stop(0.5).with_load(Load::impulse(4.0, 0.5 * H));
    let mut found = judge(&scene, rigid(None, Some(Reached::Ahead(0.5))), 0.75, 1.0);
    found.observe(&Claim::of(0.875, 1.0, 0.0, 1).step());
    near(found.walls.rebounds.outside.excess.value, 0.5 * 5.0);
    // Under the staggered rule a blow of half a step before counts to this step's velocity: back by
    // −8 m/s · h from ¾ m, the body would have been at 1¾ m, which reflects the bound to ⅝ m.
    let mut contract = contract(Balance::Staggered(0.25));
    contract.promise.rigid.displacement = Some(Bound::Reflected);
    let scene = stop(0.5).with_load(Load::impulse(-8.0, 1.75 * H));
    let mut found = judge(&scene, contract, 0.75, 0.0);
    found.observe(&Claim::of(0.875, 0.0, 0.0, 1).at(2).step());
    near(found.walls.gaps.outside.excess.value, 0.875 - 0.625);
    // A blow in the second half of the step adds its −1 m to the displacement of the rule, which
    // is then ½ m behind the wall.
    let scene = stop(0.0).with_load(Load::impulse(-32.0, 2.75 * H));
    let mut found = judge(&scene, contract, 0.0, 0.0);
    found.observe(&Claim::of(0.5, 0.0, 12.0, 1).at(2).step());
    near(found.walls.gaps.outside.excess.value, 0.5);
    assert_eq!(found.balance.path.excess.value, 0.0);
}

#[test]
fn a_body_behind_a_wall_that_does_not_push_is_seen() {
    let (found, _) = shown(judge(&stop(0.5), rigid(Some(Bound::End), None), 0.0, 12.0), &Claim::of(1.5, 12.0, 12.0, 1));
    near(found.walls.gaps.outside.excess.value, 0.5);
    assert_eq!(found.walls.depth, [0.5]);
}

#[test]
fn a_spring_that_pushes_by_its_law_is_not_doubted() {
    // ½ m inside 8 N/m at the step's end.
    let scene = under(Wall::upper("pad", 1.0).with_elasticity(8.0, 0.0));
    let claim = Claim::of(1.5, 2.0, 2.0, 1).pushed(-4.0 * H, -4.0);
    let (found, closed) = shown(judge(&scene, contract(Balance::Theta(0.5)), 1.25, 2.0), &claim);
    assert_eq!((found.walls.law.value, found.walls.law.excess.value, closed), (0.0, 0.0, false));
}

#[test]
fn a_closed_wall_keeps_the_impact_law_unless_rounding_alone_closes_it() {
    let at = |w1: f64, after: f64, p: f64| {
        let start = judge(&stop(0.5), rigid(None, Some(Reached::Closed)), 0.75, 2.0);
        shown(start, &Claim::of(w1, 2.0, after, 1).pushed(p, 0.0))
    };
    // Half the touching distance before the wall, at the wall, and behind it; on at 2 m/s, where
    // −½ · 2 m/s was due.
    for (w1, doubt) in [(1.0 - 5e-13, 0.0), (1.0, 3.0), (1.125, 3.0)] {
        let (found, closed) = at(w1, 2.0, 0.0);
        near(found.walls.rebounds.outside.excess.value, doubt);
        assert!(closed, "{w1}");
    }
    // Near the wall, but not closed.
    let (found, closed) = at(0.875, 2.0, 0.0);
    assert!(!closed && found.walls.rebounds.outside.excess.value == 0.0);
    // One that pushes counts as closed wherever it is: 4 N that throw the body back at 2 instead of
    // 1 m/s.
    let (found, closed) = at(0.5, -2.0, -4.0 * H);
    assert!(closed);
    near(found.walls.rebounds.worst_excess(1.0, 1.0).value, 1.0);
}

#[test]
fn where_rounding_decides_whether_a_wall_is_reached_either_is_accepted() {
    let scene = under(Wall::lower("stop", 0.0)).with_initial(&[1.0], &[0.0]);
    let touch = scene.touching_distance();
    let contract = rigid(None, Some(Reached::Ahead(0.5)));
    // At rest at the touching distance, at a tenth of it, and beyond it: pushed on to −1 m/s.
    for (q, doubt) in [(touch, 0.0), (0.1 * touch, 1.0), (1.5 * touch, 0.0)] {
        let (found, _) = shown(judge(&scene, contract, q, 0.0), &Claim::of(q, 0.0, -1.0, 1));
        near(found.walls.rebounds.outside.excess.value, doubt);
    }
}
