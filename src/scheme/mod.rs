//! How time advances: one file per scheme, and the [`Stepper`] that drives any of them.
//!
//! | file | what it holds |
//! |---|---|
//! | `moreau_jean.rs`, `position.rs`, `paoli_schatzman.rs`, `generalized_alpha.rs`, `penalty.rs`, `central_difference.rs` | the schemes on a grid |
//! | `event/`, `structure_event/`, `exact/` | the exact scheme, of one degree of freedom and of several, and what both share |
//! | `rule.rs`, `grid.rs` | the trait of a scheme on a grid, and the type that drives it |
//! | `space.rs`, `line.rs`, `matrices.rs` | its arithmetic: numbers, or vectors and matrices |
//! | `body.rs`, `face.rs`, `blows.rs`, `start.rs` | the structure, its walls and loads, and the forces at the start |
//! | `chung_hulbert.rs` | the generalized-α rule of smooth forces, between walls and in round holes |
//! | `programme.rs`, `wall_rows.rs` | the quadratic programme of a step: walls to rows and back |
//! | `newton.rs` | walls with force laws: semismooth Newton on their forces |
//! | `staggered.rs` | shared by schemes whose velocity is half a step behind |
//! | `supports/`, `disks/`, `pushes.rs` | scenes with round holes and friction, and their contact episodes |
//! | `jumps.rs` | jumps of loads within a step |
//! | `frame.rs` | the state, and the results of a step |
//! | `motion.rs`, `kernel.rs`, `stepper.rs` | the trait of all motions, the choice of one, and the public type |

mod blows;
mod body;
mod central_difference;
mod chung_hulbert;
mod counters;
mod disks;
mod equilibrium;
// For tests of the exact scheme alone; a program has Stepper.
#[doc(hidden)]
pub mod event;
mod exact;
mod face;
mod frame;
mod generalized_alpha;
mod grid;
mod handed;
mod jumps;
mod kernel;
mod line;
mod matrices;
mod method;
mod moreau_jean;
mod motion;
mod name;
mod newton;
mod paoli_schatzman;
mod penalise;
mod penalty;
mod penalty_law;
mod position;
mod programme;
mod pushes;
mod rule;
mod space;
mod staggered;
mod start;
mod stepper;
mod structure_event;
mod supports;
mod wall_rows;

pub use counters::Counters;
pub use equilibrium::equilibrium;
pub use handed::Handed;
pub use method::Method;
pub use name::NAMES;
pub use penalty_law::{Integrator, PenaltyLaw};
pub use stepper::Stepper;

use crate::step::{
    Balance, Bound, Conserves, Contract, Elastic, Friction, Law, Normal, Promise, PromisedForce, Reached, Rigid,
    Tolerances, Turning,
};
use serde::{Deserialize, Serialize};

/// A way to advance time. What each realises and where it fails stands in the README's table of
/// schemes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Scheme {
    /// Backward Euler with the walls on the displacement: e = 0, whatever the walls say.
    ImplicitEuler,
    /// Central differences with the restitution in the bound.
    PaoliSchatzman,
    /// The impact law on the velocity, with the θ-method between impacts.
    MoreauJean {
        /// θ in [½, 1]: ½ conserves energy, more damps.
        theta: f64,
    },
    /// Nonsmooth generalized-α: the walls on the displacement, then on the velocity.
    GeneralizedAlpha {
        /// ρ∞ in [0, 1], the factor by which a step multiplies the fastest free vibrations: 1
        /// conserves them, 0 removes them in one step.
        rho: f64,
    },
    /// Average acceleration with the walls on the displacement: for demonstration, since it
    /// gains energy.
    Newmark,
    /// Rigid walls replaced by springs.
    Penalty {
        /// The spring.
        law: PenaltyLaw,
        /// The rule that steps through it.
        integrator: Integrator,
    },
    /// The exact motion from event to event: the reference.
    Event,
}

impl Scheme {
    /// True for a scheme that solves a quadratic programme in every step that meets a wall. A
    /// penalty uses Newton's method, the exact scheme closed forms and series.
    #[must_use]
    pub fn has_qp(&self) -> bool {
        !matches!(self, Self::Penalty { .. } | Self::Event)
    }

    /// The equations and conditions that every step of the scheme satisfies.
    #[must_use]
    pub fn contract(&self) -> Contract {
        let (balance, promise, instant) = match *self {
            Self::ImplicitEuler => (Balance::Theta(1.0), end_position(), 1.0),
            Self::Newmark => (Balance::Theta(0.5), end_position(), 1.0),
            Self::PaoliSchatzman => {
                (Balance::Staggered(0.25), rigid(Some(Bound::Reflected), None, Law::MeanDepth(0.25)), 0.0)
            }
            Self::MoreauJean { theta } => {
                let mut promise = rigid(None, Some(Reached::Ahead(0.5)), Law::Depth(theta));
                (promise.round, promise.friction) = (Some(supports::TURNING), Some(Friction::EndVelocity));
                (Balance::Theta(theta), promise, 0.5)
            }
            Self::GeneralizedAlpha { rho } => {
                let mut promise = rigid(Some(Bound::End), Some(Reached::Closed), Law::Depth(1.0));
                promise.elastic.force = PromisedForce::Trapezoid;
                promise.hole = Some(Bound::End);
                promise.round = Some(Turning { normal: Normal::Middle(supports::CROSSING), ..supports::TURNING });
                (generalized_alpha(rho), promise, 0.5)
            }
            Self::Penalty { integrator, .. } => match integrator {
                Integrator::Trapezoidal => (Balance::Theta(0.5), Promise::springs(Law::Ends(0.5)), 0.5),
                Integrator::ImplicitEuler => (Balance::Theta(1.0), Promise::springs(Law::Ends(1.0)), 1.0),
                Integrator::CentralDifference => (Balance::Staggered(0.0), Promise::springs(Law::Start), 0.0),
                Integrator::DiscreteGradient => (Balance::Theta(0.5), Promise::springs(Law::Gradient), 0.5),
            },
            Self::Event => (Balance::Exact, Promise::throughout(), 1.0),
        };
        let conserves = match *self {
            Self::MoreauJean { theta: 0.5 } => Conserves::RigidWalls,
            Self::Penalty { integrator: Integrator::DiscreteGradient, .. } => Conserves::UndampedWalls,
            Self::Event => Conserves::Everything,
            _ => Conserves::Nothing,
        };
        Contract { balance, promise, instant, tolerances: Tolerances::of(conserves) }
    }
}

/// Conditions at rigid walls on the mean force of a step, and the law of the others on that mean.
fn rigid(displacement: Option<Bound>, velocity: Option<Reached>, law: Law) -> Promise {
    let force = PromisedForce::Mean;
    Promise {
        rigid: Rigid { force, displacement, velocity },
        elastic: Elastic { force, law },
        round: None,
        circle: None,
        hole: None,
        friction: None,
    }
}

/// Walls on the displacement at the end of the step, by the force there.
fn end_position() -> Promise {
    let force = PromisedForce::End;
    Promise {
        rigid: Rigid { force, displacement: Some(Bound::End), velocity: None },
        elastic: Elastic { force, law: Law::Depth(1.0) },
        round: None,
        circle: None,
        hole: Some(Bound::End),
        friction: None,
    }
}

/// The rule's weights (Chung & Hulbert 1993, doi:10.1115/1.2900803, eqs 17, 20 and 25): order 2,
/// and the least damping of slow vibrations that ρ∞ allows.
fn generalized_alpha(rho: f64) -> Balance {
    let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
    let gamma = 0.5 + alpha_f - alpha_m;
    Balance::GeneralizedAlpha { alpha_m, alpha_f, beta: 0.25 * (gamma + 0.5).powi(2), gamma }
}
