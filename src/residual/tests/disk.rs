//! Round holes under a bound on the displacement at the end of a step.

use super::*;
use crate::residual::place::Place;
use crate::scene::Face;
use crate::step::{Bound, Law, Normal, Turning};

/// The bound alone, and with an impact law on holes that are touched within this share of the gap.
fn bounds(touching: Option<f64>) -> (Balance, Promise) {
    let turning = |touching| Turning { normal: Normal::Middle(0.5), touching, sagitta: 0.0, deepest: 0.0 };
    let promise = Promise { hole: Some(Bound::End), round: touching.map(turning), ..Promise::springs(Law::Ends(0.5)) };
    (Balance::Theta(1.0), promise)
}

#[test]
fn the_size_of_a_way_is_that_of_all_its_terms() {
    let mut scene = with_hole(body([4.0; 2], 0.0), "hole", 8.0, RIGID);
    let at = PlaneRows { y: Row::new(vec![(0, -2.0), (1, 0.5)]), z: Row::dof(1) };
    scene.walls[0].face = Face::Round { at, centre: [1.0, -5.0], gap: 8.0 };
    let judge = judge(&scene, bounds(None), 0.5, &[1.0, -4.0]);
    let made = Made { q: vec![-3.0, 2.0], before: vec![10.0, -2.0], after: vec![0.5, 4.0], ..Made::rest(&scene, 0.5) };
    // Of places 2 + 2 + 4 and 6 + 1 + 2 m, centre 6 m, gap 8 m, and half a second at 20 + 1 + 2 and
    // 1 + 2 + 4 m/s.
    let hole = scene.holes().next().expect("a hole");
    let size = judge.way(&hole, &judge.hole_motion(&made.step(), &hole, &Place::new(hole.at, &[2.0; 2])));
    assert_eq!(size, 8.0 + 9.0 + 6.0 + 8.0 + 0.5 * (23.0 + 7.0));
}

#[test]
fn a_body_outside_the_circle_is_accused_with_and_without_a_push() {
    let scene = with_hole(body([4.0; 2], 0.0), "hole", 0.5, RIGID);
    for impulse in [0.0, 0.25] {
        let mut judge = judge(&scene, bounds(None), 0.25, &[0.0, 0.0]);
        let (depth, speed) = (1e-9, 1e3);
        let r = 0.5 + depth;
        let made = Made { q: vec![0.6 * r, 0.8 * r], before: vec![speed, 0.0], ..Made::rest(&scene, 0.25) };
        let made = made.pushing(0, [0.6, 0.8], impulse);
        judge.supports_on_grid(Scalar, &made.step(), false);
        assert!((judge.walls.gaps.worst(1.0, 1.0) - depth).abs() < 1e-15, "{impulse}");
        // Place 0.7 m, gap 0.5 m and a quarter of a second at 1000 m/s.
        assert_less(judge.walls.gaps.outside.excess.value, depth, judge.noise.place(0.7 + 0.5 + 250.0));
    }
}

#[test]
fn a_push_beside_the_place_at_the_end_counts_less_the_rounding_of_place_and_force() {
    let scene = with_hole(body([4.0; 2], 0.0), "hole", 4.0, RIGID);
    let (h, turn, speed) = (0.25, 1e-6, 1e7);
    let mut judge = judge(&scene, bounds(None), h, &[0.0, 0.0]);
    judge.noise.load(1e6);
    let normal = [0.6 - 0.8 * turn, 0.8 + 0.6 * turn];
    let made = Made { q: vec![2.4, 3.2], before: vec![speed, 0.0], ..Made::rest(&scene, h) }.pushing(0, normal, 0.75);
    judge.supports_on_grid(Scalar, &made.step(), false);
    // 3 N at 4 m from the centre.
    let way = judge.noise.of(5.6 + 4.0 + h * speed);
    let noise = 3.0 * way / 4.0 + judge.noise.wall_force(0);
    assert_less(judge.supports.as_ref().expect("a hole").askew.excess.value, 3.0 * turn, noise);
}

#[test]
fn a_hole_is_closed_within_the_tolerance_of_gaps_or_where_it_pushes() {
    // A millionth of the gap.
    let tolerance = 0.5e-6;
    let scene = with_hole(body([4.0; 2], 0.0), "hole", 0.5, RIGID);
    let closes = |gap: f64, impulse: f64| {
        let made = Made { q: vec![0.0, gap - 0.5], ..Made::rest(&scene, 0.25) };
        judge(&scene, bounds(Some(1e-12)), 0.25, &[0.0, 0.0]).closes(&made.pushing(0, [0.0; 2], impulse).step())
    };
    assert!(closes(0.0, 0.0) && closes(-tolerance, 0.0) && closes(0.9 * tolerance, 0.0) && closes(0.25, 0.125));
    assert!(!closes(1.1 * tolerance, 0.0) && !closes(0.5, 0.0));
}

#[test]
fn a_blow_drives_into_a_hole_if_its_velocity_points_outwards() {
    let scene = with_hole(body([4.0; 2], 0.0), "hole", 5.0, RIGID);
    for (at, given, drives) in [
        ([3.0, 4.0], [1.0, 0.0], true),
        ([3.0, 4.0], [-1.0, 0.0], false),
        // Along the brim, a little outwards, and a little inwards: 3 · 4 − 4 · 3 = 0.
        ([3.0, 4.0], [4.0, -3.0], false),
        ([3.0, 4.0], [4.0, -2.75], true),
        ([3.0, 4.0], [4.0, -3.25], false),
        ([-3.0, 4.0], [-8.0, -5.0], true),
        ([3.0, -4.0], [5.0, 4.0], false),
    ] {
        let made = Made { q: at.to_vec(), ..Made::rest(&scene, 0.25) };
        let mut judge = judge(&scene, bounds(None), 0.25, &at);
        judge.blows.struck.copy_from_slice(&given);
        assert_eq!(judge.drives_into_hole(&made.step()), drives, "{at:?}, {given:?}");
    }
}
