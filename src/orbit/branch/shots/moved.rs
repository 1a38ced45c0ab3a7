//! The strobe moved away from events.

use super::Shots;
use super::step_start::StepStart;
use crate::error::Result;
use crate::orbit::branch::arclength::{Vector, extended};
use crate::orbit::orbit_run::{Recorded, run};
use crate::orbit::signature::Kind;

/// Step along the tangent, relative to its length, of the second point that is moved to the new
/// strobe to find the tangent there.
const CARRY: f64 = 1e-6;

/// Weight of a stretch at rest on a wall when a place for the strobe is chosen; free flight has 1.
const HELD: f64 = 0.2;

/// A turning point closer to a wall than this share of the gap may become an impact.
const CLOSE: f64 = 0.05;

/// The strobe lies at least this share of the longest flight away from events.
const ROOM: f64 = 0.15;

impl Shots<'_> {
    /// The curve with its strobe moved to `strobe` (cycles), and the same point of it.
    pub(super) fn moved(&self, now: &StepStart, strobe: f64) -> Result<(Self, StepStart)> {
        let passed = now.passages.iter().filter(|p| p.phase < strobe).count();
        let count = now.passages.len() * if self.symmetric { 2 } else { 1 };
        let turn = f64::from(self.periods);
        let moved = Self {
            strobe: strobe - (strobe / turn).floor() * turn,
            first: (self.first + 2 * count - passed) % count.max(1),
            ..self.clone()
        };
        let (y, along) = self.carried(&now.y, &now.tangent, strobe)?;
        let (y, linear, _) = moved.correct(&y, &along, None)?;
        let there = moved.step_start(y, linear, &along)?;
        Ok((moved, there))
    }

    /// The better instant for the strobe, in cycles; `None` where it is well placed.
    pub(super) fn better_strobe(&self, now: &StepStart) -> Option<f64> {
        let (start, turn) = (self.strobe, self.cycles());
        let close = now.touches.iter().filter(|touch| touch.gap < CLOSE * self.scales.length);
        let mut phases: Vec<f64> = now.passages.iter().map(|p| p.phase).chain(close.map(|touch| touch.phase)).collect();
        phases.sort_by(f64::total_cmp);
        let (first, last) = (*phases.first()?, *phases.last()?);
        phases.push(first + turn);
        // The state of a body held by a wall is known less accurately.
        let rests = |phase: f64| {
            now.passages.iter().any(|p| p.phase == phase && matches!(p.event.kind, Kind::Rest | Kind::Chatter))
        };
        let room = |pair: &[f64]| (pair[1] - pair[0]) * if rests(pair[0]) { HELD } else { 1.0 };
        let longest = phases.windows(2).max_by(|a, b| room(a).total_cmp(&room(b)))?;
        let left = (first - start).min(start + turn - last);
        (left < ROOM * (longest[1] - longest[0])).then(|| 0.5 * (longest[0] + longest[1]))
    }

    /// The point `y` and the unit tangent there, with the state advanced to `strobe` (cycles).
    pub(super) fn carried(&self, y: &Vector, tangent: &Vector, strobe: f64) -> Result<(Vector, Vector)> {
        let carried = |y: &Vector| -> Result<Vector> {
            let posed = self.posed(self.value(y))?;
            let span = [self.strobe, strobe].map(|phase| phase * posed.period);
            let turn = run(&posed.scene, posed.period, span, &self.state(y), Recorded::Events)?;
            Ok(extended(&self.scales.scaled(&turn.end), y[y.len() - 1]))
        };
        let there = carried(y)?;
        let beside = carried(&(y + tangent * CARRY))?;
        let along = (beside - &there).normalize();
        Ok((there, along))
    }
}
