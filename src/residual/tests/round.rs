//! Round holes with an impact law on the velocity.

use super::*;
use crate::scene::Load;
use crate::step::{Law, Normal, Turning};

/// The law of a hole that is touched within this share of its gap, with arcs of one height.
fn law(touching: f64, arc: f64) -> (Balance, Promise) {
    let round = Turning { normal: Normal::Ahead(0.5), touching, sagitta: arc, deepest: arc };
    (Balance::Theta(0.5), Promise { round: Some(round), ..Promise::springs(Law::Ends(0.5)) })
}

#[test]
fn a_speed_beyond_the_bound_and_a_push_beside_the_normal_count_less_the_rounding_of_all_terms() {
    let (h, gap, n) = (64.0, 8.0, [0.6, 0.8]);
    let mut scene = with_hole(body([4.0; 2], 0.0), "hole", gap, RIGID);
    scene.walls[0] = scene.walls[0].clone().with_centre([2.0, -1.5]);
    let scene = scene.with_load(Load::impulse(1.0, h));
    // 40 m from the centre, and with the blow of the step at 1 m/s on the way back.
    let mut judge = judge(&scene, law(1e-6, 0.0), h, &[26.0, 30.5]);
    judge.blows.struck.copy_from_slice(&[0.3, 0.4]);
    judge.noise.load(50.0);
    // A step that leaves the hole at more than 1 m/s, pushed by 2 N beside the normal.
    let (fast, turn) = (1e-9, 1e-9);
    let made = Made {
        q: vec![9.2, 8.1],
        before: vec![-0.9, -1.2],
        after: n.map(|n| n * (1.0 + fast)).to_vec(),
        ..Made::rest(&scene, h)
    };
    let made = made.pushing(0, [0.6 - 0.8 * turn, 0.8 + 0.6 * turn], 2.0 * h);
    judge.supports_on_grid(Scalar, &made.step(), false);
    // Places 56.5 and 17.3 m, centre 3.5 m, gap 8 m, and the way at 2.1 + 1.4 + 0.7 m/s.
    let speeds = 4.2;
    let place = judge.noise.of(56.5 + 17.3 + 3.5 + gap + h * speeds);
    let noise = judge.noise.velocity(speeds, h) + place / gap * speeds;
    assert_less(judge.walls.rebounds.outside.excess.value, fast, noise);
    let askew = judge.supports.as_ref().expect("a hole").askew.excess.value;
    assert_less(askew, 2.0 * turn, 2.0 * place / gap + judge.noise.wall_force(0));
    // It pushes, and does not pull.
    assert_eq!(judge.walls.tension, 0.0);
}

#[test]
fn a_hole_may_push_from_where_it_is_touched_on_and_at_the_edge_of_that() {
    let (touching, gap) = (1.0 / 16.0, 0.5);
    let scene = with_hole(body([4.0; 2], 0.0), "hole", gap, RIGID);
    // Shares of the touching distance by which the body at rest is inside the circle.
    for (share, allowed) in [(0.5, true), (1.5, true), (2.5, false), (9.0, false)] {
        let at = vec![gap * (1.0 - share * touching), 0.0];
        let mut judge = judge(&scene, law(touching, touching), 1.0, &at);
        let made = Made { q: at, ..Made::rest(&scene, 1.0) }.pushing(0, [1.0, 0.0], 3.0);
        judge.supports_on_grid(Scalar, &made.step(), false);
        assert_eq!(judge.walls.law.value, if allowed { 0.0 } else { 3.0 }, "{share}");
    }
}

#[test]
fn rounding_may_decide_whether_a_body_touched_at_the_start_and_nothing_else() {
    // The brim is at 15/16 m. The body passes along it at 0.5 m/s, and where the normal is taken
    // that is an approach at a: by turning alone if it touched, else an arrival.
    let (touching, gap, e) = (1.0 / 16.0, 1.0, 0.5);
    let scene = with_hole(body([4.0; 2], 0.0), "hole", gap, RIGID);
    let missed = |beside: f64, answer: f64| {
        let start = [0.9375 + beside, 0.0];
        let ahead = [start[0], 0.25];
        let n = ahead.map(|x| x / ahead[0].hypot(ahead[1]));
        let a = 0.5 * n[1];
        let mut judge = judge(&scene, law(touching, touching), 1.0, &start);
        let made = Made {
            q: vec![start[0], 0.5],
            before: vec![0.0, 0.5],
            after: n.map(|n| -answer * a * n).to_vec(),
            ..Made::rest(&scene, 1.0)
        };
        judge.supports_on_grid(Scalar, &made.pushing(0, n, 1.0).step(), false);
        judge.walls.rebounds.worst(1.0, 1.0) / a
    };
    // Within the rounding of a place, some 1e-13 m, both answers are right.
    for beside in [-1e-15, 0.0, 1e-15] {
        for answer in [1.0, e] {
            assert!(missed(beside, answer) < 1e-12, "{beside}, {answer}");
        }
    }
    for (beside, right, wrong) in [(1e-3, 1.0, e), (-1e-3, e, 1.0)] {
        assert!(missed(beside, right) < 1e-12, "{beside}");
        assert!((missed(beside, wrong) - (1.0 - e)).abs() < 1e-12, "{beside}");
    }
}

#[test]
fn the_hole_that_pushes_askew_is_named() {
    let scene = body([4.0; 2], 0.0).with_wall(crate::scene::Wall::upper("wall", 1.0));
    let scene = with_hole(with_hole(scene, "first", 0.5, RIGID), "second", 0.5, RIGID);
    let mut judge = judge(&scene, law(1e-6, 0.0), 1.0, &[0.5, 0.0]);
    let made = Made { q: vec![0.5, 0.0], ..Made::rest(&scene, 1.0) };
    let made = made.pushing(1, [1.0, 0.0], 1.0).pushing(2, [0.8, 0.6], 1.0);
    judge.supports_on_grid(Scalar, &made.step(), false);
    let found = judge.supports.as_ref().expect("holes").askew.excess;
    assert_eq!(found.wall.and_then(|place| scene.wall_name(place)), Some("second"));
}

#[test]
fn a_hole_is_passed_over_only_where_the_step_is_certainly_inside_of_it_and_no_faster_than_before() {
    let (gap, h, far) = (0.5, 1.0, 1e6);
    let scene = with_hole(body([4.0; 2], 0.0), "hole", gap, RIGID);
    // At this start, before a step whose end and velocities are these; `noted` is the largest
    // place so far, m, of which rounding is a share.
    let passed = |start: f64, end: f64, before: f64, after: f64, noted: f64| {
        let mut judge = judge(&scene, law(1e-12, 0.0), h, &[start, 0.0]);
        judge.noise.state(&[noted, 0.0], &[0.0; 2], h, &judge.weights);
        (judge.sums.steps, judge.extent.speed) = (1, 0.25);
        let made =
            Made { q: vec![end, 0.0], before: vec![before, 0.0], after: vec![after, 0.0], ..Made::rest(&scene, h) };
        let places = judge.places.as_ref().expect("a hole");
        let hole = scene.holes().next().expect("a hole");
        let passed = |step: &Step<'_>| judge.is_out_of_reach(Scalar, step, &hole, &places.holes[0]);
        assert!(!passed(&made.clone().pushing(0, [1.0, 0.0], 1e-300).step()));
        passed(&made.step())
    };
    let at = |share: f64| gap * (1.0 - share);
    assert!(passed(0.0, 0.0, 0.0, 0.0, 0.0) && passed(at(0.1), -at(0.1), 0.0, 0.0, 0.0));
    // Near the circle at either end, or where the normal is taken, half a step on.
    for (share, inside) in [(1e-6, true), (1e-11, false), (0.0, false), (-1e-3, false)] {
        assert_eq!(passed(0.0, at(share), 0.0, 0.0, 0.0), inside, "{share}");
        assert_eq!(passed(-at(share), 0.0, 0.0, 0.0, 0.0), inside, "{share}");
        assert_eq!(passed(0.25, 0.0, 2.0 * (at(share) - 0.25), 0.0, 0.0), inside, "{share}");
        assert!(!passed(0.0, at(share), 0.0, 0.0, far), "{share}");
    }
    // A place that is faster than any before has to be noted.
    assert!(passed(0.0, 0.0, 0.0, 0.24, 0.0) && !passed(0.0, 0.0, 0.0, 0.26, 0.0));
    // What is no number is not certain.
    assert!(!passed(0.0, f64::NAN, 0.0, 0.0, 0.0) && !passed(0.0, 0.0, f64::NAN, 0.0, 0.0));
}
