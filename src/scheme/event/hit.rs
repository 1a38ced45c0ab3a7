//! Where a search ended.

/// Where the search ended.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hit {
    /// Time since the arc's start, s.
    pub tau: f64,
    /// Displacement (m) and velocity (m/s) there, from the left.
    pub state: [f64; 2],
    /// The wall of the event; `None` where there is none up to the end.
    pub wall: Option<usize>,
}
