//! How deep exact motion goes into an elastic wall.
//!
//! It is deepest where its speed into the wall becomes one out of it: between two instants, which
//! are less than a radian of the fastest motion apart, such a turn is a root of the speed.

use crate::flow::bisect;
use crate::scene::Wall;

/// How far a body in the state `q` (m), `v` (m/s) is behind the face of a flat `wall`, m, and its
/// speed into it, m/s.
pub(super) fn behind(wall: &Wall, q: &[f64], v: &[f64]) -> [f64; 2] {
    [-wall.gap(wall.row().dot(q)), -wall.side().sign() * wall.row().dot(v)]
}

/// The largest depth (m) between two times (s) on a `motion` that gives the depth and the speed
/// into the wall (m/s) at a time, and has no rate above `fastest` (rad/s).
pub(super) fn deepest([from, to]: [f64; 2], fastest: f64, mut motion: impl FnMut(f64) -> [f64; 2]) -> f64 {
    let parts = (fastest * (to - from)).ceil().max(1.0);
    let [mut deepest, speed] = motion(from);
    let mut last = [from, speed];
    let mut part = 1.0;
    while part <= parts {
        let t = if part < parts { from + (to - from) * (part / parts) } else { to };
        let [depth, speed] = motion(t);
        deepest = deepest.max(depth);
        if last[1] > 0.0 && speed < 0.0 {
            let turn = bisect(|t| motion(t)[1], last[0], t);
            deepest = deepest.max(motion(turn)[0]);
        }
        (last, part) = ([t, speed], part + 1.0);
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::deepest;

    #[test]
    fn a_sine_is_deepest_at_its_crest_wherever_the_instants_lie() {
        // Rounding of sines near 1, whose slope there is nothing.
        for k in 0..100 {
            let from = 0.017 * f64::from(k);
            for to in [1.6, 3.1, 8.0] {
                let crest =
                    if to >= 0.5 * std::f64::consts::PI + std::f64::consts::TAU || from < 1.57 { 1.0 } else { 0.0 };
                let found = deepest([from, to], 1.0, |t| [t.sin(), t.cos()]);
                if from < to && crest == 1.0 {
                    assert!((found - 1.0).abs() < 1e-15, "{from} to {to}: {found}");
                }
            }
        }
        // A motion that only leaves is deepest where it starts, one that only enters at its end.
        assert_eq!(deepest([2.0, 3.0], 1.0, |t| [t.sin(), t.cos()]), 2_f64.sin());
        assert_eq!(deepest([0.0, 1.0], 1.0, |t| [t.sin(), t.cos()]), 1_f64.sin());
    }
}
