//! What happens at one instant: blows, impacts, sticking, release, and the contact of elastic walls
//! beginning or ending.

use super::Event;
use super::gap_bounds::GapBounds;
use crate::scene::Side;
use crate::scheme::exact::{Phase, TAIL_CHANGE, TAIL_HEIGHT, TIME_UNITS, noise};

impl Event {
    /// Handles everything that happens at the present instant; `hit` is the wall of the event that
    /// ended the arc. True if the velocity jumped or a wall's phase changed.
    pub(super) fn resolve_instant(&mut self, hit: Option<usize>, extra: f64) -> bool {
        let left = self.v;
        while let Some(&(_, impulse)) = self.forcing.impulses.get(self.blow).filter(|b| b.0 <= self.time) {
            self.v += impulse / self.body.mass;
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
                // The rest ends before the blow, and what the blow does at the wall is a new
                // impact.
                self.support = None;
                let time = self.time;
                if let Some(b) = self.barriers.get_mut(index) {
                    self.shown.closed.extend(b.close(time, 0.0));
                }
                self.resolve_rigid(None, extra, None);
            } else {
                self.resolve_rigid(hit, extra, Some(index));
            }
        } else {
            if let Some(index) = hit {
                self.cross(index);
            }
            // After a blow the velocity is not taken for rounding.
            self.resolve_rigid(hit.filter(|_| !blown), extra, None);
        }
        if self.v != left {
            self.reclassify();
        }
        true
    }

    /// Moves an elastic wall into its next phase, and puts the body exactly on the surface if it is
    /// there.
    fn cross(&mut self, index: usize) {
        let (q, v, time, resolution) = (self.q, self.v, self.time, self.resolution);
        let Some(b) = self.barriers.get_mut(index) else { return };
        if matches!(b.phase, Phase::Rigid(_)) {
            self.q = b.position;
            return;
        }
        if b.cross((q, v), resolution, time) {
            self.q = b.position;
        }
        b.settle(index, time, v, &mut self.shown.closed);
        self.room = GapBounds::between(&self.barriers);
    }

    /// Updates the phases after a jump of velocity, which may begin or end the contact at elastic
    /// walls with damping.
    pub(super) fn reclassify(&mut self) {
        if !self.soft {
            return;
        }
        let (q, v, time, resolution) = (self.q, self.v, self.time, self.resolution);
        for (index, b) in self.barriers.iter_mut().enumerate() {
            b.classify(q, v, resolution);
            b.settle(index, time, v, &mut self.shown.closed);
        }
        self.room = GapBounds::between(&self.barriers);
    }

    /// Handles the rigid walls that touch: Newton's law for an approach, otherwise sticking or
    /// leaving. `held` is the wall that has carried the body so far.
    ///
    /// For several closed walls on one side, Newton's law reads ẇ⁺ + e ẇ⁻ ≥ 0 for each, so the
    /// largest e decides, and the first wall that has it takes the impulse. Closed walls on both
    /// sides hold the body in place.
    fn resolve_rigid(&mut self, hit: Option<usize>, extra: f64, held: Option<usize>) {
        // In one piece, the decisions of one instant: each needs those above it.
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
        } else if hit.is_some_and(|h| closed.contains(&Some(h))) && held.is_none() {
            // Touched with a velocity within rounding of 0: it is set to 0 if the body is pressed
            // onto the wall.
            let away = if hit == closed[0] { 1.0 } else { -1.0 };
            if self.acceleration(self.v, extra)[0] * away <= 0.0 {
                self.v = 0.0;
            }
        }
        let carrier = struck.or(held).or(hit).filter(|i| closed.contains(&Some(*i))).unwrap_or(first);
        let mut next = if self.v == 0.0 { self.pressed(closed, carrier, extra) } else { None };
        if held.is_some() && held == hit && next == held {
            // The force of this wall has just vanished, so only a wall on the other side could hold
            // the body.
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

    /// The wall that carries a body of velocity 0: one on the side to which it is pressed, `None`
    /// if it lifts off. `carrier` is kept where neither side is pressed.
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

    /// True if the flight that starts now with the present velocity, away from a wall, is the tail
    /// of an accumulation or too short to be resolved in double precision.
    ///
    /// Sticking at once removes the momentum and the energy of the whole tail: the impulses of its
    /// impacts sum up to m p (t∞ − t), with p the steady pressing acceleration. The displacement is
    /// off by less than the height of the flight, and t∞ is kept for callers.
    fn sticks(&mut self, away: f64, e: f64, extra: f64) -> bool {
        let speed = self.v.abs();
        // An upper bound of the pressing acceleration: most flights are far too high for a tail,
        // and need no closer look.
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

    /// True if drag makes the impacts die out, at any restitution, from this speed (m/s) on under
    /// this pressing acceleration (m/s²), before the load can have removed half of that
    /// acceleration.
    ///
    /// A flight of speed u loses the speed 2cu²/3mp in the time 2u/p: the impacts never end, but
    /// decay like exp(−ct/3m) until they are not resolved.
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

#[cfg(test)]
mod tests;
