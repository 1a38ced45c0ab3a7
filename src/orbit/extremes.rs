//! The extremes of the displacement, or of the force of a wall, inside a flight: roots of the rate,
//! not samples.

use crate::flow::{Arc, Jet, bisect};

/// Length of a search window, in units of the shortest period of motion and load over 2π.
const WINDOW: f64 = 0.25;

/// Most windows of one flight.
const MOST_WINDOWS: f64 = 1e5;

/// Where the search begins after a start with velocity 0, in windows.
const SOON: f64 = 1e-2;

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
