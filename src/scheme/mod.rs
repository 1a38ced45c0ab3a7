//! How time advances: one file per scheme.

mod penalty_law;

pub use penalty_law::{Integrator, PenaltyLaw};
