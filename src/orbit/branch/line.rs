//! A branch in one direction, and the trait of all curves of orbits.

use super::super::periodic::Orbit;
use super::arclength::Vector;
use super::label::Label;
use super::point::Point;
use crate::error::{Error, Result};

/// Least number of points after which a curve may be found closed.
pub(super) const LEAST_LOOP: usize = 6;

/// Why a branch ends.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum End {
    /// At the end of the range of the key.
    Range,
    /// At a special point beyond which no body can follow its orbits.
    Special(Label),
    /// It has come back to its first point.
    Closed,
    /// After as many points as were asked for.
    Points,
    /// At the end of what the key accepts, with what was said about the first value beyond.
    Refused(String),
    /// Where it could not be continued, with the reason.
    Stuck(String),
}

impl End {
    /// The end at which the next orbit has this `error`.
    pub(super) fn of(error: &Error) -> Self {
        // Only a value of the key can make an invalid scene of a valid one.
        if error.is_request() { Self::Refused(error.to_string()) } else { Self::Stuck(error.to_string()) }
    }
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
    /// The branch that goes on beyond, where following this one has found it.
    pub beyond: Option<Box<Begin<C>>>,
}

/// A branch in one direction.
#[derive(Debug)]
pub(super) struct Line<C> {
    pub points: Vec<Point>,
    pub passed: Vec<Passed<C>>,
    pub end: End,
}

/// The first point of a branch, and its direction there.
#[derive(Debug, Clone)]
pub(super) struct Begin<C> {
    pub curve: C,
    pub y: Vector,
    pub along: Vector,
    /// True if the branch is to be followed in both directions.
    pub both: bool,
}

/// How orbits at one special point are compared: the mirror of the scene (the wall opposite to each
/// wall), a typical speed (m/s), and a tolerance.
#[derive(Debug)]
pub(super) struct Metric {
    pub mirror: Option<Vec<usize>>,
    pub speed: f64,
    /// Orbits are the same if they differ by less than this, in cycles and as a share of the
    /// largest speed.
    pub near: f64,
}

/// Values of the key are the same if they differ by less than this share of its range; likewise
/// orbits of one degree of freedom.
pub(super) const NODE: f64 = 1e-6;

/// A curve of orbits.
pub(super) trait Followed: Sized {
    /// The unit tangent at the solution `y`, in the direction of `along`.
    fn tangent_at(&self, y: &Vector, along: &Vector) -> Result<Vector>;

    /// Follows it from the solution `y` in the direction of `along`, while the key stays in
    /// `range`. It takes at most `most` points, the first being that at `y`, and calls `seen` with
    /// each.
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

    /// The orbit at `y`, and how it is compared with others.
    fn orbit_at(&self, y: &Vector) -> Result<(Orbit, Metric)>;
}
