//! Why there is no derivative.

use std::fmt;

/// Why a motion has no derivative with respect to its start or to a key, or why it is not known.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum NoDerivative {
    /// Coupled walls at several places (an impulse at one moves the other) were struck at one
    /// instant. In a changed motion one of them is struck first, and the result depends on which:
    /// the derivative differs from one direction of the change to another.
    Together {
        /// Time, s.
        time: f64,
        /// The names of the walls.
        walls: Vec<String>,
    },
    /// The step does not resolve its events: it was made by a scheme on a grid, or in a stretch
    /// that the exact scheme has handed to one.
    Unresolved {
        /// End of the step, s.
        time: f64,
    },
    /// The body reaches a rigid wall without speed: a small change lets it pass or be struck, and
    /// the derivative is infinite on one side. An impact that multiplies a change by more than 1e4
    /// counts as one.
    Graze {
        /// Time, s.
        time: f64,
        /// The name of the wall.
        wall: String,
    },
    /// Changes of the start have grown by more than 1e6: past this horizon the motion that is known
    /// to rounding does not determine its derivative to eight digits.
    Horizon {
        /// Time, s.
        time: f64,
        /// By what a change of the start has grown since it was smallest.
        growth: f64,
    },
    /// The body touches a wall already, and the key moves one of them only: what follows differs
    /// from one direction of the change to the other.
    Touching {
        /// Time, s.
        time: f64,
        /// The name of the wall.
        wall: String,
    },
    /// A key moves the instant of a blow that falls into a rest or an impact, or that begins or
    /// ends a push: how that changes the contact is not known.
    Blow {
        /// Time, s.
        time: f64,
        /// The name of the wall.
        wall: String,
    },
    /// A body comes to rest on a wall with restitution 0, which the key raises: in place of one
    /// contact there would be many impacts.
    Rebounds {
        /// Time, s.
        time: f64,
        /// The name of the wall.
        wall: String,
    },
}

impl NoDerivative {
    /// The reason in words, for the derivative by `key` alone.
    #[must_use]
    pub fn by(&self, key: &str) -> String {
        self.to_string().replacen("no derivative", &format!("no derivative by {key}"), 1)
    }

    /// The time at which the reason arises, s: up to there the derivative is known.
    #[must_use]
    pub fn time(&self) -> f64 {
        match self {
            Self::Together { time, .. }
            | Self::Unresolved { time }
            | Self::Graze { time, .. }
            | Self::Horizon { time, .. }
            | Self::Touching { time, .. }
            | Self::Blow { time, .. }
            | Self::Rebounds { time, .. } => *time,
        }
    }
}

impl fmt::Display for NoDerivative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Together { time, walls } => {
                let walls = walls.join("\" and \"");
                write!(f, "no derivative: the coupled walls \"{walls}\" are struck at one instant, t = {time} s")
            }
            Self::Unresolved { time } => write!(
                f,
                "no derivative: the step up to t = {time} s is of a scheme on a grid and does not resolve its events; \
                 the scheme event does"
            ),
            Self::Graze { time, wall } => {
                write!(f, "no derivative: wall {wall:?} is grazed at t = {time} s, where it is infinite")
            }
            Self::Horizon { time, growth } => write!(
                f,
                "no derivative: at t = {time} s a small change has grown by a factor of {growth:.1e}, and the \
                 motion is no longer predictable"
            ),
            Self::Touching { time, wall } => write!(
                f,
                "no derivative: at t = {time} s wall {wall:?} is touched, and the key moves wall or body away from \
                 the other, or into it"
            ),
            Self::Blow { time, wall } => write!(
                f,
                "no derivative: at t = {time} s a blow, which the key moves, falls into a contact with wall {wall:?}"
            ),
            Self::Rebounds { time, wall } => write!(
                f,
                "no derivative: the body comes to rest on wall {wall:?} at t = {time} s with a restitution of 0, and \
                 above 0 one contact becomes many impacts"
            ),
        }
    }
}

impl std::error::Error for NoDerivative {}
