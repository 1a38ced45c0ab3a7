//! Round holes along a structure's exact motion.

use super::stretch::start;
use super::*;
use crate::flow::{HeldRow, HeldRows, Series, SeriesBody, SeriesStart};
use crate::scene::Wall;
use std::iter::{empty, once};

/// The body slides at 2 m/s round 8 m from the direction (0.6, 0.8) on: pressed by 2 N.
const GAP: f64 = 8.0;
const PUSH: f64 = 2.0;
const TIME: f64 = 64.0;
const SPAN: f64 = 0.125;

fn scene(gap: f64, centre: [f64; 2]) -> Scene {
    let mut scene = with_hole(body([4.0; 2], 0.0), "hole", gap, RIGID);
    scene.walls[0] = scene.walls[0].clone().with_centre(centre);
    scene
}

const CENTRE: [f64; 2] = [1.0, -3.0];
const PLACE: [f64; 2] = [4.8 + 1.0, 6.4 - 3.0];
const SPEED: [f64; 2] = [-1.6, 1.2];

/// That motion, and the step that it makes.
fn sliding() -> (Series, Made) {
    let scene = scene(GAP, CENTRE);
    let mut body = SeriesBody::new(&scene).expect("a mass");
    body.turn(0, [0.6, 0.8]);
    let mut series = Series::new(&body);
    let mut hold = HeldRows::with_room(1);
    hold.set(&body, once(HeldRow { row: 0, sign: -1.0, position: GAP + 0.6 - 0.8 * 3.0 }), empty());
    let from =
        SeriesStart { time: TIME, q: &PLACE, v: &SPEED, extra: &[0.0; 2], until: TIME + SPAN, reach: f64::INFINITY };
    series.begin(&mut body, &from, &[], &hold, once((0, 0, 1.0)), &mut [0.0; 4]);
    let mut made = Made { start: TIME, end: TIME + SPAN, before: SPEED.to_vec(), ..Made::rest(&scene, SPAN) };
    series.state(made.end, &mut made.q, &mut made.after);
    let normal = [(made.q[0] - CENTRE[0]) / GAP, (made.q[1] - CENTRE[1]) / GAP];
    // All that it gives: along the mean normal, of an arc of SPEED · SPAN/GAP = 1/32 rad.
    let given = series.hole_impulse(0, TIME, made.end);
    let impulse = PUSH * SPAN;
    let turned = [0, 1].map(|axis: usize| given[axis] + impulse * normal[axis]);
    made.turned[0] = turned;
    (series, made.pushing(0, normal, impulse))
}

fn judged(scene: &Scene, series: &Series, made: &Made) -> Judge {
    let mut judge = start(scene, (&PLACE, &SPEED));
    judge.observe(&made.along(Path::Series(series)));
    judge
}

/// The terms of a place: rows of 9.2 m, the centre 4 m away, the gap, and the time since the start
/// at 2.79 m/s. Over the stretch all of that changes by a few parts in a thousand.
const SIZE: f64 = 9.2 + 4.0 + GAP + 2.79 * (TIME + 0.5 * SPAN);

#[test]
fn a_hole_of_another_size_or_place_counts_less_the_rounding_of_all_terms() {
    let (series, made) = sliding();
    let right = judged(&scene(GAP, CENTRE), &series, &made);
    assert_eq!(right.findings(), []);
    assert!(
        (right.walls.force_scale - PUSH).abs() < 1e-12 && right.walls.tension == 0.0,
        "{}",
        right.walls.force_scale
    );
    // By what exceeds rounding, which is 2e-11 m.
    let other = 1e-10;
    let small = judged(&scene(GAP - other, CENTRE), &series, &made);
    let noise = small.noise.place(SIZE);
    let found = small.walls.gaps.outside.excess.value;
    assert!((found - (other - noise)).abs() < 3e-3 * noise, "{found:e}, {noise:e}");
    let wide = judged(&scene(GAP + other, CENTRE), &series, &made);
    let both = |gap: f64, force: f64| wide.walls.gaps.worst_excess(gap, force).value;
    assert!((both(1.0, 1e-30) - (other - noise)).abs() < 3e-3 * noise, "{:e}", both(1.0, 1e-30));
    assert!((both(1e-30, 1.0) - PUSH).abs() < 1e-9, "{:e}", both(1e-30, 1.0));
    // A force beside the normal: where the centre lies elsewhere along the brim, in the middle of
    // the stretch.
    let [c, s] = [0.6 - 0.8 / 64.0, 0.8 + 0.6 / 64.0];
    let shifted = [CENTRE[0] - s * 1e-9, CENTRE[1] + c * 1e-9];
    let askew = judged(&scene(GAP, shifted), &series, &made);
    let doubt = askew.supports.as_ref().expect("a hole").askew.excess.value;
    let place = askew.noise.of(SIZE) * PUSH / GAP;
    let force = askew.noise.wall_force(0);
    let expected = PUSH * 1e-9 / GAP - place - force;
    // The force's own noise, which grows during the stretch, is some times larger.
    assert!((doubt - expected).abs() < 0.2 * place, "{doubt:e}, {expected:e}, {place:e}, {force:e}");
}

#[test]
fn a_body_that_flies_out_of_a_hole_is_accused_without_a_push() {
    // The same motion without its hole: the judge's body leaves it by (v t)²/2γ.
    let (_, mut made) = sliding();
    let free = scene(99.0, CENTRE);
    let mut body = SeriesBody::new(&free).expect("a mass");
    let mut series = Series::new(&body);
    let from =
        SeriesStart { time: TIME, q: &PLACE, v: &SPEED, extra: &[0.0; 2], until: TIME + SPAN, reach: f64::INFINITY };
    series.begin(&mut body, &from, &[], &HeldRows::with_room(1), empty(), &mut [0.0; 4]);
    series.state(made.end, &mut made.q, &mut made.after);
    made.turned[0] = [0.0; 2];
    let made = made.pushing(0, [0.0; 2], 0.0);
    let judge = judged(&scene(GAP, CENTRE), &series, &made);
    let out = (2.0 * SPAN * 0.98_f64).powi(2) / (2.0 * GAP);
    let found = judge.walls.gaps.outside.excess.value;
    assert!((found / out - 1.0).abs() < 0.01, "{found:e}, {out:e}");
}

#[test]
fn a_body_at_rest_in_the_centre_of_a_hole_is_not_accused() {
    let scene = scene(GAP, [0.0; 2]);
    let mut body = SeriesBody::new(&scene).expect("a mass");
    let mut series = Series::new(&body);
    let from =
        SeriesStart { time: 0.0, q: &[0.0; 2], v: &[0.0; 2], extra: &[0.0; 2], until: SPAN, reach: f64::INFINITY };
    series.begin(&mut body, &from, &[], &HeldRows::with_room(1), empty(), &mut [0.0; 4]);
    let mut judge = start(&scene, (&[], &[]));
    judge.observe(&Made::rest(&scene, SPAN).along(Path::Series(&series)));
    assert_eq!((judge.findings(), judge.residuals().complementarity), (Vec::new(), 0.0));
}

#[test]
fn an_impulse_that_the_force_does_not_give_counts_less_its_rounding() {
    let (series, made) = sliding();
    let impulse = PUSH * SPAN;
    let told = |by: f64| {
        let mut other = made.clone();
        other.turned[0][0] += by;
        judged(&scene(GAP, CENTRE), &series, &other)
    };
    // 32 units of the impulse, of which the sums need some.
    let unit = f64::EPSILON * impulse;
    let askew = told(96.0 * unit).supports.as_ref().expect("a hole").askew.value * SPAN;
    assert!((askew - 64.0 * unit).abs() < 8.0 * unit, "{} units", askew / unit);
    let judge = told(1e-9);
    let doubt = judge.supports.as_ref().expect("a hole").askew.excess.value;
    let force = judge.noise.wall_force(0);
    let expected = (1e-9 - 32.0 * unit) / SPAN - force;
    assert!((doubt - expected).abs() < 0.01 * force, "{doubt:e}, {expected:e}, {force:e}");
}

/// A step that ends with an impulse of 1 N s of each of these holes where the body is at `q`, from
/// the velocity `before` to `after`; the judge has seen a speed of 100 m/s before.
fn strike(scene: &Scene, end: f64, q: [f64; 2], (before, after): ([f64; 2], [f64; 2])) -> Judge {
    let mut judge = start(scene, (&[], &[]));
    judge.series.mid.copy_from_slice(&before);
    judge.extent.speed = 100.0;
    judge.noise.span = SPAN;
    let made = Made { start: end - SPAN, end, q: q.to_vec(), after: after.to_vec(), ..Made::rest(scene, SPAN) };
    let holes = 0..scene.holes().count();
    let mut made = holes.clone().fold(made, |made, hole| made.pushing(hole, [0.6, 0.8], 1.0));
    made.jump[holes].fill(1.0);
    judge.strike_holes(&made.step());
    judge
}

fn struck(judge: &Judge) -> (f64, f64) {
    judge.supports.as_ref().map_or((0.0, 0.0), |supports| (supports.struck.value, supports.struck.excess.value))
}

#[test]
fn an_impact_keeps_newtons_law_beside_an_idle_wall_and_a_slow_one_may_be_the_last_of_many() {
    let scene = scene(5.0, [0.0; 2]).with_wall(Wall::upper("idle", 9.0));
    // Along (0.6, 0.8): the speeds before and after, and by how much the law is missed.
    for (before, after, missed) in [
        (4.0, -2.0, 0.0),
        (4.0, -1.0, 1.0),
        (4.0, -2.5, 0.5),
        (4.0, 0.5, 2.5),
        // Rebounds below 1e-4 of 100 m/s: anywhere between −e of the approach and 0.
        (0.0078125, -0.00390625, 0.0),
        (0.0078125, -0.001953125, 0.0),
        (0.0078125, 0.0, 0.0),
        (0.0078125, -0.0048828125, 0.0009765625),
        (0.0078125, 0.0009765625, 0.0048828125),
        (0.015625, -0.001953125, 0.0),
        // And not above.
        (0.03125, -0.001953125, 0.013671875),
    ] {
        let along = |v: f64| [0.6 * v, 0.8 * v];
        let judge = strike(&scene, 1.0, [3.0, 4.0], (along(before), along(after)));
        let (found, doubt) = struck(&judge);
        // Rounding of metres per second; 1e-12 of 5 m in a millisecond is allowed.
        assert!((found - missed).abs() < 4e-15 && (doubt - missed).abs() < 2e-8, "{before} {after}: {found} {doubt}");
        assert_eq!((judge.walls.tension, judge.walls.gaps.worst(1.0, 1.0)), (0.0, 0.0));
    }
}

#[test]
fn an_impact_off_the_circle_or_the_law_counts_less_the_rounding_of_all_terms() {
    // At 5 m and a little more from a centre elsewhere, in a run of an hour.
    let scene = scene(5.0, [1.0, -3.0]).with_duration(4096.0);
    let (end, more) = (2.0, 1e-7);
    let (r, before, after) = (5.0 + more, [0.6 * 4.0, 0.8 * 4.0], [0.6 * -2.0, 0.8 * -2.0]);
    let judge = strike(&scene, end, [0.6 * r + 1.0, 0.8 * r - 3.0], (before, after));
    // Places of 4 + 1 m, centre 4 m, gap 5 m, and the time at 5.6 + 2.8 m/s.
    let noise = judge.noise.place(4.0 + 1.0 + 4.0 + 5.0 + 8.4 * end);
    assert_less(judge.walls.gaps.outside.excess.value, more, noise);
    // The speed after is 1e-7 m/s too large.
    let after = after.map(|v| v * (1.0 + 1e-7));
    let judge = strike(&scene, end, [4.0, 1.0], (before, after));
    let speeds = judge.noise.velocity(8.4, 4.096) + noise / 5.0 * 8.4;
    let (found, doubt) = struck(&judge);
    assert!((found - 2e-7).abs() < 1e-14, "{found:e}");
    assert_less(doubt, 2e-7, speeds);
    // The normal told is turned by 1e-8: of that share of the speeds.
    let turned = strike(&scene, end, [4.0 - 4e-8, 1.0 + 3e-8], (before, after.map(|v| v / (1.0 + 1e-7))));
    let (found, doubt) = struck(&turned);
    assert!(found < 1e-7, "{found:e}");
    assert!((doubt - (8.4e-8 - speeds)).abs() < 2e-3 * speeds, "{doubt:e}, {speeds:e}");
}

#[test]
fn the_hole_that_is_struck_against_its_law_is_named() {
    let scene = with_hole(scene(5.0, [0.0; 2]), "other", 5.0, RIGID).with_wall(Wall::upper("idle", 9.0));
    let mut judge = start(&scene, (&[], &[]));
    judge.series.mid.copy_from_slice(&[3.0, 0.0]);
    let made =
        Made { q: vec![5.0, 0.0], after: vec![-1.5, 0.0], jump: vec![0.0, 1.0, 0.0], ..Made::rest(&scene, SPAN) };
    judge.strike_holes(&made.pushing(1, [0.8, 0.6], 1.0).step());
    let found = judge.supports.as_ref().expect("holes").struck.excess;
    assert_eq!(found.wall.and_then(|place| scene.wall_name(place)), Some("other"));
}
