//! One step of time as data: what a scheme hands to whoever records or judges it.

use crate::flow::{Arc, Series};

/// The momentum balance that every step of a scheme fulfils. With it a judge can hold a step to its word without
/// knowing the scheme. F(t, q, v) = f(t) − C v − K q is the smooth force, f_x the extra force of the step ([`Step::extra`]), J the sum of
/// the loads' impulses that fall to the step, p the contact impulse of the step, and v₋, v₊ are [`Step::velocity_before`] and
/// [`Step::velocity_after`].
///
/// An impulse at t = 0 is part of the start and of no step. Between steps the displacement goes on by d from where the rule takes it: a
/// blow J_b acts at its instant t_b, not where the rule counts it, so that it takes a free body to the very place. The smooth forces and
/// the elastic walls of the step are those without d, but for a damper: it takes −C d of the momentum, so that over any time it feels the
/// whole way. Where a rigid wall that pushes in the step is what its blows drive into, under the promises [`Promise::Velocity`] and
/// [`Promise::MeanPosition`], blow and answer stay together and d is 0 (unless the wall pushes for −C d alone); under
/// [`Promise::Corrected`] −C d is left out where such a wall is closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Balance {
    /// M(v₊ − v₋) = h[(1−θ)F(t, q, v₋) + θF(t⁺, q⁺, v₊) + f_x] + J − C d + p and q⁺ − q = h[(1−θ)v₋ + θv₊] + d; to J belongs what falls in (t, t⁺],
    /// and M d = Σ(t⁺ − θh − t_b)J_b over that.
    Theta(f64),
    /// M(v₊ − v₋) = h[f(t) + f_x − C(v₋ + v₊)/2 − K(b q⁻ + (1−2b) q + b q⁺)] + J − C d_J + p with v₋ = (q − q⁻)/h, v₊ = (q⁺ − d − q)/h, and b this
    /// number: ¼ averages the stiffness, 0 takes it at t. To J belongs what falls in (t − h/2, t + h/2], after t = 0; M d sums
    /// (t − t_b)J_b over (t, t + h/2] and (t⁺ − t_b)J_b over (t + h/2, t⁺], and M d_J the (t − t_b)J_b of J.
    Staggered(f64),
    /// With s = M a of an auxiliary acceleration a, and s⁺ at the step's end:
    ///
    /// M(v₊ − v₋) = h[(1−γ)s + γs⁺ + f_x] + J − C d + p,   M(q⁺ − q − hv₋ − U) = h²[(½−β)s + βs⁺ + ½f_x] + Σ(t⁺ − t_b)J_b,
    ///
    /// where (1−α_m)s⁺ + α_m s = (1−α_f)F⁺ + α_f F with F = F(t, q, v₋) and F⁺ = F(t⁺, q⁺, v₊), each with the elastic walls' forces
    /// [`Step::force`] there; at the start s = F. p is that of the rigid walls, and U, by which they correct the displacement, is 0 unless
    /// one is closed after the step. To J belong the blows J_b at t_b in (t, t⁺], and M d = Σ(t⁺ − h/2 − t_b)J_b: from the middle of the step on
    /// the rule has the damper feel J.
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
    /// The differential equation itself over the step's [`Arc`] or [`Series`], M q̈ = F(t, q, q̇) + f_x + r; at the instant t⁺ that ends it
    /// the velocity jumps by M(v₊ − v) = J + p⁺, with v the arc's last, J what falls in (t, t⁺] (an arc ends at each impulse), and p⁺ the
    /// [`Step::jump`] of the walls.
    Exact,
}

/// What a scheme promises of the contact forces of a step. Depth s = −gap, s₊ = max(s, 0), |r| = pressure.
///
/// Wherever a step stands for a stretch of time, a dashpot c_a feels the mean rate of penetration, (s⁺₊ − s₊)/h, which
/// makes its impulse exact, and the sum of spring and dashpot is never negative: a wall does not pull.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Promise {
    /// Rigid: 0 ≤ gap(w⁺) ⟂ |r| ≥ 0, with r at t⁺. Elastic: |r| = (k_a s⁺ + c_a(s⁺ − s₊)/h)₊.
    EndPosition,
    /// Rigid: 0 ≤ slack of (1+e_l)g_l − e_l w⁻ ≤ w⁺ ≤ (1+e_u)g_u − e_u w⁻ ⟂ |r| ≥ 0, the smaller e in both where unequal ones would make
    /// them cross (or [`Path::OneRestitution`]), and w⁻ = w − hẇ with ẇ = v₋ after the step's load impulses, which come first. Elastic: |r| = (k_a s̄ + c_a(s⁺ −
    /// s⁻₊)/2h)₊ at the mean depth s̄ = ¼s⁻ + ½s + ¼s⁺.
    MeanPosition,
    /// With ẇ the velocity after the step's load impulses, which come first. Rigid, for walls that w + ½hẇ reaches to within 1e-12 of the
    /// gap scale: 0 ≤ rebound ⟂ |p| ≥ 0, rebound = ±(ẇ⁺ + ε ẇ) away from
    /// the wall, ε = e if approaching or at rest and 1 if separating; no force elsewhere.
    /// Elastic: |p|/h = (k_a s_θ + c_a(s_θ − s₊)/θh)₊ at s_θ = (1−θ)s + θs⁺.
    Velocity,
    /// Rigid: 0 ≤ gap(w⁺) ⟂ |p| ≥ 0, and for walls that are closed after it (gap within 1e-12 of the gap scale, or p not 0) 0 ≤ rebound ⟂
    /// |p| ≥ 0 with the rebound of
    /// [`Promise::Velocity`]. Elastic: |r| = (k_a s⁺ + c_a(s⁺ − s₊)/h)₊, and |p| the mean of |r| at both ends, times h.
    Corrected,
    /// Every wall: |p|/h = ((1−θ)|r|(s) + θ|r|(s⁺) + c_a(s⁺₊ − s₊)/h)₊ with the wall's spring |r|(s) and the θ of the balance.
    LawAtEnds,
    /// Every wall: |p|/h = (|r|(s) + c_a ṡ)₊ while s > 0, at the step's start, with the mean of v₋ and v₊ for ṡ.
    LawAtStart,
    /// Every wall: |p|/h = (ΔU/Δs + c_a(s⁺₊ − s₊)/h)₊, the discrete gradient of the wall's energy U between s and s⁺.
    DiscreteGradient,
    /// The conditions themselves, at every instant of the step's [`Arc`] or [`Series`].
    Exact,
}

/// How far a run may stray from a promise, beyond rounding, before it is refuted, and why.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Largest residual, dimensionless.
    pub limit: f64,
    /// Why as much as this and no more.
    pub reason: &'static str,
}

/// The scenes on which a scheme keeps the energy ledger closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Conserves {
    /// None: what it makes or loses is the scheme's known error, which the ledger tells and a note says.
    Nothing,
    /// Those whose walls are all rigid.
    RigidWalls,
    /// Those whose walls have no dashpot.
    UndampedWalls,
    /// All.
    Everything,
}

/// What a run may stray by and still keep its scheme's word. What a scheme does not promise (the depth behind the walls of moreau-jean, the
/// energy of newmark) is not here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Of the conditions at the walls ([`Promise`]), over the scales of gap, speed and contact force.
    pub walls: Tolerance,
    /// Of the momentum balance over the largest force in it, and of the displacement from what the velocities make of it.
    pub balance: Tolerance,
    /// Of the momentum that the walls' impulses leave open over the run, over the momentum exchanged.
    pub impulses: Tolerance,
    /// Of the energy ledger over the energy exchanged.
    pub energy: Tolerance,
    /// Where that ledger is promised to close.
    pub conserves: Conserves,
}

impl Tolerances {
    /// Those of every scheme of the crate, with the scenes on which it conserves energy.
    #[must_use]
    pub const fn of(conserves: Conserves) -> Self {
        Self {
            walls: Tolerance { limit: 1e-6, reason: "solvers meet a bound to 1e-9 of its scale; the rest is rounding" },
            balance: Tolerance { limit: 1e-6, reason: "a step's equations are solved to rounding" },
            impulses: Tolerance {
                limit: 1e-6,
                reason: "what a step's rule for the smooth forces may miss is taken off",
            },
            energy: Tolerance { limit: 1e-6, reason: "the scheme conserves energy to rounding" },
            conserves,
        }
    }
}

/// A scheme's word: constant over a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contract {
    /// The momentum balance of a step.
    pub balance: Balance,
    /// What holds at the walls.
    pub promise: Promise,
    /// Where in the step a contact impulse belongs, as a fraction of it (0: its start, 1: its end).
    pub instant: f64,
    /// How far a run may stray from all that.
    pub tolerances: Tolerances,
}

/// One episode of contact at one wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Index of the wall in the scene.
    pub wall: usize,
    /// When it began, s.
    pub start: f64,
    /// When it ended, s: equal to `start` for an instantaneous impact; none if still open at the end of the run.
    pub end: Option<f64>,
    /// Impulse of the wall on the body over the episode, N s; signed as the force (lower ≥ 0, upper ≤ 0).
    pub impulse: f64,
    /// Largest |force| in the episode, N; none where the force was not finite (an impact).
    pub peak_force: Option<f64>,
    /// Speed towards the wall just before, m/s, ≥ 0.
    pub approach_speed: f64,
    /// Speed away from the wall just after, m/s, ≥ 0; none if still open.
    pub departure_speed: Option<f64>,
}

/// What lies between the two ends of a step.
#[derive(Debug, Clone, Copy)]
pub enum Path<'a> {
    /// Nothing is known between the grid's instants.
    Grid,
    /// The same, of a step in which no displacement keeps all the bounds of [`Promise::MeanPosition`] with each wall's own e: all of
    /// them take the smallest e of the scene's rigid walls.
    OneRestitution,
    /// The exact motion and wall forces of one degree of freedom.
    Exact(&'a Arc),
    /// The same of several.
    Series(&'a Series),
    /// A step of the exact scheme over a stretch that it hands to a scheme on a grid.
    Handed {
        /// What the step keeps, in place of the run's contract.
        contract: Contract,
        /// Its length, s: that of the step's times but for their rounding.
        step: f64,
    },
}

impl Path<'_> {
    /// Displacement (m) and velocity (m/s) at `t` within the step, into slices over degrees of freedom. Nothing is written for a step on a grid.
    pub(crate) fn state(&self, t: f64, q: &mut [f64], v: &mut [f64]) {
        match self {
            Self::Grid | Self::OneRestitution | Self::Handed { .. } => {}
            Self::Exact(arc) => {
                if let (Some(q), Some(v)) = (q.first_mut(), v.first_mut()) {
                    (*q, *v) = arc.state(t);
                }
            }
            Self::Series(series) => series.state(t, q, v),
        }
    }

    /// Force of wall `wall` at `t` within the step, N, signed; 0 on a grid.
    pub(crate) fn contact_force(&self, wall: usize, t: f64) -> f64 {
        match self {
            Self::Grid | Self::OneRestitution | Self::Handed { .. } => 0.0,
            Self::Exact(arc) => arc.contact_force(wall, t),
            Self::Series(series) => series.contact_force(wall, t),
        }
    }

    /// Impulse of wall `wall` over [from, to] within the step, N s, signed; 0 on a grid.
    pub(crate) fn contact_impulse(&self, wall: usize, from: f64, to: f64) -> f64 {
        match self {
            Self::Grid | Self::OneRestitution | Self::Handed { .. } => 0.0,
            Self::Exact(arc) => arc.contact_impulse(wall, from, to),
            Self::Series(series) => series.contact_impulse(wall, from, to),
        }
    }
}

/// One step, lent by the stepper until the next one.
///
/// Slices over degrees of freedom have length n, slices over walls the number of walls, in the scene's order.
#[derive(Debug, Clone, Copy)]
pub struct Step<'a> {
    /// Number of the step, from 0.
    pub index: u64,
    /// Time at its start, s.
    pub start: f64,
    /// Time at its end, s. Equal to `start` for an impact at the very start of an exact run.
    pub end: f64,
    /// Displacement at the end, m.
    pub q: &'a [f64],
    /// Velocity at the end, m/s, right-continuous: after an impact at that instant.
    pub v: &'a [f64],
    /// Velocity that enters the momentum balance, m/s: (q − q⁻)/h for a staggered scheme, else that of the step's start.
    pub velocity_before: &'a [f64],
    /// Velocity that leaves the momentum balance, m/s: (q⁺ − q)/h for a staggered scheme, else `v`.
    pub velocity_after: &'a [f64],
    /// Impulse of each wall on the body over the step, N s, signed.
    pub impulse: &'a [f64],
    /// The part of `impulse` that acted in the instant `end`, N s; all zero for schemes on a grid, which know no instants.
    pub jump: &'a [f64],
    /// Force of each wall: at the instant `end` for the exact scheme, else the multiplier the scheme computed, which is
    /// impulse/h unless the scheme's impulse averages two of them; N, signed.
    pub force: &'a [f64],
    /// Extra force given by the caller, N, as it enters the momentum balance: constant over the step, or for a staggered scheme, whose
    /// balance is centred at `start`, the mean of the last step's and this one's; length n.
    pub extra: &'a [f64],
    /// Contact episodes that ended in this step.
    pub closed: &'a [Contact],
    /// What is known of the motion inside the step.
    pub path: Path<'a>,
}
