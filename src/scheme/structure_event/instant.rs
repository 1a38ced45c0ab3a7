//! What happens at one instant: blows, impacts, lasting contact and its end, and the contact of
//! elastic walls beginning or ending.

use super::StructureEvent;
use super::closed_row::{Cause, ClosedRow, Fate, LEVELS, side_of};
use super::impact::TOLD;
use super::round::PLACINGS;
use super::rows::SIGNS;
use crate::error::Result;
use crate::flow::HeldRow;
use crate::scheme::exact::{ExactWall, Phase};
use crate::step::Contact;

/// Bodies that move together within this share of the gap touch each other, as
/// [`Scene::touching_distance`](crate::Scene::touching_distance) has it.
const TOGETHER: f64 = 1e-12;

impl StructureEvent {
    /// Handles everything that happens at the present instant; `hit` is the event that ended the
    /// stretch. True if the velocity jumped or a contact changed.
    pub(super) fn resolve_instant(&mut self, hit: Option<Cause>) -> Result<bool> {
        let blown = self.blow();
        if hit.is_none() && !blown {
            return Ok(false);
        }
        self.clock.count().events += 1;
        let wall = match hit {
            Some(Cause::Elastic(wall)) => Some(wall),
            Some(Cause::Gap(row, _) | Cause::Release(row)) => self.walls_of.get(row).and_then(|w| w.first()).copied(),
            None => None,
        };
        self.clock.last_wall = wall.or(self.clock.last_wall);
        if let Some(Cause::Elastic(wall)) = hit {
            self.cross(wall);
        }
        let jumped = self.resolve_rigid(hit, blown)?;
        if jumped || blown {
            self.reclassify();
        }
        Ok(true)
    }

    /// Gives the blow that is due; false if there is none.
    fn blow(&mut self) -> bool {
        let before = self.blow.checked_sub(1).and_then(|i| self.blows.get(i)).copied().unwrap_or(0.0);
        if self.blows.get(self.blow).is_none_or(|&time| time > self.time) {
            return false;
        }
        self.blow += 1;
        if !self.loads.blow(before, self.time, &mut self.rhs) {
            return false;
        }
        self.body.solve(&mut self.rhs);
        self.v.iter_mut().zip(&self.rhs).for_each(|(v, change)| *v += change);
        true
    }

    /// Moves an elastic wall into its next phase.
    fn cross(&mut self, wall: usize) {
        let row = self.body.row_of[wall];
        let (w, rate) = (self.body.rows.dot(row, &self.q), self.body.rows.dot(row, &self.v));
        let resolution = self.resolution(row, self.barriers[wall].position);
        let Some(b) = self.barriers.get_mut(wall) else { return };
        b.cross((w, rate), resolution, self.time);
        b.settle(wall, self.time, rate, &mut self.shown.closed);
    }

    /// Updates the phases after a jump of velocity, which may begin or end the contact at elastic
    /// walls with damping.
    pub(super) fn reclassify(&mut self) {
        for wall in 0..self.barriers.len() {
            if matches!(self.barriers[wall].phase, Phase::Rigid(_)) {
                continue;
            }
            let row = self.body.row_of[wall];
            let (w, rate) = (self.body.rows.dot(row, &self.q), self.body.rows.dot(row, &self.v));
            let resolution = self.resolution(row, self.barriers[wall].position);
            let b = &mut self.barriers[wall];
            b.classify(w, rate, resolution);
            b.settle(wall, self.time, rate, &mut self.shown.closed);
        }
    }

    /// Handles the rigid walls that touch: impacts where walls are approached, lasting contact or
    /// separation elsewhere. Returns whether the velocity jumped.
    fn resolve_rigid(&mut self, hit: Option<Cause>, blown: bool) -> Result<bool> {
        self.close_rows(hit);
        if self.closed_rows.is_empty() {
            return Ok(false);
        }
        let struck = self.is_any_approached();
        if struck {
            if blown {
                self.end_rests();
            }
            self.impact()?;
            self.reclassify();
        }
        let released = if let (Some(Cause::Release(row)), false) = (hit, blown || struck) { Some(row) } else { None };
        self.settle(released)?;
        self.decided = self.time;
        for closed_row in 0..self.closed_rows.len() {
            self.record_row(closed_row);
        }
        Ok(struck)
    }

    /// Finds the closed rows, and puts the structure exactly onto their surfaces.
    fn close_rows(&mut self, hit: Option<Cause>) {
        self.closed_rows.clear();
        (self.fastest_row, self.fastest_weighed) = (0.0, 0.0);
        self.turn();
        for row in 0..self.places.len() {
            let place = self.places[row];
            if place.carriers == [0, 0] {
                continue;
            }
            let (w, rate) = (self.body.rows.dot(row, &self.q), self.body.rows.dot(row, &self.v));
            let mut closed = [false; 2];
            for (side, closed) in closed.iter_mut().enumerate().filter(|(side, _)| place.carriers[*side] > 0) {
                // The instant is known only to an ulp of the time.
                let late = 4.0 * f64::EPSILON * self.time * rate.abs();
                let gap = place.gap(side, w);
                // Bodies that move together at a wall touch it, at whatever distance the roundings
                // of their motion have left.
                *closed = hit == Some(Cause::Gap(row, side))
                    || place.held == SIGNS[side]
                    || gap <= self.resolution(row, place.bound[side]) + late
                    || (gap <= TOGETHER * self.length && rate.abs() <= TOLD * self.body.size(row, &self.v));
            }
            if closed == [false, false] {
                continue;
            }
            self.fastest_row = self.fastest_row.max(rate.abs());
            self.fastest_weighed = self.fastest_weighed.max(rate.abs() / self.body.delassus(row, row).sqrt());
            let both = closed == [true, true];
            let sign = match closed {
                [true, true] if place.held != 0.0 => place.held,
                [true, true] if rate > 0.0 => -1.0,
                [true, _] => 1.0,
                [false, _] => -1.0,
            };
            self.closed_rows.push(ClosedRow {
                row,
                sign,
                both,
                was: place.held,
                arrived: sign * rate,
                restitution: 0.0,
                push: [0.0; 2],
                candidate: false,
                fate: Fate::None,
                force: [0.0; LEVELS],
            });
        }
        if self.closed_rows.is_empty() {
            return;
        }
        let turns = self.closed_rows.iter().any(|s| self.body.round(s.row).is_some());
        for _ in 0..if turns { PLACINGS } else { 1 } {
            self.place_seats();
            self.turn();
        }
        self.derivatives[0].copy_from_slice(&self.q);
        self.derivatives[1].copy_from_slice(&self.v);
        self.forces(0);
        self.sizes.instant.copy_from_slice(&self.rhs_size);
    }

    /// Puts the structure onto the surfaces of the closed rows.
    fn place_seats(&mut self) {
        let Self { surface, body, closed_rows, places, q, scratch, .. } = self;
        let held = |s: &ClosedRow| HeldRow { row: s.row, sign: s.sign, position: places[s.row].bound[side_of(s.sign)] };
        // A row that is just leaving must not be put back: it would never leave.
        let leaves = |s: &ClosedRow| {
            let gap = places[s.row].gap(side_of(s.sign), body.rows.dot(s.row, q));
            gap >= 0.0 && s.arrived > 0.0 && s.was == 0.0 && !s.both
        };
        surface.set(body, std::iter::empty(), closed_rows.iter().filter(|s| !leaves(s)).map(held));
        surface.place(body, q, scratch);
    }

    /// Ends the rests that a blow disturbs: what the blow does at a wall that carried the structure
    /// is a new impact.
    fn end_rests(&mut self) {
        for closed_row in 0..self.closed_rows.len() {
            if self.closed_rows[closed_row].was != 0.0 && self.is_approached(closed_row) {
                let s = self.closed_rows[closed_row];
                self.each_wall(s.row, s.was, |b, _, closed, time| closed.extend(b.close(time, 0.0)));
                self.closed_rows[closed_row].was = 0.0;
            }
        }
    }

    /// Calls `of` for each of the nearest rigid walls on one side of a row.
    fn each_wall(&mut self, row: usize, sign: f64, mut of: impl FnMut(&mut ExactWall, usize, &mut Vec<Contact>, f64)) {
        let bound = self.places[row].bound[side_of(sign)];
        for &wall in &self.walls_of[row] {
            let b = &mut self.barriers[wall];
            if matches!(b.phase, Phase::Rigid(_)) && b.sign == sign && b.position == bound {
                of(b, wall, &mut self.shown.closed, self.time);
            }
        }
    }

    /// Records what has happened at a closed row in the step and in the episodes of its walls.
    fn record_row(&mut self, closed_row: usize) {
        let s = self.closed_rows[closed_row];
        let (rate, place) = (s.sign * self.rate_of(closed_row), self.places[s.row]);
        for (side, sign) in SIGNS.into_iter().enumerate() {
            let stays = place.held == sign;
            if s.push[side] > 0.0 {
                self.record_impact(s, side, stays, rate);
            } else if s.was == sign && !stays {
                self.each_wall(s.row, sign, |b, _, closed, time| closed.extend(b.close(time, sign * rate)));
            }
            if stays {
                self.each_wall(s.row, sign, |b, wall, _, time| b.open(wall, time, 0.0));
            }
        }
    }

    /// Records an impulse: the walls with the largest restitution share it.
    fn record_impact(&mut self, s: ClosedRow, side: usize, stays: bool, rate: f64) {
        let (place, sign) = (self.places[s.row], SIGNS[side]);
        let (e, arrived) = (place.restitution[side], s.sign * sign * s.arrived);
        let impulse = sign * s.push[side] / place.strikers[side] as f64;
        self.places[s.row].struck = self.time;
        let mut jump = std::mem::take(&mut self.shown.jump);
        self.each_wall(s.row, sign, |b, wall, closed, time| {
            if b.phase == Phase::Rigid(e) {
                if let Some(jump) = jump.get_mut(wall) {
                    *jump += impulse;
                }
                b.open(wall, time, -arrived);
                if let Some(open) = &mut b.open {
                    open.impulse += impulse;
                }
            }
            if !stays {
                closed.extend(b.close(time, sign * rate));
            }
        });
        self.shown.jump = jump;
    }
}

#[cfg(test)]
mod tests;
