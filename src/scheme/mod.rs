//! How time advances: one file per scheme, and the [`Stepper`] that drives any of them.
//!
//! | file | what it holds |
//! |---|---|
//! | `moreau_jean.rs`, `located/`, `position.rs`, `paoli_schatzman.rs`, `generalized_alpha.rs`, `penalty.rs`, `central_difference.rs` | the schemes on a grid |
//! | `event/`, `structure_event/`, `exact/` | the exact scheme, of one degree of freedom and of several, and what both share |
//! | `entry.rs`, `fits.rs` | what is known of each scheme beside its rule, and which scenes it refuses |
//! | `name.rs`, `method.rs` | schemes, and schemes with their solver, as words |
//! | `penalty_law.rs` | the springs of a penalty scheme, and the scene with them |
//! | `rule.rs`, `grid.rs` | the trait of a scheme on a grid, and the type that drives it |
//! | `space.rs`, `line.rs`, `matrices.rs` | its arithmetic: numbers, or vectors and matrices |
//! | `body.rs`, `flat_row.rs`, `blows.rs`, `start.rs` | the structure, its walls and loads, and the forces at the start |
//! | `chung_hulbert.rs` | the generalized-α rule of smooth forces, between walls and in round holes |
//! | `programme.rs`, `wall_rows.rs` | the quadratic programme of a step: walls to rows and back |
//! | `newton.rs` | walls with force laws: semismooth Newton on their forces |
//! | `staggered.rs` | shared by schemes whose velocity is half a step behind |
//! | `supports/`, `disks/` | scenes with round holes and friction |
//! | `equilibrium.rs`, `static_programme.rs` | the static start, and the programme that it solves |
//! | `handover.rs` | stretches that the exact scheme leaves to moreau-jean |
//! | `counters.rs` | the work of a run |
//! | `frame.rs` | the state, and the results of a step |
//! | `motion.rs`, `kernel.rs`, `stepper.rs` | the trait of all motions, the choice of one, and the public type |
//!
//! # One degree of freedom and many
//!
//! A scheme on a grid is written once, over a `Space`: `Line` holds numbers, and its programme is a
//! clamp; `Matrices` holds vectors, operators and factors, and its programme is condensed onto all
//! walls by `qp`. `System::Oscillator` is stepped over the line, `System::Structure` over matrices,
//! and so is an oscillator with a wall behind a lever. Modal reduction does not concern the
//! schemes: it makes another scene, whose matrices are diagonal and whose rows are dense
//! (`scene/modal/reduction.rs`). Recorder, judge, studies and output use steps and rows only.

mod blows;
mod body;
mod central_difference;
mod chung_hulbert;
mod counters;
mod disks;
mod entry;
mod equilibrium;
// For tests of the exact scheme alone; a program has Stepper.
#[doc(hidden)]
pub mod event;
mod exact;
mod fits;
mod flat_row;
mod frame;
mod generalized_alpha;
mod grid;
mod handover;
mod kernel;
mod line;
mod located;
mod matrices;
mod method;
mod moreau_jean;
mod motion;
mod name;
mod newton;
mod paoli_schatzman;
mod penalty;
mod penalty_law;
mod position;
mod programme;
mod rule;
mod space;
mod staggered;
mod start;
mod static_programme;
mod stepper;
mod structure_event;
mod supports;
mod wall_rows;

pub use counters::Counters;
pub use entry::{Coverage, Realised, SchemeEntry, SchemeKind};
pub use equilibrium::equilibrium;
pub(crate) use exact::{TAIL_CHANGE, TAIL_HEIGHT, TIME_UNITS};
pub(crate) use fits::check_exact;
#[cfg(feature = "case")]
pub(crate) use fits::check_some_scheme;
pub use handover::Handover;
pub use method::Method;
pub use penalty_law::{Integrator, PenaltyLaw};
pub use stepper::Stepper;

use crate::step::Contract;
use serde::{Deserialize, Serialize};

/// A way to advance time. What each is for and where it fails stands in its [`SchemeEntry`].
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
    /// The θ-method with θ = ½, whose steps are divided at the impacts.
    Located,
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
    /// Every scheme with its default settings, in the order in which tables list them; of the
    /// penalty, which has none, with some springs.
    pub const ALL: [Self; 8] = [
        Self::MoreauJean { theta: 0.5 },
        Self::Located,
        Self::PaoliSchatzman,
        Self::GeneralizedAlpha { rho: generalized_alpha::RHO },
        Self::ImplicitEuler,
        Self::Newmark,
        Self::Penalty {
            law: PenaltyLaw::Linear { stiffness: 1.0, damping: 0.0 },
            integrator: Integrator::DiscreteGradient,
        },
        Self::Event,
    ];

    /// What is known of the scheme beside its rule.
    #[must_use]
    pub fn entry(&self) -> &'static SchemeEntry {
        match self {
            Self::ImplicitEuler => &position::IMPLICIT_EULER,
            Self::Newmark => &position::NEWMARK,
            Self::PaoliSchatzman => &paoli_schatzman::ENTRY,
            Self::MoreauJean { .. } => &moreau_jean::ENTRY,
            Self::Located => &located::ENTRY,
            Self::GeneralizedAlpha { .. } => &generalized_alpha::ENTRY,
            Self::Penalty { .. } => &penalty::ENTRY,
            Self::Event => &exact::ENTRY,
        }
    }

    /// True for a scheme that solves a quadratic programme in every step that meets a wall. A
    /// penalty uses Newton's method, the exact scheme closed forms and series.
    #[must_use]
    pub fn has_qp(&self) -> bool {
        self.entry().kind == SchemeKind::Qp
    }

    /// True for the exact scheme, which has no step.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.entry().kind == SchemeKind::Exact
    }

    /// True for a penalty whose springs take no energy, so that their restitution tends to 1.
    pub(crate) fn is_lossless(&self) -> bool {
        matches!(self, Self::Penalty { law, .. } if law.is_lossless())
    }

    /// The equations and conditions that every step of the scheme satisfies.
    #[must_use]
    pub fn contract(&self) -> Contract {
        match *self {
            Self::ImplicitEuler => position::contract(1.0),
            Self::Newmark => position::contract(0.5),
            Self::PaoliSchatzman => paoli_schatzman::contract(),
            Self::MoreauJean { theta } => moreau_jean::contract(theta),
            Self::Located => located::contract(),
            Self::GeneralizedAlpha { rho } => generalized_alpha::contract(rho),
            Self::Penalty { integrator, .. } => penalty::contract(integrator),
            Self::Event => exact::CONTRACT,
        }
    }
}
