//! The coarsest step with which refinement begins: just short enough to see the shortest event of
//! the scene.

use crate::error::Result;
use crate::scene::{LoadKind, Loads, Scene, System};
use crate::time::{TimeGrid, TimeOptions};
use std::f64::consts::{PI, TAU};

/// Number of first steps in the shortest period or contact of the scene.
const STEPS_PER_PERIOD: f64 = 8.0;

/// Least number of steps in a run.
const FEWEST_STEPS: f64 = 64.0;

/// Most rows where no spacing is asked for.
const MOST_ROWS: f64 = 1e4;

/// Rows and first step of a refinement. Every further level halves the step and keeps the rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoarseGrid {
    /// Spacing of the rows, s.
    pub sample: f64,
    /// Steps over the whole run.
    pub steps: u64,
    /// Steps between two rows.
    per_row: u64,
}

impl CoarseGrid {
    /// The coarse grid of `scene`. Its rows are those asked for; without a spacing there is one row
    /// per first step, at most ten thousand.
    ///
    /// # Errors
    /// [`crate::Error::Invalid`] for times that make no sense.
    pub fn of(scene: &Scene, time: &TimeOptions) -> Result<Self> {
        let shortest = shortest_time(scene) / STEPS_PER_PERIOD;
        let largest = shortest.min(scene.duration / FEWEST_STEPS);
        let spacing = time.sample.unwrap_or(largest.max(scene.duration / MOST_ROWS));
        let rows =
            TimeGrid::stepping(scene.duration, &TimeOptions { step: 0.5 * spacing, sample: Some(spacing), ..*time })?;
        let sample = scene.duration / rows.rows as f64;
        // In range: the number of rows is bounded, and a scene with more steps per row than this is
        // refused by its grid.
        let per_row = (sample / largest * (1.0 - 1e-9)).ceil().clamp(1.0, 1e9) as u64;
        Ok(Self { sample, steps: rows.rows.saturating_mul(per_row), per_row })
    }

    /// The time options of the grid whose step has been halved `level` times.
    #[must_use]
    pub fn options(&self, level: u32, time: &TimeOptions) -> TimeOptions {
        let step = self.sample / (self.per_row as f64 * 2f64.powi(level as i32));
        TimeOptions { step, sample: Some(self.sample), ..*time }
    }
}

/// The shortest time scale of the scene, s: a period of the system (with several degrees of
/// freedom, the geometric mean between the slowest and the fastest), a period of a load, the
/// spacing of a table, a contact with an elastic wall, or the time in which the gap is crossed at
/// the initial speed. Infinite where the scene has no time scale.
fn shortest_time(scene: &Scene) -> f64 {
    let [slowest, fastest] = scene.system.frequencies();
    let slowest = match scene.system {
        System::Oscillator(_) => slowest,
        // The geometric mean: impacts excite more than the slowest mode, and further halvings
        // resolve the faster ones.
        System::Structure(_) => (slowest.max(TAU / scene.duration) * fastest).sqrt(),
    };
    let mut times = vec![period(slowest * slowest)];
    for load in &scene.loads {
        match &load.kind {
            LoadKind::Harmonic { frequency, .. } if *frequency > 0.0 => times.push(1.0 / frequency),
            LoadKind::Table(table) => {
                if let [first, .., last] = table.time() {
                    // Table rows are samples of a signal, so a period holds several of them.
                    times.push(STEPS_PER_PERIOD * (last - first) / (table.time().len() - 1) as f64);
                }
            }
            _ => {}
        }
    }
    let masses = scene.wall_masses();
    let mut blow = vec![0.0; scene.initial.v.len()];
    Loads::new(&scene.loads).initial_blow(&mut blow);
    for (wall, mass) in scene.walls.iter().zip(masses) {
        // Speed at the wall from an impulse at the start, taken up by the mass that the wall feels:
        // an estimate, exact for one degree of freedom.
        let speed = (wall.row().dot(&scene.initial.v) + wall.row().dot(&blow) / mass).abs();
        if speed > 0.0 {
            times.push(scene.gap_scale() / speed);
        }
        if let Some(stiffness) = wall.law.stiffness() {
            times.push(PI / TAU * period(slowest * slowest + stiffness / mass));
        }
    }
    times.into_iter().fold(f64::INFINITY, f64::min)
}

fn period(omega_squared: f64) -> f64 {
    if omega_squared > 0.0 { TAU / omega_squared.sqrt() } else { f64::INFINITY }
}
