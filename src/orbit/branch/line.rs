//! A branch in one direction, and what any kind of curve of orbits can do.

use super::super::periodic::Orbit;
use super::arclength::Vector;
use super::label::Label;
use super::point::Point;
use crate::error::Result;

/// Why a branch ends.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum End {
    /// At the end of the range of the key.
    Range,
    /// At a special point beyond which its orbits are none.
    Special(Label),
    /// Where it began.
    Closed,
    /// After as many points as were asked for.
    Points,
    /// Where it could not be continued, with the reason.
    Stuck(String),
}

/// A special point that was passed.
#[derive(Debug, Clone)]
pub(super) struct Passed<C> {
    pub label: Label,
    pub event: usize,
    pub wall: Option<usize>,
    pub point: Point,
    pub curve: C,
    pub y: Vector,
    /// How many points of the branch lie before it.
    pub after: usize,
    /// Where the orbits go on beyond, if following them has told.
    pub beyond: Option<Box<Begin<C>>>,
}

/// A branch in one direction.
#[derive(Debug)]
pub(super) struct Line<C> {
    pub points: Vec<Point>,
    pub passed: Vec<Passed<C>>,
    pub end: End,
}

/// Where a branch begins, and to which side it goes.
#[derive(Debug, Clone)]
pub(super) struct Begin<C> {
    pub curve: C,
    pub y: Vector,
    pub along: Vector,
    /// True if it goes on to both sides.
    pub both: bool,
}

/// What orbits at one place are compared by: the mirror of the scene (the wall opposite to each
/// wall), a typical speed (m/s), and how near.
#[derive(Debug)]
pub(super) struct Metric {
    pub mirror: Option<Vec<usize>>,
    pub speed: f64,
    /// Orbits within this, in cycles and as a share of the largest speed, are one.
    pub near: f64,
}

/// Values of the key within this share of its range are one, and orbits of one degree of freedom
/// within the same.
pub(super) const NODE: f64 = 1e-6;

/// A curve of orbits.
pub(super) trait Followed: Sized {
    /// The unit tangent at `y`, a solution, on the side of `along`.
    fn tangent_at(&self, y: &Vector, along: &Vector) -> Result<Vector>;

    /// Follows it from `y`, a solution, on the side of `along`, while the key stays in `range`. At
    /// most `most` points, the first being that at `y`; `seen` is told each.
    fn follow(
        &self,
        y: Vector,
        along: &Vector,
        range: [f64; 2],
        most: usize,
        seen: &mut dyn FnMut(&Point),
    ) -> Result<Line<Self>>;

    /// The branch that begins at the special point `at` of this one.
    ///
    /// # Errors
    /// [`Error::NoOrbit`](crate::Error::NoOrbit) where none was found, with the reason.
    fn switch(&self, at: &Passed<Self>) -> Result<Begin<Self>>;

    /// The orbit at `y`, and what it is compared by.
    fn orbit_at(&self, y: &Vector) -> Result<(Orbit, Metric)>;
}
