//! What walls store.

use crate::scene::Wall;

/// Energy stored in a wall at displacement `w`, J; 0 for a damped wall that does not touch the
/// body.
pub(in super::super) fn stored(wall: &Wall, w: f64, touching: bool) -> f64 {
    if wall.law.is_damped() && !touching { 0.0 } else { wall.law.energy(-wall.gap(w)) }
}

/// Energy stored half a step on the way from `w` to `w + shift`: the mean of both ends.
pub(super) fn half(wall: &Wall, w: f64, shift: f64, touching: bool) -> f64 {
    0.5 * (stored(wall, w, touching) + stored(wall, w + shift, touching))
}
