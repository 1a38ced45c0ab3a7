//! Which touching walls push where the speed is 0.
//!
//! Over the closed rows of speed 0, 0 ≤ ẅ ⟂ λ ≥ 0: the accelerations minimise ½ (q̈ − M⁻¹F)ᵀ M (q̈
//! − M⁻¹F) over G q̈ ≥ 0 (Gauss's principle). Rows with λ > 0 are held, rows with ẅ > 0 leave.
//! Where both vanish to rounding the next derivative decides in the same way, and the rows held so
//! far are held in it too. At a round hole ẅ is that of the distance to the circle, which the
//! turning of the normal changes too (`round.rs`). A row that no derivative decides is stopped and
//! left free: nothing presses on it, so it is not in contact, and the search for events finds which
//! way it goes.

use super::StructureEvent;
use super::closed_row::{ClosedRow, Fate, LEVELS, side_of};
use super::rows::{LeadingZeros, SIGNS};
use crate::error::Result;
use crate::flow::HeldRow;
use crate::scheme::exact::noise;

/// Relative tolerance within which a force that the search found to vanish must be 0; if it is
/// larger, something else has changed it.
const VANISHED: f64 = 1e-9;

impl StructureEvent {
    /// Decides on the closed rows of speed 0, and holds those that are pressed. `released` is the
    /// row whose force has just vanished.
    pub(super) fn settle(&mut self, released: Option<usize>) -> Result<()> {
        for closed_row in 0..self.closed_rows.len() {
            let s = self.closed_rows[closed_row];
            let (rate, quiet) = (self.rate_of(closed_row), self.quiet(s.row));
            // After an impact without restitution, the speed is rounding.
            let stopped = s.push != [0.0; 2] && s.restitution == 0.0 && rate.abs() <= 1e3 * quiet;
            let rests = !s.candidate && (s.both || stopped || rate.abs() <= quiet || rate < 0.0);
            self.closed_rows[closed_row].fate = if rests { Fate::Open } else { Fate::None };
        }
        self.derivatives[0].copy_from_slice(&self.q);
        self.derivatives[1].copy_from_slice(&self.v);
        for level in 0..LEVELS {
            if !self.closed_rows.iter().any(|s| s.fate == Fate::Open) {
                break;
            }
            self.forces(level);
            self.turn_forces(level);
            self.decide(level, released)?;
            self.enlarge(level);
        }
        self.hold_seats(released);
        Ok(())
    }

    /// Decides one level: one derivative of the acceleration and of the forces.
    fn decide(&mut self, level: usize, released: Option<usize>) -> Result<()> {
        let resting = |s: &&ClosedRow| matches!(s.fate, Fate::Open | Fate::Held(_));
        if let (1, Some(at)) =
            (self.closed_rows.iter().filter(resting).count(), self.closed_rows.iter().position(|s| resting(&s)))
        {
            return self.decide_one(level, at, released);
        }
        self.lo.fill(f64::NEG_INFINITY);
        self.hi.fill(f64::INFINITY);
        for s in self.closed_rows.iter().filter(resting) {
            let held = s.both || matches!(s.fate, Fate::Held(_));
            let bound = -self.bend(s.row, level);
            if s.sign > 0.0 || held {
                self.lo[s.row] = bound;
            }
            if s.sign < 0.0 || held {
                self.hi[s.row] = bound;
            }
        }
        if !self.solve()? {
            return Err(self.unsolved("the forces of walls in lasting contact are not found"));
        }
        let Some(solver) = &self.solver else { return Ok(()) };
        let solution = solver.solution();
        self.derivatives[level + 2].copy_from_slice(&solution.x);
        // The forces of the walls are terms of the acceleration too.
        for (&r, row) in solution.multiplier.iter().zip(0..).filter(|(r, _)| **r != 0.0) {
            self.body.rows.row(row).iter().for_each(|&(i, g)| self.rhs_size[i] += (g * r).abs());
        }
        for at in 0..self.closed_rows.len() {
            let push = solution.multiplier.get(self.closed_rows[at].row).copied().unwrap_or(0.0);
            self.closed_rows[at].force[level] = push;
            let s = self.closed_rows[at];
            if s.fate != Fate::Open {
                continue;
            }
            let push = s.sign * push;
            let away = s.sign * (self.body.rows.dot(s.row, &solution.x) + self.bend(s.row, level));
            self.closed_rows[at] = self.judged(s, level, push * self.body.delassus(s.row, s.row), away, released);
        }
        Ok(())
    }

    /// As [`Self::decide`], for a single row.
    fn decide_one(&mut self, level: usize, at: usize, released: Option<usize>) -> Result<()> {
        let s = self.closed_rows[at];
        let away = s.sign * (self.body.answer(s.row, &self.rhs) + self.bend(s.row, level));
        let held = s.both || away < 0.0;
        let judged = self.judged(s, level, -away, away.max(0.0), released);
        let w = self.body.delassus(s.row, s.row);
        let next = &mut self.derivatives[level + 2];
        next.copy_from_slice(&self.rhs);
        self.body.solve(next);
        if held {
            self.body.add_column(s.row, -s.sign * away / w, &mut self.derivatives[level + 2]);
            self.body.rows.row(s.row).iter().for_each(|&(i, g)| self.rhs_size[i] += (g * away / w).abs());
        }
        self.closed_rows[at] = judged;
        self.closed_rows[at].force[level] = if held { -s.sign * away / w } else { 0.0 };
        Ok(())
    }

    /// A closed row after the decision of one level: `push` is its force's share of the
    /// acceleration, `away` the acceleration that remains.
    fn judged(&self, mut s: ClosedRow, level: usize, push: f64, away: f64, released: Option<usize>) -> ClosedRow {
        let large = self.body.answer_size(s.row, &self.rhs_size) + self.bend_size(s.row, level);
        let large = self.lean(s.row) * large;
        let vanished = level == 0 && released == Some(s.row) && push.abs() <= VANISHED * large;
        let little = if vanished { VANISHED * large } else { noise(large) };
        if s.both && push.abs() > little {
            s.sign *= push.signum();
            s.fate = Fate::Held(level);
        } else if push > little || away < -little {
            s.fate = Fate::Held(level);
        } else if !s.both && away > little {
            s.fate = Fate::Gone(level);
        }
        s
    }

    /// Holds the rows that are to be held, and records what has been decided.
    fn hold_seats(&mut self, released: Option<usize>) {
        let Self { hold, body, closed_rows, places, v, scratch, .. } = self;
        for place in places.iter_mut() {
            place.held = 0.0;
            place.forget();
        }
        let held = |s: &ClosedRow| {
            let position = places.get(s.row).map_or(0.0, |place| place.bound[side_of(s.sign)]);
            matches!(s.fate, Fate::Held(_)).then_some(HeldRow { row: s.row, sign: s.sign, position })
        };
        let of = |level: usize| closed_rows.iter().filter(move |s| s.fate == Fate::Held(level)).filter_map(&held);
        // The speed that rounding leaves after a stop is removed here, so that it does not enter
        // the motion that follows.
        if closed_rows.iter().any(|s| s.fate == Fate::Open) {
            let stopped = closed_rows
                .iter()
                .filter(|s| matches!(s.fate, Fate::Open | Fate::Held(_)))
                .map(|s| HeldRow { row: s.row, sign: s.sign, position: places[s.row].bound[side_of(s.sign)] });
            hold.set(body, std::iter::empty(), stopped);
            hold.stop(body, v, scratch);
        }
        // The rows held by their force itself share it. Of the others, a row that depends on those
        // before it carries no force; the row that has just been found to pull comes last, so that
        // of several equal rows it is the one without a force.
        let pulled = |held: &HeldRow| released == Some(held.row);
        let idle = |level: usize| of(level).filter(move |held| !pulled(held)).chain(of(level).filter(pulled));
        hold.set(body, of(0), (1..LEVELS).flat_map(idle));
        hold.stop(body, v, scratch);
        for s in closed_rows.iter() {
            let in_hold = hold.rows().iter().any(|held| held.row == s.row);
            let (side, place) = (side_of(s.sign), &mut places[s.row]);
            match s.fate {
                Fate::Held(level) if in_hold => {
                    place.held = s.sign;
                    place.force_zeros = Some(LeadingZeros::Then(level));
                    if s.both {
                        place.gap_zeros = [Some(LeadingZeros::All); 2];
                    }
                }
                Fate::Held(_) | Fate::Open => {
                    place.gap_zeros[side] = Some(LeadingZeros::Unknown(LEVELS + 2));
                    if s.both {
                        place.gap_zeros = [Some(LeadingZeros::Unknown(LEVELS + 2)); 2];
                    }
                }
                Fate::Gone(level) => place.gap_zeros[side] = Some(LeadingZeros::Then(level + 2)),
                Fate::None => place.gap_zeros[side] = Some(LeadingZeros::Then(1)),
            }
        }
        self.share_holds();
    }

    /// Finds the walls that carry the held rows.
    pub(super) fn share_holds(&mut self) {
        let Self { hold, places, carriers, walls_of, barriers, .. } = self;
        carriers.clear();
        for (k, held) in hold.rows().iter().enumerate() {
            let side = side_of(held.sign);
            let place = &places[held.row];
            let carries = |wall: &&usize| {
                let b = &barriers[**wall];
                b.sign == SIGNS[side] && b.stiffness == 0.0 && b.position == place.bound[side]
            };
            let share = 1.0 / place.carriers[side] as f64;
            carriers.extend(walls_of[held.row].iter().filter(carries).map(|&wall| (wall, k, share)));
        }
    }
}

#[cfg(test)]
mod tests;
