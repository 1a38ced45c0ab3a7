//! Why there is no derivative.

use std::fmt;

/// Why a motion has no derivative with respect to its start, or why it is not known.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum NoDerivative {
    /// Coupled walls at several places (an impulse at one moves the other) were struck at one
    /// instant. In a changed motion one of them is struck first, and the result depends on which:
    /// the derivative differs from one direction of the change to another.
    Together {
        /// Time, s.
        time: f64,
        /// The walls, by their index in the scene.
        walls: Vec<usize>,
    },
    /// The step does not resolve its events: it was made by a scheme on a grid, or in a stretch
    /// that the exact scheme has handed to one.
    Unresolved {
        /// End of the step, s.
        time: f64,
    },
}

impl fmt::Display for NoDerivative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Together { time, walls } => {
                write!(f, "no derivative: {} coupled walls are struck at one instant, t = {time} s", walls.len())
            }
            Self::Unresolved { time } => write!(
                f,
                "no derivative: the step up to t = {time} s is of a scheme on a grid and does not resolve its events; \
                 the scheme event does"
            ),
        }
    }
}

impl std::error::Error for NoDerivative {}
