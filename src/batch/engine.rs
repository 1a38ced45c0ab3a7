//! The lanes: each seat holds an oscillator until that is done, and then the next.

use super::lane::Lane;
use super::outcome::{AtWall, By, Outcome, grown};
use super::series::{REACH, Series};
use super::state::{Constants, State};
use super::stretch::Ended;
use super::vector::{Mask, Vector};
use pulp::{Simd, WithSimd};

/// Impacts in a period beyond which a lane is handed over: no motion of ordinary size has that
/// many.
const MOST_IMPACTS: f64 = 4096.0;

/// A share of a step below which a lane that cannot be decided is handed over: a graze to rounding.
const LEAST_SHARE: f64 = 1e-6;

/// Lanes at most.
const SEATS: usize = 8;

/// Beyond this size, or below its inverse, the carried change of the start is scaled.
const LARGE: f64 = 1e100;

/// Oscillators to follow, with at most `W` sines each.
pub(super) struct Engine<'a, const W: usize> {
    pub lanes: &'a [(usize, &'a Lane, Series)],
    /// Filled for each of the lanes that could be followed.
    pub outcomes: &'a mut [Option<Outcome>],
    /// `keep` for each of the lanes in turn, by the number that stands with it.
    pub strobes: &'a mut [[f64; 2]],
    pub settle: u32,
    pub keep: u32,
}

/// Who sits in a lane.
#[derive(Clone, Copy, Default)]
struct Seat {
    /// Index into the lanes; none if the seat is empty.
    of: Option<usize>,
    /// Periods passed.
    passed: u32,
    /// ln of the size of the change of the start when the window began, less what has been scaled
    /// out since.
    began: f64,
}

/// What is counted, per wall (lower, upper).
#[derive(Clone, Copy)]
struct Tally<S: Simd> {
    /// Impacts in the period.
    recent: Vector<S>,
    impacts: [Vector<S>; 2],
    /// Σ(1 + e)|w| and the largest, m a step.
    impulse: [Vector<S>; 2],
    largest: [Vector<S>; 2],
}

impl<S: Simd> Tally<S> {
    #[inline(always)]
    fn see<const W: usize>(&mut self, k: &Constants<S, W>, ended: &Ended<S>) {
        let [zero, one] = [0.0, 1.0].map(|x| self.recent.all(x));
        for wall in 0..2 {
            let hit = ended.struck[wall];
            let count = hit.pick(one, zero);
            let impulse = hit.pick((one + k.restitution[wall]) * ended.speed, zero);
            self.recent = self.recent + count;
            self.impacts[wall] = self.impacts[wall] + count;
            self.impulse[wall] = self.impulse[wall] + impulse;
            self.largest[wall] = self.largest[wall].max(impulse);
        }
        self.recent = ended.strobed.pick(zero, self.recent);
    }

    fn clear(&mut self, slot: usize) {
        let all = [&mut self.impacts, &mut self.impulse, &mut self.largest];
        all.into_iter().flatten().for_each(|x| x.put(slot, 0.0));
    }
}

impl<const W: usize> WithSimd for Engine<'_, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let zero = Vector::splat(simd, 0.0);
        let mut k = Constants::<S, W>::new(simd);
        let mut a = State::<S, W>::new(simd);
        let none = [zero; 2];
        let mut tally = Tally { recent: zero, impacts: none, impulse: none, largest: none };
        let mut seats = [Seat::default(); SEATS];
        let mut waiting = 0..self.lanes.len();
        let mut busy = zero;
        for (slot, seat) in seats.iter_mut().enumerate().take(S::F64_LANES) {
            self.seat(waiting.next(), slot, seat, &mut k, &mut a, &mut tally);
            busy.put(slot, f64::from(u8::from(seat.of.is_some())));
        }
        while seats.iter().any(|seat| seat.of.is_some()) {
            let active = busy.gt(zero);
            let mut held = !active;
            loop {
                let (b, stop) = k.march(&a);
                held = held | stop;
                a = a.or(held, &b);
                if held.every() {
                    break;
                }
            }
            let ended = k.stretch(&mut a, active);
            k.restart(&mut a, ended.strobed);
            tally.see(&k, &ended);
            let stuck = !a.share.gt(zero.all(LEAST_SHARE)) | tally.recent.gt(zero.all(MOST_IMPACTS));
            // An impact that leaves no speed begins a rest.
            let resting = (ended.struck[0] | ended.struck[1]) & a.w.abs().le(zero);
            let lost = active & (stuck | resting);
            let called = ended.strobed | lost;
            if !called.any() {
                continue;
            }
            let (called, lost) = (called.pick(zero.all(1.0), zero), lost.pick(zero.all(1.0), zero));
            for (slot, seat) in seats.iter_mut().enumerate().take(S::F64_LANES) {
                if called.get(slot) == 0.0 {
                    continue;
                }
                let over = lost.get(slot) != 0.0 || self.strobe(slot, seat, &mut a, &mut tally);
                if over {
                    self.seat(waiting.next(), slot, seat, &mut k, &mut a, &mut tally);
                    busy.put(slot, f64::from(u8::from(seat.of.is_some())));
                }
            }
        }
    }
}

impl<const W: usize> Engine<'_, W> {
    /// Puts the next oscillator into a lane, or leaves it empty.
    fn seat<S: Simd>(
        &self,
        next: Option<usize>,
        slot: usize,
        seat: &mut Seat,
        k: &mut Constants<S, W>,
        a: &mut State<S, W>,
        tally: &mut Tally<S>,
    ) {
        *seat = Seat { of: next, ..Seat::default() };
        let Some((_, lane, series)) = next.and_then(|n| self.lanes.get(n)) else { return };
        k.put(slot, lane, series);
        a.t.put(slot, 0.0);
        a.u.put(slot, lane.displacement);
        a.w.put(slot, lane.velocity * series.step);
        for (wave, phase) in k.waves.iter().zip(&mut a.phase) {
            for (now, start) in phase.iter_mut().zip(&wave.start) {
                now.put(slot, start.get(slot));
            }
        }
        // A change of displacement and velocity alike.
        a.tangent[0].put(slot, 1.0);
        a.tangent[1].put(slot, REACH);
        a.high.put(slot, k.upper.get(slot));
        a.low.put(slot, k.lower.get(slot));
        a.share.put(slot, 1.0);
        tally.recent.put(slot, 0.0);
        if self.settle == 0 {
            begin(slot, seat, a, tally);
        }
    }

    /// A period has ended in this lane: true if it was the last, or if the motion has left the
    /// numbers.
    fn strobe<S: Simd>(&mut self, slot: usize, seat: &mut Seat, a: &mut State<S, W>, tally: &mut Tally<S>) -> bool {
        let Some((index, lane, series)) = seat.of.and_then(|n| self.lanes.get(n)) else { return true };
        let (u, w) = (a.u.get(slot), a.w.get(slot));
        if !(u.is_finite() && w.is_finite()) {
            return true;
        }
        seat.passed += 1;
        let size = size(slot, a);
        if size > LARGE || (size > 0.0 && size < 1.0 / LARGE) {
            a.tangent.iter_mut().for_each(|x| x.put(slot, x.get(slot) / size));
            seat.began -= size.ln();
        }
        if let Some(row) = seat.passed.checked_sub(self.settle + 1)
            && let Some(strobe) = self.strobes.get_mut(index * self.keep as usize + row as usize)
        {
            *strobe = [u, w / series.step];
        }
        if seat.passed == self.settle {
            begin(slot, seat, a, tally);
        }
        if seat.passed < self.settle.saturating_add(self.keep) {
            return false;
        }
        let unit = lane.body.mass / series.step;
        let at = |wall: usize, sign: f64| AtWall {
            impacts: tally.impacts[wall].get(slot) as u64,
            impulse: sign * unit * tally.impulse[wall].get(slot),
            largest_impulse: unit * tally.largest[wall].get(slot),
            peak_force: None,
        };
        let length = f64::from(self.keep) * lane.period;
        let outcome = Outcome {
            by: By::Lanes,
            lower: at(0, 1.0),
            upper: at(1, -1.0),
            extent: [a.low.get(slot), a.high.get(slot)],
            exponent: grown(seat.began, self::size(slot, a)) / length,
        };
        if let Some(place) = self.outcomes.get_mut(*index) {
            *place = Some(outcome);
        }
        true
    }
}

/// The window begins in this lane.
fn begin<S: Simd, const W: usize>(slot: usize, seat: &mut Seat, a: &mut State<S, W>, tally: &mut Tally<S>) {
    tally.clear(slot);
    let u = a.u.get(slot);
    a.high.put(slot, u);
    a.low.put(slot, u);
    seat.began = size(slot, a).ln();
}

/// Size of the change of the start: displacement, and velocity over the fastest rate of the lane.
fn size<S: Simd, const W: usize>(slot: usize, a: &State<S, W>) -> f64 {
    let [du, dw] = [a.tangent[0].get(slot), a.tangent[1].get(slot) / REACH];
    (du * du + dw * dw).sqrt()
}

impl<S: Simd, const W: usize> State<S, W> {
    /// This state in the lanes that are `held`, `b` in the others.
    #[inline(always)]
    fn or(&self, held: Mask<S>, b: &Self) -> Self {
        let pick = |x, y| held.pick(x, y);
        Self {
            t: pick(self.t, b.t),
            u: pick(self.u, b.u),
            w: pick(self.w, b.w),
            phase: std::array::from_fn(|i| std::array::from_fn(|j| pick(self.phase[i][j], b.phase[i][j]))),
            tangent: std::array::from_fn(|i| pick(self.tangent[i], b.tangent[i])),
            ..*self
        }
    }
}
