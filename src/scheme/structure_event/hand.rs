//! Stretches that are handed to moreau-jean.
//!
//! Impacts may accumulate where no rule ends the accumulation: at several walls in turn, under a
//! force that changes meanwhile, or at e = 1 under drag. More than [`CROWD`] events within two
//! radians of the fastest motion (or a thousandth of the run, if that is shorter) are taken for
//! such an accumulation. A stretch of that length is then stepped by moreau-jean with θ = ½ in
//! [`PARTS`] steps. The exact motion continues from its end, with displacements behind walls put
//! back onto them. The run's notes report it.

use super::StructureEvent;
use super::stretch::Stretch;
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::{Checked, Load, LoadKind, Scene, Table};
use crate::scheme::grid::Grid;
use crate::scheme::matrices::Matrices;
use crate::scheme::moreau_jean::MoreauJean;
use crate::scheme::motion::Motion;
use crate::scheme::supports::Supports;
use crate::scheme::{Handover, Scheme};

/// Maximum number of events within a stretch before it is handed over …
const CROWD: u64 = 5000;

/// … and where the stretch just before has been handed over already.
const CROWD_AGAIN: u64 = 50;

/// Number of steps of a stretch that is handed over: a hundredth of a radian of the fastest motion
/// each.
const PARTS: u64 = 200;

/// The longest stretch, as a share of the run.
const LONGEST: f64 = 1e-3;

/// θ of moreau-jean.
const THETA: f64 = 0.5;

impl StructureEvent {
    /// The length of a stretch in which events are counted, s.
    pub(super) fn crowd_window(&self) -> f64 {
        let rate = self.series.rate();
        let longest = LONGEST * self.clock.duration;
        if rate > 0.0 { longest.min(2.0 / rate) } else { longest }
    }

    /// Hands the next stretch over if there were too many events.
    pub(super) fn hand_over(&mut self) -> Result<()> {
        let (window, events) = (self.crowd_window(), self.clock.total().events);
        if self.time > self.crowd.since + window {
            (self.crowd.since, self.crowd.at_since) = (self.time, events);
        }
        let again = !self.crowd.stretches.is_empty() && self.time <= self.crowd.handed + window;
        if events - self.crowd.at_since <= if again { CROWD_AGAIN } else { CROWD } {
            return Ok(());
        }
        let to = self.limit().min(self.time + window);
        // A blow is given at the end of a step of exact motion, so the stretch ends before it.
        let blown = self.blows.get(self.blow).is_some_and(|&blow| blow <= to);
        let to = if blown { to.next_down() } else { to };
        if to <= self.time {
            return Ok(());
        }
        let (scene, h) = (self.scene_from_here(to - self.time), (to - self.time) / PARTS as f64);
        let contract = Scheme::MoreauJean { theta: THETA }.contract();
        let mut grid: Box<dyn Motion> = if self.body.rounds.is_empty() {
            let rule = Box::new(MoreauJean::<Matrices>::new(&scene, THETA, h, Backend::Auto)?);
            Box::new(Grid::new(&scene, &scene.wall_masses(), rule, contract, h)?)
        } else {
            Box::new(Supports::new(&Checked::made(scene.clone()), THETA, contract, h)?)
        };
        grid.restart(&scene, 0.0, &self.q, &self.v)?;
        self.stretch = Some(Box::new(Stretch { grid, from: self.time, to, h, step: 0, contract }));
        let joins = |last: &&mut Handover| self.time <= last.to + window;
        match self.crowd.stretches.last_mut().filter(joins) {
            Some(last) => (last.to, last.step) = (to, last.step.max(h)),
            None => self.crowd.stretches.push(Handover { from: self.time, to, step: h }),
        }
        Ok(())
    }

    /// The scene with its loads from the present on, up to their next blow or table row. It keeps
    /// its own start, by which distances are measured: from the present state, at which walls
    /// touch, a scene without a gap of its own would have none.
    fn scene_from_here(&self, duration: f64) -> Scene {
        let now = self.time;
        let shifted = |load: &Load| {
            let kind = match &load.kind {
                LoadKind::Constant { .. } => load.kind.clone(),
                LoadKind::Harmonic { amplitude, frequency, phase } => LoadKind::Harmonic {
                    amplitude: *amplitude,
                    frequency: *frequency,
                    phase: phase + std::f64::consts::TAU * frequency * now,
                },
                // A stretch ends before the next blow. Functions of time were rejected at the
                // start.
                LoadKind::Impulse { .. } | LoadKind::Function(_) => return None,
                LoadKind::Table(table) => {
                    let (at, slope) = table.piece(now);
                    let line = Table::new(vec![0.0, 2.0 * duration], vec![at, at + 2.0 * slope * duration]).ok()?;
                    LoadKind::Table(line)
                }
            };
            Some(Load { kind, at: load.at.clone() })
        };
        let scene = Scene {
            system: self.scene.system.clone(),
            walls: self.scene.walls.clone(),
            supports: self.scene.supports.clone(),
            loads: self.scene.loads.iter().filter_map(shifted).collect(),
            probes: Vec::new(),
            output_times: Vec::new(),
            initial: self.scene.initial.clone(),
            duration,
        };
        scene.with_gap_scale(self.scene.gap_scale())
    }

    /// Takes one step of the current stretch.
    pub(super) fn advance_stretch(&mut self, mut stretch: Box<Stretch>) -> Result<()> {
        if stretch.step == 0 {
            // The exact episodes end here; the steps have their own.
            for b in &mut self.barriers {
                self.shown.closed.extend(b.close(self.time, 0.0));
            }
        }
        let s = &mut *stretch;
        s.grid.advance(s.step, Some(&self.shown.extra))?;
        s.step += 1;
        self.crowd.steps += 1;
        let last = s.step == PARTS;
        self.time = if last { s.to } else { s.from + s.step as f64 * s.h };
        let step = s.grid.step(s.step - 1);
        self.q.copy_from_slice(step.q);
        self.v.copy_from_slice(step.v);
        self.shown.impulse.copy_from_slice(step.impulse);
        self.shown.force.copy_from_slice(step.force);
        self.shown.normal.copy_from_slice(step.normal);
        let later = |c: &crate::step::Contact| {
            let mut c = *c;
            c.start += s.from;
            c.end = c.end.map(|end| end + s.from);
            c
        };
        self.shown.closed.extend(step.closed.iter().map(later));
        if !last {
            self.stretch = Some(stretch);
            return Ok(());
        }
        let ended = |mut c: crate::step::Contact| {
            c = later(&c);
            c.end = Some(self.time.max(c.start));
            c.departure_speed = Some(c.departure_speed.unwrap_or(0.0));
            c
        };
        let still = s.grid.open_contacts();
        self.shown.closed.extend(still.into_iter().map(ended));
        self.resume();
        Ok(())
    }

    /// Resumes the exact motion where a stretch has ended.
    fn resume(&mut self) {
        self.crowd.handed = self.time;
        (self.crowd.since, self.crowd.at_since) = (self.time, self.clock.total().events);
        self.clock.pass(self.time);
        self.places.iter_mut().for_each(|place| place.held = 0.0);
        self.hold.set(&self.body, std::iter::empty(), std::iter::empty());
        self.carriers.clear();
        self.decided = f64::NEG_INFINITY;
        self.turn();
        self.reclassify();
        // Blows due now are given in the next step of the exact motion.
    }
}

#[cfg(test)]
mod tests;
