//! An instant in the exact scheme of structures: what led to it, the rows whose gap is closed, and
//! what becomes of them.

/// The event that ends a stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Cause {
    /// The gap of a rigid wall closes: row and side.
    Gap(usize, usize),
    /// The force that holds a row vanishes.
    Release(usize),
    /// The phase of an elastic wall changes.
    Elastic(usize),
}

/// A row whose gap is closed at an instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct ClosedRow {
    pub row: usize,
    /// The sign of the force of the walls that are touched.
    pub sign: f64,
    /// True if walls on both sides are touched: the row cannot move.
    pub both: bool,
    /// The sign of the walls that held the row up to this instant; 0 if none did.
    pub was: f64,
    /// ẇ away from the walls before the instant, m/s.
    pub arrived: f64,
    pub restitution: f64,
    /// Impulses of the lower and the upper walls, magnitudes, N s.
    pub push: [f64; 2],
    /// True if its flight may be the tail of an accumulation of impacts.
    pub candidate: bool,
    pub fate: Fate,
    /// The force that holds it and its derivatives, N, N/s …, as `rest.rs` finds them, signed.
    pub force: [f64; LEVELS],
}

/// Number of derivatives of the acceleration that `rest.rs` examines, including itself.
pub(super) const LEVELS: usize = 3;

/// 0 for lower walls, 1 for upper ones.
pub(super) fn side_of(sign: f64) -> usize {
    usize::from(sign < 0.0)
}

/// What becomes of a row of speed 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Fate {
    /// It has speed, or is not closed.
    None,
    /// No derivative has decided.
    Open,
    /// Held, by the derivative of this order of its force.
    Held(usize),
    /// Released, by the derivative of this order of its acceleration.
    Gone(usize),
}
