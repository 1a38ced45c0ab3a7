//! Random designs: every coordinate of every point is a function of seed, point and dimension only,
//! so that rows can be computed in any order, on any machine, and repeatedly.

mod latin;
mod normal;
mod sobol;

pub use normal::Normal;
pub use sobol::MOST_DIMENSIONS;

use crate::error::{Error, Result, names};
use crate::hash;

/// The kind of a random design.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Design {
    /// Independent of one another.
    Uniform,
    /// Latin hypercube: each range is cut into as many slices as there are points, and each slice
    /// has one.
    LatinHypercube,
    /// Sobol's sequence, up to [`MOST_DIMENSIONS`] dimensions.
    Sobol,
}

names!(Design: "random design", Uniform => "uniform", LatinHypercube => "lhs", Sobol => "sobol");

/// A random design over all axes of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Random {
    /// The kind of design.
    pub design: Design,
    /// Number of points.
    pub points: u64,
    /// The seed. Sobol's sequence without a seed is the plain one; with a seed it is scrambled.
    pub seed: Option<u64>,
}

/// Maximum number of points: those of a sequence of 32 bits.
const MOST_POINTS: u64 = 1 << 32;

impl Random {
    /// Coordinate `dimension` of point `point`, from 0 to below 1.
    #[must_use]
    pub fn share(&self, point: u64, dimension: usize) -> f64 {
        let seed = self.seed.unwrap_or(0);
        match self.design {
            Design::Uniform => hash::unit(hash::mix(seed, dimension as u64, point)),
            Design::LatinHypercube => latin::share(seed, self.points, point, dimension as u64),
            Design::Sobol => sobol::share(self.seed, point, dimension),
        }
    }

    pub(super) fn validate(&self, dimensions: usize) -> Result<()> {
        if self.points == 0 || self.points > MOST_POINTS {
            return Err(Error::invalid(
                "[random] points",
                self.points,
                format!("a whole number from 1 to {MOST_POINTS}"),
            ));
        }
        if self.design == Design::Sobol && dimensions > MOST_DIMENSIONS {
            let expected = format!("at most {MOST_DIMENSIONS} [[vary]]; lhs takes any number");
            return Err(Error::invalid("[random] kind", format!("sobol over {dimensions} dimensions"), expected));
        }
        Ok(())
    }
}
