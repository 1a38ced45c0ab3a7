//! What happens in an instant: blows, impacts, sticking, release, entry into elastic walls and letting go.

use super::Event;
use crate::scene::Side;
use crate::scheme::exact::{Phase, noise};

/// A flight after an impact is the tail of an accumulation if it is lower than this share of the scene's length …
const TAIL_HEIGHT: f64 = 1e-12;

/// … and if the pressing acceleration will change by less than this share until the impacts have accumulated: then
/// t∞ = t + flight/(1 − e) has that relative error.
const TAIL_CHANGE: f64 = 1e-6;

/// A flight of fewer units in the last place of the time than this is not resolved.
const TIME_UNITS: f64 = 8.0;

impl Event {
    /// Everything that happens at the present instant, to which `hit` has brought the body. True if the velocity jumped
    /// or a wall's phase changed.
    pub(super) fn happen(&mut self, hit: Option<usize>, extra: f64) -> bool {
        let left = self.v;
        while let Some(&(time, impulse)) = self.forcing.impulses.get(self.blow).filter(|b| b.0 <= self.time) {
            // Blows at t = 0 are part of the start.
            if time > 0.0 {
                self.v += impulse / self.body.mass;
            }
            self.blow += 1;
        }
        let blown = self.v != left;
        if hit.is_none() && !blown {
            return false;
        }
        self.clock.count().events += 1;
        self.clock.last_wall = hit.or(self.clock.last_wall);
        if let Some(index) = self.support {
            if blown {
                // The rest ends before the blow: what the blow does at the wall is an impact of its own.
                self.support = None;
                let time = self.time;
                if let Some(b) = self.barriers.get_mut(index) {
                    self.shown.closed.extend(b.close(time, 0.0));
                }
                self.meet_rigid(None, extra, None);
            } else {
                if hit == Some(index) {
                    self.support = None;
                }
                self.meet_rigid(hit, extra, Some(index));
            }
        } else {
            if let Some(index) = hit {
                self.cross(index);
            }
            // A blow leaves no velocity that is rounding.
            self.meet_rigid(hit.filter(|_| !blown), extra, None);
        }
        if self.v != left {
            self.reclassify();
        }
        true
    }

    /// Moves an elastic wall into its next phase and sets the body onto the surface it has reached.
    fn cross(&mut self, index: usize) {
        let (q, v, time, resolution) = (self.q, self.v, self.time, self.resolution);
        let Some(b) = self.barriers.get_mut(index) else { return };
        let at_surface = b.gap(q).abs() <= resolution;
        if matches!(b.phase, Phase::Rigid(_)) {
            self.q = b.position;
            return;
        }
        if b.cross(at_surface, time) {
            self.q = b.position;
        }
        b.settle(index, time, v, &mut self.shown.closed);
    }

    /// After a jump of velocity: elastic walls with damping may let go or take hold.
    pub(super) fn reclassify(&mut self) {
        let (q, v, time, resolution) = (self.q, self.v, self.time, self.resolution);
        for (index, b) in self.barriers.iter_mut().enumerate() {
            b.classify(q, v, resolution);
            b.settle(index, time, v, &mut self.shown.closed);
        }
    }

    /// Rigid walls that touch: Newton's law for an approach, sticking or leaving else. `held` carried the body so far.
    ///
    /// Of several closed walls on one side, Newton's law holds as ẇ⁺ + e ẇ⁻ ≥ 0 for each, so the largest e decides, and
    /// the first wall that has it takes the impulse. Closed walls on both sides hold the body fast.
    fn meet_rigid(&mut self, hit: Option<usize>, extra: f64, held: Option<usize>) {
        let resolution = self.resolution;
        let side = if self.v < 0.0 { Side::Lower } else { Side::Upper };
        let (mut struck, mut restitution) = (None, -1.0);
        let (mut closed, mut first) = ([None, None], None);
        for (index, b) in self.barriers.iter().enumerate() {
            let Phase::Rigid(e) = b.phase else { continue };
            if b.gap(self.q) > resolution && hit != Some(index) {
                continue;
            }
            let slot = usize::from(b.side == Side::Upper);
            if closed[slot].is_none() {
                closed[slot] = Some(index);
            }
            first = first.or(Some(index));
            if b.side == side && self.v != 0.0 && e > restitution {
                (struck, restitution) = (Some(index), e);
            }
        }
        let Some(first) = first else { return };
        let caught = closed[0].is_some() && closed[1].is_some();
        let before = self.v;
        if let Some(index) = struck {
            self.clock.count().impacts += 1;
            let e = if caught { 0.0 } else { restitution };
            self.v = if e > 0.0 { -e * before } else { 0.0 };
            let away = -before.signum();
            if e > 0.0 && self.sticks(away, e, extra) {
                self.v = 0.0;
            }
            let impulse = self.body.mass * (self.v - before);
            if let Some(jump) = self.shown.jump.get_mut(index) {
                *jump += impulse;
            }
            self.reclassify();
            let (time, speed) = (self.time, away * self.v);
            let supports = self.v == 0.0 && self.pressed(closed, index, extra) == Some(index);
            if let Some(b) = self.barriers.get_mut(index) {
                b.open(index, time, before.abs());
                if let Some(open) = &mut b.open {
                    open.impulse += impulse;
                }
                if !supports {
                    self.shown.closed.extend(b.close(time, speed));
                }
            }
        } else if hit.is_some_and(|h| closed.contains(&Some(h))) && self.support.is_none() && held.is_none() {
            // Touched with a velocity that is rounding: it counts as none if the body is pressed.
            let away = if hit == closed[0] { 1.0 } else { -1.0 };
            if self.acceleration(self.v, extra)[0] * away <= 0.0 {
                self.v = 0.0;
            }
        }
        let carrier = struck.or(held).or(hit).filter(|i| closed.contains(&Some(*i))).unwrap_or(first);
        let mut next = if self.v == 0.0 { self.pressed(closed, carrier, extra) } else { None };
        if held.is_some() && held == hit && next == held {
            // The force of this wall has just vanished: only one behind the body could hold it.
            next = if caught { closed.into_iter().flatten().find(|&w| Some(w) != held) } else { None };
        }
        if let Some(old) = held.filter(|&old| next != Some(old)) {
            let (time, v) = (self.time, self.v);
            if let Some(b) = self.barriers.get_mut(old) {
                self.shown.closed.extend(b.close(time, b.sign * v));
            }
        }
        self.support = next;
        if next.is_none() && self.v == 0.0 {
            self.released = self.time;
        }
    }

    /// The wall that carries a body without velocity: on the side to which it is pressed, none if it is lifted.
    /// `carrier` is kept where nothing presses either way.
    fn pressed(&self, closed: [Option<usize>; 2], carrier: usize, extra: f64) -> Option<usize> {
        let [a, rate] = self.acceleration(0.0, extra);
        let size = self.force_size;
        let push = if a.abs() > noise(size[0]) { a } else { 0.0 };
        let push = if push == 0.0 && rate.abs() > noise(size[1]) { rate } else { push };
        let side = self.barriers.get(carrier).map(|b| b.side)?;
        let on = |slot: usize| closed[slot].map(|w| if usize::from(side == Side::Upper) == slot { carrier } else { w });
        if push < 0.0 {
            on(0)
        } else if push > 0.0 {
            on(1)
        } else if self.curvature() * side.sign() > 0.0 && !(closed[0].is_some() && closed[1].is_some()) {
            None
        } else {
            Some(carrier)
        }
    }

    /// True if the flight that starts now with the present velocity, away from a wall, is the tail of an accumulation or
    /// below what double precision resolves.
    ///
    /// Sticking at once takes the momentum and the energy of the whole tail: m p (t∞ − t) of steady pressing is what its
    /// impacts sum up to. The body is displaced by less than the height, and t∞ is kept for who asks.
    fn sticks(&mut self, away: f64, e: f64, extra: f64) -> bool {
        let speed = self.v.abs();
        // What presses is at most this; a flight far too high then needs no closer look.
        let most = self.force_size[0] + self.body.damping * speed / self.body.mass;
        let (low, short) = (TAIL_HEIGHT * self.length + self.resolution, TIME_UNITS * f64::EPSILON * self.time);
        if !self.arc.touches() && speed * speed > 4.0 * most * low && speed > most * short {
            return false;
        }
        let [a, rate] = self.acceleration(self.v, extra);
        let press = -away * a;
        if press <= noise(self.force_size[0]) {
            return false;
        }
        let (height, flight) = (0.5 * speed * speed / press, 2.0 * speed / press);
        if height <= self.resolution || flight <= TIME_UNITS * f64::EPSILON * self.time {
            return true;
        }
        if height >= TAIL_HEIGHT * self.length {
            return false;
        }
        let remaining = flight / (1.0 - e);
        let body = self.body;
        let change = rate.abs() + (body.damping * a.abs() + body.stiffness * speed) / body.mass;
        if change * remaining <= TAIL_CHANGE * press {
            self.accumulation = Some(self.time + remaining);
            return true;
        }
        self.dies_of_drag(speed, press)
    }

    /// True if drag ends the impacts from this speed (m/s) on under this pressing acceleration (m/s²), at any restitution,
    /// before the load can have taken half of it away.
    ///
    /// A flight of speed u loses 2cu²/3mp in the time 2u/p: the impacts never end, but die like exp(−ct/3m) into what is
    /// not resolved.
    fn dies_of_drag(&self, speed: f64, press: f64) -> bool {
        let (mass, [.., rate]) = (self.body.mass, self.sizes);
        let least = (2.0 * press * self.resolution).sqrt().max(0.5 * press * TIME_UNITS * f64::EPSILON * self.time);
        let remaining = 3.0 * mass / self.body.damping * (speed / least).ln().max(0.0);
        let (mut drag, mut spring) = (self.body.damping, self.body.stiffness);
        for b in &self.barriers {
            drag += b.damping;
            spring += b.stiffness;
        }
        let change = rate * remaining + drag * speed + spring * 0.5 * speed * speed / press;
        change <= 0.5 * press * mass
    }
}
