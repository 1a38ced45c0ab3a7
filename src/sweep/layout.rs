//! How the points of a sweep lie over its axes.

use super::random::Random;

/// How the points of a sweep lie over its axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Layout {
    /// Every combination of the values of the axes.
    #[default]
    Grid,
    /// Drawn at random.
    Random(Random),
    /// The case itself, then each axis at its lower and at its upper bound, the others as in the
    /// case.
    OneAtATime,
}

impl Layout {
    /// The random design, where it is one.
    pub fn random(self) -> Option<Random> {
        if let Self::Random(random) = self { Some(random) } else { None }
    }

    /// Number of points over `axes` axes, which a grid has as many values of as `grid` says.
    pub fn points(self, axes: usize, grid: u64) -> u64 {
        match self {
            Self::Grid => grid,
            Self::Random(random) => random.points,
            Self::OneAtATime => 1 + 2 * axes as u64,
        }
    }

    /// The number of the point at which axis number `axis` is at its lower bound, or for `side` 1
    /// at its upper one.
    pub fn row_of(axis: usize, side: u64) -> u64 {
        1 + 2 * axis as u64 + side
    }

    /// The axis that point number `point` varies one at a time, and the share of its range there;
    /// `None` for the case itself.
    pub fn varied(point: u64) -> Option<(usize, f64)> {
        let place = point.checked_sub(1)?;
        Some(((place / 2) as usize, (place % 2) as f64))
    }
}
