//! Checks of friction against Coulomb's law on the impulses of a step.
//!
//! With p the normal impulse, f the friction impulse along t and ẇ_t⁺ the sliding velocity at the
//! end of the step: μp − |f| ≥ 0, and μp + f sign(ẇ_t⁺) is complementary to |ẇ_t⁺|. A body that
//! slides with another friction than −μp sign(ẇ_t⁺) violates the second by what is missing.
//!
//! This μ is the kinetic one. Where the static one is larger and the contact pushed at the end of
//! the step or part before, |f| is at most μ_s p, and what it has beyond μ_k p is complementary to
//! |ẇ_t⁺|, and to the sliding speed before unless f acts along that: then it holds a body that
//! would turn. At the instant of an impact friction is kinetic.
//!
//! Where friction leaves no room for a rebound, or a body comes to rest, the wall may have none
//! ([`Friction`]).

use super::Judge;
use super::Supports;
use super::front::ComplementarityFront;
use super::place::terms;
use crate::scene::{Face, FrictionCoefficients, PlaneRows, heading};
#[cfg(doc)]
use crate::step::Friction;
use crate::step::Step;

/// A contact with friction in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct FrictionImpulse {
    /// Index of the wall.
    pub place: usize,
    pub friction: FrictionCoefficients,
    /// p and f, N s.
    pub impulse: [f64; 2],
    pub tangent: [f64; 2],
}

/// A push and a mass that the scheme computed with other roundings.
const SAME: f64 = 1.0 + 1e-9;

impl Judge {
    /// True if a rigid wall of restitution `e`, which the body approaches with the velocity
    /// `struck` (m/s), has none in this step: [`Friction`].
    pub(super) fn gives_up(&self, step: &Step<'_>, wall: usize, e: f64, struck: f64) -> bool {
        let Some(supports) = self.supports.as_ref().filter(|_| self.contract.promise.friction.is_some()) else {
            return false;
        };
        step.wedged.contains(&wall)
            || step.resting.contains(&wall)
                && 2.0 * e * supports.mass[wall] * struck.abs() <= SAME * (1.0 - e) * supports.pushed[wall].abs()
    }

    /// Checks the friction of one contact over a step or a part, and keeps how fast it slides.
    pub(super) fn check_friction(
        &self,
        step: &Step<'_>,
        at: &PlaneRows,
        rub: &FrictionImpulse,
        supports: &mut Supports,
    ) {
        self.check_friction_of(rub, supports, || self.rates(step, at));
    }

    /// The same at a place with these `rates`, as [`Judge::rates`] gives them.
    pub(super) fn check_friction_of(
        &self,
        rub: &FrictionImpulse,
        supports: &mut Supports,
        rates: impl FnOnce() -> ([f64; 2], f64),
    ) {
        let Some(slid) = supports.slid.get_mut(rub.place) else { return };
        let before = std::mem::replace(slid, f64::INFINITY);
        if rub.impulse != [0.0; 2] {
            let now = self.check_cone(rates(), rub, before, &mut supports.rubs);
            *slid = if rub.impulse[0] > 0.0 { now } else { f64::INFINITY };
        }
    }

    /// The velocity of a place at the end of the step, m/s, and the sum of the magnitudes of the
    /// terms of all its velocities.
    fn rates(&self, step: &Step<'_>, at: &PlaneRows) -> ([f64; 2], f64) {
        let speeds = terms(at, step.velocity_before) + terms(at, step.velocity_after) + terms(at, &self.blows.struck);
        (at.dot(step.velocity_after), speeds)
    }

    /// The same at the instant of an impact.
    pub(super) fn check_friction_at_end(
        &self,
        step: &Step<'_>,
        at: &PlaneRows,
        rub: &FrictionImpulse,
        supports: &mut Supports,
    ) {
        let Some(slid) = supports.slid.get_mut(rub.place) else { return };
        // A contact without an impulse there that pushed before is one whose velocity changes.
        if rub.impulse != [0.0; 2] || slid.is_finite() {
            *slid = self.check_cone(self.rates(step, at), rub, f64::INFINITY, &mut supports.rubs);
        }
    }

    /// Checks the friction of a contact that `slid` before along t (m/s, infinite where it did not
    /// push). Returns how fast it slides now, less rounding, m/s.
    fn check_cone(
        &self,
        (after, speeds): ([f64; 2], f64),
        rub: &FrictionImpulse,
        slid: f64,
        rubs: &mut ComplementarityFront,
    ) -> f64 {
        let [p, f] = rub.impulse.map(|impulse| impulse / self.h);
        let rate = rub.tangent[0] * after[0] + rub.tangent[1] * after[1];
        let noise = self.noise.velocity(speeds, self.noise.span);
        let force = self.noise.wall_force(rub.place);
        let [most, kinetic] = [rub.friction.limit(slid.is_finite()), rub.friction.sliding].map(|mu| mu * p.max(0.0));
        let beyond = if slid.is_finite() { f.abs() - kinetic } else { 0.0 };
        let turns = f * slid > 0.0;
        let pairs = [
            (0.0, most - f.abs()),
            (rate.abs(), (kinetic + f * rate.signum()).max(0.0)),
            (rate.abs().max(if turns { 0.0 } else { slid.abs() }), beyond.max(0.0)),
        ];
        for (slack, missing) in pairs.into_iter().filter(|pair| pair.0.is_finite()) {
            rubs.add((slack, noise), (missing, force), self.noise.end, rub.place);
        }
        (rate.abs() - noise).max(0.0).copysign(rate)
    }

    /// Checks the friction of all flats over a step or a part.
    pub(super) fn rub_flats(&mut self, step: &Step<'_>, supports: &mut Supports) {
        self.rub_flats_by(step, |judge, at, rub| judge.check_friction(step, at, rub, supports));
    }

    /// The same at the instant of an impact.
    pub(super) fn rub_flats_at_end(&mut self, step: &Step<'_>, supports: &mut Supports) {
        self.rub_flats_by(step, |judge, at, rub| judge.check_friction_at_end(step, at, rub, supports));
    }

    fn rub_flats_by(&mut self, step: &Step<'_>, mut check: impl FnMut(&Self, &PlaneRows, &FrictionImpulse)) {
        let scene = std::sync::Arc::clone(&self.scene);
        for (index, wall) in scene.walls.iter().enumerate() {
            let (Some(&p), Some(&f)) = (step.impulse.get(index), step.friction.get(index)) else { continue };
            let (Face::Flat { direction: Some(degrees), .. }, Some(support)) = (&wall.face, scene.support_of(index))
            else {
                continue;
            };
            let [y, z] = heading(*degrees);
            let rub =
                FrictionImpulse { place: index, friction: wall.friction, impulse: [p.abs(), f], tangent: [-z, y] };
            self.walls.force_scale = self.walls.force_scale.max(f.abs() / self.h);
            check(self, &support.at, &rub);
        }
    }
}
