//! Why there is no derivative.

use std::fmt;

/// Why a motion has no derivative with respect to its start, or none that is known.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum NoDerivative {
    /// Walls at several places that feel each other were struck at one instant. In a changed motion
    /// one is struck before the other, and what comes out depends on which: the derivative differs
    /// from one direction of the change to another.
    Together {
        /// When, s.
        time: f64,
        /// The walls, by their index in the scene.
        walls: Vec<usize>,
    },
    /// The step does not resolve its events: it is one of a scheme on a grid, or of a stretch that
    /// the exact scheme has handed to one.
    Unresolved {
        /// End of the step, s.
        time: f64,
    },
}

impl fmt::Display for NoDerivative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Together { time, walls } => write!(
                f,
                "no derivative: {} walls that feel each other are struck at one instant, t = {time} s",
                walls.len()
            ),
            Self::Unresolved { time } => write!(
                f,
                "no derivative: the step up to t = {time} s is one on a grid, which does not resolve its events; \
                 the scheme event does"
            ),
        }
    }
}

impl std::error::Error for NoDerivative {}
