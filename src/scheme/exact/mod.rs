//! What the exact schemes of one and of several degrees of freedom share: when steps end and when a
//! run is abandoned, the walls and their phases, and what a step shows.

mod clock;
mod guard;
mod shown;
mod wall;

pub(super) use clock::Clock;
pub use guard::{EVENTS_PER_WINDOW, EventCounters, WINDOWS};
pub(super) use shown::Shown;
pub(super) use wall::{ExactWall, Phase, barriers};

use crate::error::{Error, Result, Subject};
use crate::scene::{LoadKind, Scene};

/// Maximum number of contact changes at one instant within one step: beyond it the step ends with
/// length 0, and the guard counts its events.
pub(super) const CHANGES_AT_ONCE: usize = 16;

/// Rounding error of a sum of terms of this size: four units in the last place.
pub(crate) fn noise(size: f64) -> f64 {
    4.0 * f64::EPSILON * size
}

/// Rejects loads for which the exact motion is not available.
pub(super) fn known_loads(scene: &Scene) -> Result<()> {
    match scene.loads.iter().position(|load| matches!(load.kind, LoadKind::Function(_))) {
        Some(index) => Err(Error::invalid(
            Subject::nth("load", index),
            "a function of time",
            "for the exact scheme, which has to know the motion in closed form: a constant, a sine, an impulse \
             or a table (one of the function, with a stated error, is Table::sampled); or a stepping scheme",
        )),
        None => Ok(()),
    }
}
