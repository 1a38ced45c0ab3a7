//! Round holes: rows that turn.
//!
//! A hole bounds |w| ≤ γ. Its gap is taken as φ = (γ² − |w|²)/2γ, which is γ − |w| near the circle
//! and a polynomial of the series. At each instant the row of the hole is n·P with n = w/|w|:
//! impacts are those of an upper wall on that row. Where the structure touches and slides, the gap
//! has the derivatives
//!
//! φ̈ = −(n·ẅ + |ẇ|²/γ),
//! φ⁽³⁾ = −(n·w⁽³⁾ + 3 ẇ·ẅ/γ),
//! φ⁽⁴⁾ = −(n·w⁽⁴⁾ + (4 ẇ·w⁽³⁾ + 3 |ẅ|²)/γ),
//!
//! so that the row's acceleration is compared with the bend −|ẇ|²/γ of the circle, and so on. The
//! force r n of a hole that holds (r ≤ 0) turns as well: its derivatives are ṙ n + r ẇ/γ and r̈ n +
//! (2 ṙ ẇ + r ẅ)/γ.

use super::StructureEvent;
use super::closed_row::Fate;
use super::rows::DERIVATIVES;
use crate::flow::Round;
use crate::scheme::exact::noise;

/// Number of times that the structure is put onto round holes: their rows turn as it moves there,
/// and each further pass squares what the first has left.
pub(super) const PLACINGS: usize = 3;

/// Nearer to the centre than this share of γ, a hole keeps its last normal: it is far from closed.
const INSIDE: f64 = 0.5;

/// What the derivative of order `level` + 2 of the gap has beside that of n·w, with the sign of the
/// latter.
pub(super) fn bend(round: &Round, derivatives: &[Vec<f64>; DERIVATIVES], level: usize) -> f64 {
    let dot = |[a, b]: [f64; 2], [c, d]: [f64; 2]| a * c + b * d;
    let w = |k: usize| round.pair(&derivatives[k]);
    let sum = match level {
        0 => dot(w(1), w(1)),
        1 => 3.0 * dot(w(1), w(2)),
        _ => 4.0 * dot(w(1), w(3)) + 3.0 * dot(w(2), w(2)),
    };
    sum / round.gap
}

impl StructureEvent {
    /// Turns the rows of the holes to the present place.
    pub(super) fn turn(&mut self) {
        if self.body.rounds.is_empty() {
            return;
        }
        let (fixed, mut any) = (self.body.fixed, false);
        let Self { body, places, barriers, q, .. } = self;
        for hole in 0..body.rounds.len() {
            let round = &body.rounds[hole];
            let [y, z] = round.offset(q);
            let distance = y.hypot(z);
            let normal = [y / distance, z / distance];
            if distance > INSIDE * round.gap && normal != round.normal {
                body.turn(hole, normal);
                any = true;
            }
            let (bound, wall) = (body.rounds[hole].bound(), body.rounds[hole].wall);
            places[fixed + hole].bound[1] = bound;
            barriers[wall].position = bound;
        }
        if any {
            self.turned = true;
            if !self.hold.rows().is_empty() {
                let Self { hold, body, places, .. } = self;
                hold.renew(body, |row, position| if row < fixed { position } else { places[row].bound[1] });
                self.share_holds();
            }
        }
    }

    /// See [`bend`]; 0 for a wall.
    pub(super) fn bend(&self, row: usize, level: usize) -> f64 {
        self.body.round(row).map_or(0.0, |round| bend(round, &self.derivatives, level))
    }

    /// The size of its terms.
    pub(super) fn bend_size(&self, row: usize, level: usize) -> f64 {
        let Some(round) = self.body.round(row) else { return 0.0 };
        let w = |k: usize| round.size(&self.sizes.derivative[k]);
        let sum = match level {
            0 => w(1) * w(1),
            1 => 3.0 * w(1) * w(2),
            _ => 4.0 * w(1) * w(3) + 3.0 * w(2) * w(2),
        };
        sum / round.gap
    }

    /// How much larger than rounding the error of the direction of a normal is: the place is known
    /// to the rounding error of its terms only. 1 for a wall.
    pub(super) fn lean(&self, row: usize) -> f64 {
        self.body.round(row).map_or(1.0, |round| (round.place_size(&self.q) / round.gap).max(1.0))
    }

    /// The speed along the normal that its rounding error takes from the sliding speed, m/s; 0 for
    /// a wall.
    pub(super) fn turned_speed(&self, row: usize) -> f64 {
        let Some(round) = self.body.round(row) else { return 0.0 };
        let speed = round.size(&self.v);
        noise(self.lean(row) * speed + speed * speed / round.gap * self.series.longest())
    }

    /// Adds to `rhs` what the turning of the forces of held holes adds to the derivative of order
    /// `level` of the forces, and to `rhs_size` the size of its terms.
    pub(super) fn turn_forces(&mut self, level: usize) {
        if level == 0 || self.body.rounds.is_empty() {
            return;
        }
        let Self { body, closed_rows, derivatives, rhs, rhs_size, .. } = self;
        for closed_row in closed_rows.iter().filter(|closed_row| matches!(closed_row.fate, Fate::Held(_))) {
            let Some(round) = body.round(closed_row.row) else { continue };
            let [first, second] = [1, 2].map(|k: usize| round.pair(&derivatives[k]));
            let [r, rate, _] = closed_row.force;
            let of = |axis: usize| match level {
                1 => r * first[axis],
                _ => 2.0 * rate * first[axis] + r * second[axis],
            };
            let force = [0, 1].map(|axis| of(axis) / round.gap);
            round.push(force, rhs);
            round.push_size(force, rhs_size);
        }
    }

    /// Adds to the sizes of the rate of the forces, in `rhs_size`, what the held forces add as they
    /// turn.
    pub(super) fn add_turned_sizes(&mut self) {
        let Self { body, hold, series, rhs_size, .. } = self;
        for (k, held) in hold.rows().iter().enumerate() {
            let Some(round) = body.round(held.row) else { continue };
            let share = series.held_force(k)[0] / (round.gap * series.unit());
            round.push_size(round.pair(series.term(1)).map(|w| share * w), rhs_size);
        }
    }

    /// As `noises`, of the gap of a hole, given those of the terms of order 2 and 3 that come from
    /// forces.
    pub(super) fn round_noises(&self, row: usize, [second, third]: [f64; 2]) -> [f64; 4] {
        let Some(round) = self.body.round(row) else { return [0.0; 4] };
        let [w1, w2] = [1, 2].map(|k: usize| round.size(self.series.term(k)));
        let lean = self.lean(row);
        [
            self.resolution(row, round.bound()),
            lean * (noise(w1) + 2.0 * second),
            lean * second + noise(w1 * w1 / round.gap),
            lean * third + noise(3.0 * w1 * w2 / round.gap),
        ]
    }

    /// Σ of the sizes of the terms of the gap of a hole after the first, m, up to `x`.
    pub(super) fn round_travel(&self, round: &Round, x: f64) -> f64 {
        let terms = (1..self.series.terms()).rev();
        let way = terms.fold(0.0, |sum, k| x * (sum + round.size(self.series.term(k))));
        way * (1.0 + 0.5 * way / round.gap)
    }

    /// Adds to the rounding errors of the force on held row number `k` and of its rate, N and N/s,
    /// those of the bends of the circles.
    pub(super) fn add_bend_noises(&self, k: usize, out: &mut [f64; 4]) {
        let unit = self.series.unit();
        for (held, share) in self.hold.independent().iter().zip(self.hold.inverse(k)) {
            let Some(round) = self.body.round(held.row) else { continue };
            let [w1, w2] = [1, 2].map(|k: usize| round.size(self.series.term(k)));
            let scale = share.abs() / (round.gap * unit * unit);
            out[0] += noise(scale * w1 * w1);
            out[1] += noise(scale * 6.0 * w1 * w2 / unit);
        }
    }

    /// Writes what the holes did in the step, with the magnitudes of their impulses and forces.
    pub(super) fn write_holes(&mut self) {
        let Self { body, series, shown, .. } = self;
        for round in &body.rounds {
            let (index, normal) = (round.wall, round.normal);
            for values in [&mut shown.impulse, &mut shown.jump, &mut shown.force] {
                values[index] = values[index].abs();
            }
            let (impulse, jump) = (shown.impulse[index], shown.jump[index]);
            if impulse == 0.0 {
                continue;
            }
            let along = series.hole_impulse(index, series.start(), series.end());
            shown.turned[index] = [0, 1].map(|axis: usize| along[axis] + (impulse - jump) * normal[axis]);
            shown.normal[index] = normal;
        }
    }

    /// Programmes, pivots and fallbacks so far.
    pub(super) fn solver_work(&self) -> [u64; 3] {
        let own = self.solver.as_ref().map_or([0; 3], |solver| {
            let inner = solver.counters();
            [inner.solves - inner.free, inner.pivots, inner.fallbacks]
        });
        [0, 1, 2].map(|i: usize| self.spent[i] + own[i])
    }

    /// Drops the solver, and keeps its counters.
    pub(super) fn book_solver(&mut self) {
        self.spent = self.solver_work();
        self.solver = None;
    }
}

#[cfg(test)]
mod tests;
