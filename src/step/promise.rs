//! What a scheme promises of the contact forces of a step.
//!
//! A promise is made of parts, and the judge holds a step to each part: a new scheme that keeps some of them says so here, and needs no
//! judge of its own. Depth s = −gap, s₊ = max(s, 0), |r| = pressure; w, s and ẇ are at the step's start, w⁺, s⁺ and ẇ⁺ at its end, and ẇ is
//! taken after the step's load impulses, which come first. w⁻ = w − hẇ is where the body was a step before, and s⁻ its depth.

#[cfg(doc)]
use super::Step;
#[cfg(doc)]
use crate::flow::{Arc, Series};

/// What holds at the walls in every step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Promise {
    /// At rigid walls.
    pub rigid: Rigid,
    /// At walls whose force follows a law of the depth: elastic ones, and what a penalty puts in place of rigid ones.
    pub elastic: Elastic,
}

/// What holds at rigid walls. Neither a bound nor an impact law means that they give no force: so it is where a penalty has replaced them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rigid {
    /// The force r, or the impulse p per step, that the conditions are made on.
    pub force: PromisedForce,
    /// The bound on the displacement, complementary to that force.
    pub displacement: Option<Bound>,
    /// The impact law on the velocity, 0 ≤ rebound ⟂ |p| ≥ 0 with rebound = ±(ẇ⁺ + ε ẇ) away from the wall, ε = e if approaching or at rest
    /// and 1 if separating, of the walls that are reached. A wall that is not, and has no bound, gives no force.
    pub velocity: Option<Reached>,
}

/// Which force of a wall a condition is made on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PromisedForce {
    /// The mean of the step, [`Step::impulse`]/h.
    Mean,
    /// That at its end, [`Step::force`].
    End,
    /// The same, of which the mean is that of both ends of the step: [`Step::impulse`] = h(r + r⁺)/2.
    Trapezoid,
}

/// A bound on the displacement at a rigid wall: 0 ≤ slack ⟂ |r| ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Bound {
    /// The slack is the gap at the step's end, with all that blows add to the displacement.
    End,
    /// The bound has the restitution in it: the slack of (1+e_l)g_l − e_l w⁻ ≤ w⁺ ≤ (1+e_u)g_u − e_u w⁻, the smaller e in both where unequal
    /// ones would make them cross (or [`Path::OneRestitution`](super::Path::OneRestitution)).
    Reflected,
    /// The gap at every instant of the step's [`Arc`] or [`Series`].
    Throughout,
}

/// Which rigid walls keep the impact law in a step. A wall counts as touched within 1e-12 of the gap scale
/// ([`Scene::touching_distance`](crate::Scene::touching_distance)).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Reached {
    /// Those which w + φ h ẇ reaches, at this fraction φ of the step.
    Ahead(f64),
    /// Those which w⁺ touches, or which push.
    Closed,
}

/// What holds at walls with a law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// The force that follows the law.
    pub force: PromisedForce,
    /// Where in the step it does.
    pub law: Law,
}

/// Where in a step a wall's force is the one of its law.
///
/// Wherever a step stands for a stretch of time, a dashpot c_a feels the mean rate of penetration, (s⁺₊ − s₊)/h, which
/// makes its impulse exact, and the sum of spring and dashpot is never negative: a wall does not pull.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Law {
    /// At one depth: |r| = (k_a s_θ + c_a(s_θ − s₊)/θh)₊ with s_θ = (1−θ)s + θs⁺, at this θ; 1 is the step's end.
    Depth(f64),
    /// At the mean depth of three instants: |r| = (k_a s̄ + c_a(s⁺ − s⁻₊)/2h)₊ with s̄ = b s⁻ + (1−2b)s + b s⁺, and b this number.
    MeanDepth(f64),
    /// The mean of both ends: |r| = ((1−θ)|r|(s) + θ|r|(s⁺) + c_a(s⁺₊ − s₊)/h)₊ with the wall's spring |r|(s), and this θ.
    Ends(f64),
    /// At the step's start: |r| = (|r|(s) + c_a ṡ)₊ while s > 0, with the mean of [`Step::velocity_before`] and [`Step::velocity_after`] for ṡ.
    Start,
    /// The discrete gradient of the wall's energy U between both ends: |r| = (ΔU/Δs + c_a(s⁺₊ − s₊)/h)₊.
    Gradient,
    /// At every instant of the step's [`Arc`] or [`Series`].
    Throughout,
}

impl Promise {
    /// Complementarity and laws at every instant: what exact motion keeps.
    #[must_use]
    pub const fn throughout() -> Self {
        Self {
            rigid: Rigid { force: PromisedForce::Mean, displacement: Some(Bound::Throughout), velocity: None },
            elastic: Elastic { force: PromisedForce::Mean, law: Law::Throughout },
        }
    }

    /// Springs in place of rigid walls: all walls follow `law` in the mean of the step.
    #[must_use]
    pub const fn springs(law: Law) -> Self {
        Self {
            rigid: Rigid { force: PromisedForce::Mean, displacement: None, velocity: None },
            elastic: Elastic { force: PromisedForce::Mean, law },
        }
    }
}
