//! Impacts at several walls at once.
//!
//! Over the closed walls that are approached or at rest, with ẇ counted away from the wall,
//!
//! minimise ½ (v⁺ − v)ᵀ M (v⁺ − v)   subject to   ẇ⁺ + e ẇ ≥ 0,
//!
//! which is Newton's law with an impulse at each wall whose own approach requires one (Moreau 1988,
//! doi:10.1007/978-3-7091-2624-0_1). It is repeated while any closed wall is approached, since one
//! impulse may drive the structure into the next wall; after [`PASSES`] repetitions, or where walls
//! on opposite sides leave no room for a rebound, one programme over all closed walls with e = 0
//! ends the impact. Energy never grows: in each pass p · (ẇ⁺ + ẇ) ≤ 0 at every wall with an
//! impulse.
//!
//! Walls that are struck in turn, each impulse driving the structure into the next wall, are no
//! such impact. Their flights shorten until none is resolved in double precision, while the speeds
//! are still large: where a wall leaves with speed 0 (e = 0), each flight is of the order of the
//! square of the one before. From there on the displacement does not change any more, and each
//! impact in turn is that of one wall, p = −(1 + e) ẇ/Wᵣᵣ. Either the structure leaves all walls
//! after some of them, or the speeds fall geometrically: then infinitely many impacts accumulate,
//! and in the limit all these walls have ẇ = 0.

use super::StructureEvent;
use super::closed_row::{ClosedRow, side_of};
use crate::error::{Error, Result};
use crate::qp::{Failure, Rhs};
use crate::scheme::exact::noise;

/// Maximum number of programmes at one instant before one with e = 0 over all closed walls ends the
/// impact.
const PASSES: usize = 20;

/// Maximum number of programmes with e = 0 at one instant; if walls are still approached then, it
/// is an error.
const TURNS: usize = 2000;

/// Relative tolerance for the sign of a speed in a programme, over the largest speed of the rows
/// that touch.
pub(super) const TOLD: f64 = 4e-12;

/// Maximum number of impacts in turn at one instant: with 0.9995 of the speed left after each, all
/// are below [`TOLD`].
const IN_TURN: usize = 1 << 16;

/// Walls struck in turn have accumulated their impacts where the speeds left are below this share
/// of the first: [`TOLD`] ends them, at up to 1/√(1 − c²) times that, with c² = W²ᵢⱼ/WᵢᵢWⱼⱼ.
const ACCUMULATED: f64 = 1e-9;

/// A closed row was struck before it could move if its last impact was within this share of the
/// time in which events are counted (`hand.rs`).
const RECENT: f64 = 1e-4;

impl StructureEvent {
    /// The speed away from a wall below which it counts as 0, m/s.
    pub(super) fn quiet(&self, row: usize) -> f64 {
        let pull = self.body.answer_size(row, &self.sizes.instant);
        // Where forces balance, the velocity has the rounding error of their terms over the last
        // stretch.
        let own = noise(self.body.size(row, &self.v) + pull * self.series.longest()) + self.turned_speed(row);
        if self.closed_rows.len() < 2 {
            return own;
        }
        // In a programme, rows are coupled through W: the tolerance scales with √W, so heavy rows
        // get a finer one, and light rows no coarser one than in absolute terms.
        let weighed = self.fastest_weighed * self.body.delassus(row, row).sqrt();
        own.max(TOLD * self.fastest_row.min(weighed))
    }

    /// True if the structure approaches the wall of this closed row.
    pub(super) fn is_approached(&self, closed_row: usize) -> bool {
        let s = &self.closed_rows[closed_row];
        let rate = self.rate_of(closed_row);
        let quiet = self.quiet(s.row);
        if s.both { rate.abs() > quiet } else { rate < -quiet }
    }

    /// True if the structure approaches any closed wall.
    pub(super) fn is_any_approached(&self) -> bool {
        (0..self.closed_rows.len()).any(|closed_row| self.is_approached(closed_row))
    }

    /// ẇ away from the wall, m/s.
    pub(super) fn rate_of(&self, closed_row: usize) -> f64 {
        let s = &self.closed_rows[closed_row];
        s.sign * self.body.rows.dot(s.row, &self.v)
    }

    /// Handles the impacts of this instant, with those that end an accumulation.
    pub(super) fn impact(&mut self) -> Result<()> {
        for closed_row in 0..self.closed_rows.len() {
            let s = self.closed_rows[closed_row];
            let e = self.places[s.row].restitution[side_of(s.sign)];
            self.closed_rows[closed_row].restitution = if s.both { 0.0 } else { e };
        }
        self.arriving.copy_from_slice(&self.v);
        self.strike()?;
        let mut stuck = false;
        if self.closed_rows.iter().any(|s| s.restitution > 0.0) {
            stuck = self.stick()?;
        }
        if stuck {
            self.v.copy_from_slice(&self.arriving);
            self.strike()?;
        }
        Ok(())
    }

    /// Applies the impact law from the present velocity until no closed wall is approached.
    fn strike(&mut self) -> Result<()> {
        self.closed_rows.iter_mut().for_each(|s| s.push = [0.0; 2]);
        if self.closed_rows.len() == 1 {
            self.strike_alone(0);
            return Ok(());
        }
        if self.is_struck_in_turn() {
            return self.strike_in_turn();
        }
        for pass in 0..=PASSES {
            if !self.is_any_approached() {
                break;
            }
            if pass == PASSES || !self.pass(false)? {
                return self.stop();
            }
        }
        Ok(())
    }

    /// Applies Newton's law to one closed wall by itself.
    fn strike_alone(&mut self, closed_row: usize) {
        let s = self.closed_rows[closed_row];
        let push = -s.sign * (1.0 + s.restitution) * self.rate_of(closed_row) / self.body.delassus(s.row, s.row);
        self.body.add_column(s.row, push, &mut self.v);
        self.closed_rows[closed_row].push[side_of(push)] += push.abs();
    }

    /// True if a closed row that is not approached flew up from an impact just before, too short to
    /// move away: what strikes another row now is one of several impacts in turn.
    fn is_struck_in_turn(&self) -> bool {
        let since = self.time - RECENT * self.crowd_window();
        let flew = |(at, s): (usize, &ClosedRow)| {
            s.was == 0.0 && !s.both && self.places[s.row].struck >= since && !self.is_approached(at)
        };
        self.closed_rows.iter().enumerate().any(flew)
    }

    /// Strikes the closed walls in turn, each by itself, the one approached fastest first, until
    /// none is approached; where the speeds fall to rounding, the impacts accumulate, and the walls
    /// that are struck are left with speed 0.
    fn strike_in_turn(&mut self) -> Result<()> {
        // The root of the energy that stopping the row by itself would take.
        let weighed = |this: &Self, at: usize| {
            let row = this.closed_rows[at].row;
            this.rate_of(at).abs() / this.body.delassus(row, row).sqrt()
        };
        let (count, mut first) = (self.closed_rows.len(), 0.0_f64);
        for _ in 0..IN_TURN {
            let approached = (0..count).filter(|&at| self.is_approached(at));
            let Some(at) = approached.max_by(|&a, &b| weighed(self, a).total_cmp(&weighed(self, b))) else { break };
            first = first.max(weighed(self, at));
            self.strike_alone(at);
        }
        let struck = |s: &ClosedRow| s.push != [0.0; 2];
        let left =
            (0..count).filter(|&at| struck(&self.closed_rows[at])).map(|at| weighed(self, at)).fold(0.0, f64::max);
        if left > ACCUMULATED * first && !self.is_any_approached() {
            return Ok(());
        }
        self.closed_rows.iter_mut().filter(|s| struck(s)).for_each(|s| s.restitution = 0.0);
        self.stop()
    }

    /// Ends the impacts of an instant with one programme over all closed walls with e = 0. If rows
    /// are so nearly dependent that it fails, the approached walls are treated in turn with e = 0,
    /// which also ends at a motion that approaches no wall.
    fn stop(&mut self) -> Result<()> {
        if self.pass(true)? { Ok(()) } else { self.in_turn() }
    }

    /// Treats the approached walls with e = 0 until none is left.
    fn in_turn(&mut self) -> Result<()> {
        self.closed_rows.iter_mut().for_each(|s| s.restitution = 0.0);
        for _ in 0..TURNS {
            if !self.is_any_approached() {
                return Ok(());
            }
            if !self.pass(false)? {
                break;
            }
        }
        Err(self.unsolved("closed walls are still approached after their impacts"))
    }

    /// Solves one programme; the `last` one is over all closed walls, with e = 0. False if walls on
    /// opposite sides leave no room for the rebounds.
    fn pass(&mut self, last: bool) -> Result<bool> {
        self.lo.fill(f64::NEG_INFINITY);
        self.hi.fill(f64::INFINITY);
        for closed_row in 0..self.closed_rows.len() {
            let (s, rate, quiet) =
                (self.closed_rows[closed_row], self.rate_of(closed_row), self.quiet(self.closed_rows[closed_row].row));
            if !(last || s.both || rate <= quiet) {
                continue;
            }
            let bound = if last || rate >= -quiet { 0.0 } else { -s.restitution * rate };
            // Between walls on both sides only the approached one counts in this pass, the other in
            // the next: an impulse against the motion never adds energy.
            let fixed = s.both && (last || rate.abs() <= quiet);
            let lower = if s.both { s.sign * rate < 0.0 } else { s.sign > 0.0 };
            if lower || fixed {
                self.lo[s.row] = bound;
            }
            if !lower || fixed {
                self.hi[s.row] = -bound;
            }
        }
        self.rhs.fill(0.0);
        self.body.add_inertia(&self.v, &mut self.rhs);
        if !self.solve()? {
            return Ok(false);
        }
        let Self { solver: Some(solver), closed_rows, body, v, .. } = self else { return Ok(true) };
        for s in closed_rows {
            let p = solver.solution().multiplier.get(s.row).copied().unwrap_or(0.0);
            if p != 0.0 {
                s.push[side_of(p)] += p.abs();
                body.add_column(s.row, p, v);
            }
        }
        Ok(true)
    }

    /// Solves the programme of `rhs`, `lo` and `hi`. False if no motion that satisfies the bounds
    /// is found.
    pub(super) fn solve(&mut self) -> Result<bool> {
        let (time, step) = (self.time, self.steps);
        if self.solver.is_none() || self.turned {
            self.make_solver()?;
            self.turned = false;
        }
        let Some(solver) = &mut self.solver else { return Ok(true) };
        match solver.solve(&Rhs { b: &self.rhs, lo: &self.lo, hi: &self.hi }) {
            Ok(_) => Ok(true),
            Err(Failure::Infeasible { .. } | Failure::NotSolved { .. }) => Ok(false),
            Err(failure) => Err(Error::qp((time, step), None, failure)),
        }
    }

    pub(super) fn unsolved(&self, reason: &str) -> Error {
        Error::Qp { time: self.time, step: self.steps, wall: None, reason: reason.to_owned(), cause: None }
    }

    /// Rounding error of the displacement of a row here, m.
    pub(super) fn resolution(&self, row: usize, position: f64) -> f64 {
        let moved = self.series.span() * self.body.size(row, self.series.term(1));
        noise(self.body.size(row, &self.q) + moved + position.abs())
    }
}

#[cfg(test)]
mod tests;
