//! The exact motion as a reference: whether it can be afforded, and once more with another rounding.

use crate::error::{Error, Result};
use crate::residual::{Finding, Judge};
use crate::run::Run;
use crate::scene::Scene;
use crate::scheme::{Scheme, Stepper};
use crate::statistics::{Forces, Statistics};
use crate::time::TimeOptions;
use crate::trajectory::{Recorder, Trajectory};

/// Steps from event to event that a reference may take: a second or so. The exact scheme itself follows far more before it gives up.
const MOST_EVENTS: u64 = 1_000_000;

/// What several degrees of freedom cost: each takes its part in every event, about a quarter of what one takes alone.
fn most_events(scene: &Scene) -> u64 {
    (4 * MOST_EVENTS / scene.system.degrees_of_freedom().max(1) as u64).clamp(1000, MOST_EVENTS)
}

/// Follows `scene` from event to event and keeps nothing.
///
/// # Errors
/// What the exact scheme reports, and [`Error::TooManyEvents`] beyond a million steps of one degree of freedom, four million over n of n.
pub fn affordable(scene: &Scene) -> Result<()> {
    let mut stepper = Stepper::new(scene, &Scheme::Event, scene.duration)?;
    let most = most_events(scene);
    for _ in 0..most {
        if stepper.time() >= scene.duration {
            return Ok(());
        }
        stepper.step()?;
    }
    let time = stepper.time();
    let wall = scene.walls.first().map_or_else(String::new, |w| w.name.clone());
    Err(Error::TooManyEvents { time, wall, count: most, window: time })
}

/// Stretches of the other run over the duration: no divisor of anything, so that its stops fall on no row and no period.
const STRETCHES: f64 = 97.3;

/// The stride of the other run, s: the exact scheme stops at its multiples and begins its closed form anew, with other roundings.
#[must_use]
pub fn stride(scene: &Scene) -> f64 {
    scene.duration / STRETCHES
}

/// The exact motion with other roundings.
#[derive(Debug, Clone)]
pub struct Replay {
    /// Its rows and contacts.
    pub trajectory: Trajectory,
    /// Its statistics.
    pub statistics: Statistics,
    /// What the judge refutes of it.
    pub findings: Vec<Finding>,
}

/// The exact motion of `scene` at the rows of `run`, with stops at every multiple of [`stride`]; its statistics have the window of `time`.
///
/// # Errors
/// What the exact scheme reports.
pub fn replay(scene: &Scene, run: &Run, time: &TimeOptions) -> Result<Replay> {
    let mut stepper = Stepper::new(scene, &Scheme::Event, stride(scene))?;
    let state = stepper.state();
    let mut judge = Judge::new(scene, stepper.contract(), stride(scene), &state.q, &state.v);
    let mut recorder = Recorder::new(scene, run.grid.rows, &state.q, &state.v);
    let mut forces = Forces::new(scene, time.statistics_from, time.force_averaging);
    while stepper.time() < scene.duration {
        let step = stepper.step()?;
        judge.see(&step);
        recorder.see(&step);
        forces.see(&step);
    }
    let trajectory = recorder.finish(&stepper.open_contacts());
    let statistics = Statistics::new(scene, trajectory.contacts(), time.statistics_from).with_forces(&forces);
    Ok(Replay { trajectory, statistics, findings: judge.findings() })
}
