//! What the exact schemes of one and of several degrees of freedom share: when steps end and when a
//! run is abandoned, the walls and their phases, and what a step shows.

mod clock;
mod guard;
mod shown;
mod wall;

pub(super) use clock::Clock;
pub use guard::{EVENTS_PER_WINDOW, EventCounters, WINDOWS};
pub(super) use shown::StepOutput;
pub(super) use wall::{ExactWall, Phase, barriers};

use crate::error::{Error, Result, Subject};
use crate::scene::{LoadKind, Scene};
use crate::scheme::entry::{Coverage, Realised, SchemeEntry, SchemeKind};
use crate::step::{Balance, Conserves, Contract, Promise, Tolerances};

/// Why friction is refused.
const NO_STICKING: &str = "where a contact sticks, slips or turns round in the middle of an impact, the exact scheme \
                           has no law for it";

/// What is known of the exact schemes beside their motion.
pub(super) const ENTRY: SchemeEntry = SchemeEntry {
    name: "event",
    settings: &[],
    default: "",
    kind: SchemeKind::Exact,
    restitution: Realised::PerWall,
    realises: "e, per wall",
    purpose: "the exact reference, also in round holes without friction",
    order: None,
    fails: "gives up, with an error, at more than a million events in a twentieth of the run",
    round: Coverage::Stepped("is exact"),
    elastic_round: Coverage::Refused("the force of an elastic hole has no series of its own"),
    friction: Coverage::Refused(NO_STICKING),
    elastic_round_friction: Coverage::Refused(NO_STICKING),
};

/// What every step of exact motion satisfies.
pub(super) const CONTRACT: Contract = Contract {
    balance: Balance::Exact,
    promise: Promise::throughout(),
    instant: 1.0,
    tolerances: Tolerances::of(Conserves::Everything),
    divides: false,
};

/// Maximum number of contact changes at one instant within one step: beyond it the step ends with
/// length 0, and the guard counts its events.
pub(super) const CHANGES_AT_ONCE: usize = 16;

/// A flight after an impact is the tail of an accumulation of impacts if its height is below this
/// share of the scene's length …
pub(crate) const TAIL_HEIGHT: f64 = 1e-12;

/// … and if the pressing acceleration changes by less than this share before the impacts have
/// accumulated: then t∞ = t + flight/(1 − e) has that relative error.
pub(crate) const TAIL_CHANGE: f64 = 1e-6;

/// A flight shorter than this many units in the last place of the time (of a sweep's oscillators:
/// of the period) is not resolved.
pub(crate) const TIME_UNITS: f64 = 8.0;

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
             or a table, such as one of values of the function; or a stepping scheme",
        )),
        None => Ok(()),
    }
}
