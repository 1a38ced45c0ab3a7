//! Checks of friction against Coulomb's law on the impulses of a step.
//!
//! With p the normal impulse, f the friction impulse along t and ẇ_t⁺ the sliding velocity at the
//! end of the step: μp − |f| ≥ 0, and μp + f sign(ẇ_t⁺) is complementary to |ẇ_t⁺|. A body that
//! slides with another friction than −μp sign(ẇ_t⁺) violates the second by what is missing. Where
//! friction leaves no room for a rebound, or a body comes to rest, the wall may have none
//! ([`Friction`]).

use super::Judge;
use super::front::ComplementarityFront;
use super::hole_motion::terms;
use crate::scene::{Face, PlaneRows, heading};
#[cfg(doc)]
use crate::step::Friction;
use crate::step::Step;

/// A contact with friction in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct FrictionImpulse {
    /// Index of the wall.
    pub place: usize,
    pub friction: f64,
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

    /// Checks the friction of one contact.
    pub(super) fn check_friction(
        &self,
        step: &Step<'_>,
        at: &PlaneRows,
        rub: &FrictionImpulse,
        rubs: &mut ComplementarityFront,
    ) {
        let [p, f] = rub.impulse.map(|impulse| impulse / self.h);
        if p == 0.0 && f == 0.0 {
            return;
        }
        let after = at.dot(step.velocity_after);
        let rate = rub.tangent[0] * after[0] + rub.tangent[1] * after[1];
        let most = rub.friction * p.max(0.0);
        let speeds = terms(at, step.velocity_before) + terms(at, step.velocity_after) + terms(at, &self.blows.struck);
        let noise = self.noise.velocity(speeds, self.noise.span);
        let force = self.noise.wall_force(rub.place);
        for (slack, missing) in [(0.0, most - f.abs()), (rate.abs(), most + f * rate.signum())] {
            rubs.add((slack, noise), (missing, force), self.noise.end, rub.place);
        }
    }

    /// Checks the friction of all flats.
    pub(super) fn rub_flats(&mut self, step: &Step<'_>, rubs: &mut ComplementarityFront) {
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
            self.check_friction(step, &support.at, &rub, rubs);
        }
    }
}
