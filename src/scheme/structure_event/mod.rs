//! The exact scheme for several degrees of freedom: Taylor series between events, which are located
//! to rounding.
//!
//! | file | what it holds |
//! |---|---|
//! | `start.rs` | the scene at its start |
//! | `rows.rs` | the rows of the walls: bounds, which are held, rounding errors |
//! | `search.rs`, `root.rs` | the first event of a stretch |
//! | `motion.rs` | the motion between events: series, forces, impulses |
//! | `pace.rs` | how long a series is to be where events follow one another quickly |
//! | `instant.rs` | what happens at one instant, and the episodes of contact |
//! | `impact.rs` | impacts, at several walls at once |
//! | `tail.rs` | accumulations of impacts, which end in lasting contact |
//! | `rest.rs` | which touching walls push where the speed is 0 |
//! | `closed_row.rs` | a closed row at an instant, and what becomes of it |
//! | `round.rs` | round holes: rows that turn |
//! | `hand.rs`, `stretch.rs` | the stretches that are handed to moreau-jean |
//! | `back.rs` | the structure put back in front of its walls after them |
//! | `view.rs` | what the scheme shows after each step |

mod back;
mod closed_row;
mod hand;
mod impact;
mod instant;
mod motion;
mod pace;
mod rest;
mod root;
mod round;
mod rows;
mod search;
mod start;
mod stretch;
mod tail;
mod view;

use super::exact::{CHANGES_AT_ONCE, Clock, ExactWall, StepOutput};
use super::frame::all_finite;
use super::matrices::Matrices;
use crate::error::{Error, Result};
use crate::flow::{HeldRows, Series, SeriesBody, Touching};
use crate::qp;
use crate::scene::{Loads, Scene};
use crate::step::Contract;
use closed_row::ClosedRow;
use pace::Pace;
use rows::{DERIVATIVES, Sizes, WallRow};
use std::sync::Arc;
use stretch::{ImpactBurst, Stretch};

/// A structure between walls, advanced from event to event:
///
/// M q̈ + C q̇ + K q = f(t) + Gᵀ r, 0 ≤ gap ⟂ |r| ≥ 0 and an impact law at rigid walls, |r| =
/// max(0, k_a s + c_a ṡ) for s > 0 at elastic ones.
///
/// Between events the motion is a [`Series`]; a step ends with an event or with the series. The
/// first root of each gap, and of the force of each wall that touches, is never skipped
/// (`root.rs`).
///
/// - Impacts at several walls at once are one quadratic programme in the metric of M: see
///   `impact.rs`. They never gain energy.
/// - Walls that touch at speed 0 balance the forces that press on them: 0 ≤ ẅ ⟂ λ ≥ 0, one
///   quadratic programme, and where both vanish the next derivatives decide (`rest.rs`).
/// - Accumulations of impacts end in lasting contact as for one degree of freedom.
/// - A round hole is an upper wall along its normal, whose row turns with the motion (`round.rs`):
///   the structure hits it at a root of (γ² − |w|²)/2γ, and lasting contact is sliding round it.
#[derive(Debug)]
pub(super) struct StructureEvent {
    scene: Arc<Scene>,
    body: SeriesBody,
    loads: Loads,
    barriers: Vec<ExactWall>,
    /// One for each row of the body.
    places: Vec<WallRow>,
    /// Walls of each row.
    walls_of: Vec<Vec<usize>>,
    solver: Option<qp::Solver>,
    /// Programmes, pivots and fallbacks of solvers that are no longer used, and whether rows of
    /// holes have turned since the present one was made.
    spent: [u64; 3],
    turned: bool,
    series: Series,
    /// Work space for looking ahead.
    flight: Series,
    hold: HeldRows,
    /// The rows that touch at an instant, to put the structure onto their surfaces.
    surface: HeldRows,
    /// Walls that hold rows: wall, number of the held row, share.
    carriers: Vec<(usize, usize, f64)>,
    touching: Vec<Touching>,
    closed_rows: Vec<ClosedRow>,
    /// The largest speed of a row that touches at the present instant, m/s, and in the metric of
    /// the mass, √J.
    fastest_row: f64,
    fastest_weighed: f64,
    sizes: Sizes,
    clock: Clock,
    /// A typical displacement of the scene, m.
    length: f64,
    time: f64,
    q: Vec<f64>,
    v: Vec<f64>,
    /// Factor on the rounding error that a coefficient must exceed to count as different from 0:
    /// above 1 while events follow one another without motion, since only rounding can make the
    /// search contradict the last decision.
    doubt: f64,
    /// The instant of the last decision on the rows, s.
    decided: f64,
    /// Times of the blows after the start, s, and the number given so far.
    blows: Vec<f64>,
    blow: usize,
    pace: Pace,
    crowd: ImpactBurst,
    stretch: Option<Box<Stretch>>,
    /// The contract and the step (s) of the last step, if it was handed over.
    handed: Option<(Contract, f64)>,
    steps: u64,
    // Vectors of length n.
    derivatives: [Vec<f64>; DERIVATIVES],
    rhs: Vec<f64>,
    rhs_size: Vec<f64>,
    arriving: Vec<f64>,
    departing: Vec<f64>,
    // Vectors over rows.
    scratch: Vec<f64>,
    pushes: Vec<f64>,
    lo: Vec<f64>,
    hi: Vec<f64>,
    shown: StepOutput<Matrices>,
}

/// Factor by which `doubt` grows with each such event, and its maximum.
const DOUBT: f64 = 4.0;
const MOST_DOUBT: f64 = 1e4;

impl StructureEvent {
    /// Takes the extra force of the step; what was decided under another one no longer holds.
    fn take_extra(&mut self, extra: Option<&[f64]>) {
        let changed = match extra {
            Some(extra) => self.shown.extra != extra,
            None => self.shown.extra.iter().any(|&f| f != 0.0),
        };
        if changed {
            match extra {
                Some(extra) => self.shown.extra.copy_from_slice(extra),
                None => self.shown.extra.fill(0.0),
            }
            self.decided = f64::NEG_INFINITY;
        }
    }

    /// Moves on to the next event, end of a series, multiple of the stride, or the end of the
    /// scene, whichever is first, under a constant extra force (N, n entries; `None` means 0). A
    /// step of no length happens where the structure starts on a wall and moves into it. Past the
    /// end of the scene the motion goes on.
    ///
    /// # Errors
    /// [`Error::TooManyEvents`]; [`Error::NotFinite`] if the numbers overflow; [`Error::Qp`] if a
    /// programme is not solved.
    pub fn advance(&mut self, extra: Option<&[f64]>) -> Result<()> {
        self.shown.begin(self.time, &self.v);
        self.take_extra(extra);
        self.steps += 1;
        self.handed = None;
        if self.stretch.is_none() {
            self.hand_over()?;
        }
        if let Some(stretch) = self.stretch.take() {
            self.handed = Some((stretch.contract, stretch.h));
            self.advance_stretch(stretch)?;
            return self.clock.check(self.time, &self.barriers);
        }
        if self.crowd.handed == self.time {
            // Not before: the last step told where it ended.
            self.put_back()?;
        }
        for _ in 0..CHANGES_AT_ONCE {
            let before = self.time;
            let limit = self.limit();
            self.begin_within(limit, self.pace.reach());
            self.clock.count().evaluations += 1;
            let hit = self.search();
            let (x, end) = match hit {
                Some(hit) => (hit.x, (self.time + hit.x * self.series.unit()).min(self.series.end())),
                None => (self.series.span(), self.series.end()),
            };
            self.pace.note(end - before, hit.is_some(), self.series.longest());
            self.note_pressures(x);
            self.time = end;
            self.series.cut(end);
            if x > 0.0 {
                self.series.state_at(x, &mut self.q, &mut self.v);
                self.check()?;
            }
            self.gather_impulses();
            let changed = self.resolve_instant(hit.map(|hit| hit.cause))?;
            let jumped = self.shown.jumped();
            self.doubt = if end > before || jumped { 1.0 } else { (DOUBT * self.doubt).min(MOST_DOUBT) };
            if end > self.shown.start || jumped || !changed {
                break;
            }
        }
        self.clock.pass(self.time);
        self.shown.add_jumps();
        let round = !self.body.rounds.is_empty();
        if round {
            self.turn();
        }
        self.set_forces();
        if round {
            self.write_holes();
        }
        self.clock.check(self.time, &self.barriers)
    }

    fn check(&self) -> Result<()> {
        if all_finite(&self.q) && all_finite(&self.v) {
            return Ok(());
        }
        Err(Error::NotFinite { time: self.time, step: self.steps, what: "state" })
    }
}

#[cfg(test)]
mod tests;
