//! The motion of the body between events: its arc, the forces on it, and the impulses of the walls.

use super::Event;
use crate::flow::{Start, Support};
use crate::scene::Oscillator;
use crate::scheme::exact::{Phase, noise};

/// A motion below this share of the largest so far counts as rest: ε², far below the rounding of a
/// sum of the two.
const FADED: f64 = f64::EPSILON * f64::EPSILON;

impl Event {
    /// True for a state that has decayed to [`FADED`] of the largest motion so far.
    pub(super) fn has_faded(&self, [q, v]: [f64; 2]) -> bool {
        q.abs() <= FADED * self.largest[0] && v.abs() <= FADED * self.largest[1]
    }

    /// Sets a motion that has decayed to rest at the origin: only around 0 could numbers resolve it
    /// further.
    fn fade(&mut self) {
        self.largest = [self.largest[0].max(self.q.abs()), self.largest[1].max(self.v.abs())];
        if self.support.is_none() && self.has_faded([self.q, self.v]) {
            [self.q, self.v] = [0.0, 0.0];
        }
    }

    pub(super) fn begin_arc(&mut self, span: f64, extra: f64) {
        self.fade();
        let from = Start {
            time: self.time,
            late: self.late,
            state: [self.q, self.v],
            forcing: &self.forcing,
            extra,
            span,
            length: self.length,
        };
        let soft = if self.soft { &self.barriers[..] } else { &[] };
        let touching = soft.iter().enumerate().filter_map(|(index, b)| b.touch(index));
        let support = self.support.and_then(|wall| Some(Support { wall, side: self.barriers.get(wall)?.side }));
        self.arc.begin(&from, touching, support);
        let sizes = self.arc.sizes();
        let [q, _, force, rate] = sizes;
        self.resolution = noise(q + self.farthest);
        self.sizes = sizes;
        // The instant itself is known only to an ulp of the time.
        let (mass, fastest) = (self.body.mass, self.arc.fastest());
        let size = (force + rate * self.time) / mass;
        self.force_size = [size, rate * (1.0 + fastest * self.time) / mass + self.body.damping / mass * size];
        self.take_up(noise(size * mass));
    }

    /// Begins the episode of the wall that carries the body, or ends it where nothing presses: a
    /// contact exists only where a force acts.
    fn take_up(&mut self, least: f64) {
        let Some((index, b)) = self.support.and_then(|i| self.barriers.get_mut(i).map(|b| (i, b))) else { return };
        if self.arc.is_unpressed(least) {
            self.shown.closed.extend(b.close(self.time, 0.0));
        } else {
            b.open(index, self.time, 0.0);
        }
    }

    /// Adds the impulses of the arc just completed to the step and to the open episodes.
    pub(super) fn gather_impulses(&mut self) {
        if self.support.is_none() && !self.arc.touches() {
            return;
        }
        let (from, to) = (self.arc.start(), self.arc.end());
        for (index, b) in self.barriers.iter_mut().enumerate() {
            // A wall that carries the body without an episode does not push.
            if (self.support == Some(index) && b.open.is_some()) || b.phase == Phase::Touching {
                let impulse = self.arc.contact_impulse(index, from, to);
                if let Some(total) = self.shown.impulse.get_mut(index) {
                    *total += impulse;
                }
                if let Some(open) = &mut b.open {
                    open.impulse += impulse;
                }
            }
        }
    }

    /// Acceleration (m/s²) of the body here at velocity `v`, without rigid walls, from the right of
    /// the present; and the rate (m/s³) at which the load changes it.
    pub(super) fn acceleration(&self, v: f64, extra: f64) -> [f64; 2] {
        let Oscillator { mass, damping, stiffness } = self.body;
        let (f, rate) = self.load_now();
        let mut sum = f + extra - damping * v - stiffness * self.q;
        for b in self.barriers.iter().filter(|b| !matches!(b.phase, Phase::Rigid(_)) && b.gap(self.q) < 0.0) {
            sum += b.sign * b.sum(self.q, v).max(0.0);
        }
        [sum / mass, rate / mass]
    }

    /// Load (N) from the right and its rate (N/s), without the extra force.
    fn load_now(&self) -> (f64, f64) {
        let (mut f, mut rate) = (self.forcing.constant, 0.0);
        for h in &self.forcing.harmonics {
            let (s, c) = (h.omega * self.time + h.phase + h.omega * self.late).sin_cos();
            f += h.amplitude * s;
            rate += h.amplitude * h.omega * c;
        }
        for table in &self.forcing.tables {
            let (value, slope) = table.piece(self.time);
            f += value + slope * self.late;
            rate += slope;
        }
        (f, rate)
    }

    /// f″/m at the present, m/s⁴, which decides where force and rate vanish.
    pub(super) fn curvature(&self) -> f64 {
        let second = |h: &crate::scene::Harmonic| {
            -h.amplitude * h.omega * h.omega * (h.omega * self.time + h.phase).sin() / self.body.mass
        };
        let sum: f64 = self.forcing.harmonics.iter().map(second).sum();
        let size: f64 = self.forcing.harmonics.iter().map(|h| h.amplitude.abs() * h.omega * h.omega).sum();
        if sum.abs() > noise(size / self.body.mass) { sum } else { 0.0 }
    }

    pub(super) fn set_forces(&mut self, extra: f64) {
        let push = if self.support.is_some() { -self.acceleration(0.0, extra)[0] } else { 0.0 };
        let push = if push.abs() > noise(self.force_size[0]) { self.body.mass * push } else { 0.0 };
        for (index, b) in self.barriers.iter().enumerate() {
            let Some(force) = self.shown.force.get_mut(index) else { continue };
            *force = if self.support == Some(index) {
                b.sign * (b.sign * push).max(0.0)
            } else if b.phase == Phase::Touching {
                b.sign * b.sum(self.q, self.v).max(0.0)
            } else {
                0.0
            };
        }
    }
}

#[cfg(test)]
mod tests;
