//! The conditions that a scheme promises for the contact forces of a step.
//!
//! A promise is made of parts, and the judge checks each part: a new scheme states the parts that
//! it keeps, and needs no judge of its own. Depth s = −gap, s₊ = max(s, 0), |r| = pressure; w, s
//! and ẇ are at the step's start, w⁺, s⁺ and ẇ⁺ at its end, and ẇ is taken after the step's load
//! impulses, which come first. w⁻ = w − hẇ is the position one step before, and s⁻ its depth.

#[cfg(doc)]
use super::Step;
#[cfg(doc)]
use crate::flow::{Arc, Series};

/// The conditions at the walls in every step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Promise {
    /// At rigid walls.
    pub rigid: Rigid,
    /// At walls whose force follows a law of the depth: elastic ones, and the springs that a
    /// penalty puts in place of rigid ones.
    pub elastic: Elastic,
    /// At round holes; `None` for a scheme that does not step scenes with round holes.
    pub round: Option<Turning>,
    /// At round holes in exact motion; `None` for a scheme on a grid.
    pub circle: Option<Circle>,
    /// The bound on the displacement at rigid round holes, complementary to the impulse p of the
    /// step: under [`Bound::End`] 0 ≤ γ − |w⁺| ⟂ p ≥ 0, with w⁺ at the step's end, including the
    /// displacement that blows add; where there is no impact law [`Promise::round`] beside it, the
    /// impulse is −p n with n = w⁺/|w⁺|. Under [`Bound::Along`] p is not 0 only where the body
    /// stays at the hole, |w| = |w⁺| = γ, and n is parallel to w + w⁺; of an elastic hole
    /// the dashpot then feels the rate along n: its plate begins where n·w is, or on the circle
    /// beyond it, by γ − |w|. `None` for a scheme without such a
    /// bound.
    pub hole: Option<Bound>,
    /// At supports with friction; `None` for a scheme without friction.
    pub friction: Option<Friction>,
}

/// The conditions at round holes, |w| ≤ γ, at every instant of the step's [`Series`]:
///
/// the force on the structure is −N n with n = w/|w| and 0 ≤ γ − |w| ⟂ N ≥ 0; while N > 0 the
/// structure slides along the circle.
///
/// At the instant of its end the hole may give the impulse −p n, p ≥ 0, where |w| = γ. Then the
/// structure does not approach the hole any more, n·ẇ⁺ ≤ 0, and if no other wall or hole gives one
/// at that instant, Newton's law holds: n·ẇ⁺ = −e n·ẇ⁻. An approach whose rebound e n·ẇ⁻ is slower
/// than `tail` times the largest speed at walls and holes may be the last of infinitely many, and
/// end anywhere between −e n·ẇ⁻ and 0: the flight after it is too low to be followed. (With 1e-4 it
/// is lower than 1e-12 γ where 5000 times that speed squared over γ presses the body back.)
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Share of the largest speed below which a rebound may be that of the last of infinitely many
    /// approaches.
    pub tail: f64,
}

/// The conditions at round holes, |w| ≤ γ, where the normal turns while the body slides: Newton's
/// law of impact for the velocity with which the body arrives at the hole, and full reflection for
/// the approach velocity that is due only to the turning of the normal.
///
/// A hole in play gives −p n with p ≥ 0; [`Normal`] says which holes are, and n. Any other gives no
/// impulse. Let a = n·ẇ, a_r the part of it with which the body arrives, and a_c = a − a_r the part
/// that turning adds:
///
/// a_r = a where |w| < γ(1 − τ), τ = (h|ẇ|/γ)²/8, the height of the arc of a step, but at least
/// `sagitta` and at most `deepest`: the body comes from inside. Else the body touches, and a_r is
/// w·ẇ/|w|, its approach along the normal at the step's start, but at least 0 and at most a.
///
/// A body that slides falls by h²(v₀² − v²)/8γ inside of the circle while it slows down from v₀ to
/// v. So, under [`Normal::Ahead`], the contact with a hole that pushed in the step before may last
/// with |w| from γ(1 − α²/2), but at least γ/2, on: the body then touches as well. α is the largest
/// angle h|n × ẇ|/γ by which n turned in a step since the contact began.
///
/// a > 0: 0 ≤ −(e a_r + a_c) − n·ẇ⁺ ⟂ p ≥ 0;    a ≤ 0: 0 ≤ −a − n·ẇ⁺ ⟂ p ≥ 0.
///
/// So ẇ⁺ = −ε ẇ along every normal that pushes, with ε between e and 1: a step changes the energy
/// by −Σ p(1−ε)a/2 ≤ 0, whatever the normals and the masses. A body that slides is reflected at n
/// and moves on the circle as by the midpoint rule; with n·ẇ⁺ ≤ −e a instead, it would lose speed
/// at the rate h v²/2γ² and creep outwards by h v²/2γ, both times (1−e)/(1+e). In the limit of
/// small steps the law is Newton's on a smooth wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning {
    /// n.
    pub normal: Normal,
    /// The share of γ within which a hole counts as touched.
    pub touching: f64,
    /// The least τ.
    pub sagitta: f64,
    /// The largest τ.
    pub deepest: f64,
}

/// The normal of a round hole in a step, and the holes in play.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Normal {
    /// n = ŵ/|ŵ| with ŵ = w + φ h ẇ, where the body is about to be at this fraction φ of the step;
    /// in play are the holes with |ŵ| ≥ γ(1 − `touching`), and those whose contact may last with
    /// |w| and with |ŵ|.
    Ahead(f64),
    /// n along w + w⁺, in the middle of the step; in play are the holes with |w⁺| ≥ γ(1 −
    /// `touching`), under a bound on the displacement. Where that middle (w + w⁺)/2 is nearer to
    /// the centre than this share of γ, it says nothing of the normal: the body crosses the hole
    /// within the step, and arrives at w⁺ with all of its approach, n = w⁺/|w⁺| and a_r = a.
    Middle(f64),
}

/// Coulomb's law at the supports that have friction, and what it changes of the law of impact.
///
/// Impulses that balance one another, as of a body pushed into a corner of flats of large friction,
/// may contradict the rebounds that these contacts demand. Then the contacts give up their rebound
/// for the step, which lists them ([`Step::wedged`]), and ε = 0 in place of their e, also for the
/// approach that the turning of a normal adds: without rebounds a solution always exists (Anitescu
/// & Potra 1997, doi:10.1023/A:1008292328909). They do so, too, where impulses that obey both laws
/// would add energy (Kane & Levinson 1985, Dynamics: Theory and Applications): with ε = 0 they
/// cannot, since n·ẇ⁺ p = 0 and t·ẇ⁺ p_t ≤ 0.
///
/// A wall with friction on which a load presses, and which pushed with p⁻ in the step before, may
/// have ε = 0 too ([`Step::resting`]) if the approach a at the mass m that the wall feels keeps 2 e
/// m a ≤ (1 − e) p⁻: the rebounds at e a, e² a, … under that push then all end within the step, and
/// the body rests. (With the wall's e it would leave and come back step after step.)
///
/// Where a wall's static coefficient μ_s is above its kinetic one μ_k
/// ([`FrictionCoefficients`](crate::FrictionCoefficients)), μ is μ_k; but μ_s over a step or part
/// at whose end the contact sticks, if before that it
///
/// - stuck: it pushed, and did not slide at the end. At the start of a run a wall that the body
///   touches and does not slide along counts as one that stuck;
/// - or slid, and friction acts along the sliding velocity that it had: it passes rest within the
///   step, where static friction holds what would turn.
///
/// A contact that was open has μ_k, and so has an impact at an instant: a body that comes to stick
/// by it may have μ_s after that. What begins to slide has μ_k over all of that step or part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Friction {
    /// On the impulse of a step and the velocity at its end, along the tangent t = (−n_z, n_y):
    /// |p_t| ≤ μ p, and p_t = −μ p sign(t·ẇ⁺) where t·ẇ⁺ is not 0.
    EndVelocity,
}

/// The conditions at rigid walls. With neither a bound nor an impact law they give no force, for
/// example where a penalty has replaced them by springs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rigid {
    /// The force r, or the impulse p of the step, that the conditions refer to.
    pub force: PromisedForce,
    /// The bound on the displacement, complementary to that force.
    pub displacement: Option<Bound>,
    /// The impact law on the velocity, 0 ≤ rebound ⟂ |p| ≥ 0 with rebound = ±(ẇ⁺ + ε ẇ) away from
    /// the wall, ε = e if approaching or at rest and 1 if separating, at the walls that are
    /// reached; so the impulses never add energy, and ẇ⁺ = −ẇ keeps the law at every wall. Where
    /// there is friction, ε may be 0 while approaching ([`Friction`]). A wall that is neither
    /// reached nor has a bound gives no force.
    pub velocity: Option<Reached>,
}

/// The force of a wall that a condition refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PromisedForce {
    /// The mean of the step, [`Step::impulse`]/h.
    Mean,
    /// The force at its end, [`Step::force`].
    End,
    /// The force at its end, [`Step::force`], where the impulse takes the mean of both ends of the
    /// step: [`Step::impulse`] = h(r + r⁺)/2.
    Trapezoid,
}

/// A bound on the displacement at a rigid wall: 0 ≤ slack ⟂ |r| ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Bound {
    /// The slack is the gap at the step's end, including the displacement that blows add.
    End,
    /// The bound includes the restitution: the slack is that of (1+e_l)g_l − e_l w⁻ ≤ w⁺ ≤
    /// (1+e_u)g_u − e_u w⁻, with the smaller e in both where unequal ones would make them cross (or
    /// [`Path::OneRestitution`](super::Path::OneRestitution)).
    Reflected,
    /// The slack is the gap at the step's end, and that at its start where the wall pushes.
    Along,
    /// The gap at every instant of the step's [`Arc`] or [`Series`].
    Throughout,
}

/// Which rigid walls keep the impact law in a step. A wall counts as touched within 1e-12 of the
/// gap scale ([`Scene::touching_distance`](crate::Scene::touching_distance)).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Reached {
    /// The walls that w + φ h ẇ reaches, at this fraction φ of the step.
    Ahead(f64),
    /// The walls that w⁺ touches, or which push.
    Closed,
}

/// The conditions at walls whose force follows a law of the depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// The force that follows the law.
    pub force: PromisedForce,
    /// Where in the step it follows the law.
    pub law: Law,
}

/// Where in a step a wall's force follows its law.
///
/// Where a law covers the whole step, a dashpot c_a feels the mean rate of penetration, (s⁺₊ −
/// s₊)/h, which makes its impulse exact, and the sum of spring and dashpot is never negative: a
/// wall does not pull.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Law {
    /// At one depth: |r| = (k_a s_θ + c_a(s_θ − s₊)/θh)₊ with s_θ = (1−θ)s + θs⁺, at this θ; 1 is
    /// the step's end.
    Depth(f64),
    /// At the mean depth of three instants: |r| = (k_a s̄ + c_a(s⁺ − s⁻₊)/2h)₊ with s̄ = b s⁻ +
    /// (1−2b)s + b s⁺, and b the number given.
    MeanDepth(f64),
    /// The mean of both ends: |r| = ((1−θ)|r|(s) + θ|r|(s⁺) + c_a(s⁺₊ − s₊)/h)₊ with |r|(s) the
    /// force of the wall's spring, and θ the number given.
    Ends(f64),
    /// At the step's start: |r| = (|r|(s) + c_a ṡ)₊ while s > 0, with the mean of
    /// [`Step::velocity_before`] and [`Step::velocity_after`] for ṡ.
    Start,
    /// The discrete gradient of the wall's energy U between both ends: |r| = (ΔU/Δs + c_a(s⁺₊ −
    /// s₊)/h)₊.
    Gradient,
    /// At every instant of the step's [`Arc`] or [`Series`].
    Throughout,
}

impl Promise {
    /// Complementarity and laws at every instant, as exact motion keeps them.
    #[must_use]
    pub const fn throughout() -> Self {
        Self {
            circle: Some(Circle { tail: 1e-4 }),
            ..Self::constraints(Some(Bound::Throughout), None, Law::Throughout)
        }
    }

    /// Rigid walls as constraints, with conditions on the mean force of a step, and others by
    /// `law` on that mean.
    #[must_use]
    pub const fn constraints(displacement: Option<Bound>, velocity: Option<Reached>, law: Law) -> Self {
        let force = PromisedForce::Mean;
        Self {
            rigid: Rigid { force, displacement, velocity },
            elastic: Elastic { force, law },
            round: None,
            circle: None,
            hole: None,
            friction: None,
        }
    }

    /// Springs in place of rigid walls: the mean force of every wall over the step follows `law`.
    #[must_use]
    pub const fn springs(law: Law) -> Self {
        Self::constraints(None, None, law)
    }
}
