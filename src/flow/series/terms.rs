//! The terms of a series, by recurrence.

use super::circle::Circle;
use super::wave::Wave;
use super::{Acting, HeldRows, Series, SeriesBody, TERMS};

/// The start of a series.
pub(crate) struct Start<'a> {
    /// Time, s.
    pub time: f64,
    /// Displacement, m, and velocity, m/s, n entries each.
    pub q: &'a [f64],
    pub v: &'a [f64],
    /// A constant force in addition to the loads, N, n entries.
    pub extra: &'a [f64],
    /// The latest end of the stretch, s.
    pub until: f64,
    /// The time within which an event is expected to end it, s; infinite if none is. The stretch
    /// may be as short as that: it then takes fewer terms.
    pub reach: f64,
}

/// An elastic wall that touches.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touching {
    pub wall: usize,
    pub row: usize,
    /// Its position g, m.
    pub position: f64,
    /// k_a, N/m.
    pub stiffness: f64,
    /// c_a, N s/m.
    pub damping: f64,
}

/// Length of the longest stretch, in radians of the fastest motion: no term of its series is more
/// than twice the motion.
const RADIANS: f64 = 2.0;

/// The same in a scene with round holes: |w|² has twice the rate of w, and with 2 radians the first
/// term that the product leaves out would be 4³²/32! = 7e-17 of it; this makes it 7e-21.
const ROUND_RADIANS: f64 = 1.5;

/// However soon an event is expected, a stretch is not made shorter than this share of the longest:
/// its series has hardly more terms than [`FEWEST`] then.
const LEAST_REACH: f64 = 1.0 / 256.0;

/// The series ends where a term of the acceleration is below this share of the first.
const LAST: f64 = 1e-18;

/// Minimum number of terms, so that oscillations of the load are included besides its constant and
/// ramp.
pub(super) const FEWEST: usize = 8;

/// If the last term is above this share of the largest, the fastest rate was underestimated and the
/// stretch is cut.
const TRUNCATION: f64 = 1e-16;

/// The same for a stretch along a circle. Its series is that of elliptic functions, whose terms
/// fall geometrically, so that the sum of all terms left out is at most twice this.
const ROUND_TRUNCATION: f64 = 2e-17;

/// With a larger acceleration over γ, in units of the stretch, a series along a circle is begun
/// again with a shorter one.
const MOST_BEND: f64 = 16.0;

/// The largest term of the motion at a round hole over a stretch, in γ: the structure may cross the
/// hole within it.
const MOST_TRAVEL: f64 = 2.0;

/// A stretch is not cut below this share of the time at which it starts: it would not end later.
const SHORTEST: f64 = 16.0 * f64::EPSILON;

impl Series {
    /// A series of length 0, to be filled by [`Series::begin`].
    pub(crate) fn new(body: &SeriesBody) -> Self {
        let (n, rows, walls) = (body.n, body.rows.count(), body.row_of.len());
        let waves = body.loads.iter().map(|(_, forcing)| forcing.harmonics.len()).sum();
        Self {
            n,
            start: 0.0,
            end: 0.0,
            unit: 1.0,
            terms: 1,
            motion: vec![0.0; n * TERMS],
            seen: vec![0.0; rows * TERMS],
            round_walls: body.rounds.iter().map(|round| round.wall).collect(),
            fixed: body.fixed,
            squares: 1,
            circles: body.rounds.iter().map(|round| Circle::new(round.gap, TERMS)).collect(),
            wanted: Vec::with_capacity(rows),
            forces: vec![0.0; (walls + rows) * TERMS],
            acting: Vec::with_capacity(2 * walls),
            waves: Vec::with_capacity(waves),
            rate: 0.0,
            longest: 1.0,
        }
    }

    /// The fastest rate (1/s) that the stretch was made for: of its oscillations, decays and loads.
    pub(crate) fn rate(&self) -> f64 {
        self.rate
    }

    /// Starts a new stretch, as long as two radians of the fastest motion and `from.until` allow,
    /// and no longer than `from.reach`. `carriers` are the walls behind the held rows: wall, number
    /// of the held row, share.
    pub(crate) fn begin(
        &mut self,
        body: &mut SeriesBody,
        from: &Start,
        touching: &[Touching],
        hold: &HeldRows,
        carriers: impl Iterator<Item = (usize, usize, f64)>,
        work: &mut [f64],
    ) {
        self.rate = body.rate(touching.iter().map(|t| (t.row, t.stiffness, t.damping)));
        let slides = hold.rows().iter().any(|held| held.row >= self.fixed);
        if slides {
            self.rate = self.rate.max(turning_rate(body, hold, from.v));
        }
        let radians = if self.circles.is_empty() { RADIANS } else { ROUND_RADIANS };
        let longest = if self.rate > 0.0 { radians / self.rate } else { f64::INFINITY };
        let span = from.until - from.time;
        self.longest = span.min(longest);
        self.unit = self.longest.min(from.reach.max(LEAST_REACH * self.longest));
        self.start = from.time;
        // Start and span together would miss the given end by rounding, and with it a blow.
        self.end = if span <= self.unit { from.until } else { from.time + self.unit };
        self.terms = if slides { TERMS } else { terms_for(self.rate * self.unit) };
        self.acting.clear();
        self.acting.extend(touching.iter().enumerate().map(|(slot, t)| Acting {
            wall: t.wall,
            slot,
            share: 1.0,
            sign: None,
        }));
        let held = |(wall, k, share): (usize, usize, f64)| {
            let sign = hold.rows().get(k).map(|held| held.sign);
            Acting { wall, slot: touching.len() + k, share, sign }
        };
        self.acting.extend(carriers.map(held));
        self.acting.sort_unstable_by_key(|acting| acting.wall);
        while let Some(shorter) = self.fill(body, from, touching, hold, work) {
            (self.unit, self.longest) = (shorter, shorter);
            self.end = self.start + shorter;
        }
        if slides {
            self.shorten(touching.len()..touching.len() + hold.rows().len());
        } else {
            self.check();
        }
        self.stay_near();
        for held in hold.rows() {
            let w = &mut self.seen[held.row * TERMS..(held.row + 1) * TERMS];
            w.fill(0.0);
            w[0] = held.position;
        }
        if !self.circles.is_empty() {
            self.square(body, hold);
        }
    }

    /// Computes the terms. If the acceleration along a circle is so large that the terms would grow
    /// without bounds, it returns a shorter unit, and the terms are invalid.
    fn fill(
        &mut self,
        body: &mut SeriesBody,
        from: &Start,
        touching: &[Touching],
        hold: &HeldRows,
        work: &mut [f64],
    ) -> Option<f64> {
        // In one piece, the recursion of the terms: each part works on slices of the one before.
        let n = self.n;
        let slides = hold.rows().iter().any(|held| held.row >= self.fixed);
        self.forces[..(touching.len() + hold.rows().len()) * TERMS].fill(0.0);
        self.motion[..n].copy_from_slice(from.q);
        for (a, v) in self.motion[n..2 * n].iter_mut().zip(from.v) {
            *a = v * self.unit;
        }
        self.add_row_term(body, 0);
        self.add_row_term(body, 1);
        Wave::wind(&mut self.waves, body, self.start, self.unit);
        for k in 0..self.terms - 2 {
            let (known, next) = self.motion.split_at_mut((k + 2) * n);
            let force = &mut next[..n];
            if k == 0 {
                force.copy_from_slice(from.extra)
            } else {
                force.fill(0.0)
            }
            Wave::push(&mut self.waves, body, (self.start, self.unit), k, force);
            body.stiffness.add_product(-1.0, &known[k * n..(k + 1) * n], force);
            if let Some(damping) = &body.damping {
                damping.add_product(-((k + 1) as f64) / self.unit, &known[(k + 1) * n..], force);
            }
            for (slot, t) in touching.iter().enumerate() {
                let w = &self.seen[t.row * TERMS..];
                let s = if k == 0 { w[0] - t.position } else { w[k] };
                let push = -t.stiffness * s - t.damping * (k + 1) as f64 * w[k + 1] / self.unit;
                self.forces[slot * TERMS + k] = push;
                body.rows.add_transposed(t.row, push, force);
            }
            let factor = self.unit * self.unit / ((k + 1) * (k + 2)) as f64;
            if slides {
                self.wanted.clear();
                self.wanted.resize(body.rows.count(), 0.0);
                for (i, held) in hold.rows().iter().enumerate() {
                    let hole = held.row.wrapping_sub(self.fixed);
                    let (Some(circle), Some(round)) = (self.circles.get(hole), body.rounds.get(hole)) else { continue };
                    let slot = (touching.len() + i) * TERMS;
                    round.push(circle.turned(&self.forces[slot..slot + k]), force);
                    self.wanted[held.row] = circle.bend(k + 2) / factor;
                }
                let (forces, wanted) = (&mut self.forces, &self.wanted);
                let tell = |i: usize, push: f64| forces[(touching.len() + i) * TERMS + k] += push;
                hold.balance(body, force, work, |held| wanted[held.row], tell);
            } else if !hold.rows().is_empty() {
                let forces = &mut self.forces;
                let tell = |i: usize, push: f64| forces[(touching.len() + i) * TERMS + k] += push;
                hold.balance(body, force, work, |_| 0.0, tell);
            }
            body.solve(force);
            force.iter_mut().for_each(|a| *a *= factor);
            self.add_row_term(body, k + 2);
            if slides && k == 0 {
                let held = hold.rows().iter().filter_map(|held| self.circles.get(held.row.wrapping_sub(self.fixed)));
                let bend = held.map(Circle::start).fold(0.0, f64::max);
                if bend > MOST_BEND && bend.is_finite() {
                    return Some(self.unit / bend.sqrt());
                }
            }
            if slides && k + 3 >= FEWEST && self.vanishes(k, touching.len() + hold.rows().len()) {
                self.terms = k + 3;
                break;
            }
        }
        None
    }

    /// True if the terms of the motion and of the `slots` forces, whose last is that of order `k`,
    /// have fallen below rounding: along circles, no bound on the terms is known before.
    fn vanishes(&self, k: usize, slots: usize) -> bool {
        let n = self.n;
        let vanish = |size: &dyn Fn(usize) -> f64, last: usize| {
            let least = LAST * (0..4).map(size).fold(0.0, f64::max);
            (last - 2..=last).rev().all(|k| size(k) <= least)
        };
        vanish(&|k| self.motion[k * n..(k + 1) * n].iter().fold(0.0, |a: f64, x| a.max(x.abs())), k + 2)
            && self.circles.iter().all(|circle| vanish(&|k| circle.size(k), k + 2))
            && (0..slots).all(|slot| vanish(&|k| self.forces[slot * TERMS + k].abs(), k))
    }

    /// Computes term k of the displacements at the rows.
    #[inline]
    fn add_row_term(&mut self, body: &SeriesBody, k: usize) {
        let term = &self.motion[k * self.n..(k + 1) * self.n];
        for row in 0..body.rows.count() {
            self.seen[row * TERMS + k] = body.rows.dot(row, term);
        }
        if self.circles.is_empty() {
            return;
        }
        for (circle, round) in self.circles.iter_mut().zip(&body.rounds) {
            circle.set(k, if k == 0 { round.offset(term) } else { round.pair(term) });
        }
    }

    /// Cuts a stretch along circles, whose series converge on a part of the unit only, to where the
    /// last terms of motion and forces are below rounding, and makes its length the unit.
    fn shorten(&mut self, slots: std::ops::Range<usize>) {
        let (n, top) = (self.n, self.terms - 1);
        let mut share = 1.0_f64;
        let mut observe = |size: &dyn Fn(usize) -> f64, last: usize| {
            let largest = (0..4).map(size).fold(0.0, f64::max);
            let end = size(last).max(size(last - 1));
            if end > ROUND_TRUNCATION * largest && largest > 0.0 {
                share = share.min((ROUND_TRUNCATION * largest / end).powf(1.0 / (last - 1) as f64));
            }
        };
        observe(&|k| self.motion[k * n..(k + 1) * n].iter().fold(0.0, |a: f64, x| a.max(x.abs())), top);
        for circle in &self.circles {
            observe(&|k| circle.size(k), top);
        }
        for slot in slots {
            observe(&|k| self.forces[slot * TERMS + k].abs(), top - 2);
        }
        self.scale(share);
        self.rate = self.rate.max(RADIANS / self.longest);
    }

    /// Cuts the stretch to where no term of the motion at a hole exceeds [`MOST_TRAVEL`] of its
    /// gap: the gap polynomial (γ² − |w|²)/2γ has the rounding error of its largest value, which
    /// far behind the hole is that of |w|²/2γ.
    fn stay_near(&mut self) {
        let mut share = 1.0_f64;
        for circle in &self.circles {
            let most = MOST_TRAVEL * circle.radius;
            for k in (1..self.terms).filter(|&k| circle.size(k) > most) {
                share = share.min((most / circle.size(k)).powf(1.0 / k as f64));
            }
        }
        self.scale(share.max(SHORTEST * self.start / self.unit));
    }

    /// Makes this share of the unit the new one, and ends the stretch there; 1 or more changes
    /// nothing.
    fn scale(&mut self, share: f64) {
        if share >= 1.0 {
            return;
        }
        let (n, mut power) = (self.n, 1.0);
        for k in 0..self.terms {
            self.motion[k * n..(k + 1) * n].iter_mut().for_each(|a| *a *= power);
            self.seen.iter_mut().skip(k).step_by(TERMS).for_each(|c| *c *= power);
            self.forces.iter_mut().skip(k).step_by(TERMS).for_each(|c| *c *= power);
            self.circles.iter_mut().for_each(|circle| circle.scale(k, power));
            power *= share;
        }
        self.unit *= share;
        self.longest = self.unit;
        self.end = self.end.min(self.start + self.unit);
    }

    /// Computes the gaps to the circles that do not hold.
    fn square(&mut self, body: &SeriesBody, hold: &HeldRows) {
        self.squares = (2 * self.terms - 1).min(TERMS);
        for (hole, (circle, round)) in self.circles.iter().zip(&body.rounds).enumerate() {
            let row = self.fixed + hole;
            if hold.rows().iter().any(|held| held.row == row) {
                continue;
            }
            let seen = &mut self.seen[row * TERMS..(row + 1) * TERMS];
            circle.square(self.terms, &mut seen[..self.squares]);
            seen[0] = round.bound() - circle.gap();
        }
    }

    /// Shortens the stretch to where its last terms are below rounding, if they are not.
    fn check(&mut self) {
        let n = self.n;
        let size = |k: usize| self.motion[k * n..(k + 1) * n].iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        let last = size(self.terms - 1).max(size(self.terms - 2));
        let largest = (0..4.min(self.terms)).map(size).fold(0.0, f64::max);
        if last > TRUNCATION * largest && largest > 0.0 {
            let share = (TRUNCATION * largest / last).powf(1.0 / (self.terms - 2) as f64);
            self.end = self.end.min(self.start + share * self.unit);
        }
    }
}

/// The largest rate |ẇ|/γ (1/s) at which the normals of held holes turn.
fn turning_rate(body: &SeriesBody, hold: &HeldRows, v: &[f64]) -> f64 {
    let rate = |round: &super::Round| {
        let [y, z] = round.pair(v);
        y.hypot(z) / round.gap
    };
    hold.rows().iter().filter_map(|held| body.round(held.row)).map(rate).fold(0.0, f64::max)
}

/// The number of terms after which all are below rounding at x = 1, for a motion of `radians`:
/// terms of the acceleration go as xᵏ⁻²/(k − 2)!.
fn terms_for(radians: f64) -> usize {
    let (mut term, mut k) = (1.0, 0);
    while term > LAST && k + 3 < TERMS {
        k += 1;
        term *= radians / k as f64;
    }
    (k + 3).max(FEWEST)
}
