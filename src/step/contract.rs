//! The contract of a scheme: the momentum balance of a step, the conditions at the walls, and their
//! tolerances.

use super::Promise;
#[cfg(doc)]
use super::{Bound, Step};
#[cfg(doc)]
use crate::flow::{Arc, Series};

/// The momentum balance that every step of a scheme fulfils; with it a judge can check a step
/// without knowing the scheme. F(t, q, v) = f(t) − C v − K q is the smooth force, f_x the extra
/// force of the step ([`Step::extra`]), J the sum of the loads' impulses assigned to the step, p
/// the contact impulse of the step, and v₋, v₊ are [`Step::velocity_before`] and
/// [`Step::velocity_after`].
///
/// An impulse at t = 0 is part of the initial state and belongs to no step. A blow (a load's
/// impulse) J_b acts at its own instant t_b, not where the rule counts it. So the displacement at
/// the step's end is that of the rule plus d, so that a free body ends exactly where the blow would
/// take it. Smooth forces and elastic walls are evaluated without d, except for dampers: by the
/// term −C d they act on the whole displacement over any time.
///
/// Where blows drive the body into a rigid wall that pushes in the step, blow and answer take
/// effect together and d is 0 (unless the wall pushes only because of −C d). This does not hold
/// where the promise bounds the displacement at the step's end ([`Bound::End`]), which includes d:
/// there d stays, and under [`Balance::GeneralizedAlpha`] −C d is left out where such a wall is
/// closed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Balance {
    /// M(v₊ − v₋) = h[(1−θ)F(t, q, v₋) + θF(t⁺, q⁺, v₊) + f_x] + J − C d + p and q⁺ − q =
    /// h[(1−θ)v₋ + θv₊] + d; J sums the blows in (t, t⁺], and M d = Σ(t⁺ − θh − t_b)J_b over the
    /// same.
    Theta(f64),
    /// M(v₊ − v₋) = h[f(t) + f_x − C(v₋ + v₊)/2 − K(b q⁻ + (1−2b) q + b q⁺)] + J − C d_J + p with
    /// v₋ = (q − q⁻)/h, v₊ = (q⁺ − d − q)/h, and b the number given: ¼ averages the stiffness
    /// force, 0 takes it at t. J sums the blows in (t − h/2, t + h/2], after t = 0; M d sums (t −
    /// t_b)J_b over (t, t + h/2] and (t⁺ − t_b)J_b over (t + h/2, t⁺], and M d_J the (t − t_b)J_b
    /// of J.
    Staggered(f64),
    /// With s = M a of an auxiliary acceleration a, and s⁺ at the step's end:
    ///
    /// M(v₊ − v₋) = h[(1−γ)s + γs⁺ + f_x] + J − C d + p, M(q⁺ − q − hv₋ − U) = h²[(½−β)s + βs⁺ +
    /// ½f_x] + Σ(t⁺ − t_b)J_b,
    ///
    /// where (1−α_m)s⁺ + α_m s = (1−α_f)F⁺ + α_f F with F = F(t, q, v₋) and F⁺ = F(t⁺, q⁺, v₊),
    /// each with the elastic walls' forces [`Step::force`] there; at the start s = F. p is the
    /// impulse of the rigid walls, and U, by which they correct the displacement, is 0 unless one
    /// is closed after the step, to the tolerance of its gap. To J belong the blows J_b at t_b in
    /// (t, t⁺], and M d = Σ(t⁺ − h/2 − t_b)J_b: under this rule the damper feels J from the middle
    /// of the step on.
    GeneralizedAlpha {
        /// α_m.
        alpha_m: f64,
        /// α_f.
        alpha_f: f64,
        /// β.
        beta: f64,
        /// γ.
        gamma: f64,
    },
    /// The differential equation itself over the step's [`Arc`] or [`Series`], M q̈ = F(t, q, q̇) +
    /// f_x + r; at the instant t⁺ that ends it the velocity jumps by M(v₊ − v) = J + p⁺, with v the
    /// last velocity of the arc, J the blows in (t, t⁺] (an arc ends at each impulse), and p⁺ the
    /// [`Step::jump`] of the walls.
    Exact,
}

/// Largest deviation from a promise, beyond rounding, that is not a finding, and the reason for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Largest residual, dimensionless.
    pub limit: f64,
    /// Why this limit was chosen.
    pub reason: &'static str,
}

/// The scenes on which a scheme keeps the energy ledger closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Conserves {
    /// No scenes: the energy that the scheme creates or loses is its known error, which the ledger
    /// shows and a note states.
    Nothing,
    /// Scenes whose walls are all rigid.
    RigidWalls,
    /// Scenes whose walls have no dashpot.
    UndampedWalls,
    /// All scenes.
    Everything,
}

/// Tolerances of a scheme's promises. What a scheme does not promise (the depth behind the walls of
/// moreau-jean, the energy of newmark) has none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// For the conditions at the walls ([`Promise`]), relative to the scales of gap, speed and
    /// contact force.
    pub walls: Tolerance,
    /// For the momentum balance, relative to the largest force in it, and for the displacement
    /// against what the velocities give.
    pub balance: Tolerance,
    /// For the momentum of the run that the walls' impulses do not account for, relative to the
    /// momentum exchanged.
    pub impulses: Tolerance,
    /// For the energy ledger, relative to the energy exchanged.
    pub energy: Tolerance,
    /// The scenes on which the ledger is promised to close.
    pub conserves: Conserves,
}

impl Tolerances {
    /// The tolerances of every scheme of the crate, with the scenes on which the scheme conserves
    /// energy.
    #[must_use]
    pub const fn of(conserves: Conserves) -> Self {
        Self {
            walls: Tolerance { limit: 1e-6, reason: "solvers meet a bound to 1e-9 of its scale; the rest is rounding" },
            balance: Tolerance { limit: 1e-6, reason: "a step's equations are solved to rounding" },
            impulses: Tolerance {
                limit: 1e-6,
                reason: "the error of the step's rule for the smooth forces is subtracted",
            },
            energy: Tolerance { limit: 1e-6, reason: "the scheme conserves energy to rounding" },
            conserves,
        }
    }
}

/// The promises of a scheme for every step; constant over a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contract {
    /// The momentum balance of a step.
    pub balance: Balance,
    /// What holds at the walls.
    pub promise: Promise,
    /// Where in the step a contact impulse belongs, as a fraction of it (0: its start, 1: its end).
    pub instant: f64,
    /// The tolerances of these promises.
    pub tolerances: Tolerances,
    /// True if steps on a grid are divided at impacts, blows and jumps of loads
    /// ([`Path::Part`](super::Path::Part)).
    pub divides: bool,
}
