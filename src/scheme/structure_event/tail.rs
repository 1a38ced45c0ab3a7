//! The end of an accumulation of impacts: rows whose flights have become too low stay on their
//! walls.

use super::StructureEvent;
use super::closed_row::side_of;
use crate::error::Result;
use crate::scheme::exact::{TAIL_CHANGE, TAIL_HEIGHT, TIME_UNITS, noise};

impl StructureEvent {
    /// Sets the restitution to 0 in the closed rows whose flight after the impact is the tail of an
    /// accumulation, or too short to be resolved in double precision. Returns whether there is any.
    pub(super) fn stick(&mut self) -> Result<bool> {
        // An upper bound of the pressing acceleration: most flights are far too high for a tail,
        // and need no closer look.
        self.derivatives[0].copy_from_slice(&self.q);
        self.derivatives[1].copy_from_slice(&self.v);
        self.forces(0);
        let short = TIME_UNITS * f64::EPSILON * self.time;
        let mut any = false;
        for closed_row in 0..self.closed_rows.len() {
            let s = self.closed_rows[closed_row];
            let (rate, position) = (self.rate_of(closed_row), self.places[s.row].bound[side_of(s.sign)]);
            let most = self.body.answer_size(s.row, &self.rhs_size) + self.bend_size(s.row, 0);
            let resolved = self.resolution(s.row, position);
            let low = self.low(s.row) + TAIL_HEIGHT * self.places[s.row].travel + resolved;
            // A row at rest that the impact presses does not fly: in the trial it is held.
            let wanted = s.push[side_of(s.sign)] > 0.0 && s.restitution > 0.0 && rate > self.quiet(s.row);
            // Reactions of other held rows press too, with the size of the forces that they
            // balance: no bound is known then.
            let most = if self.closed_rows.len() > 1 { f64::INFINITY } else { most };
            self.closed_rows[closed_row].candidate =
                wanted && (rate * rate <= 4.0 * most * low || rate <= most * short);
            any |= self.closed_rows[closed_row].candidate;
            self.places[s.row].drifts &= !wanted || self.closed_rows[closed_row].candidate;
        }
        if !any {
            return Ok(false);
        }
        self.departing.copy_from_slice(&self.v);
        self.reclassify();
        self.settle(None)?;
        // The stretch that led here is kept unchanged, since the step shows it.
        std::mem::swap(&mut self.series, &mut self.flight);
        self.begin_series(self.limit());
        self.measure();
        let mut found = false;
        for closed_row in 0..self.closed_rows.len() {
            let s = self.closed_rows[closed_row];
            if s.candidate && self.is_tail(closed_row, short) {
                self.closed_rows[closed_row].restitution = 0.0;
                found = true;
            }
            self.closed_rows[closed_row].candidate = false;
        }
        std::mem::swap(&mut self.series, &mut self.flight);
        self.v.copy_from_slice(&self.departing);
        Ok(found)
    }

    /// True if the flight of a closed row in the series just begun is a tail.
    ///
    /// Sticking at once removes the momentum and the energy of the whole tail: under a steady
    /// pressing force its impacts sum up to the same impulse.
    fn is_tail(&self, closed_row: usize, short: f64) -> bool {
        let s = self.closed_rows[closed_row];
        let (c, unit) = (self.series.seen(s.row), self.series.unit());
        let rate = s.sign * c[1] / unit;
        let press = -2.0 * s.sign * c[2] / (unit * unit);
        let large = self.lean(s.row) * (self.body.answer_size(s.row, &self.sizes.force[0]) + self.bend_size(s.row, 0));
        if press <= noise(large) || rate <= 0.0 {
            return false;
        }
        let (height, flight) = (0.5 * rate * rate / press, 2.0 * rate / press);
        let position = self.places[s.row].bound[side_of(s.sign)];
        // A height within the rounding error of the gap in this time is no flight, nor is one
        // within that of the whole stretch where such an error may have begun it.
        let until = if self.places[s.row].drifts { 1.0 } else { (flight / unit).min(1.0) };
        if height <= self.rounding_until(s.row, position, until).below() || flight <= short {
            return true;
        }
        if height >= self.low(s.row) || s.restitution >= 1.0 {
            return false;
        }
        let remaining = flight / (1.0 - s.restitution) / unit;
        let (mut change, mut power) = (0.0, remaining);
        for (k, c) in c.iter().enumerate().skip(3) {
            change += (k * (k - 1)) as f64 * c.abs() * power;
            power *= remaining;
        }
        change / (unit * unit) <= TAIL_CHANGE * press
    }

    /// The height below which a flight may be a tail, m.
    fn low(&self, row: usize) -> f64 {
        TAIL_HEIGHT * self.length.min(self.places[row].travel)
    }
}
