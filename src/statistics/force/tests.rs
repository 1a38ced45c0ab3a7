//! Sums over steps made by hand.

use super::*;
use crate::scene::Wall;

#[test]
fn impulses_are_averaged_over_the_intervals_of_a_window_that_begins_later() {
    // A window from 2 to 12 s, in intervals of 0.1 s.
    let scene = Scene::oscillator(1.0, 0.0, 1.0).with_wall(Wall::upper("wall", 1.0)).with_duration(12.0);
    let mut forces = Forces::new(&scene, 2.0, 0.1);
    let mut push = |start: f64, p: f64| {
        forces.observe(&Step {
            start,
            end: start + 0.01,
            impulse: &[p],
            force: &[100.0 * p],
            ..Step::still(&[0.0], &[0.0])
        });
    };
    // Before the window; at its beginning; two in one interval; and three close to the end, the
    // last two of them in one interval again.
    for start in [1.5, 2.02, 5.32, 5.35, 11.02, 11.92, 11.94] {
        push(start, -2.0);
    }
    let wall = forces.statistics(0, 0).expect("a window");
    assert_eq!((wall.impulse_n_s, wall.rms_averaged_over_s), (-12.0, Some(0.1)));
    // 12 N s in 10 s; squares of 2, 4, 2 and 4 N s, each over 0.1 s and 10 s. Ten roundings.
    assert!((wall.mean_n - 1.2).abs() < 1e-15);
    assert!((wall.rms_n - 40.0_f64.sqrt()).abs() < 1e-14, "{}", wall.rms_n);
    // The two that end at 5.36 s lie within one stretch of 0.1 s; so do those that end at 11.95
    // s, later.
    let largest = wall.largest.expect("pushes");
    assert!((largest.mean_n - 40.0).abs() < 1e-9 && (largest.at_s - 5.34).abs() < 1e-9, "{largest:?}");
}
