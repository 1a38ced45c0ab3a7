//! Which scenes a scheme refuses, and why: from its entry.

use super::entry::{Coverage, SchemeKind};
use super::{Integrator, Method, Scheme};
use crate::error::{Error, Result, Subject};
use crate::qp::Backend;
use crate::scene::{Scene, Wall};
use std::fmt::Display;

/// What a scheme may take in place of what it refuses.
const NO_FRICTION: &str = "no friction";
const RIGID: &str = "rigid round supports";

/// What of a scene a scheme has no rule for.
struct Refusal {
    /// In words, with the name of the place.
    found: String,
    /// What the scheme would take in its place.
    instead: &'static [&'static str],
    why: &'static str,
}

/// What `scheme` refuses of the supports, sliders and friction of `scene`: of several, what would
/// be refused without friction as well comes first.
fn refusal(scene: &Scene, scheme: Scheme) -> Option<Refusal> {
    let entry = scheme.entry();
    let refused = |coverage: Coverage, what: &str, name: &str, instead: &'static [&'static str]| match coverage {
        Coverage::Refused(why) => Some(Refusal { found: format!("{what} {name:?}"), instead, why }),
        Coverage::Stepped(_) => None,
    };
    let ring = scene.holes().find(|hole| !hole.law.is_rigid());
    let hole = scene.holes().next();
    let rubs = scene.walls.iter().enumerate().find(|(_, wall)| wall.friction.acts());
    let takes = |coverage: Coverage| matches!(coverage, Coverage::Stepped(_));
    let were_it_rigid: &[&str] =
        if takes(entry.round) && (rubs.is_none() || takes(entry.friction)) { &[RIGID] } else { &[] };
    let found = ring.as_ref();
    let found =
        found.and_then(|ring| refused(entry.elastic_round, "the elastic round support", ring.name, were_it_rigid));
    let found = found.or_else(|| refused(entry.round, "the round support", hole?.name, &[]));
    found.or_else(|| {
        let (index, wall) = rubs?;
        let place = match () {
            () if wall.is_round() => "friction at the round support",
            () if scene.is_slider(index) => "friction at the slider",
            () => "friction at the wall",
        };
        refused(entry.friction, place, &wall.name, &[NO_FRICTION]).or_else(|| {
            let both = "friction and the elastic round support";
            refused(entry.elastic_round_friction, both, ring?.name, &[NO_FRICTION, RIGID])
        })
    })
}

/// A wall whose law neither a quadratic programme nor the exact motion takes.
fn nonlinear_wall(scene: &Scene, scheme: Scheme) -> Option<&Wall> {
    scene.nonlinear_wall().filter(|_| scheme.entry().kind != SchemeKind::Penalty)
}

/// Refuses a scene that no scheme steps: penalties, which alone step a law that is not linear, have
/// no friction.
///
/// # Errors
/// [`Error::Invalid`] whose subject is the wall with that law.
pub(crate) fn check_some_scheme(scene: &Scene) -> Result<()> {
    let rubs = scene.walls.iter().find(|wall| wall.friction.acts());
    let (Some(wall), Some(rubs)) = (scene.nonlinear_wall(), rubs) else { return Ok(()) };
    let value = format!("{}, beside the friction at {:?}", wall.law.kind(), rubs.name);
    let expected = "no friction, or walls that are rigid or elastic: no scheme steps both";
    Err(Error::invalid(Subject::wall(&wall.name), value, expected))
}

/// What would be accepted in place of what is refused: one of `schemes`, or the scene without it.
fn expected(schemes: &[&str], refusal: &Refusal) -> String {
    let mut choices = [schemes, refusal.instead].concat();
    let last = choices.pop().unwrap_or("a scene without it");
    let others = choices.join(", ");
    let or = if others.is_empty() { "" } else { " or " };
    format!("{others}{or}{last}: {}", refusal.why)
}

/// Refuses `scene` where the exact scheme does, for `asked`, which no other scheme can give.
///
/// # Errors
/// [`Error::Invalid`]: what of the scene it is, and what would be accepted.
pub(crate) fn check_exact(scene: &Scene, asked: impl Display) -> Result<()> {
    if let Some(wall) = nonlinear_wall(scene, Scheme::Event) {
        let found = format!("asked for {asked}, and the wall {:?} has {}", wall.name, wall.law.kind());
        return Err(Error::invalid("the exact motion", found, "rigid and elastic walls"));
    }
    match refusal(scene, Scheme::Event) {
        Some(refusal) => {
            let found = format!("asked for {asked}, with {}", refusal.found);
            Err(Error::invalid("the exact motion", found, expected(&[], &refusal)))
        }
        None => Ok(()),
    }
}

/// Refuses `scene`, whose walls are those of the case, where `method` has no rule for its walls or
/// supports.
///
/// # Errors
/// [`Error::Invalid`]: what of the scene it is, and what would be accepted.
pub(super) fn check(scene: &Scene, Method { scheme, backend }: Method) -> Result<()> {
    check_some_scheme(scene)?;
    if let Some(wall) = nonlinear_wall(scene, scheme) {
        let expected = "a rigid or an elastic wall, or the scheme penalty, which steps through that law";
        return Err(Error::invalid(Subject::wall(&wall.name).part("law"), wall.law.kind(), expected));
    }
    if let Some(refused) = refusal(scene, scheme) {
        let takes = |other: &Scheme| refusal(scene, *other).is_none() && nonlinear_wall(scene, *other).is_none();
        let schemes: Vec<_> = Scheme::ALL.iter().filter(|one| takes(one)).map(|one| one.entry().name).collect();
        let found = format!("{scheme}, with {}", refused.found);
        return Err(Error::invalid("scheme", found, expected(&schemes, &refused)));
    }
    if !scene.turns_or_rubs() {
        let unknowns = scene.system.degrees_of_freedom();
        if backend == Backend::Clamp && scheme.has_qp() && unknowns > 1 {
            let expected = format!("auto, condensed or clarabel: there are {unknowns} unknowns, and the clamp has one");
            return Err(Error::invalid("QP solver", backend, expected));
        }
        return Ok(());
    }
    if let Scheme::Penalty { integrator, .. } = scheme
        && integrator != Integrator::DiscreteGradient
    {
        let expected = "discrete-gradient: of the penalties, only that one keeps energy and angular momentum in a \
                        round hole";
        return Err(Error::invalid("integrator", integrator, expected));
    }
    if backend != Backend::Auto && !scheme.is_exact() {
        let expected = "auto: with round supports or friction a step is no quadratic programme, and sweeps over its \
                        contacts solve it";
        return Err(Error::invalid("QP solver", backend, expected));
    }
    Ok(())
}
