//! The motion of the structure between events: its series, the forces on it, and the impulses of
//! the walls.

use super::StructureEvent;
use super::round::bend;
use super::rows::{Sizes, WallRow};
use crate::flow::{HeldRow, SeriesStart, Touching};
use crate::scheme::exact::Phase;

impl StructureEvent {
    /// The time at which the next series must end, s: a multiple of the stride, a row of a table, a
    /// blow, or the end if it is still ahead.
    pub(super) fn limit(&self) -> f64 {
        let mut limit = self.clock.limit(self.time);
        if let Some(&time) = self.blows.get(self.blow) {
            limit = limit.min(time);
        }
        self.body.next_corner(self.time).map_or(limit, |corner| limit.min(corner))
    }

    /// Begins the series from here on, with the walls that touch and the rows that are held, up to
    /// `limit` (s) at the latest.
    pub(super) fn begin_series(&mut self, limit: f64) {
        self.begin_within(limit, f64::INFINITY);
    }

    /// The same where an event is expected within `reach` (s).
    pub(super) fn begin_within(&mut self, limit: f64, reach: f64) {
        if self.decided != self.time {
            self.places.iter_mut().for_each(WallRow::forget);
        }
        let Self { body, barriers, touching, .. } = self;
        touching.clear();
        touching.extend(barriers.iter().enumerate().filter(|(_, b)| b.phase == Phase::Touching).map(|(wall, b)| {
            Touching { wall, row: body.row_of[wall], position: b.position, stiffness: b.stiffness, damping: b.damping }
        }));
        if !body.rounds.is_empty() {
            self.turn();
        }
        let Self { body, series, touching, hold, carriers, .. } = self;
        if !hold.rows().is_empty() {
            hold.place(body, &mut self.q, &mut self.scratch);
            hold.stop(body, &mut self.v, &mut self.scratch);
        }
        let from =
            SeriesStart { time: self.time, q: &self.q, v: &self.v, extra: &self.shown.extra, until: limit, reach };
        series.begin(body, &from, touching, hold, carriers.iter().copied(), &mut self.scratch);
        self.sizes.known = false;
    }

    /// Adds the impulses of the stretch just completed to the step and to the open episodes.
    pub(super) fn gather_impulses(&mut self) {
        let Self { series, barriers, shown, .. } = self;
        for (wall, ..) in series.acting() {
            let p = series.contact_impulse(wall, series.start(), series.end());
            if let (Some(total), Some(b)) = (shown.impulse.get_mut(wall), barriers.get_mut(wall)) {
                *total += p;
                if let Some(open) = &mut b.open {
                    open.impulse += p;
                }
            }
        }
    }

    /// Computes the derivative of `order` of the force on the structure, without rigid walls, at
    /// the present instant from the right, and the sizes of its terms: into `rhs` (N/sᵏ) and
    /// `rhs_size`. Uses the derivatives of q from `order` to `order` + 1, and from order 1 on their
    /// sizes too.
    pub(super) fn forces(&mut self, order: usize) {
        let Self { body, derivatives, rhs, rhs_size, sizes, barriers, .. } = self;
        rhs.fill(0.0);
        rhs_size.fill(0.0);
        let Sizes { derivative: size_of, .. } = sizes;
        if order == 0 {
            rhs.copy_from_slice(&self.shown.extra);
            rhs_size.iter_mut().zip(&self.shown.extra).for_each(|(size, f)| *size = f.abs());
            for (sizes, x) in size_of.iter_mut().zip(&*derivatives).take(2) {
                sizes.iter_mut().zip(x).for_each(|(size, x)| *size = x.abs());
            }
        }
        let (x, rate) = (&derivatives[order], &derivatives[order + 1]);
        let (x_size, rate_size) = (&size_of[order], &size_of[order + 1]);
        body.add_load(order as u32, self.time, rhs, rhs_size);
        body.add_force(x, rate, rhs);
        body.add_sizes(x_size, rate_size, rhs_size);
        for (wall, b) in barriers.iter().enumerate().filter(|(_, b)| b.phase == Phase::Touching) {
            let row = body.row_of[wall];
            let position = if order == 0 { b.position } else { 0.0 };
            let spring = -b.stiffness * (body.rows.dot(row, x) - position);
            let dashpot = -b.damping * body.rows.dot(row, rate);
            body.rows.add_transposed(row, spring + dashpot, rhs);
            let large = b.stiffness * (body.size(row, x_size) + position.abs()) + b.damping * body.size(row, rate_size);
            for &(i, g) in body.rows.row(row) {
                rhs_size[i] += g.abs() * large;
            }
        }
        body.level_sizes(rhs_size);
    }

    /// Computes the size of derivative `order` + 2 of q, which follows from the force of that order
    /// in `rhs_size`.
    pub(super) fn enlarge(&mut self, order: usize) {
        let Self { body, derivatives, rhs_size, sizes: Sizes { derivative, work, .. }, .. } = self;
        work.copy_from_slice(rhs_size);
        body.solve(work);
        for ((size, x), terms) in derivative[order + 2].iter_mut().zip(&derivatives[order + 2]).zip(&*work) {
            *size = x.abs().max(terms.abs());
        }
    }

    /// Computes the sizes of force and rate at the start of the series, unless they are known.
    pub(super) fn measure(&mut self) {
        if self.sizes.known {
            return;
        }
        self.sizes.known = true;
        self.derivatives[0].copy_from_slice(&self.q);
        self.derivatives[1].copy_from_slice(&self.v);
        let factor = 2.0 / (self.series.unit() * self.series.unit());
        for (a, term) in self.derivatives[2].iter_mut().zip(self.series.term(2)) {
            *a = factor * term;
        }
        for order in 0..2 {
            self.forces(order);
            for (k, held) in self.hold.rows().iter().enumerate() {
                let push = self.series.held_force(k)[order] * if order == 0 { 1.0 } else { 1.0 / self.series.unit() };
                self.body.rows.row(held.row).iter().for_each(|&(i, g)| self.rhs_size[i] += (g * push).abs());
            }
            if order == 1 {
                self.add_turned_sizes();
            }
            self.sizes.force[order].copy_from_slice(&self.rhs_size);
            if order == 0 {
                self.enlarge(0);
            }
        }
    }

    /// Computes the force of each wall now.
    pub(super) fn set_forces(&mut self) {
        self.shown.force.fill(0.0);
        if !self.hold.rows().is_empty() {
            self.derivatives[0].copy_from_slice(&self.q);
            self.derivatives[1].copy_from_slice(&self.v);
            self.forces(0);
            let Self { hold, body, rhs, scratch, pushes, derivatives, .. } = self;
            pushes.clear();
            pushes.resize(hold.rows().len(), 0.0);
            let wanted = |held: &HeldRow| body.round(held.row).map_or(0.0, |round| -bend(round, derivatives, 0));
            hold.balance(body, rhs, scratch, wanted, |k, push| pushes[k] += push);
            for &(wall, k, share) in &self.carriers {
                let (Some(force), Some(held)) = (self.shown.force.get_mut(wall), self.hold.rows().get(k)) else {
                    continue;
                };
                *force = share * held.sign * (held.sign * self.pushes[k]).max(0.0);
            }
        }
        for (wall, b) in self.barriers.iter().enumerate().filter(|(_, b)| b.phase == Phase::Touching) {
            let row = self.body.row_of[wall];
            let sum = b.sum(self.body.rows.dot(row, &self.q), self.body.rows.dot(row, &self.v));
            self.shown.force[wall] = b.sign * sum.max(0.0);
        }
    }
}

#[cfg(test)]
mod tests;
