//! The assignment of oscillators to a group of lanes: which oscillator each lane computes ("the
//! guest in its seat"), since when, and what has been counted for it.

use super::lane::{Lane, LaneWall};
use super::outcome::{AtWall, By, Outcome, grown};
use super::rest::{Arrival, Release, Rest};
use super::series::{LaneConstants, REACH};
use super::state::{Constants, State};
use super::stretch::Ended;
use super::vector::Vector;
use pulp::Simd;

/// Maximum number of lanes.
pub(super) const SEATS: usize = 8;

/// Beyond this size, or below its inverse, the propagated change of the initial state is scaled.
const LARGE: f64 = 1e100;

/// An oscillator that the lanes support.
pub(super) struct LaneJob<'a> {
    /// Its number in the share of the batch.
    pub index: usize,
    pub lane: &'a Lane,
    pub series: LaneConstants,
}

/// The memory for the results.
pub(super) struct Results<'a> {
    /// One for each oscillator of the share; empty for an oscillator that could not be computed.
    pub outcomes: &'a mut [Option<Outcome>],
    /// `keep` for each.
    pub strobes: &'a mut [[f64; 2]],
    pub settle: u32,
    pub keep: u32,
}

/// The oscillator in a lane.
#[derive(Clone, Copy, Default)]
struct LaneSlot {
    /// Index of the oscillator; `None` if the lane is empty.
    of: Option<usize>,
    /// Periods completed.
    passed: u32,
    /// ln of the size of the change of the initial state when the window began, minus ln of the
    /// factors by which it was scaled down since.
    began: f64,
    /// The largest pressing acceleration of a rest so far in the window, m per step squared, per
    /// wall; 0 without a rest.
    peak: [f64; 2],
}

/// Counts per wall (lower, upper).
#[derive(Clone, Copy)]
struct Tally<S: Simd> {
    /// Impacts in the period.
    recent: Vector<S>,
    impacts: [Vector<S>; 2],
    /// Σ(1 + e)|w| and the largest term, m per step.
    impulse: [Vector<S>; 2],
    largest: [Vector<S>; 2],
}

/// A group of lanes.
pub(super) struct Group<S: Simd, const W: usize> {
    pub constants: Constants<S, W>,
    pub state: State<S, W>,
    /// 1 in lanes with an oscillator, 0 in the others.
    pub busy: Vector<S>,
    tally: Tally<S>,
    seats: [LaneSlot; SEATS],
}

impl<S: Simd, const W: usize> Group<S, W> {
    pub fn new(simd: S) -> Self {
        let zero = Vector::splat(simd, 0.0);
        let none = [zero; 2];
        Self {
            constants: Constants::new(simd),
            state: State::new(simd),
            busy: zero,
            tally: Tally { recent: zero, impacts: none, impulse: none, largest: none },
            seats: [LaneSlot::default(); SEATS],
        }
    }

    /// Counts the impacts of a stretch.
    #[inline(always)]
    pub fn count(&mut self, ended: &Ended<S>) {
        let tally = &mut self.tally;
        let (zero, one) = (tally.recent.all(0.0), tally.recent.all(1.0));
        for wall in 0..2 {
            let hit = ended.struck[wall];
            let count = hit.pick(one, zero);
            let impulse = hit.pick((one + self.constants.restitution[wall]) * ended.speed, zero);
            tally.recent = tally.recent + count;
            tally.impacts[wall] = tally.impacts[wall] + count;
            tally.impulse[wall] = tally.impulse[wall] + impulse;
            tally.largest[wall] = tally.largest[wall].max(impulse);
        }
        tally.recent = ended.strobed.pick(zero, tally.recent);
    }

    /// Impacts of each lane in its period.
    #[inline(always)]
    pub fn recent(&self) -> Vector<S> {
        self.tally.recent
    }

    /// Assigns the next oscillator to a lane, or leaves the lane empty. An oscillator that starts
    /// at rest on a wall, and stays there to its end or cannot be decided, is skipped.
    pub fn fill(&mut self, slot: usize, guests: &[LaneJob], next: &mut usize, results: &mut Results) {
        loop {
            let of = Some(*next).filter(|n| *n < guests.len());
            if let Some(seat) = self.seats.get_mut(slot) {
                *seat = LaneSlot { of, ..LaneSlot::default() };
            }
            self.busy.put(slot, f64::from(u8::from(of.is_some())));
            let Some(guest) = of.and_then(|n| guests.get(n)) else { return };
            *next += 1;
            self.sit(slot, guest);
            if results.settle == 0 {
                self.begin(slot);
            }
            let LaneJob { lane, .. } = guest;
            let at = |stop: Option<LaneWall>| stop.is_some_and(|s| s.position == lane.displacement);
            if lane.velocity != 0.0 || !(at(lane.lower) || at(lane.upper)) {
                return;
            }
            let wall = usize::from(!at(lane.lower));
            if !self.arrive(slot, wall, guests, results) {
                return;
            }
        }
    }

    fn sit(&mut self, slot: usize, LaneJob { lane, series, .. }: &LaneJob) {
        let (k, a) = (&mut self.constants, &mut self.state);
        k.put(slot, lane, series);
        a.t.put(slot, 0.0);
        a.u.put(slot, lane.displacement);
        a.w.put(slot, lane.velocity * series.step);
        for (wave, phase) in k.waves.iter().zip(&mut a.phase) {
            for (now, start) in phase.iter_mut().zip(&wave.start) {
                now.put(slot, start.get(slot));
            }
        }
        a.high.put(slot, k.upper.get(slot));
        a.low.put(slot, k.lower.get(slot));
        a.share.put(slot, 1.0);
        self.tally.recent.put(slot, 0.0);
        self.vary(slot);
    }

    /// Begins the change of the initial state: equal parts of displacement and velocity.
    fn vary(&mut self, slot: usize) {
        let [du, dw] = &mut self.state.tangent;
        du.put(slot, 1.0);
        dw.put(slot, REACH);
    }

    /// Begins the window of this lane, and the change anew if a rest has made it 0.
    fn begin(&mut self, slot: usize) {
        if self.size(slot) == 0.0 {
            self.vary(slot);
        }
        let tally = &mut self.tally;
        let all = [&mut tally.impacts, &mut tally.impulse, &mut tally.largest];
        all.into_iter().flatten().for_each(|x| x.put(slot, 0.0));
        let u = self.state.u.get(slot);
        self.state.high.put(slot, u);
        self.state.low.put(slot, u);
        let began = self.size(slot).ln();
        if let Some(seat) = self.seats.get_mut(slot) {
            (seat.began, seat.peak) = (began, [0.0; 2]);
        }
    }

    /// Size of the change of the initial state: displacement, and velocity over the fastest rate of
    /// the lane.
    fn size(&self, slot: usize) -> f64 {
        let [du, dw] = self.state.tangent;
        let (du, dw) = (du.get(slot), dw.get(slot) / REACH);
        (du * du + dw * dw).sqrt()
    }

    /// The body has reached the wall (0 lower, 1 upper) almost without speed: it leaves again, or
    /// rests until it is released. Returns true if the lane is free again, since the last period is
    /// over or the outcome is undecided.
    pub fn arrive(&mut self, slot: usize, wall: usize, guests: &[LaneJob], results: &mut Results) -> bool {
        let Some(LaneJob { lane, series, .. }) = self.guest(slot, guests) else { return true };
        let (stop, away) = if wall == 0 { (lane.lower, 1.0) } else { (lane.upper, -1.0) };
        let Some((LaneWall { position, .. }, restitution)) = stop.and_then(|s| Some((s, s.law.restitution()?))) else {
            return true;
        };
        let rest = Rest::new(series, away, position);
        let (mut t, speed) = (self.state.t.get(slot), self.state.w.get(slot).abs());
        match rest.arrival(t, speed, restitution, lane.length(), position) {
            Arrival::Flies => return false,
            Arrival::Unclear => return true,
            Arrival::Rests => {}
        }
        // The speed becomes 0, and the motion from here on does not depend on the motion before.
        if let Some(impulse) = self.tally.impulse.get_mut(wall) {
            impulse.put(slot, impulse.get(slot) - speed);
        }
        self.state.w.put(slot, 0.0);
        self.state.tangent.iter_mut().for_each(|x| x.put(slot, 0.0));
        let mut peak = 0.0_f64;
        loop {
            let release = rest.release(t, series.steps);
            let end = match release {
                Release::At(end) => end,
                Release::Later => series.steps,
                Release::Unclear => return true,
            };
            peak = peak.max(rest.highest(t, end));
            if let Some(impulse) = self.tally.impulse.get_mut(wall) {
                impulse.put(slot, impulse.get(slot) + rest.impulse(t, end));
            }
            self.note(slot, wall, peak);
            if release != Release::Later {
                self.lift(slot, end, series);
                return false;
            }
            t = 0.0;
            self.tally.recent.put(slot, 0.0);
            if self.strobe(slot, guests, results) {
                return true;
            }
        }
    }

    /// The oscillator in a lane.
    fn guest<'g, 'a>(&self, slot: usize, guests: &'g [LaneJob<'a>]) -> Option<&'g LaneJob<'a>> {
        guests.get(self.seats.get(slot)?.of?)
    }

    /// Records the pressing acceleration of a rest that reaches into the window.
    fn note(&mut self, slot: usize, wall: usize, peak: f64) {
        if let Some(known) = self.seats.get_mut(slot).and_then(|seat| seat.peak.get_mut(wall)) {
            *known = known.max(peak);
        }
    }

    /// Releases a body that rested up to `t` in its period.
    fn lift(&mut self, slot: usize, t: f64, series: &LaneConstants) {
        self.state.t.put(slot, t);
        for (wave, [sin, cos]) in series.waves.iter().zip(&mut self.state.phase) {
            let [s, c] = wave.at(t);
            sin.put(slot, s);
            cos.put(slot, c);
        }
    }

    /// Ends a period of this lane. Returns true if it was the last, or if the state became infinite
    /// or NaN.
    pub fn strobe(&mut self, slot: usize, guests: &[LaneJob], results: &mut Results) -> bool {
        let Some(LaneJob { index, lane, series }) = self.guest(slot, guests) else { return true };
        let (u, w) = (self.state.u.get(slot), self.state.w.get(slot));
        if !(u.is_finite() && w.is_finite()) {
            return true;
        }
        let size = self.size(slot);
        let Some(seat) = self.seats.get_mut(slot) else { return true };
        seat.passed += 1;
        let passed = seat.passed;
        if size > LARGE || (size > 0.0 && size < 1.0 / LARGE) {
            self.state.tangent.iter_mut().for_each(|x| x.put(slot, x.get(slot) / size));
            seat.began -= size.ln();
        }
        let Results { settle, keep, .. } = *results;
        if let Some(row) = passed.checked_sub(settle + 1)
            && let Some(strobe) = results.strobes.get_mut(index * keep as usize + row as usize)
        {
            *strobe = [u, w / series.step];
        }
        if passed == settle {
            self.begin(slot);
        }
        if passed < settle.saturating_add(keep) {
            return false;
        }
        let outcome = self.outcome(slot, lane, series, f64::from(keep) * lane.period);
        if let Some(place) = results.outcomes.get_mut(*index) {
            *place = outcome;
        }
        true
    }

    /// The result of the oscillator in a lane over a window of `length` (s).
    fn outcome(&self, slot: usize, lane: &Lane, series: &LaneConstants, length: f64) -> Option<Outcome> {
        let seat = self.seats.get(slot)?;
        let unit = lane.body.mass / series.step;
        let at = |wall: usize, sign: f64| AtWall {
            impacts: self.tally.impacts[wall].get(slot) as u64,
            impulse: sign * unit * self.tally.impulse[wall].get(slot),
            largest_impulse: unit * self.tally.largest[wall].get(slot),
            peak_force: Some(unit / series.step * seat.peak[wall]).filter(|peak| *peak > 0.0),
        };
        Some(Outcome {
            by: By::Lanes,
            lower: at(0, 1.0),
            upper: at(1, -1.0),
            extent: [self.state.low.get(slot), self.state.high.get(slot)],
            exponent: grown(seat.began, self.size(slot)) / length,
        })
    }
}
