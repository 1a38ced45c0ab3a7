//! The terms of a series, by recurrence.

use super::circle::Circle;
use super::truncation::{FEWEST, LAST, RADIANS, terms_for};
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

/// [`RADIANS`] in a scene with round holes: |w|² has twice the rate of w, and with 2 radians the
/// first term that the product leaves out would be 4³²/32! = 7e-17 of it; this makes it 7e-21.
const ROUND_RADIANS: f64 = 1.5;

/// However soon an event is expected, a stretch is not made shorter than this share of the longest:
/// its series has hardly more terms than [`FEWEST`] then.
const LEAST_REACH: f64 = 1.0 / 256.0;

/// With a larger acceleration over γ, in units of the stretch, a series along a circle is begun
/// again with a shorter one.
const MOST_BEND: f64 = 16.0;

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
        self.terms = if slides { TERMS } else { terms_for(self.rate * self.unit, LAST) };
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
}

/// The largest rate |ẇ|/γ (1/s) at which the normals of held holes turn.
fn turning_rate(body: &SeriesBody, hold: &HeldRows, v: &[f64]) -> f64 {
    let rate = |round: &super::Round| {
        let [y, z] = round.pair(v);
        y.hypot(z) / round.gap
    };
    hold.rows().iter().filter_map(|held| body.round(held.row)).map(rate).fold(0.0, f64::max)
}
