//! The exact motion of a structure over a stretch.

use super::*;
use crate::flow::{HeldRow, HeldRows, Series, SeriesBody, SeriesStart, Touching};
use crate::scene::{Load, Wall};
use std::iter::{empty, once};

/// The node of Gauss's rule of eight points that is nearest to the end of [−1, 1].
const LAST: f64 = 0.960_289_856_497_536_2;

pub(super) fn start(scene: &Scene, (q, v): (&[f64], &[f64])) -> Judge {
    let tolerances = Tolerances::of(Conserves::Everything);
    let (balance, promise) = (Balance::Exact, Promise::throughout());
    Judge::new(scene, Contract { balance, promise, instant: 1.0, tolerances, divides: false }, 1.0, q, v)
}

/// The exact motion of `scene` from a time and state on over `span` seconds, and the step that it
/// makes. Wall 0 touches as an elastic one with this stiffness (N/m) and position (m), or holds.
fn stretch(scene: &Scene, (time, q, v): (f64, &[f64], &[f64]), span: f64, wall: Option<(f64, f64)>) -> (Series, Made) {
    let mut body = SeriesBody::new(scene).expect("a mass");
    let mut series = Series::new(&body);
    let mut hold = HeldRows::with_room(1);
    let extra = vec![0.0; q.len()];
    let from = SeriesStart { time, q, v, extra: &extra, until: time + span, reach: f64::INFINITY };
    let mut work = vec![0.0; 4];
    match wall {
        Some((stiffness, position)) if stiffness > 0.0 => {
            let touching = [Touching { wall: 0, row: 0, position, stiffness, damping: 0.0 }];
            series.begin(&mut body, &from, &touching, &hold, empty(), &mut work);
        }
        Some((_, position)) => {
            hold.set(&body, once(HeldRow { row: 0, sign: -1.0, position }), empty());
            series.begin(&mut body, &from, &[], &hold, once((0, 0, 1.0)), &mut work);
        }
        None => series.begin(&mut body, &from, &[], &hold, empty(), &mut work),
    }
    assert!((series.end() - (time + span)).abs() <= f64::EPSILON * time, "a shorter stretch");
    let mut made = Made { start: time, end: series.end(), before: v.to_vec(), ..Made::rest(scene, span) };
    series.state(series.end(), &mut made.q, &mut made.after);
    made.force = (0..scene.walls.len()).map(|wall| series.contact_force(wall, series.end())).collect();
    (series, made)
}

#[test]
fn the_largest_speed_is_that_within_the_stretch_and_after_its_blows_in_the_metric_of_the_mass() {
    // 16 kg at 1 rad/s, from 0.8 rad before its largest speed to 0.8 rad after; and 4 kg at rest.
    let diagonal = |x: [f64; 2]| Symmetric::diagonal(&x);
    let (mass, damping) = (diagonal([16.0, 4.0]), diagonal([0.0; 2]));
    let scene = Scene::structure(Structure { mass, damping, stiffness: diagonal([16.0, 0.0]) });
    let (sin, cos) = 0.8_f64.sin_cos();
    let state = (&[-sin, 0.0][..], &[cos, 0.0][..]);
    let (series, made) = stretch(&scene, (0.0, state.0, state.1), 1.6, None);
    let mut judge = start(&scene, state);
    judge.observe(&made.along(Path::Series(&series)));
    // The rule has an instant within 0.12 rad of the middle.
    let speed = judge.normal_speed / 4.0;
    assert!((0.98..1.0 + 1e-12).contains(&speed), "{speed}");
    // A blow at the end of half a second: from rest to 4 m/s.
    let scene = body([4.0, 16.0], 0.0).with_load(Load::impulse(16.0, 0.5));
    let (series, mut made) = stretch(&scene, (0.0, &[0.0; 2], &[0.0; 2]), 0.5, None);
    made.after = vec![4.0, 0.0];
    let mut judge = start(&scene, (&[], &[]));
    judge.observe(&made.along(Path::Series(&series)));
    let energy = judge.energy.report();
    assert_eq!((judge.normal_speed, energy.load_work_j, energy.final_j), (8.0, 32.0, 32.0));
    assert_eq!((energy.exchanged_j, energy.residual_j), (64.0, 0.0));
}

#[test]
fn a_structure_behind_a_rigid_wall_counts_less_the_rounding_of_all_terms() {
    // The difference of two places, kilometres away, passes 4000 m long after the start. A wall
    // 10 m below makes the gap scale small.
    let scene = |position: f64| {
        let at = Row::new(vec![(0, 2.0), (1, -1.0)]);
        let upper = Wall::upper("wall", position).at(at.clone());
        body([4.0, 16.0], 0.0).with_wall(upper).with_wall(Wall::lower("below", 3990.0).at(at))
    };
    let (time, span) = (4096.0, f64::exp2(-10.0));
    let state = (&[1000.0, -2000.0][..], &[1.0, 0.0][..]);
    let (series, made) = stretch(&scene(9999.0), (time, state.0, state.1), span, None);
    let mut judge = start(&scene(4000.0), state);
    judge.observe(&made.along(Path::Series(&series)));
    // 2 m/s, at the last instant of the rule.
    let depth = 2.0 * span * 0.5 * (1.0 + LAST);
    let noise = judge.noise.place(2000.0 + 2000.0 + 4000.0 + 2.0 * time);
    let found = judge.walls.gaps.outside.excess.value;
    // The place is rounded to 5e-13 m and the time to 5e-13 s, and the noise is 3e-10 m.
    assert!((found - (depth - noise)).abs() < 0.02 * noise, "{found:e}, {depth:e} − {noise:e}");
}

#[test]
fn a_rigid_wall_that_pushes_at_a_distance_is_accused() {
    // Pressed by 3 N onto a wall at 1 m; the judge knows it 1/8 m further away.
    let scene =
        |position: f64| body([4.0, 16.0], 0.0).with_wall(Wall::upper("wall", position)).with_load(Load::constant(3.0));
    let state = (&[1.0, 0.0][..], &[0.0, 0.0][..]);
    let (series, made) = stretch(&scene(1.0), (0.0, state.0, state.1), 0.5, Some((0.0, 1.0)));
    let mut judge = start(&scene(1.125), state);
    judge.observe(&made.along(Path::Series(&series)));
    let both = |gap: f64, force: f64| judge.walls.gaps.worst_excess(gap, force).value;
    assert!((both(1.0, 1.0) - 0.125).abs() < 1e-9 && (both(1e-9, 1.0) - 3.0).abs() < 1e-9);
    assert_eq!(judge.walls.tension, 0.0);
}

#[test]
fn a_force_of_a_spring_off_its_law_counts_less_what_the_rounding_of_the_place_explains() {
    // As of one degree of freedom: a very heavy body at 1 m/s, and a wall 1 nm nearer or further.
    let (position, time, nearer) = (1024.0, 4096.0, f64::exp2(-30.0));
    let scene = |position: f64| {
        body([f64::exp2(40.0); 2], 0.0).with_wall(Wall::upper("pad", position).with_elasticity(1.0, 0.0))
    };
    let state = (&[1024.5, 0.0][..], &[1.0, 0.0][..]);
    let touch = Some((1.0, position));
    let (series, made) = stretch(&scene(position), (time, state.0, state.1), 1e-3, touch);
    let rounding = 32.0 * f64::EPSILON * (1024.5 + 1024.0 + 4096.0);
    for by in [nearer, -nearer] {
        let mut judge = start(&scene(position - by), state);
        judge.observe(&made.along(Path::Series(&series)));
        // Places are rounded to 2e-13 m, and so is the force: some hundredths of the allowance.
        let error = judge.walls.law.value;
        assert!((error - (nearer - rounding)).abs() < 0.05 * rounding, "{error} {nearer} {rounding}");
    }
}

#[test]
fn a_stop_before_the_stretch_is_the_force_that_gives_it_within_a_radian() {
    // A load of nothing makes a quarter of a radian per second the fastest rate: one is 4 s.
    let scene = |force: f64| {
        let hum = Load::harmonic(0.0, 0.25 / std::f64::consts::TAU, 0.0);
        body([4.0, 16.0], 0.0).with_load(hum).with_load(Load::constant(force)).with_duration(10.0)
    };
    let state = (&[0.0, 0.0][..], &[1.0, 0.0][..]);
    let (series, mut made) = stretch(&scene(1.0), (0.0, state.0, state.1), 1.0, None);
    // The last step ended with 1.125 m/s: 0.5 N s were lost, 0.125 N over four seconds.
    made.before[0] = 1.125;
    let mut judge = start(&scene(1.0), state);
    judge.observe(&made.along(Path::Series(&series)));
    let near = |found: f64, expected: f64| (found - expected).abs() < 1e-12;
    assert!(near(judge.balance.largest, 0.125) && near(judge.balance.force.value, 0.0625), "{}", judge.balance.largest);
    // Over the whole step it is 0.5 N; and 0.5 N more if the load is 1.5 N.
    for (force, open) in [(1.0, 0.5), (1.5, 1.0)] {
        let mut judge = start(&scene(force), state);
        judge.observe(&made.along(Path::Series(&series)));
        assert!(near(judge.balance.force.excess.value, open / 2.0), "{:?}", judge.balance.force.excess);
    }
}
