//! Attractors.

use crate::scene::State;
use nalgebra::Complex;

/// How long a wall is touched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Lasts {
    /// An impact on a rigid wall.
    Instant,
    /// Contact with a rigid wall that lasts from the first impact on.
    Rest,
    /// Impacts on a rigid wall that accumulate and end in contact that lasts.
    Chatter,
    /// Contact with an elastic wall.
    Push,
    /// Contact with a wall that never ends.
    Always,
}

/// A wall touched along a periodic motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Touch {
    /// Index of the wall in the scene.
    pub wall: usize,
    /// The beginning of the contact, in periods of the load since the first strobe.
    pub phase: f64,
    /// The speed towards the wall then, m/s.
    pub speed: f64,
    /// How long it lasts.
    pub lasts: Lasts,
}

/// A motion that other motions approach.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Attractor {
    /// A periodic motion.
    Periodic {
        /// The states once a period of the load, at whole multiples of it: as many as the motion
        /// takes periods of the load to repeat itself.
        strobes: Vec<State>,
        /// The walls touched, in the order of time; none for a quiet motion.
        touches: Vec<Touch>,
        /// The Floquet multipliers over that time, 2n of them, the largest first.
        multipliers: Vec<Complex<f64>>,
    },
    /// Motion with a positive Lyapunov exponent.
    Chaotic,
}

impl Attractor {
    /// Number of periods of the load after which it repeats itself; `None` for a chaotic motion.
    #[must_use]
    pub fn period(&self) -> Option<usize> {
        match self {
            Self::Periodic { strobes, .. } => Some(strobes.len()),
            Self::Chaotic => None,
        }
    }
}
