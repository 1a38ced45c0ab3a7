//! What is told of an instant: what led to it, the closed rows, and what becomes of them.

/// What a stretch ends with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Cause {
    /// A gap of a rigid wall closes: row and side.
    Gap(usize, usize),
    /// The force that holds a row vanishes.
    Release(usize),
    /// An elastic wall is entered, left, lets go or takes hold.
    Elastic(usize),
}

/// A closed row at an instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct ClosedRow {
    pub row: usize,
    /// The sign of the force of the walls that are touched.
    pub sign: f64,
    /// Walls of both sides are touched: the row cannot move.
    pub both: bool,
    /// The sign of the walls that held the row so far; 0 without.
    pub was: f64,
    /// ẇ away from the walls before the instant, m/s.
    pub arrived: f64,
    pub restitution: f64,
    /// Impulses of the lower and the upper walls, magnitudes, N s.
    pub push: [f64; 2],
    /// Its flight may be the tail of an accumulation.
    pub candidate: bool,
    pub fate: Fate,
}

/// 0 for lower walls, 1 for upper ones.
pub(super) fn side_of(sign: f64) -> usize {
    usize::from(sign < 0.0)
}

/// What becomes of a row without speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Fate {
    /// It has speed, or is not closed.
    None,
    /// No derivative has decided.
    Open,
    /// Held, by the derivative of this order of its force.
    Held(usize),
    /// Let go, by the derivative of this order of its acceleration.
    Gone(usize),
}
