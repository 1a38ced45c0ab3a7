//! The terms of a series, by recurrence.

use super::wave::Wave;
use super::{Acting, Hold, Series, SeriesBody, TERMS};

/// What a series starts from.
pub(crate) struct Start<'a> {
    /// When, s.
    pub time: f64,
    /// Displacement, m, and velocity, m/s, n entries each.
    pub q: &'a [f64],
    pub v: &'a [f64],
    /// A constant force on top of the loads, N, n entries.
    pub extra: &'a [f64],
    /// How far it may reach, s.
    pub span: f64,
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

/// The series ends where a term of the acceleration is below this share of the first.
const LAST: f64 = 1e-18;

/// Minimum number of terms: beside constants and ramps of the load they leave room for the load's
/// own oscillations.
const FEWEST: usize = 8;

/// If the last term is above this share of the largest, the fastest rate was underestimated and the
/// stretch is cut.
const TRUNCATION: f64 = 1e-16;

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
            forces: vec![0.0; (walls + rows) * TERMS],
            acting: Vec::with_capacity(2 * walls),
            waves: Vec::with_capacity(waves),
            rate: 0.0,
        }
    }

    /// The fastest rate (1/s) that the stretch was made for: of its oscillations, decays and loads.
    pub(crate) fn rate(&self) -> f64 {
        self.rate
    }

    /// Starts a new stretch, as long as two radians of the fastest motion and `from.span` allow.
    /// `carriers` are the walls behind the held rows: wall, number of the held row, share.
    pub(crate) fn begin(
        &mut self,
        body: &mut SeriesBody,
        from: &Start,
        touching: &[Touching],
        hold: &Hold,
        carriers: impl Iterator<Item = (usize, usize, f64)>,
        work: &mut [f64],
    ) {
        let n = self.n;
        self.rate = body.rate(touching.iter().map(|t| (t.row, t.stiffness, t.damping)));
        let longest = if self.rate > 0.0 { RADIANS / self.rate } else { f64::INFINITY };
        self.unit = from.span.min(longest);
        self.start = from.time;
        self.end = if from.span <= longest { from.time + from.span } else { from.time + self.unit };
        self.terms = terms_for(self.rate * self.unit);
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
        self.forces[..(touching.len() + hold.rows().len()) * TERMS].fill(0.0);
        self.motion[..n].copy_from_slice(from.q);
        for (a, v) in self.motion[n..2 * n].iter_mut().zip(from.v) {
            *a = v * self.unit;
        }
        self.look(body, 0);
        self.look(body, 1);
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
            if !hold.rows().is_empty() {
                let forces = &mut self.forces;
                hold.balance(body, force, work, |i, push| forces[(touching.len() + i) * TERMS + k] += push);
            }
            body.solve(force);
            let factor = self.unit * self.unit / ((k + 1) * (k + 2)) as f64;
            force.iter_mut().for_each(|a| *a *= factor);
            self.look(body, k + 2);
        }
        for held in hold.rows() {
            let w = &mut self.seen[held.row * TERMS..held.row * TERMS + self.terms];
            w.fill(0.0);
            w[0] = held.position;
        }
        self.check();
    }

    /// Computes term k of the displacements at the rows.
    #[inline]
    fn look(&mut self, body: &SeriesBody, k: usize) {
        let term = &self.motion[k * self.n..(k + 1) * self.n];
        for row in 0..body.rows.count() {
            self.seen[row * TERMS + k] = body.rows.dot(row, term);
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
