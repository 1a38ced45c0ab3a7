//! A periodic orbit: its events, and when and how fast each of them happens.

use super::signature::{Event, Kind, Signature};

/// A solved orbit repeats a shorter one if its parts differ by less than this, and is symmetric if
/// its second half differs by less from the mirror image of the first. Newton's method leaves 1e-9
/// of the gap at most, of which a nearly grazing impact makes a larger error of its speed. Beside a
/// period doubling, where an orbit differs from that of half its period by the root of the distance
/// to it, this is a distance of 1e-14 of the key's value.
pub(super) const REPEATED: f64 = 1e-7;

/// Most of a contact that a flight before it takes where that vanishes.
const MERGED: f64 = 1e-2;

/// Two successive parts of an orbit that differ by less than this are the same.
const SAME: f64 = 1e-5;

/// A periodic orbit, given by its events: with one degree of freedom they determine it.
#[derive(Debug, Clone, PartialEq)]
pub struct Orbit {
    /// Its events in order, its forcing periods and its symmetry.
    pub signature: Signature,
    /// The instant of each event, in cycles of the forcing period from t = 0; increasing.
    pub phases: Vec<f64>,
    /// The speed of each event (see [`Kind`](super::Kind)), m/s; below 0 for an orbit that comes
    /// from behind the wall there, which no body can follow.
    pub speeds: Vec<f64>,
    /// The forcing period, s.
    pub forcing_period: f64,
}

impl Orbit {
    /// The period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        f64::from(self.signature.periods) * self.forcing_period
    }

    /// The instant of the event after number `index`, which may fall into the next period, in
    /// cycles of the forcing period from t = 0.
    pub(super) fn next_phase(&self, index: usize) -> f64 {
        self.phases.get(index + 1).copied().unwrap_or_else(|| self.phases[0] + self.signature.cycles())
    }

    /// The same orbit with all of its events: the mirror half of a symmetric one added. `mirror` is
    /// the wall opposite to each wall.
    pub(super) fn unfolded(&self, mirror: Option<&[usize]>) -> Self {
        let (true, Some(mirror)) = (self.signature.symmetric, mirror) else { return self.clone() };
        let mut whole = self.clone();
        whole.signature.symmetric = false;
        for (index, event) in self.signature.events.iter().enumerate() {
            let wall = mirror.get(event.wall).copied().unwrap_or(event.wall);
            whole.signature.events.push(Event { wall, ..*event });
            whole.phases.extend(self.phases.get(index).map(|phase| phase + self.signature.cycles()));
            whole.speeds.extend(self.speeds.get(index));
        }
        whole
    }

    /// The same orbit written with twice its period: the start of a branch of period-doubled
    /// orbits.
    pub(super) fn doubled(&self) -> Self {
        let mut twice = self.clone();
        twice.signature.periods *= 2;
        twice.signature.events.extend_from_slice(&self.signature.events);
        twice.phases.extend(self.phases.iter().map(|phase| phase + self.signature.cycles()));
        twice.speeds.extend_from_slice(&self.speeds);
        twice
    }

    /// True if both have the same events, instants within `near` cycles (after whole forcing
    /// periods) and speeds within `near` of the largest, in this order.
    pub(super) fn near(&self, other: &Self, near: f64) -> bool {
        let top = self.speeds.iter().fold(0.0_f64, |top, v| top.max(v.abs()));
        let later = self.phases.first().zip(other.phases.first()).map_or(0.0, |(a, b)| (a - b).round());
        let close = |(a, b): (&f64, &f64), scale: f64| (a - b).abs() <= near * scale;
        self.signature.events == other.signature.events
            && self.phases.iter().zip(&other.phases).all(|(a, b)| close((a, &(b + later)), 1.0))
            && self.speeds.iter().zip(&other.speeds).all(|pair| close(pair, top))
    }

    /// The same orbit listed from its event `first` on; this event falls into the first `within`
    /// forcing periods.
    pub(super) fn rotated(&self, first: usize, within: u32) -> Self {
        let count = self.phases.len();
        if count == 0 {
            return self.clone();
        }
        let first = first % count;
        let mut orbit = self.clone();
        orbit.signature.events.rotate_left(first);
        orbit.speeds.rotate_left(first);
        orbit.phases.rotate_left(first);
        let turn = self.signature.cycles();
        let within = f64::from(within);
        let start = orbit.phases.first().map_or(0.0, |phase| (phase / within).floor() * within);
        for (index, phase) in orbit.phases.iter_mut().enumerate() {
            *phase += if index + first >= count { turn } else { 0.0 } - start;
        }
        orbit
    }

    /// The first half of the orbit, if the other half is its mirror image: instants within `near`
    /// cycles and speeds within `near` of the largest. `mirror` is the wall opposite to each wall.
    pub(super) fn folded(&self, mirror: Option<&[usize]>, near: f64) -> Option<Self> {
        mirror?;
        let signature = &self.signature;
        let count = signature.events.len();
        if !count.is_multiple_of(2) || signature.periods.is_multiple_of(2) || signature.symmetric {
            return None;
        }
        let half = self.first(count / 2, signature.periods, true)?;
        half.unfolded(mirror).is(self, near).then_some(half)
    }

    /// The shortest orbit that this one repeats a whole number of times: instants within `near`
    /// cycles and speeds within `near` of the largest; `None` if it repeats none.
    pub(super) fn repeated(&self, near: f64) -> Option<Self> {
        let signature = &self.signature;
        let count = signature.events.len();
        if count == 0 || signature.symmetric {
            return None;
        }
        let divides = |turns: &u32| signature.periods.is_multiple_of(*turns) && count.is_multiple_of(*turns as usize);
        (2..=signature.periods).rev().filter(divides).find_map(|turns| {
            let part = count / turns as usize;
            self.first(part, signature.periods / turns, false).filter(|_| self.rotated(part, 1).near(self, near))
        })
    }

    /// The orbit of the first `count` events, over `periods` forcing periods.
    pub(super) fn first(&self, count: usize, periods: u32, symmetric: bool) -> Option<Self> {
        Some(Self {
            signature: Signature { events: self.signature.events.get(..count)?.to_vec(), periods, symmetric },
            phases: self.phases.get(..count)?.to_vec(),
            speeds: self.speeds.get(..count)?.to_vec(),
            forcing_period: self.forcing_period,
        })
    }

    /// Adds an event, which becomes event number `index`.
    pub(super) fn insert(&mut self, index: usize, event: Event, phase: f64, speed: f64) {
        self.signature.events.insert(index, event);
        self.phases.insert(index, phase);
        self.speeds.insert(index, speed);
    }

    /// Leaves out event number `index`.
    pub(super) fn remove(&mut self, index: usize) {
        self.signature.events.remove(index);
        self.phases.remove(index);
        self.speeds.remove(index);
    }

    /// The orbit without the flight before the contact that event number `entry` begins, where the
    /// contact before it is with the same elastic wall and that flight is of at most [`MERGED`] of
    /// the contact: the two are one where its duration is 0. `None` at another event.
    pub(super) fn merged(&self, entry: usize) -> Option<Self> {
        let count = self.phases.len();
        let exit = (entry + count).checked_sub(1)? % count;
        let [before, after] = [*self.signature.events.get(exit)?, *self.signature.events.get(entry)?];
        let same = before.kind == Kind::Leave && before.wall == after.wall && count > 2;
        let wraps = exit > entry;
        let flight = self.next_phase(exit) - self.phases.get(exit)?;
        let contact = self.next_phase(entry) - self.phases.get(entry)?;
        if !same || flight > MERGED * contact || (wraps && self.signature.symmetric) {
            return None;
        }
        let mut merged = self.clone();
        merged.remove(entry.max(exit));
        merged.remove(entry.min(exit));
        // Contacts begin with their entry.
        Some(if wraps { merged.rotated(1, merged.signature.periods) } else { merged })
    }

    /// The shortest orbit that this one repeats, with false; or the half whose mirror image is the
    /// other half, with true.
    pub(super) fn part(&self, mirror: Option<&[usize]>) -> Option<(Self, bool)> {
        self.part_within(mirror, SAME)
    }

    /// The same with instants within `near` cycles and speeds within `near` of the largest.
    pub(super) fn part_within(&self, mirror: Option<&[usize]>, near: f64) -> Option<(Self, bool)> {
        let once = self.repeated(near).map(|once| (once, false));
        once.or_else(|| self.folded(mirror, near).map(|half| (half, true)))
    }

    /// True if both are the same orbit, whichever event they begin with: all instants within `near`
    /// cycles and all speeds within `near` of the largest. Both must be unfolded.
    pub(super) fn is(&self, other: &Self, near: f64) -> bool {
        let count = self.phases.len();
        if count != other.phases.len() || self.signature.periods != other.signature.periods {
            return false;
        }
        let (turn, top) = (self.signature.cycles(), self.speeds.iter().fold(0.0_f64, |top, v| top.max(v.abs())));
        let apart = |a: f64, b: f64| {
            let cycles = a - b;
            (cycles - (cycles / turn).round() * turn).abs()
        };
        // Orbits shifted by whole forcing periods are the same, too.
        let same = |shift: usize, later: u32| {
            (0..count).all(|i| {
                let j = (i + shift) % count;
                self.signature.events.get(i) == other.signature.events.get(j)
                    && apart(self.phases[i] + f64::from(later), other.phases[j]) <= near
                    && (self.speeds[i] - other.speeds[j]).abs() <= near * top
            })
        };
        count == 0 || (0..count).any(|shift| (0..self.signature.periods).any(|later| same(shift, later)))
    }
}
