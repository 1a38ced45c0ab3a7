//! Rest on a wall: when it begins, how long it lasts, and the force.

use super::series::{LaneConstants, sin_cos};
use crate::scheme::{TAIL_CHANGE, TAIL_HEIGHT, TIME_UNITS};

/// Maximum number of iterations in the search for a release: it converges like Newton's method, and
/// slowly only if the pressing acceleration touches 0.
const MOST_STEPS: usize = 200;

/// Number of places per radian of the fastest sine at which maxima of the pressing acceleration are
/// looked for.
const LOOKS: f64 = 4.0;

/// Number of bisections after which a maximum is known to rounding.
const HALVINGS: usize = 30;

/// What follows an impact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Arrival {
    /// The body leaves the wall.
    Flies,
    /// It stays on the wall.
    Rests,
    /// Undecided: the pressing acceleration is zero to rounding.
    Unclear,
}

/// When a rest ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Release {
    /// At this time, in steps of the lane since the period began.
    At(f64),
    /// Not before the time asked for.
    Later,
    /// Undecided: the pressing acceleration touches 0 to rounding.
    Unclear,
}

/// A body at rest on a wall at g, so that only the load varies. The wall pushes with the
/// acceleration
///
/// p(t) = −away (p₀ − κg + Σ A sin(θt + φ)) ≥ 0,
///
/// in metres per step squared, with away = 1 on a lower wall and −1 on an upper one. The body
/// leaves when p falls through 0.
pub(super) struct Rest<'a> {
    series: &'a LaneConstants,
    away: f64,
    /// p₀ − κg.
    constant: f64,
    /// A pressing acceleration below this is rounding error.
    noise: f64,
}

impl<'a> Rest<'a> {
    pub fn new(series: &'a LaneConstants, away: f64, position: f64) -> Self {
        let spring = series.kappa * position;
        let noise = 4.0 * f64::EPSILON * (series.load + spring.abs());
        Self { series, away, constant: series.push - spring, noise }
    }

    /// p and its first derivative at `t` (steps since the period began).
    fn press(&self, t: f64) -> [f64; 2] {
        let (mut p, mut rate) = (self.constant, 0.0);
        for wave in &self.series.waves {
            let [sin, cos] = wave.at(t);
            p += wave.amplitude * sin;
            rate += wave.amplitude * wave.theta * cos;
        }
        [-self.away * p, -self.away * rate]
    }

    /// What follows an impact at `t` after which the body has `speed` (m per step), with
    /// restitution `e`; `length` (m) is a typical displacement, `position` that of the wall.
    pub fn arrival(&self, t: f64, speed: f64, e: f64, length: f64, position: f64) -> Arrival {
        let [still, rate] = self.press(t);
        // The damping force on the way off the wall presses, too.
        let press = still + self.series.alpha * speed;
        if press.abs() <= self.noise {
            return if speed > 0.0 { Arrival::Flies } else { Arrival::Unclear };
        }
        if press < 0.0 {
            return Arrival::Flies;
        }
        let (height, flight) = (0.5 * speed * speed / press, 2.0 * speed / press);
        let resolved = 8.0 * f64::EPSILON * position.abs();
        if height <= resolved || flight <= TIME_UNITS * f64::EPSILON * self.series.steps {
            return Arrival::Rests;
        }
        let change = rate.abs() + self.series.alpha * press + self.series.kappa * speed;
        let closed = change * flight / (1.0 - e) <= TAIL_CHANGE * press;
        if height < TAIL_HEIGHT * length && closed { Arrival::Rests } else { Arrival::Flies }
    }

    /// The time at which the body leaves, at `from` or later and before `to` (steps).
    ///
    /// With B = Σ|A|θ² ≥ |p″|, p(t + s) ≥ p + p′s − ½Bs²: a step to the root of this bound does not
    /// pass a root of p, and near one it is a Newton step.
    pub fn release(&self, from: f64, to: f64) -> Release {
        let curve: f64 = self.series.waves.iter().map(|w| w.amplitude.abs() * w.theta * w.theta).sum();
        let mut t = from;
        for _ in 0..MOST_STEPS {
            let [p, rate] = self.press(t);
            if p <= self.noise {
                return if rate < 0.0 { Release::At(t) } else { Release::Unclear };
            }
            let root = (rate * rate + 2.0 * curve * p).sqrt();
            let step = if rate < 0.0 { 2.0 * p / (root - rate) } else { (root + rate) / curve };
            let next = t + step;
            // For a constant load the step is 0/0, NaN, and the comparison takes it as longer than
            // any time.
            if next >= to || next.is_nan() {
                return Release::Later;
            }
            if next == t {
                return Release::At(t);
            }
            t = next;
        }
        Release::Unclear
    }

    /// ∫p over [`from`, `to`], m per step: A Δ sin(mid) sin(θΔ/2)/(θΔ/2) for a sine.
    pub fn impulse(&self, from: f64, to: f64) -> f64 {
        let (span, mid) = (to - from, 0.5 * (from + to));
        let mut sum = self.constant * span;
        for wave in &self.series.waves {
            let half = 0.5 * wave.theta * span;
            let share = if half == 0.0 { 1.0 } else { sin_cos(half)[0] / half };
            sum += wave.amplitude * span * wave.at(mid)[0] * share;
        }
        (-self.away * sum).max(0.0)
    }

    /// The largest p over [`from`, `to`], m per step squared.
    pub fn highest(&self, from: f64, to: f64) -> f64 {
        let fastest = self.series.waves.iter().map(|w| w.theta).fold(0.0, f64::max);
        let looks = ((to - from) * fastest * LOOKS).ceil().clamp(1.0, 1e6) as u32;
        let time = |look: u32| from + (to - from) * f64::from(look) / f64::from(looks);
        let mut before = (from, self.press(from));
        let mut highest = before.1[0];
        for look in 1..=looks {
            let now = (time(look), self.press(time(look)));
            highest = highest.max(now.1[0]);
            if before.1[1] > 0.0 && now.1[1] < 0.0 {
                let (mut low, mut high) = (before.0, now.0);
                for _ in 0..HALVINGS {
                    let mid = 0.5 * (low + high);
                    (low, high) = if self.press(mid)[1] > 0.0 { (mid, high) } else { (low, mid) };
                }
                highest = highest.max(self.press(low)[0]);
            }
            before = now;
        }
        highest
    }
}
