//! Which scenes a scheme refuses, and why: from its entry.

use super::entry::Coverage;
use super::{Integrator, Method, Scheme, SchemeKind};
use crate::error::{Error, Result, Subject};
use crate::qp::Backend;
use crate::scene::Scene;

/// Refuses `scene` where `method` has no rule for its walls or supports.
///
/// # Errors
/// [`Error::Invalid`]: what of the scene it is, and what would be accepted.
pub(super) fn check(scene: &Scene, Method { scheme, backend }: Method) -> Result<()> {
    let entry = scheme.entry();
    if entry.kind == SchemeKind::Qp
        && let Some(wall) = scene.walls.iter().find(|wall| !wall.law.is_linear())
    {
        let expected = "a rigid or an elastic wall, or the scheme penalty, which steps through that law";
        return Err(Error::invalid(Subject::wall(&wall.name).part("law"), "the φ² penalty", expected));
    }
    if !scene.turns_or_rubs() {
        return Ok(());
    }
    let refuse = |what: &str, name: &str, expected: &str| {
        Err(Error::invalid("scheme", format!("{scheme}, with {what} {name:?}"), expected.to_owned()))
    };
    let ring = scene.holes().find(|hole| !hole.law.is_rigid());
    if let Some((index, wall)) = scene.walls.iter().enumerate().find(|(_, wall)| wall.friction.acts()) {
        if let Coverage::Refused(expected) = entry.friction {
            let place = if scene.is_slider(index) { "friction at the slider" } else { "friction at the wall" };
            return refuse(place, &wall.name, expected);
        }
        if let (Some(ring), Coverage::Refused(expected)) = (&ring, entry.elastic_round_friction) {
            return refuse("friction and the elastic round support", ring.name, expected);
        }
    }
    if let (Some(ring), Coverage::Refused(expected)) = (&ring, entry.elastic_round) {
        return refuse("the elastic round support", ring.name, expected);
    }
    if let (Some(hole), Coverage::Refused(expected)) = (scene.holes().next(), entry.round) {
        return refuse("the round support", hole.name, expected);
    }
    if let Scheme::Penalty { integrator, .. } = scheme
        && integrator != Integrator::DiscreteGradient
    {
        let expected = "discrete-gradient: of the penalties, only that one keeps energy and angular momentum in a \
                        round hole";
        return Err(Error::invalid("integrator", integrator, expected));
    }
    if backend != Backend::Auto && entry.kind != SchemeKind::Exact {
        let expected = "auto: with round supports or friction a step is no quadratic programme, and sweeps over its \
                        contacts solve it";
        return Err(Error::invalid("QP solver", backend, expected));
    }
    Ok(())
}
