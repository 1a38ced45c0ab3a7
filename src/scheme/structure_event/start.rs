//! The exact scheme at the start of a scene.

use super::StructureEvent;
use super::pace::Pace;
use super::rows::{Sizes, WallRow};
use super::stretch::ImpactBurst;
use crate::error::{Error, Result};
use crate::flow::{HeldRows, Series, SeriesBody};
use crate::qp::{self, Backend};
use crate::scene::{Loads, Scene};
use crate::scheme::exact::{Clock, StepOutput, barriers, known_loads};
use std::sync::Arc;

/// The programme's signs are tested relative to its own motion, so any positive length will do.
const SCALE: f64 = 1e-200;

impl StructureEvent {
    /// The scene at its start, after the blows at t = 0. Steps end at events, with a series, and at
    /// multiples of `stride` (s).
    ///
    /// # Errors
    /// [`Error::Invalid`] for a wall of the φ² penalty, which has no linear law, and for a function
    /// of time as load. Holes must be rigid.
    pub(in crate::scheme) fn new(scene: &Arc<Scene>, stride: f64) -> Result<Self> {
        // In one piece: most of it is the list of the fields.
        known_loads(scene)?;
        let barriers = barriers(scene)?;
        let (walls, round) = (barriers.len(), scene.holes().next().is_some());
        let singular = || Error::invalid(("system", "mass matrix"), "singular", "a positive definite matrix");
        let mut body = SeriesBody::new(scene).ok_or_else(singular)?;
        let (n, rows) = (body.n, body.rows.count());
        let mut walls_of = vec![Vec::new(); rows];
        body.row_of.iter().enumerate().for_each(|(wall, &row)| walls_of[row].push(wall));
        let places: Vec<WallRow> = walls_of.iter().map(|walls| WallRow::new(scene, walls)).collect();
        let loads = Loads::new(&scene.loads);
        let v = velocity_after_blow(scene, &loads, &mut body);
        let mut blows: Vec<f64> = body.blow_times();
        blows.retain(|&t| t > 0.0);
        let zero = || vec![0.0; n];
        let mut event = Self {
            loads,
            barriers,
            places,
            walls_of,
            solver: None,
            series: Series::new(&body),
            flight: Series::new(&body),
            hold: HeldRows::with_room(rows),
            surface: HeldRows::with_room(rows),
            carriers: Vec::with_capacity(walls),
            touching: Vec::with_capacity(walls),
            closed_rows: Vec::with_capacity(rows),
            fastest_row: 0.0,
            fastest_weighed: 0.0,
            sizes: Sizes::new(n),
            clock: Clock::new(scene.duration, stride),
            length: if walls > 0 { scene.gap_scale() } else { 0.0 },
            time: 0.0,
            q: scene.initial.q.clone(),
            shown: StepOutput::new(&v, (walls, round), 3 * walls + 2),
            v,
            doubt: 1.0,
            decided: f64::NEG_INFINITY,
            blows,
            blow: 0,
            pace: Pace::new(),
            crowd: ImpactBurst::default(),
            spent: [0; 3],
            turned: false,
            stretch: None,
            handed: None,
            scene: scene.clone(),
            steps: 0,
            derivatives: std::array::from_fn(|_| zero()),
            rhs: zero(),
            rhs_size: zero(),
            arriving: zero(),
            departing: zero(),
            scratch: vec![0.0; rows],
            pushes: Vec::with_capacity(rows),
            lo: vec![f64::NEG_INFINITY; rows],
            hi: vec![f64::INFINITY; rows],
            body,
        };
        if rows > 1 && !round && event.body.is_small() {
            event.make_solver()?;
        }
        event.turn();
        event.reclassify();
        event.set_forces();
        Ok(event)
    }

    /// Makes the solver of impacts and of lasting contact at several walls, when it is first
    /// needed: with many walls it is large.
    pub(super) fn make_solver(&mut self) -> Result<()> {
        self.book_solver();
        let (mass, rows) = (self.scene.system.structure().mass.clone(), &self.body.rows);
        let problem = qp::Problem { a: mass, g: rows.clone(), compliance: vec![0.0; rows.count()] };
        let (time, step) = (self.time, self.steps);
        let solver = qp::Solver::new(problem, Backend::Condensed, SCALE);
        self.solver = Some(solver.map_err(|failure| Error::qp((time, step), None, failure))?);
        Ok(())
    }

    /// Restarts the motion at `time` (s) from `q` (m) and `v` (m/s), n entries each: the state
    /// after any jump at that instant.
    pub fn restart(&mut self, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        let mut event = Self::new(&self.scene, self.clock.stride)?;
        event.time = time;
        event.q.copy_from_slice(q);
        event.v.copy_from_slice(v);
        event.shown.begin(time, &event.v);
        event.blow = event.blows.iter().filter(|&&blow| blow <= time).count();
        (event.clock, event.steps) = (self.clock.clone(), self.steps);
        event.clock.restart(time);
        event.crowd = std::mem::take(&mut self.crowd);
        event.crowd.restart(time, event.clock.total().events);
        event.turn();
        event.reclassify();
        event.shown.closed.clear();
        event.set_forces();
        (event.solver, event.spent, event.turned) = (self.solver.take(), self.spent, true);
        *self = event;
        Ok(())
    }
}

/// The initial velocity after the blows at t = 0, m/s.
fn velocity_after_blow(scene: &Scene, loads: &Loads, body: &mut SeriesBody) -> Vec<f64> {
    let (mut v, mut blow) = (scene.initial.v.clone(), vec![0.0; body.n]);
    if loads.initial_blow(&mut blow) {
        body.solve(&mut blow);
        v.iter_mut().zip(&blow).for_each(|(v, change)| *v += change);
    }
    v
}
