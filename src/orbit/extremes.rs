//! The extremes of the displacement, or of the force of a wall, inside a flight: roots of the rate,
//! not samples.

use crate::flow::{Arc, Jet};

/// Length of a search window, in units of the shortest period of motion and load over 2π.
const WINDOW: f64 = 0.25;

/// Most windows of one flight.
const MOST_WINDOWS: f64 = 1e5;

/// Where the search begins after a start with velocity 0, in windows.
const SOON: f64 = 1e-2;

/// Halvings and secant steps that locate a root.
const STEPS: usize = 80;

/// Calls `observe` with the time since the start (s), the state there with its derivatives, and the
/// second rate of each extreme of w₀ q + w₁ q̇ strictly inside the `span` (s) of `arc`, in order; w
/// are the `weights`.
///
/// The rate is a sum of exponentials and sines; in a window of a quarter of the shortest period
/// over 2π it has more than one root only if its own rate has one there too; the window is then
/// split at this root.
pub(super) fn extremes(arc: &Arc, span: f64, weights: [f64; 2], mut observe: impl FnMut(f64, &Jet, f64)) {
    let fastest = arc.fastest_motion();
    let windows = (span * fastest / WINDOW).ceil().clamp(4.0, MOST_WINDOWS);
    let width = span / windows;
    let rate = |jet: &Jet, order: usize| weights[0] * jet[order] + weights[1] * jet[order + 1];
    let value = |tau: f64, order: usize| rate(&arc.jet(tau), order);
    let rates = |tau: f64, jet: &Jet| (tau, rate(jet, 1), rate(jet, 2));
    // A rate of 0 at the start is no extreme inside: the rate soon after it gives the sign.
    let mut before = rates(0.0, &arc.start_jet());
    if before.1 == 0.0 {
        let soon = SOON * width;
        before = rates(soon, &arc.jet(soon));
    }
    for index in 1..=windows as u64 {
        let tau = if index == windows as u64 { span } else { width * index as f64 };
        let after = rates(tau, &arc.jet(tau));
        let mut root = |from: f64, to: f64| {
            let tau = bisect(|tau| value(tau, 1), from, to);
            if tau > 0.0 && tau < span {
                let jet = arc.jet(tau);
                observe(tau, &jet, rate(&jet, 2));
            }
        };
        if before.1 * after.1 < 0.0 || (before.1.signum() != after.1.signum() && after.1 != 0.0) {
            root(before.0, after.0);
        } else if before.2 * after.2 < 0.0 {
            let turn = bisect(|tau| value(tau, 2), before.0, after.0);
            if value(turn, 1) * after.1 < 0.0 {
                root(before.0, turn);
                root(turn, after.0);
            }
        }
        before = after;
    }
}

/// A root of `f` between `from` and `to`, where its signs differ, to the last digits: by secants
/// where they stay inside and converge, else by halving (the Illinois method).
pub(super) fn bisect(mut f: impl FnMut(f64) -> f64, from: f64, to: f64) -> f64 {
    let (mut a, mut b) = (from, to);
    let (mut fa, mut fb) = (f(a), f(b));
    for _ in 0..STEPS {
        let mut c = b - fb * (b - a) / (fb - fa);
        let inside = c.is_finite() && (c - a) * (c - b) < 0.0;
        if !inside {
            c = 0.5 * (a + b);
        }
        if c == a || c == b {
            break;
        }
        let fc = f(c);
        if fc == 0.0 {
            return c;
        }
        if fc * fb < 0.0 {
            (a, fa) = (b, fb);
        } else {
            fa *= 0.5;
        }
        (b, fb) = (c, fc);
        if (b - a).abs() <= 2.0 * f64::EPSILON * b.abs() {
            break;
        }
    }
    b
}
