//! What shows a flight to be clear of the walls, and where its series meets one.

use super::*;
use crate::hash::Draws;
use crate::scene::Wall;
use crate::scheme::exact::ExactWall;

fn room(low: f64, high: f64) -> GapBounds {
    let wall = |wall: Wall| ExactWall::new(&wall).unwrap();
    GapBounds::between(&[wall(Wall::lower("lower", low)), wall(Wall::upper("upper", high))]).unwrap()
}

/// Displacement and velocity of the polynomial with the derivatives `c` at 0.
fn at<const N: usize>(c: &[f64; N], s: f64) -> [f64; 2] {
    let term = |n: usize| s.powi(n as i32) / (1..=n).map(|k| k as f64).product::<f64>();
    [(0..N).map(|n| c[n] * term(n)).sum(), (1..N).map(|n| c[n] * term(n - 1)).sum()]
}

#[test]
fn a_way_is_clear_where_the_control_points_of_its_cubic_have_the_margin() {
    let mut draws = Draws::new(6, 1);
    let mut clear = [0; 2];
    for _ in 0..4000 {
        // The control points of a cubic over h, and a bound on a fourth derivative that moves it by
        // about as much: by b h⁴/384 at most, of which the margin is 4/3.
        let (h, size) = (draws.size(6.0), draws.size(6.0));
        let points = [0, 1, 2, 3].map(|_| size * draws.between(-1.0, 1.0));
        let margin = size * draws.between(0.0, 0.5);
        let bound = 288.0 * margin / h.powi(4);
        let velocity = |from: usize| 3.0 * (points[from + 1] - points[from]) / h;
        let mut jet = Jet::default();
        (jet[0], jet[1]) = (points[0], velocity(0));
        // A room in which both ends are.
        let [low, high] = [-1.5, 1.5].map(|x| size * (x + draws.between(-0.4, 0.4)));
        let walls = room(low, high);
        let spare = [1, 2].map(|i| (points[i] - low).min(high - points[i]) - margin);
        let spare = spare[0].min(spare[1]);
        if spare.abs() < 1e-9 * size {
            continue;
        }
        let found = is_clear(&jet, h, [points[3], velocity(2)], bound, &walls);
        assert_eq!(found, spare > 0.0, "{points:?} {margin} {h} between {low} and {high}");
        clear[usize::from(found)] += 1;
    }
    assert!(clear[0] > 100 && clear[1] > 1000, "{clear:?}");
}

#[test]
fn a_way_that_is_said_to_be_clear_passes_no_wall() {
    let mut draws = Draws::new(6, 2);
    let mut clear = 0;
    for _ in 0..4000 {
        let h = draws.size(6.0);
        // Any motion of constant fourth derivative, and walls that are as near as they can be.
        let c: [f64; 5] = [0, 1, 2, 3, 4].map(|n| draws.between(-2.0, 2.0) * draws.size(2.0) / h.powi(n));
        let [end, speed] = at(&c, h);
        let (mut low, mut high) = (c[0].min(end), c[0].max(end));
        for part in 1..200 {
            let q = at(&c, h * f64::from(part) / 200.0)[0];
            (low, high) = (low.min(q), high.max(q));
        }
        let beyond = (high - low) * draws.between(-0.1, 0.5);
        let walls = room(low - beyond, high + beyond);
        let jet = [c[0], c[1], c[2], c[3], c[4], 0.0, 0.0];
        if is_clear(&jet, h, [end, speed], c[4].abs(), &walls) {
            clear += 1;
            // Between two of the samples the motion is a little higher.
            let (ends, inside) = (c[0].min(end) > low - beyond && c[0].max(end) < high + beyond, beyond > 0.0);
            assert!(inside || !ends, "{c:?} {h}: {beyond}");
        }
    }
    assert!(clear > 300, "{clear}");
}

#[test]
fn a_series_has_the_value_and_the_slope_of_its_motion() {
    // (1 + s)⁶, from its derivatives at 0.
    let jet = [1.0, 6.0, 30.0, 120.0, 360.0, 720.0, 720.0];
    for (position, s) in [(0.0, 0.5), (3.0, 0.5), (-2.0, -0.25), (1.0, 0.0)] {
        // All these numbers are short in binary.
        let x: f64 = 1.0 + s;
        assert_eq!(Taylor::of(&jet, position).at(s), (x.powi(6) - position, 6.0 * x.powi(5)));
    }
}

#[test]
fn the_way_to_a_wall_is_guessed_by_halley_and_refined_once_within_the_window() {
    let mut draws = Draws::new(6, 3);
    for _ in 0..2000 {
        // gap + v s + ½a s² vanishes first at −2 gap/(v + sgn v √(v² − 2 gap a)).
        let (v, time, x) = (draws.size(8.0), draws.size(8.0), draws.between(-0.1, 0.1));
        let (gap, a) = (-v * time, -2.0 * x * v / time);
        let sign = if draws.between(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
        let root = -2.0 * gap / (v + (v * v - 2.0 * gap * a).sqrt());
        let series = Taylor([sign * gap, sign * v, 0.5 * sign * a, 0.0, 0.0, 0.0, 0.0]);
        // With x = gap a/2v², Halley's method is off by x² of the root, and Newton's from there by
        // x⁵, to first order; in all of the interval by up to three times that.
        let [guess, close] = [0.5 * root, 2.0 * root].map(|window| series.root(window) / root - 1.0);
        assert!(guess.abs() > 0.5 * x * x - 1e-15 && guess.abs() < 2.0 * x * x + 1e-15, "{x}: {guess:e}");
        assert!(close.abs() <= 4.0 * x.abs().powi(5) + 1e-15, "{x}: {close:e}");
    }
}

#[test]
fn newtons_method_meets_the_wall_or_says_that_it_does_not() {
    // (s − 2)(s + 3), from a hundredth beside the root.
    let jet = [-6.0, 1.0, 2.0, 0.0, 0.0, 0.0, 0.0];
    for from in [1.99, 2.0, 2.01] {
        let (s, rate) = Taylor::of(&jet, 0.0).polished_root(from, 1e-14).unwrap();
        // A noise of 1e-14 over a slope of 5.
        assert!((s - 2.0).abs() <= 4e-15 && (rate - 5.0).abs() < 1e-13, "{from}: {s} {rate}");
    }
    // s² + 1 never vanishes.
    assert_eq!(Taylor::of(&[1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0], 0.0).polished_root(0.5, 1e-14), None);
}
