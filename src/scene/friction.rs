//! The coefficients of Coulomb friction of a wall.

use super::system::nonnegative;
use crate::error::{Error, Result, Subject};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Largest coefficient of friction that is accepted.
const MOST_FRICTION: f64 = 10.0;

/// The coefficients of Coulomb friction of a wall: how much of its push it transmits along it, at
/// most.
///
/// A number is both at once; a difference between the two is a law with hysteresis
/// ([`Friction`](crate::Friction)).
///
/// ```
/// use signorini::FrictionCoefficients;
///
/// let plain = FrictionCoefficients::from(0.2);
/// let steel = FrictionCoefficients { sticking: 0.3, ..plain };
/// assert_eq!((plain.to_string(), steel.to_string()), ("0.2".to_owned(), "0.3 static, 0.2 kinetic".to_owned()));
/// assert!(steel.drops() && !plain.drops());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct FrictionCoefficients {
    /// The static one, μ_s, of a contact that sticks; from the kinetic one to 10.
    #[serde(rename = "static")]
    pub sticking: f64,
    /// The kinetic one, μ_k, of a contact that slides; from 0.
    #[serde(rename = "kinetic")]
    pub sliding: f64,
}

impl FrictionCoefficients {
    /// True if there is friction.
    #[must_use]
    pub fn acts(self) -> bool {
        self.sticking > 0.0
    }

    /// True if the friction drops where a slide begins: the static coefficient is above the kinetic
    /// one.
    #[must_use]
    pub fn drops(self) -> bool {
        self.sticking > self.sliding
    }

    /// The one that limits the friction of a contact now, by whether it `stuck` just before.
    pub(crate) fn limit(self, stuck: bool) -> f64 {
        if stuck { self.sticking } else { self.sliding }
    }

    /// The larger of each coefficient.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self { sticking: self.sticking.max(other.sticking), sliding: self.sliding.max(other.sliding) }
    }

    /// Refuses coefficients of the wall or support `owner` that are negative, above
    /// [`MOST_FRICTION`] or not finite, and a static one below the kinetic one.
    pub(super) fn validate(self, owner: &Subject) -> Result<()> {
        let whole = || owner.clone().part("friction");
        // One number is named as a whole.
        let one = self.sticking == self.sliding || (self.sticking.is_nan() && self.sliding.is_nan());
        let part = |name: &'static str| if one { whole() } else { whole().part(name) };
        for (name, value) in [("static", self.sticking), ("kinetic", self.sliding)] {
            nonnegative(part(name), value)?;
            if value > MOST_FRICTION {
                return Err(Error::invalid(part(name), format!("{value:?}"), format!("from 0 to {MOST_FRICTION}")));
            }
        }
        if self.sticking < self.sliding {
            let expected = format!("at least the kinetic coefficient, {:?}", self.sliding);
            return Err(Error::invalid(part("static"), format!("{:?}", self.sticking), expected));
        }
        Ok(())
    }
}

impl From<f64> for FrictionCoefficients {
    fn from(both: f64) -> Self {
        Self { sticking: both, sliding: both }
    }
}

impl fmt::Display for FrictionCoefficients {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.sticking == self.sliding {
            return write!(f, "{:?}", self.sliding);
        }
        write!(f, "{:?} static, {:?} kinetic", self.sticking, self.sliding)
    }
}
