//! The exact motion as a reference: whether it can be afforded, and the same motion with other
//! roundings.

use crate::error::{Error, Result};
use crate::residual::{Finding, Judge};
use crate::run::{Recorded, Recording, Run};
use crate::scene::Scene;
use crate::scheme::{Scheme, Stepper};
use crate::statistics::Statistics;
use crate::time::TimeOptions;
use crate::trajectory::Trajectory;

/// Most events that a reference may take: about a second. The exact scheme itself follows many more
/// before it gives up.
const MOST_EVENTS: u64 = 1_000_000;

/// The same limit for several degrees of freedom: each takes part in every event, at about a
/// quarter of the cost of a single one.
fn most_events(scene: &Scene) -> u64 {
    (4 * MOST_EVENTS / scene.system.degrees_of_freedom().max(1) as u64).clamp(1000, MOST_EVENTS)
}

/// Follows `scene` from event to event without recording.
///
/// # Errors
/// Errors of the exact scheme, and [`Error::TooManyEvents`] beyond a million events for one degree
/// of freedom, four million over n for n.
pub fn affordable(scene: &Scene) -> Result<()> {
    let mut stepper = Stepper::new(scene, &Scheme::Event, scene.duration)?;
    let mut count = 0;
    while stepper.time() < scene.duration {
        stepper.step()?;
        count += 1;
        limit_events(scene, stepper.time(), count)?;
    }
    Ok(())
}

/// An error if the exact motion of `scene` has taken too many events, `count` up to `time` (s).
///
/// # Errors
/// [`Error::TooManyEvents`], as [`affordable`].
pub(super) fn limit_events(scene: &Scene, time: f64, count: u64) -> Result<()> {
    if count < most_events(scene) {
        return Ok(());
    }
    let wall = scene.walls.first().map_or_else(String::new, |w| w.name.clone());
    Err(Error::TooManyEvents { time, wall, count, window: time })
}

/// Number of stretches of the other run in the duration; not a round number, so that its stops fall
/// on no row and no period.
const STRETCHES: f64 = 97.3;

/// The stride of the other run, s: the exact scheme stops at its multiples and starts its closed
/// form anew, with other roundings.
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
    /// Findings of the judge.
    pub findings: Vec<Finding>,
}

/// The exact motion of `scene` at the rows of `run`, with stops at every multiple of [`stride`];
/// its statistics have the window of `time`.
///
/// # Errors
/// Errors of the exact scheme.
pub fn replay(scene: &Scene, run: &Run, time: &TimeOptions) -> Result<Replay> {
    let mut stepper = Stepper::new(scene, &Scheme::Event, stride(scene))?;
    let state = stepper.state();
    let mut judge = Judge::new(scene, stepper.contract(), stride(scene), &state.q, &state.v);
    let mut recorder = Recorded::begin(&stepper, run.grid.rows, &state, time);
    while stepper.time() < scene.duration {
        let step = stepper.step()?;
        judge.observe(&step);
        Recorded::observe(&mut recorder, &step);
    }
    let (open, masses) = (stepper.open_contacts(), scene.wall_masses());
    let (trajectory, statistics) = Recorded::finish(recorder, &open, scene, &masses, time.statistics_from);
    Ok(Replay { trajectory, statistics, findings: judge.findings() })
}
