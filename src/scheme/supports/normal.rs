//! The normal of a round hole in a step, and the split of the approach along it: the law stands at
//! [`Turning`], with its reasons.

use crate::step::{Normal, Turning};

/// The numbers of the law.
pub(in crate::scheme) const TURNING: Turning =
    Turning { normal: Normal::Ahead(AHEAD), touching: 1e-12, sagitta: 1e-9, deepest: 0.999 };

/// Where in the step moreau-jean takes the normal.
pub(in crate::scheme) const AHEAD: f64 = 0.5;

/// With the middle of a step nearer to the centre than this share of γ, the body crosses the hole:
/// it moves by more than 120° round the circle, or arrives from the other side.
pub(in crate::scheme) const CROSSING: f64 = 0.5;

/// A hole in play.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::scheme) struct HoleState {
    /// n.
    pub normal: [f64; 2],
    /// The part of n·ẇ that arrives at the hole, or all of it where the body separates, m/s.
    pub arriving: f64,
    /// The upper bound on n·ẇ⁺, m/s.
    pub bound: f64,
    /// The largest angle by which the normal turned in a step since the contact began, this one
    /// included, rad.
    pub turned: f64,
}

/// The state of a hole of this gap γ (m) and restitution at the displacement `w` (m) from its
/// centre, with the velocity `rate` (m/s) after the step's blows, in a step of `h` seconds; `None`
/// if it is out of reach. `turned` is that of its contact if it pushed in the step before, else 0.
pub(in crate::scheme) fn hole_state(
    (gap, e): (f64, f64),
    [w, rate]: [[f64; 2]; 2],
    h: f64,
    turned: f64,
) -> Option<HoleState> {
    let ahead = [0, 1].map(|i: usize| w[i] + AHEAD * h * rate[i]);
    let reach = norm(ahead);
    // A NaN meets nothing; the step then ends with an error.
    if reach.is_nan() {
        return None;
    }
    if reach < gap * (1.0 - TURNING.touching) && !lasts(gap, norm(w).min(reach), turned) {
        return None;
    }
    Some(split((gap, e), [w, rate], ahead.map(|x| x / reach), h, turned))
}

/// True if the contact with a hole lasts with the body and the middle of the step at this distance
/// from the centre, or farther. To first order, the body is inside of the circle by a quarter of
/// that share if it slows down to a rest, and the middle by three quarters if it does so at once.
fn lasts(gap: f64, distance: f64, turned: f64) -> bool {
    turned > 0.0 && distance >= gap * CROSSING.max(1.0 - turned * turned / 2.0)
}

/// The state of a closed hole with the normal in the middle between `w` and `end` (m), or at `end`
/// where the body crosses the hole.
pub(in crate::scheme) fn closed_hole_state(
    (gap, e): (f64, f64),
    [w, end]: [[f64; 2]; 2],
    rate: [f64; 2],
    h: f64,
) -> HoleState {
    let middle = [0.5 * (w[0] + end[0]), 0.5 * (w[1] + end[1])];
    let size = norm(middle);
    if size >= CROSSING * gap {
        return split((gap, e), [w, rate], middle.map(|x| x / size), h, 0.0);
    }
    // All of its approach arrives, as from the centre.
    let reach = norm(end);
    split((gap, e), [[0.0; 2], rate], end.map(|x| x / reach), h, 0.0)
}

/// The split of the approach along this normal; `before` is `turned` of [`hole_state`].
fn split((gap, e): (f64, f64), [w, rate]: [[f64; 2]; 2], normal: [f64; 2], h: f64, before: f64) -> HoleState {
    let a = dot(normal, rate);
    let turned = before.max(h * (normal[0] * rate[1] - normal[1] * rate[0]).abs() / gap);
    if a <= 0.0 {
        return HoleState { normal, arriving: a, bound: -a, turned };
    }
    let distance = norm(w);
    // Nearer to the centre the direction of w says nothing.
    let sagitta = TURNING.sagitta.max((h / gap).powi(2) * dot(rate, rate) / 8.0).min(TURNING.deepest);
    let inside = distance < gap * (1.0 - sagitta) && !lasts(gap, distance, before);
    let arriving = if inside { a } else { (dot(w, rate) / distance).max(0.0).min(a) };
    HoleState { normal, arriving, bound: -(e * arriving + (a - arriving)), turned }
}

pub(in crate::scheme) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn norm(a: [f64; 2]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hole_out_of_reach_gives_nothing() {
        // Half a step ahead the body is at 0.9999 of the gap.
        assert_eq!(hole_state((1.0, 0.5), [[0.5, 0.0], [0.9998, 0.0]], 1.0, 0.0), None);
        assert_eq!(hole_state((1.0, 0.5), [[0.0, 0.0], [f64::NAN, 0.0]], 1.0, 0.0), None);
        assert!(hole_state((1.0, 0.5), [[0.5, 0.0], [1.0, 0.0]], 1.0, 0.0).is_some());
    }

    #[test]
    fn what_comes_from_inside_arrives_whole() {
        // At (0.6, 0) with (0.8, 0.6): ahead (1, 0.3), so the approach along n is 0.98/√1.09.
        let met = hole_state((1.0, 0.25), [[0.6, 0.0], [0.8, 0.6]], 1.0, 0.0).unwrap();
        let a = 0.98 / 1.09_f64.sqrt();
        assert!((met.arriving - a).abs() < 1e-15 && (met.bound + 0.25 * a).abs() < 1e-15, "{met:?}");
        assert!((met.normal[0] - 1.0 / 1.09_f64.sqrt()).abs() < 1e-15, "{met:?}");
    }

    #[test]
    fn what_turns_is_reflected_and_what_separates_keeps_its_speed() {
        // On the circle with a velocity along it: nothing arrives, whatever the restitution.
        let (h, v) = (1e-2, 0.3);
        let met = hole_state((1.0, 0.25), [[1.0, 0.0], [0.0, v]], h, 0.0).unwrap();
        let a = met.normal[1] * v;
        assert!(met.arriving == 0.0 && (met.bound + a).abs() < 1e-18 && a > 0.0, "{met:?}");
        assert!((met.turned - h * v).abs() < 1e-5 * h * v, "{met:?}");
        // On the circle with a part across it: that part arrives, the rest turns.
        let met = hole_state((1.0, 0.25), [[1.0, 0.0], [0.1, v]], h, 0.0).unwrap();
        let a = met.normal[0] * 0.1 + met.normal[1] * v;
        assert!((met.arriving - 0.1).abs() < 1e-16, "{met:?}");
        assert!((met.bound + 0.25 * 0.1 + (a - 0.1)).abs() < 1e-15, "{met:?}");
        // Behind the hole on the way back.
        let met = hole_state((1.0, 0.25), [[1.5, 0.0], [-0.5, 0.0]], h, 0.0).unwrap();
        assert!(met.arriving == -0.5 && met.bound == 0.5, "{met:?}");
    }

    #[test]
    fn a_hole_that_pushed_stays_in_play_as_far_inside_as_a_slide_may_come_and_nothing_arrives_there() {
        let (h, turned) = (1.0, 0.2);
        // At half the speed at which the contact began, so that the middle is inside of the circle.
        let rate = [0.0, 0.1];
        for (depth, stays) in [(0.9, true), (1.1, false)] {
            let w = [1.0 - depth * turned * turned / 2.0, 0.0];
            assert_eq!(hole_state((1.0, 0.25), [w, rate], h, 0.0), None);
            let met = hole_state((1.0, 0.25), [w, rate], h, turned);
            assert_eq!(met.is_some(), stays, "{depth}");
            let Some(met) = met else { continue };
            assert!(met.arriving == 0.0 && met.bound == -met.normal[1] * 0.1 && met.turned == turned, "{met:?}");
        }
        // Nor on the way back from a rebound, with the middle farther inside than that.
        assert_eq!(hole_state((1.0, 0.25), [[1.0, 0.0], [-0.1, 0.0]], h, turned), None);
        // What arrives rebounds, and a faster turn is kept.
        let met = hole_state((1.0, 0.25), [[0.99, 0.0], [0.1, 0.3]], h, turned).unwrap();
        assert!((met.arriving - 0.1).abs() < 1e-16 && met.turned > turned, "{met:?}");
    }

    #[test]
    fn the_angle_of_a_turn_is_the_way_along_the_circle_over_its_radius() {
        for k in 0..20 {
            // From the circle of radius 4e-3 m, at a speed of which 0.3 m/s is along it.
            let (gap, h, turn, along) = (4e-3, 1e-7, 0.37 * f64::from(k), if k % 2 == 0 { 0.3 } else { -0.3 });
            let (c, s, out) = (f64::cos(turn), f64::sin(turn), 0.2);
            let rate = [out * c - along * s, out * s + along * c];
            let met = hole_state((gap, 0.5), [[gap * c, gap * s], rate], h, 0.0).unwrap();
            // The normal is that half a step ahead, 4e-6 rad on.
            assert!((met.turned / (h * 0.3 / gap) - 1.0).abs() < 1e-5, "{met:?}");
        }
    }
}
