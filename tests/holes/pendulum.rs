//! `disk-pendulum`: a mass slides in a round hole under a constant force, from rest at 60°. Its
//! motion is that of a pendulum, in elliptic functions.
#![allow(
    clippy::excessive_precision,
    reason = "reference values stand as they were computed, to more digits than a double holds"
)]

use crate::rubbing::{body, hole, isotropic, load, with};
use signorini::{Load, Row, Scene};

/// The gap, m.
pub const GAP: f64 = 1.5e-3;

/// A period, s, and over it the work of wear, J, and the impulse of the hole, N s.
pub const PERIOD: f64 = 0.09536044058204921612609037;
pub const WORK: f64 = 0.05583163176564185498893038;
pub const IMPULSE: f64 = 0.6997885665844563269792825;

pub fn pendulum() -> Scene {
    let angle = 60.0_f64.to_radians();
    with(isotropic(0.8, 0.0, 0.0), hole("hole", body(), GAP, 0.7, 0.0))
        .with_load(load(Load::constant(6.0), Row::dof(0)))
        .with_initial(&[GAP * angle.cos(), GAP * angle.sin()], &[0.0, 0.0])
}
