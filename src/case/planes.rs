//! The planes in which a system moves, and the rows of places there.

use super::model::{Model, Place};
use crate::error::Result;
use crate::scene::{PlaneRows, Row};

/// The planes in which the system of a case moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Planes {
    /// One: every place has one displacement.
    #[default]
    One,
    /// The same system in the planes y and z, with this many degrees of freedom in each: all of y,
    /// then all of z.
    Two(usize),
    /// Two planes within matrices or modes: each place names its rows.
    Named,
}

impl Planes {
    /// Modes of the scene for each mode that a case file counts: 2 where each is kept in both
    /// planes.
    #[must_use]
    pub fn modes(self) -> usize {
        if let Self::Two(_) = self { 2 } else { 1 }
    }

    /// True where places need a direction.
    #[must_use]
    pub fn is_two(self) -> bool {
        self != Self::One
    }

    /// The row of a location on `model`; its errors are those of the bar, beam or modes.
    pub(super) fn row(self, model: &Model, place: &Place) -> Result<Row> {
        match place {
            Place::Towards { place, degrees } => Ok(self.rows(model, place)?.along(*degrees)),
            place => model.row(place),
        }
    }

    /// The rows of a location in both planes; in one plane nothing moves along z.
    pub(super) fn rows(self, model: &Model, place: &Place) -> Result<PlaneRows> {
        match (self, place) {
            (_, Place::Rows { y, z }) => Ok(PlaneRows { y: Row::new(y.clone()), z: Row::new(z.clone()) }),
            (_, Place::Relative { place, to }) => Ok(self.rows(model, place)?.relative_to(&self.rows(model, to)?)),
            (Self::Two(n), place) => Ok(PlaneRows::doubled(&model.row(place)?, n)),
            (Self::Named, Place::Points(points)) => {
                let along = |plane: &str| {
                    let of_plane = |(name, weight): &(String, f64)| (format!("{name}-{plane}"), *weight);
                    model.row(&Place::Points(points.iter().map(of_plane).collect()))
                };
                Ok(PlaneRows { y: along("y")?, z: along("z")? })
            }
            (_, place) => Ok(PlaneRows { y: model.row(place)?, z: Row::new(Vec::new()) }),
        }
    }
}
