//! Flights that are plain to see: to the wall that is met first, or over all of the span.
//!
//! Between two instants h apart the motion is within |q⁗|z²(h − z)²/24 of the cubic that has its
//! values and slopes at both. In Bernstein form that cubic has the control points q₀, q₀ + v₀h/3,
//! q₁ − v₁h/3, q₁ with weights B₀ … B₃ ≥ 0 of sum 1, and z²(h − z)² ≤ h⁴(B₁ + B₂)/12. So where both
//! ends are in front of a wall or at it, and the two inner points in front of it by more than
//! |q⁗|h⁴/288, the motion is in front of it all the way: no grazing contact is missed.
//!
//! What is not shown so (a graze, a start without speed) is left to the careful search.

use super::Event;
use super::gap_bounds::GapBounds;
use crate::error::Result;
use crate::flow::Jet;
use crate::scheme::exact;

/// Where the search ended.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hit {
    /// Time since the arc's start, s.
    pub tau: f64,
    /// Displacement (m) and velocity (m/s) there, from the left.
    pub state: [f64; 2],
    /// The wall of the event; `None` where there is none up to the end.
    pub wall: Option<usize>,
}

/// Length of the longest leap, in radians of the fastest oscillation.
const RADIANS: f64 = 2.0;

/// Maximum number of evaluations on one leap before the careful search takes over.
const TRIES: usize = 4;

/// Maximum number of Newton steps on a Taylor polynomial.
const NEWTON_STEPS: usize = 4;

/// How far a flight is known.
pub(super) enum Flown {
    /// To its end.
    To(Hit),
    /// Up to this time since its start (s), where it has this jet.
    Unclear(f64, Jet),
}

impl Event {
    /// Follows the flight over `span` (s), leap by leap.
    pub(super) fn fly(&mut self, span: f64) -> Result<Flown> {
        let (mut tau, mut jet) = (0.0, self.arc.start_jet());
        let (noise, Some(room)) = (self.resolution, self.room) else { return Ok(Flown::Unclear(tau, jet)) };
        let fastest = self.arc.fastest_motion();
        let longest = if fastest > 0.0 { RADIANS / fastest } else { f64::INFINITY };
        let mut window = longest.min(span);
        let mut bound = self.arc.bounds(&jet, 4, window)[0];
        let mut leap = Taylor::of(&jet, room.ahead(&jet).0).root(window);
        let mut tries = 0;
        while room.holds(jet[0], -noise) && tries < TRIES {
            self.count_evaluation(tau)?;
            if !(leap > 0.0 && leap < window) {
                leap = window;
            }
            let next = if leap >= span - tau { span } else { tau + leap };
            let end = self.arc.jet(next);
            let (position, wall) = room.ahead(&end);
            let series = Taylor::of(&end, position);
            let left = series.root(window);
            let rest = self.arc.bounds(&jet, 6, window)[1] * left.powi(6);
            if rest * left.abs() <= 5040.0 * noise {
                // The series is exact to rounding up to the wall; its derivative, the speed, only
                // where its own rest is that small.
                let Some((left, rate)) = series.polished_root(left, noise) else { break };
                let (way, hit) = (leap + left, next + left);
                let v = if rest <= 720.0 * exact::noise(self.sizes[1]) { rate } else { self.arc.jet(hit)[1] };
                if 0.0 < way && way <= window && hit < span && is_clear(&jet, way, [position, v], bound, &room) {
                    return Ok(Flown::To(Hit { tau: hit, state: [position, v], wall }));
                }
                break;
            }
            if !room.holds(end[0], noise) {
                (leap, tries) = (leap + left, tries + 1);
            } else if !is_clear(&jet, leap, [end[0], end[1]], bound, &room) {
                (leap, tries) = (0.5 * leap, tries + 1);
            } else if next >= span || self.has_faded([end[0], end[1]]) {
                return Ok(Flown::To(Hit { tau: next, state: [end[0], end[1]], wall: None }));
            } else {
                (tau, jet, leap, tries) = (next, end, left, 0);
                window = longest.min(span - tau);
                bound = self.arc.bounds(&jet, 4, window)[0];
            }
        }
        Ok(Flown::Unclear(tau, jet))
    }
}

/// True if the motion from `jet` to displacement (m) and velocity (m/s) `end` after `h` (s) is
/// between both walls on its way; `bound` is one on |q⁗|, m/s⁴.
#[inline]
fn is_clear(jet: &Jet, h: f64, [q, v]: [f64; 2], bound: f64, room: &GapBounds) -> bool {
    let (third, square) = (h * (1.0 / 3.0), h * h);
    let margin = bound * (square * square) * (1.0 / 288.0);
    room.holds(jet[0] + third * jet[1], margin) && room.holds(q - third * v, margin)
}

/// The Taylor polynomial of the way from a wall, m: coefficients of 1, s, s² …
struct Taylor([f64; 7]);

impl Taylor {
    #[inline]
    fn of(jet: &Jet, position: f64) -> Self {
        let [q, v, a, jerk, fourth, fifth, sixth] = *jet;
        Self([
            q - position,
            v,
            0.5 * a,
            jerk * (1.0 / 6.0),
            fourth * (1.0 / 24.0),
            fifth * (1.0 / 120.0),
            sixth * (1.0 / 720.0),
        ])
    }

    /// Its value and derivative at `s`.
    #[inline]
    fn at(&self, s: f64) -> (f64, f64) {
        let [.., c5, c6] = self.0;
        let (mut value, mut rate) = (c5 + s * c6, c6);
        for c in self.0[..5].iter().rev() {
            rate = value + s * rate;
            value = c + s * value;
        }
        (value, rate)
    }

    /// About where it vanishes, s from now: by Halley's method, then by Newton's if that is within
    /// `window`.
    #[inline]
    fn root(&self, window: f64) -> f64 {
        let [gap, v, half, ..] = self.0;
        let s = -gap * v / (v * v - gap * half);
        if s.abs() < window {
            let (value, rate) = self.at(s);
            s - value / rate
        } else {
            s
        }
    }

    /// Where it is within `noise` (m) of 0, s from now, and its derivative there, by Newton's
    /// method from `s`; `None` if that does not converge.
    #[inline]
    fn polished_root(&self, mut s: f64, noise: f64) -> Option<(f64, f64)> {
        for _ in 0..NEWTON_STEPS {
            let (value, rate) = self.at(s);
            if value.abs() <= noise {
                return Some((s, rate));
            }
            s -= value / rate;
        }
        None
    }
}

#[cfg(test)]
mod tests;
