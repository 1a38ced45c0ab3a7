//! How time advances: one file per scheme, and the [`Stepper`] that drives any of them.

mod central_difference;
pub mod event;
mod grid;
mod method;
mod moreau_jean;
mod name;
mod paoli_schatzman;
mod penalise;
mod penalty;
mod penalty_law;
mod position;
mod programme;
mod stepper;
mod structure;
mod structure_event;

pub use grid::Counters;
pub use method::Method;
pub use penalty_law::{Integrator, PenaltyLaw};
pub use stepper::Stepper;

use crate::step::{Balance, Contract, Promise};

/// A way to advance time. What each realises and where it fails stands in the README's table of schemes.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// Average acceleration with the walls on the displacement: an exhibit, which gains energy.
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
    /// True for a scheme whose steps that meet a wall solve a quadratic programme; a penalty solves by Newton's method, the exact scheme by hand.
    #[must_use]
    pub fn has_qp(&self) -> bool {
        !matches!(self, Self::Penalty { .. } | Self::Event)
    }

    /// What every step of the scheme keeps.
    #[must_use]
    pub fn contract(&self) -> Contract {
        let (balance, promise, instant) = match *self {
            Self::ImplicitEuler => (Balance::Theta(1.0), Promise::EndPosition, 1.0),
            Self::Newmark => (Balance::Theta(0.5), Promise::EndPosition, 1.0),
            Self::PaoliSchatzman => (Balance::Staggered(0.25), Promise::MeanPosition, 0.0),
            Self::MoreauJean { theta } => (Balance::Theta(theta), Promise::Velocity, 0.5),
            Self::Penalty { integrator, .. } => match integrator {
                Integrator::Trapezoidal => (Balance::Theta(0.5), Promise::LawAtEnds, 0.5),
                Integrator::ImplicitEuler => (Balance::Theta(1.0), Promise::LawAtEnds, 1.0),
                Integrator::CentralDifference => (Balance::Staggered(0.0), Promise::LawAtStart, 0.0),
                Integrator::DiscreteGradient => (Balance::Theta(0.5), Promise::DiscreteGradient, 0.5),
            },
            Self::Event => (Balance::Exact, Promise::Exact, 1.0),
        };
        Contract { balance, promise, instant }
    }
}
