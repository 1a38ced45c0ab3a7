//! Counters of what a solver has done.

/// What a solver has done since it was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SolverCounters {
    /// Programmes solved or refused.
    pub solves: u64,
    /// Programmes whose free motion violated no bound: no solver was needed.
    pub free: u64,
    /// Iterations of the interior-point method.
    pub iterations: u64,
    /// Rows whose state pivoting changed (brought into play or freed), relative to its warm start.
    pub pivots: u64,
    /// Programmes on which the condensed solver's pivoting did not settle, or found that bounds
    /// cross, so that it started once more from the active set that Clarabel found.
    pub fallbacks: u64,
    /// Programmes with so many rows in play that their unknowns were eliminated on the band of A.
    pub eliminated: u64,
    /// Programmes with more rows than the motion has degrees of freedom that a dual active-set
    /// method took over from pivoting, whether or not it settled.
    pub crowded: u64,
}

impl SolverCounters {
    /// Adds what another solver has done.
    pub(crate) fn add(&mut self, other: Self) {
        let Self { solves, free, iterations, pivots, fallbacks, eliminated, crowded } = other;
        self.solves += solves;
        self.free += free;
        self.iterations += iterations;
        self.pivots += pivots;
        self.fallbacks += fallbacks;
        self.eliminated += eliminated;
        self.crowded += crowded;
    }
}
