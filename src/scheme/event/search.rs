//! The search for the next event of an arc.

use super::Event;
use super::flight::{Flown, Hit};
use super::root::{Below, Step};
use crate::error::Result;
use crate::flow::{Jet, Support};
use crate::scheme::exact::{ExactWall, Phase, noise};

/// Length of the longest window of a bound, in radians of the fastest oscillation: beyond it the
/// bounds grow faster than the window.
const WINDOW_RADIANS: f64 = 1.5;

/// Maximum number of halvings or Newton steps to locate a peak to rounding.
const PEAK_STEPS: usize = 60;

impl Event {
    /// Searches the arc over `span` (s) for its first event.
    pub(super) fn search(&mut self, span: f64) -> Result<Hit> {
        // In one piece, the innermost loop: its parts share the window with its jet and bounds.
        if let Some(support) = self.support {
            return self.search_rest(support, span);
        }
        let [low, high] = self.arc.extent();
        if self.room.is_some_and(|room| room.holds(low, 0.0) && room.holds(high, 0.0)) {
            let [q, v, ..] = self.arc.jet(span);
            return Ok(Hit { tau: span, state: [q, v], wall: None });
        }
        let (mut tau, mut jet) = match self.fly(span)? {
            Flown::To(hit) => return Ok(hit),
            Flown::Unclear(tau, jet) => (tau, jet),
        };
        let fastest = self.arc.fastest_motion();
        let longest = if fastest > 0.0 { WINDOW_RADIANS / fastest } else { f64::INFINITY };
        let mut noise = self.flow_noise(tau > 0.0);
        self.note_pressures(&jet);
        let let_go = self.v == 0.0 && self.released == self.time;
        let moves = [self.q, self.v] != [0.0; 2];
        loop {
            self.count_evaluation(tau)?;
            let window = longest.min(span - tau);
            let bounds = self.arc.bounds(&jet, 4, window);
            let (mut step, mut wall, mut is_root, mut touched) = (window, None, false, false);
            for index in 0..self.barriers.len() {
                for which in 0..2 {
                    let Some(mut below) = self.watched_function(index, which, &jet, &bounds, &noise) else { break };
                    if tau == 0.0 && self.has_changed(index) {
                        // It was 0 to the rounding of the arc before, which may be coarser than
                        // that of this arc.
                        below.c[0] = below.c[0].max(0.0);
                    }
                    if let_go && tau == 0.0 {
                        below.set_aside();
                    }
                    match below.step(step) {
                        Step::Now => return Ok(Hit { tau, state: [jet[0], jet[1]], wall: Some(index) }),
                        Step::Root(s) if s < step => (step, wall, is_root, touched) = (s, Some(index), true, false),
                        Step::Touch(s) if s < step => (step, wall, is_root, touched) = (s, Some(index), true, true),
                        Step::Free(s) if s < step => (step, wall, is_root, touched) = (s, Some(index), false, false),
                        Step::Root(_) | Step::Touch(_) | Step::Free(_) => {}
                    }
                }
            }
            let next = tau + step;
            if wall.is_some() && (is_root || next == tau) {
                // So near that the Taylor series is exact to rounding, and saves an evaluation.
                let s = step;
                let q = jet[0] + s * (jet[1] + s * (0.5 * jet[2] + s * jet[3] / 6.0));
                let v = jet[1] + s * (jet[2] + s * (0.5 * jet[3] + s * jet[4] / 6.0));
                if self.arc.touches() {
                    let end = self.arc.jet(next);
                    self.note_between((tau, &jet), (next, &end));
                }
                // In a touch the body is at the wall, with speed 0.
                let state = if touched { [q, 0.0] } else { [q, v] };
                return Ok(Hit { tau: next, state, wall });
            }
            let next = if wall.is_none() && step >= span - tau { span } else { next };
            let before = jet;
            if tau == 0.0 {
                noise = self.flow_noise(true);
            }
            jet = self.arc.jet(next);
            if self.arc.touches() {
                self.note_between((tau, &before), (next, &jet));
            }
            tau = next;
            if moves && tau < span && self.has_faded([jet[0], jet[1]]) {
                return Ok(Hit { tau, state: [jet[0], jet[1]], wall: None });
            }
            if tau >= span {
                self.count_evaluation(tau)?;
                return Ok(Hit { tau: span, state: [jet[0], jet[1]], wall: self.hit_at_end(&jet, &noise) });
            }
        }
    }

    /// True if the wall's phase changed at this instant.
    fn has_changed(&self, index: usize) -> bool {
        self.barriers.get(index).is_some_and(|b| b.changed == self.time)
    }

    /// A wall met exactly at the end of the arc. A function that is not yet below 0 there is found
    /// at the start of the next arc.
    fn hit_at_end(&self, jet: &Jet, noise: &[f64; 4]) -> Option<usize> {
        (0..self.barriers.len()).find(|&index| {
            let watched = (0..2).map_while(|which| self.watched_function(index, which, jet, &[0.0; 2], noise));
            let met = |b: &Below| b.c[0] <= b.noise[0] && b.c[1] < -b.noise[1];
            { watched }.any(|b| met(&b) && b.touch(0.0, f64::INFINITY).is_none())
        })
    }

    /// The functions of wall `index` whose first root is an event, numbered by `which`: two where
    /// the body is behind the face of an elastic wall that does not push, else one.
    // Always inline: passing it through memory costs more than the arithmetic.
    #[inline(always)]
    fn watched_function(
        &self,
        index: usize,
        which: u8,
        jet: &Jet,
        bounds: &[f64; 2],
        noise: &[f64; 4],
    ) -> Option<Below> {
        let b = self.barriers.get(index)?;
        match (b.phase, which) {
            (Phase::Rigid(_), 0) => Some(gap(b, b.sign, false, jet, bounds, noise)),
            (Phase::Outside, 0) => Some(gap(b, b.sign, true, jet, bounds, noise)),
            (Phase::Touching, 0) => Some(sum(b, b.sign, jet, bounds, noise)),
            (Phase::Detached, 0) => Some(sum(b, -b.sign, jet, bounds, noise)),
            (Phase::Detached, _) => Some(gap(b, -b.sign, true, jet, bounds, noise)),
            _ => None,
        }
    }

    /// Rounding errors of displacement and its first three derivatives on this arc. Away from its
    /// start, where the `closed` form gives the acceleration, those of its own terms are among
    /// them.
    fn flow_noise(&self, closed: bool) -> [f64; 4] {
        let [_, v, force, rate] = self.sizes;
        let (mass, rub) = (self.body.mass, self.body.damping / self.body.mass);
        // The instant itself, and the load with it, is known only to an ulp of the time.
        let fastest = self.arc.fastest();
        let a = (force + rate * self.time) / mass + rub * v;
        let jerk = rate * (1.0 + fastest * self.time) / mass + rub * a + self.body.stiffness / mass * v;
        let steady = if closed { self.arc.steady_size() } else { 0.0 };
        [self.resolution, noise(v), noise(a) + noise(steady), noise(jerk) + noise(steady * self.arc.fastest_motion())]
    }

    /// Rounding errors of the force on a body at rest and of its first three derivatives, N, N/s …
    fn rest_noise(&self) -> [f64; 4] {
        let ([.., force, rate], fastest) = (self.sizes, self.arc.fastest());
        // The instant itself is known only to an ulp of the time.
        let late = 1.0 + fastest * self.time;
        let curve = rate * fastest;
        [noise(force + rate * self.time), noise(rate * late), noise(curve * late), noise(curve * fastest)]
    }

    /// The search at rest: the first root of the pressing force.
    fn search_rest(&mut self, index: usize, span: f64) -> Result<Hit> {
        let state = [self.q, 0.0];
        let Some(side) = self.barriers.get(index).map(|b| b.side) else {
            return Ok(Hit { tau: span, state, wall: None });
        };
        let support = Support { wall: index, side };
        let (bound, noise) = (self.arc.pressing_bound(), self.rest_noise());
        let fastest = self.arc.fastest();
        let longest = if fastest > 0.0 { WINDOW_RADIANS / fastest } else { f64::INFINITY };
        let jet = self.arc.jet(0.0);
        self.note_pressures(&jet);
        let (mut tau, mut pressing) = (0.0, self.arc.pressing(support, 0.0));
        loop {
            self.count_evaluation(tau)?;
            if let Some(b) = self.barriers.get_mut(index) {
                b.note(pressing[0]);
            }
            if tau >= span {
                return Ok(Hit { tau: span, state, wall: None });
            }
            let window = longest.min(span - tau);
            let below = Below { c: pressing, fourth: 0.0, bound, noise, passes_touch: true };
            let (step, is_root) = match below.step(window) {
                Step::Now => return Ok(Hit { tau, state, wall: Some(index) }),
                Step::Root(s) | Step::Touch(s) => (s, true),
                Step::Free(s) => (s, false),
            };
            let next = if step >= span - tau { span } else { tau + step };
            if is_root || next == tau {
                return Ok(Hit { tau: next, state, wall: Some(index) });
            }
            let before = pressing;
            pressing = self.arc.pressing(support, next);
            if before[1] > 0.0 && pressing[1] < 0.0 {
                let arc = &self.arc;
                let peak = highest((tau, next), |t| {
                    let p = arc.pressing(support, t);
                    [p[0], p[1], p[2]]
                });
                if let Some(b) = self.barriers.get_mut(index) {
                    b.note(peak);
                }
            }
            tau = next;
        }
    }

    /// Records the pressures of the touching elastic walls at one state.
    fn note_pressures(&mut self, jet: &Jet) {
        for b in &mut self.barriers {
            if b.phase == Phase::Touching {
                let sum = b.sum(jet[0], jet[1]);
                b.note(sum);
            }
        }
    }

    /// Records the pressures at the end of a step of the search, and those of a peak inside it.
    fn note_between(&mut self, from: (f64, &Jet), to: (f64, &Jet)) {
        let arc = &self.arc;
        for b in &mut self.barriers {
            if b.phase != Phase::Touching {
                continue;
            }
            let (position, k, c, sign) = (b.position, b.stiffness, b.damping, -b.sign);
            let rate = |x: &Jet| sign * (k * x[1] + c * x[2]);
            if rate(from.1) > 0.0 && rate(to.1) < 0.0 {
                let peak = highest((from.0, to.0), |t| {
                    let x = arc.jet(t);
                    [sign * (k * (x[0] - position) + c * x[1]), rate(&x), sign * (k * x[2] + c * x[3])]
                });
                b.note(peak);
            }
            let sum = b.sum(to.1[0], to.1[1]);
            b.note(sum);
        }
    }
}

/// The gap times `sign`.
#[inline]
fn gap(b: &ExactWall, sign: f64, passes_touch: bool, jet: &Jet, bounds: &[f64; 2], noise: &[f64; 4]) -> Below {
    Below {
        c: [sign * (jet[0] - b.position), sign * jet[1], sign * jet[2], sign * jet[3]],
        fourth: sign * jet[4],
        bound: bounds[0],
        noise: *noise,
        passes_touch,
    }
}

/// The sum of spring and dashpot force times `sign`.
#[inline(never)]
fn sum(b: &ExactWall, sign: f64, jet: &Jet, bounds: &[f64; 2], noise: &[f64; 4]) -> Below {
    let at = |n: usize| -sign * (b.stiffness * jet[n] + b.damping * jet[n + 1]);
    let at0 = -sign * (b.stiffness * (jet[0] - b.position) + b.damping * jet[1]);
    let scale = |n: usize| b.stiffness * noise[n] + b.damping * noise[(n + 1).min(3)];
    Below {
        c: [at0, at(1), at(2), at(3)],
        fourth: 0.0,
        bound: b.stiffness * bounds[0] + b.damping * bounds[1],
        noise: [scale(0), scale(1), scale(2), scale(3)],
        passes_touch: true,
    }
}

/// The maximum of g in an interval in which g′ goes from + to −, by Newton's method on g′,
/// safeguarded by bisection. `jet` gives g, g′, g″.
fn highest((mut low, mut high): (f64, f64), jet: impl Fn(f64) -> [f64; 3]) -> f64 {
    let (mut t, mut best) = (0.5 * (low + high), f64::NEG_INFINITY);
    for _ in 0..PEAK_STEPS {
        let [g, rate, second] = jet(t);
        best = best.max(g);
        if rate > 0.0 {
            low = t
        } else {
            high = t
        }
        let newton = t - rate / second;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        // The function is flat at its peak: a displacement by 1e-9 of the interval changes it by
        // 1e-18 of its variation.
        if rate == 0.0 || (next - t).abs() <= 1e-9 * (high - low).max(t.abs() * f64::EPSILON) || next == t {
            return best.max(jet(next)[0]);
        }
        t = next;
    }
    best
}

#[cfg(test)]
mod tests;
